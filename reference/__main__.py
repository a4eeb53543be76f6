"""``python -m reference``: compile all loops now, so that no run waits for it. ``course.py lab`` does it.

It takes a minute or two after set-up or after a change of the sources, and no time where it was done before.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

from tqdm import tqdm

from .code_cache import code_folder
from .compiled import COMPILED
from .integrators import INTEGRATORS
from .joints import Distance
from .scene import Scene
from .shapes import Point
from .simulators import Simulation


def main():
    """Run one step with each integrator, and one with a joint; a file in the cache's folder remembers it."""
    folder = code_folder("reference.__main__") if COMPILED else None
    if folder is None or (folder / "complete").exists():
        return
    scene = Scene()
    scene.add(Point())
    for name in tqdm(INTEGRATORS, desc="compiling the reference, once", unit="integrator"):
        Simulation(scene, 0.1, integrator=name).step()
    scene.join(Distance(0, point_b=(0, 0, 1)))
    Simulation(scene, 0.1).step()
    (folder / "complete").touch()


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        raise SystemExit(130) from None
