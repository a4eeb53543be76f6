"""What pymunk answers to the questions of unit 03, and the inputs that are recorded. Grader's side only."""

from pathlib import Path

import numpy as np

import exercises
from exercises.grader.recordings import EngineOracle

right = exercises.part("03_jacobian", "answers")

FOLDER = Path(__file__).resolve().parent / "recordings"
CASES = 24


def gears_in_pymunk(radii, inertia, omega):
    """(ω_i, ω_j, λ): two wheels on fixed bearings, joined by pymunk's GearJoint for one step.

    pymunk keeps ω_j·ratio − ω_i = 0, so ratio = −R_j/R_i. λ is read off the change of the first wheel's
    angular momentum, R_i λ.
    """
    import pymunk

    space = pymunk.Space()
    wheels = [pymunk.Body(1.0, float(moment)) for moment in inertia]
    for k, wheel in enumerate(wheels):
        wheel.position = (10.0 * k, 0.0)
        wheel.angular_velocity = float(omega[k])
    gear = pymunk.GearJoint(*wheels, 0.0, -float(radii[1] / radii[0]))
    gear.max_bias = 0.0  # pymunk moves positions first, and would correct the angles that come of it
    space.add(*wheels, gear)
    space.step(0.01)
    ω = [wheel.angular_velocity for wheel in wheels]
    return ω[0], ω[1], float(inertia[0]) * (ω[0] - float(omega[0])) / float(radii[0])


def wheels(radii, inertia, omega):
    return {"radii": np.array(radii), "inertia": np.array(inertia), "omega": np.array(omega)}


GEARS = {
    "equal radii, one twice as heavy and at rest": wheels([1.0, 1.0], [2.0, 4.0], [3.0, 0.0]),
    "they already fit: nothing happens": wheels([0.5, 1.0], [1.0, 3.0], [4.0, -2.0]),
    "a small wheel runs against a heavy one": wheels([0.2, 0.7], [0.1, 5.0], [9.0, 1.0]),
}


def any_wheels(stream):
    """Any two wheels in mesh, turning as they like."""
    radii, inertia = np.round(stream.uniform(0.2, 1.5, 2), 3), np.round(stream.uniform(0.2, 4, 2), 3)
    return wheels(radii, inertia, np.round(stream.uniform(-5, 5, 2), 3))


def gears_inputs():
    stream = np.random.default_rng(31)
    return [*GEARS.values(), *(any_wheels(stream) for _ in range(CASES))]


WHEELS = EngineOracle(
    "pymunk",
    FOLDER / "gears_pymunk.json",
    gears_in_pymunk,
    gears_inputs,
    {"joint": "GearJoint, phase 0, max_bias 0", "steps": 1, "gravity": 0, "damping": 1},
    model=right.gears,
)
ENGINES = (WHEELS,)
