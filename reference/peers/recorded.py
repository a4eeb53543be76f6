"""Recordings of what an engine did, for where it can't be installed: pybullet has wheels for one platform
only.

``python -m reference.peers.recorded`` makes all of them anew, where the engines are. Each is a JSON file in
``recordings/``: engine, version, platform; the case with its parameters, dt, record_every and the engine's
settings; and the motion. The tests check our integrators (of trees: ten lines of NumPy) against them
everywhere, and where the engine is installed record again and compare.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import json
import platform
from pathlib import Path

import numpy as np

from ..cases import CASES
from ..cases.case import Catalogue
from ..layout import Bodies
from ..trajectory import ContactHistory, Trajectory
from . import simulate_in

FOLDER = Path(__file__).with_name("recordings")
ARRAYS = ("time", "position", "orientation", "velocity", "angular_velocity")
RECORDINGS = Catalogue(
    "recording",
    {  # name: engine, case, its parameters, steps, record_every, the engine's settings
        "pybullet_free_fall": ("pybullet", "free_fall", {}, 480, 48, {}),
        "pybullet_tumbling_box": ("pybullet", "tumbling_box", {}, 480, 48, {"body": "multibody"}),
        "pybullet_tumbling_box_rigid": ("pybullet", "tumbling_box", {}, 480, 48, {"body": "rigid"}),
        "pybullet_spring": ("pybullet", "spring", {}, 1000, 100, {}),
        "pybullet_double_pendulum": ("pybullet", "double_pendulum", {"dimension": 3}, 2000, 100, {}),
        "pybullet_chain": ("pybullet", "chain", {"dimension": 3, "duration": 1.0}, 1000, 50, {}),
        "pymunk_double_pendulum": ("pymunk", "double_pendulum", {}, 2000, 100, {"error_bias": 0.0}),
        "pymunk_planar_flight": ("pymunk", "planar_flight", {}, 480, 48, {}),
        "pymunk_spring": ("pymunk", "spring", {"dimension": 2}, 1000, 100, {}),
    },
)


def record(name):
    """Run the engine: a recording, as a dictionary that JSON can hold."""
    engine, case_name, parameters, steps, every, settings = RECORDINGS[name]
    case = CASES[case_name](**parameters)
    run = simulate_in(
        case.scene, engine, case.duration, case.duration / steps, record_every=every, **settings
    )
    return {
        "engine": engine,
        "version": run.settings["version"],
        "platform": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "case": case_name,
        "parameters": parameters,
        "steps": steps,
        "dt": run.settings["dt"],
        "record_every": every,
        "settings": run.settings,
        **{key: getattr(run, key).tolist() for key in ARRAYS},
    }


def load(name):
    """A committed recording: (dictionary of its inputs, Trajectory)."""
    RECORDINGS[name]  # an unknown name raises KeyError with the list
    data = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    scene = CASES[data["case"]](**data["parameters"]).scene
    arrays = {key: np.array(data.pop(key)) for key in ARRAYS}
    contacts = ContactHistory.empty(len(arrays["time"]), scene.dimension)
    return data, Trajectory(Bodies(scene), **arrays, contacts=contacts, settings=data["settings"])


def main():
    """Make all recordings anew."""
    FOLDER.mkdir(exist_ok=True)
    for name in RECORDINGS:
        text = json.dumps(record(name), indent=None)
        (FOLDER / f"{name}.json").write_text(text + "\n", encoding="utf-8")
        print(f"recorded {name}: {len(text)} characters")


if __name__ == "__main__":
    main()
