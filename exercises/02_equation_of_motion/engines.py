"""What the engines answer to the questions of unit 02, and the inputs that are recorded. Grader's side
only."""

import math
from pathlib import Path

import numpy as np

import exercises
from exercises.grader.recordings import EngineOracle, silence

right = exercises.part("02_equation_of_motion", "answers")

FOLDER = Path(__file__).resolve().parent / "recordings"
GRAVITY = 9.81
CASES = 24


def plate_in_pymunk(outline, holes, density):
    """Mass, centre and moment of inertia of a plate with holes. pymunk weighs each polygon and gives its
    moment about any point, here about the whole plate's centre: so no parallel-axis theorem of ours is in
    it."""
    import pymunk

    parts = []
    for sign, corners in [(1, outline), *((-1, hole) for hole in holes)]:
        corners = [tuple(corner) for corner in corners.tolist()]
        shape = pymunk.Poly(pymunk.Body(1, 1), corners)
        parts.append((sign * density * shape.area, tuple(shape.center_of_gravity), corners))
    mass = sum(m for m, _, _ in parts)
    centre = np.array([sum(m * c[axis] for m, c, _ in parts) / mass for axis in (0, 1)])
    back = tuple((-centre).tolist())
    inertia = sum(math.copysign(pymunk.moment_for_poly(abs(m), corners, back), m) for m, _, corners in parts)
    return mass, centre, inertia


def swing_in_pybullet(mass, inertia, length, angle, dt, steps):
    """Angles of a pendulum: a multibody tree of one hinge, with all damping and the hinge's motor switched
    off."""
    with silence():
        import pybullet as bullet
    client = bullet.connect(bullet.DIRECT)
    try:
        options = {"physicsClientId": client}
        bullet.setGravity(0, 0, -GRAVITY, **options)
        bullet.setTimeStep(dt, **options)
        body = bullet.createMultiBody(
            baseMass=0,
            linkMasses=[mass],
            linkCollisionShapeIndices=[-1],
            linkVisualShapeIndices=[-1],
            linkPositions=[[0, 0, 0]],
            linkOrientations=[[0, 0, 0, 1]],
            linkInertialFramePositions=[[0, 0, -length]],
            linkInertialFrameOrientations=[[0, 0, 0, 1]],
            linkParentIndices=[0],
            linkJointTypes=[bullet.JOINT_REVOLUTE],
            linkJointAxis=[[0, 1, 0]],
            **options,
        )
        bullet.changeDynamics(
            body, 0, localInertiaDiagonal=[inertia] * 3, **options
        )  # apart from damping: set
        bullet.changeDynamics(
            body, 0, linearDamping=0, angularDamping=0, jointDamping=0, **options
        )  # together, one is lost
        bullet.changeDynamics(body, -1, linearDamping=0, angularDamping=0, **options)
        bullet.setJointMotorControl2(body, 0, bullet.VELOCITY_CONTROL, force=0, **options)
        bullet.resetJointState(body, 0, angle, 0.0, **options)
        angles = [angle]
        for _ in range(steps):
            bullet.stepSimulation(**options)
            angles.append(bullet.getJointState(body, 0, **options)[0])
        return np.array(angles)
    finally:
        bullet.disconnect(client)


def _round_polygon(stream, corners, size, centre=(0.0, 0.0)):
    """A convex polygon around `centre`, counter-clockwise, rounded so that a student can paste it."""
    angles = 2 * math.pi * (np.arange(corners) + stream.uniform(0, 0.6, corners)) / corners
    width, height = size * stream.uniform(0.8, 1.2, 2)
    return np.round(np.stack([width * np.cos(angles), height * np.sin(angles)], axis=1) + centre, 3)


def rectangle(width, height, x=0.0, y=0.0):
    return np.array(
        [
            (x - width / 2, y - height / 2),
            (x + width / 2, y - height / 2),
            (x + width / 2, y + height / 2),
            (x - width / 2, y + height / 2),
        ]
    )


PLATES = {  # what a student may see; random plates follow
    "a rectangle without holes: mass · (width² + height²) / 12": {
        "outline": rectangle(3.0, 1.0, 2.0, 1.0),
        "holes": (),
        "density": 2.0,
    },
    "a square with a square hole in its middle": {
        "outline": rectangle(2.0, 2.0),
        "holes": (rectangle(1.0, 1.0),),
        "density": 1.5,
    },
    "a rectangle with a hole off its middle": {
        "outline": rectangle(4.0, 2.0, 1.0),
        "holes": (rectangle(1.0, 1.0, 2.0, 0.25),),
        "density": 1.0,
    },
}
SWINGS = {
    "let go at 1 rad": {"mass": 2.0, "inertia": 0.3, "length": 0.7, "angle": 1.0, "dt": 0.01, "steps": 40},
    "let go almost upside down": {
        "mass": 1.0,
        "inertia": 0.1,
        "length": 0.5,
        "angle": 3.0,
        "dt": 0.02,
        "steps": 40,
    },
}


def some_plate(stream, i):
    """A plate; `i` says how many corners and holes it has."""
    shift, side = stream.uniform(-3, 3, 2), stream.uniform(0, 2 * math.pi)
    outline = _round_polygon(stream, 6 + i % 3, 2.0, shift)
    holes = [
        _round_polygon(
            stream, 3 + i % 3, 0.4, shift + sign * 0.7 * np.array([math.cos(side), math.sin(side)])
        )
        for sign in (1, -1)[: 1 + i % 2]
    ]
    return {"outline": outline, "holes": tuple(holes), "density": round(stream.uniform(0.5, 3), 3)}


def some_swing(stream, i):
    return {
        "mass": round(stream.uniform(0.5, 3), 3),
        "inertia": round(stream.uniform(0.1, 0.5), 3),
        "length": round(stream.uniform(0.3, 1), 3),
        "angle": round(stream.uniform(0.8, 2.8), 3),
        "dt": round(stream.uniform(0.004, 0.02), 4),
        "steps": 40,
    }


def plate_inputs():
    stream = np.random.default_rng(21)
    return [*PLATES.values(), *(some_plate(stream, i) for i in range(CASES))]


def swing_inputs():
    stream = np.random.default_rng(22)
    return [*SWINGS.values(), *(some_swing(stream, i) for i in range(CASES))]


PLATE = EngineOracle(
    "pymunk",
    FOLDER / "plate_pymunk.json",
    plate_in_pymunk,
    plate_inputs,
    {"functions": "Poly.area, Poly.center_of_gravity, moment_for_poly with an offset"},
    model=right.plate,
)
SWING = EngineOracle(
    "pybullet",
    FOLDER / "swing_pybullet.json",
    swing_in_pybullet,
    swing_inputs,
    {
        "body": "multibody tree, one revolute joint",
        "gravity": GRAVITY,
        "damping": 0,
        "joint motor": "off",
        "precision": "double",
    },
    model=right.swing,
)
ENGINES = (PLATE, SWING)
