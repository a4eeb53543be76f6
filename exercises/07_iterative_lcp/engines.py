"""What pymunk answers to the question of unit 07, and the inputs that are recorded. Grader's side only."""

from pathlib import Path

import numpy as np

import exercises
from exercises.grader.recordings import EngineOracle

right = exercises.part("07_iterative_lcp", "answers")

FOLDER = Path(__file__).resolve().parent / "recordings"
GRAVITY, CASES, SECONDS = 9.81, 24, 2.0


def stack_in_pymunk(count, mass, dt, omega, r):
    """Forces in N below each box of a stack at rest: equal boxes of 1 m, as CASES' safe oracle is set.

    omega, r: not pymunk's business. dt: its own step is 1 ms, whatever is asked.
    """
    import pymunk

    space = pymunk.Space()
    space.gravity, space.iterations, space.collision_slop = (0.0, -GRAVITY), 100, 1e-3
    ground = pymunk.Segment(space.static_body, (-20, 0), (20, 0), 0.0)
    ground.friction = 0.5
    space.add(ground)
    boxes = []
    for i in range(count):
        body = pymunk.Body(mass, pymunk.moment_for_box(mass, (1, 1)))
        body.position = (0.0, 0.5 + i)
        shape = pymunk.Poly.create_box(body, (1, 1))
        shape.friction = 0.5
        space.add(body, shape)
        boxes.append(body)
    for _ in range(round(SECONDS * 1000)):
        space.step(1e-3)
    forces = np.zeros(count)
    for i, body in enumerate(boxes):
        below = boxes[i - 1] if i else space.static_body

        def meet(arbiter, i=i, below=below):
            if below in (shape.body for shape in arbiter.shapes):
                forces[i] += abs(arbiter.total_impulse.y) * 1e3

        body.each_arbiter(meet)
    return forces


def stack(count, mass, dt=0.01, omega=1.2, r=1.7):
    return {"count": count, "mass": mass, "dt": dt, "omega": omega, "r": r}


STACKS = {
    "one box: its weight": stack(1, 2.0),
    "two boxes": stack(2, 1.5, 0.02),
    "five boxes": stack(5, 3.0, 0.005),
}


def stack_inputs():
    stream, inputs = np.random.default_rng(71), list(STACKS.values())
    for _ in range(CASES):
        count, mass = int(stream.integers(2, 9)), round(stream.uniform(0.5, 5), 3)
        inputs.append(stack(count, mass, round(stream.uniform(0.002, 0.05), 4)))
    return inputs


STACK = EngineOracle(
    "pymunk",
    FOLDER / "stack_pymunk.json",
    stack_in_pymunk,
    stack_inputs,
    {"dt": 1e-3, "iterations": 100, "collision_slop": 1e-3, "seconds": SECONDS, "gravity": GRAVITY},
    model=right.stack_forces,
)
ENGINES = (STACK,)
