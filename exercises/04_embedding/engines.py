"""What pymunk answers to the questions of unit 04, and the inputs that are recorded. Grader's side only."""

from pathlib import Path

import numpy as np

import exercises
from exercises.grader.recordings import EngineOracle

right = exercises.part("04_embedding", "answers")
FOLDER = Path(__file__).resolve().parent / "recordings"
CASES = 24
ITERATIONS = 400  # each takes off a factor of 0.64 or less, with the inertias of ``wheels``


def train_in_pymunk(radii, inertia, omega, drive, drag, dt, steps):
    """(ω, λ): three wheels on fixed bearings, two of pymunk's GearJoints, driven and braked for some steps.

    The torques are set anew before each step, from the rates of that moment. Both λ are read off the last
    step's change of the outer wheels' angular momentum: I Δω = (torque + R λ) dt.
    """
    import pymunk

    space = pymunk.Space()
    space.iterations = ITERATIONS
    wheels = [pymunk.Body(1.0, float(moment)) for moment in inertia]
    for k, wheel in enumerate(wheels):
        wheel.position = (10.0 * k, 0.0)
        wheel.angular_velocity = float(omega[k])
    gears = [pymunk.GearJoint(wheels[k], wheels[k + 1], 0.0, -float(radii[k + 1] / radii[k])) for k in (0, 1)]
    for gear in gears:
        gear.max_bias = 0.0  # the angles that the first step leaves apart are not corrected
    space.add(*wheels, *gears)
    for _ in range(steps):
        before = np.array([wheel.angular_velocity for wheel in wheels])
        torque = np.array([float(drive), 0.0, -float(drag) * before[2]])
        for wheel, moment in zip(wheels, torque, strict=True):
            wheel.torque = float(moment)
        space.step(float(dt))
    after = np.array([wheel.angular_velocity for wheel in wheels])
    λ = (np.asarray(inertia) * (after - before) / float(dt) - torque) / np.asarray(radii)
    return after, λ[[0, 2]]


def wheels(radii, mass, omega=(0.0, 0.0, 0.0), drive=0.0, drag=0.0, dt=0.01, steps=1):
    """Discs, so that no wheel is far lighter at its rim than its neighbours: pymunk's iteration converges."""
    radii = np.array(radii)
    inertia = np.round(0.5 * np.array(mass) * radii**2, 4)
    torques = {"drive": drive, "drag": drag}
    return {"radii": radii, "inertia": inertia, "omega": np.array(omega), **torques, "dt": dt, "steps": steps}


TRAINS = {
    "three equal wheels at rest, driven for one step": wheels([1.0] * 3, [2.0] * 3, drive=3.0),
    "they come into mesh with any rates": wheels([0.5, 1.0, 0.8], [1.0, 3.0, 2.0], (4.0, 1.0, -2.0)),
    "driven and braked for fifty steps": wheels(
        [0.4, 0.8, 0.6], [1.5, 2.0, 1.0], drive=2.0, drag=0.3, dt=0.02, steps=50
    ),
}


def any_train(stream):
    """Any three wheels, driven and braked for some steps."""
    radii, mass = np.round(stream.uniform(0.3, 1.2, 3), 3), np.round(stream.uniform(1, 4, 3), 3)
    omega = np.round(stream.uniform(-5, 5, 3), 3)
    drive, drag = (float(value) for value in np.round(stream.uniform([1, 0.2], [4, 0.6]), 3))
    return wheels(radii, mass, omega, drive, drag, 0.02, int(stream.integers(8, 20)))


def train_inputs():
    stream = np.random.default_rng(41)
    return [*TRAINS.values(), *(any_train(stream) for _ in range(CASES))]


TRAIN = EngineOracle(
    "pymunk",
    FOLDER / "train_pymunk.json",
    train_in_pymunk,
    train_inputs,
    {"joint": "2 GearJoints, phase 0, max_bias 0", "iterations": ITERATIONS, "gravity": 0, "damping": 1},
    model=right.train,
)
ENGINES = (TRAIN,)
