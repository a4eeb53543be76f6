"""What pymunk answers to the questions of unit 09, and the inputs that are recorded. Grader's side only."""

from pathlib import Path

import numpy as np

import exercises
from exercises.grader.recordings import EngineOracle

right = exercises.part("09_error_correction", "answers")
FOLDER = Path(__file__).resolve().parent / "recordings"
CASES = 24
NO_LIMIT = 1e9  # m/s


def two_bodies(space, x, v, mass):
    """Two bodies on the x axis, added to the space."""
    import pymunk

    bodies = [pymunk.Body(float(m), 1.0) for m in mass]
    for body, place, speed in zip(bodies, x, v, strict=True):
        body.position, body.velocity = (float(place), 0.0), (float(speed), 0.0)
    space.add(*bodies)
    return bodies


def run(space, bodies, dt, steps):
    for _ in range(steps):
        space.step(float(dt))
    return np.array([body.position.x for body in bodies]), np.array([body.velocity.x for body in bodies])


def pin_in_pymunk(x, v, mass, length, error_bias, max_bias, dt, steps):
    """(x, v) of two bodies on a line, joined by a PinJoint of that length."""
    import pymunk

    space = pymunk.Space()
    bodies = two_bodies(space, x, v, mass)
    joint = pymunk.PinJoint(*bodies)
    joint.distance, joint.error_bias, joint.max_bias = float(length), float(error_bias), float(max_bias)
    space.add(joint)
    return run(space, bodies, dt, steps)


def lift_in_pymunk(x, v, mass, radius, bias, slop, dt, steps):
    """(x, v) of two discs on a line, which may overlap."""
    import pymunk

    space = pymunk.Space()
    space.collision_bias, space.collision_slop = float(bias), float(slop)
    for body in two_bodies(space, x, v, mass):
        space.add(pymunk.Circle(body, float(radius)))
    return run(space, space.bodies, dt, steps)


def pinned(stretch, v, mass, error_bias=0.1, max_bias=NO_LIMIT, dt=0.02, steps=1, length=1.0):
    pair = {"x": np.array([0.0, length + stretch]), "v": np.array(v, dtype=float)}
    law = {"length": length, "error_bias": error_bias, "max_bias": max_bias}
    return {**pair, "mass": np.array(mass, dtype=float), **law, "dt": dt, "steps": steps}


def overlapping(depth, v, mass, bias=0.1, slop=0.01, dt=0.02, steps=1, radius=0.5):
    pair = {"x": np.array([0.0, 2 * radius - depth]), "v": np.array(v, dtype=float)}
    law = {"radius": radius, "bias": bias, "slop": slop}
    return {**pair, "mass": np.array(mass, dtype=float), **law, "dt": dt, "steps": steps}


PINS = {
    "fits, and is pulled apart: both go on together": pinned(0.0, [-1, 2], [1, 2]),
    "stretched by 30 cm, one step": pinned(0.3, [0, 0], [1, 3]),
    "the same, ten steps": pinned(0.3, [0, 0], [1, 3], steps=10),
    "no faster than max_bias": pinned(0.3, [0, 0], [1, 3], max_bias=0.2, steps=10),
}
LIFTS = {
    "touch and press on: no rebound": overlapping(0.001, [1, -1], [1, 3], slop=0.01),
    "20 cm deep, at rest, two steps": overlapping(0.2, [0, 0], [1, 3], steps=2),
    "the same, thirty steps: slop is left": overlapping(0.2, [0, 0], [1, 3], steps=30),
    "already leaving: nothing holds them": overlapping(0.1, [-0.3, 0.5], [1, 3], steps=5),
}


def number(stream, low, high):
    return round(float(stream.uniform(low, high)), 3)


def any_pin(stream):
    """Any stretched pair; in every second case ``max_bias`` holds at first."""
    stretch = number(stream, 0.1, 0.4) * float(stream.choice([-1, 1]))
    v = [number(stream, -1, 1), number(stream, -1, 1)]
    mass = [number(stream, 0.5, 1.5), number(stream, 2, 4)]
    limit = number(stream, 0.05, 0.1) if stream.integers(2) else NO_LIMIT
    dt, steps = number(stream, 0.01, 0.05), int(stream.integers(5, 30))
    return pinned(stretch, v, mass, number(stream, 0.02, 0.3), limit, dt, steps, number(stream, 0.6, 1.5))


def any_lift(stream):
    """Any overlapping pair, at rest or moving: towards each other, or apart but not yet out of it."""
    mass = [number(stream, 0.5, 1.5), number(stream, 2, 4)]
    speed, apart = number(stream, -0.5, 0.5), number(stream, -1, 0)
    dt, steps = number(stream, 0.01, 0.03), int(stream.integers(5, 20))
    law = (number(stream, 0.02, 0.3), number(stream, 0.01, 0.03))
    return overlapping(
        number(stream, 0.1, 0.3), [speed, speed + apart], mass, *law, dt, steps, number(stream, 0.4, 0.8)
    )


def pin_inputs():
    stream = np.random.default_rng(91)
    return [*PINS.values(), *(any_pin(stream) for _ in range(CASES))]


def lift_inputs():
    stream = np.random.default_rng(92)
    return [*LIFTS.values(), *(any_lift(stream) for _ in range(CASES))]


PIN = EngineOracle(
    "pymunk",
    FOLDER / "pin_pymunk.json",
    pin_in_pymunk,
    pin_inputs,
    {"joint": "PinJoint between the centres", "iterations": 10, "gravity": 0, "damping": 1},
    model=right.pin,
)
LIFT = EngineOracle(
    "pymunk",
    FOLDER / "lift_pymunk.json",
    lift_in_pymunk,
    lift_inputs,
    {"shape": "Circle", "friction": 0, "elasticity": 0, "iterations": 10, "gravity": 0, "damping": 1},
    model=right.lift,
)
ENGINES = (PIN, LIFT)
