"""``python -m reference``: compile all loops now, so that no run waits for it. ``course.py lab`` does it.

It takes a few minutes after set-up or after a change of the sources, and no time where it was done before.

Slides S4, S9, S12; lectures/02_equation_of_motion.md.
"""

from tqdm import tqdm

from .code_cache import code_folder
from .compiled import COMPILED
from .integrators import INTEGRATORS
from .joints import Distance
from .scene import Scene
from .shapes import Box, Plane, Point
from .simulators import Simulation

CONTACT = 8  # times what an integrator takes, roughly


def main():
    """Run a few steps of each kind; a file in the cache's folder remembers that it was done."""
    folder = code_folder("reference.__main__") if COMPILED else None
    if folder is None or (folder / "complete").exists():
        return
    parts = [(1, point(), {"integrator": name}) for name in INTEGRATORS]
    parts += [(1, joined_point(), {}), (CONTACT, bouncing_boxes(2), {}), (CONTACT, bouncing_boxes(3), {})]
    shares = sum(share for share, _, _ in parts)
    form = "{desc}: {percentage:3.0f}%|{bar}| {elapsed} so far"
    with tqdm(total=shares, desc="compiling the reference, once", bar_format=form) as bar:
        for share, scene, settings in parts:
            Simulation(scene, 0.1, **settings).advance(0.4)
            bar.update(share)
    (folder / "complete").touch()


def point():
    """A point mass."""
    scene = Scene()
    scene.add(Point())
    return scene


def joined_point():
    """One on a rod."""
    scene = point()
    scene.join(Distance(0, point_b=(0, 0, 1)))
    return scene


def bouncing_boxes(d):
    """A box that bounces, and two that overlap, in d dimensions: all that a step with contact can do."""
    up = (0.0,) * (d - 1)
    scene = Scene(gravity=(*up, -9.81))
    scene.add(Plane((*up, 1.0)))
    for x, height, restitution in ((0.0, 0.7, 0.5), (5.0, 0.4, 0.0), (5.0, 1.4, 0.0)):
        scene.add(Box((0.5,) * d), position=(x, *up[1:], height), restitution=restitution)
    return scene


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        raise SystemExit(130) from None
