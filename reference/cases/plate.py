"""The rolling plate: 25 balls on a plate that is pulled over the ground, aslant to the axes.

Slides S11, S12, S17; lectures/05_contact.md.
"""

import numpy as np

from ..scene import Scene
from ..shapes import Box, Plane, Sphere
from .case import GRAVITY, Case, Motion, positive
from .ground import speed_error

BALLS, RADIUS, PLATE = 25, 0.5, 10.0  # number, m, kg; each ball 1 kg
PULL, ALONG = 150.0, np.array([0.5, np.sqrt(0.75), 0.0])  # N, and where to


def rolling_plate(duration=0.25):
    """SimBenchmark's rolling test; the error is that of the velocities, relative to the plate's."""
    positive(duration=duration)
    scene = Scene(gravity=(0, 0, -GRAVITY))
    scene.add(Plane((0, 0, 1)), friction=0.5)
    plate = scene.add(Box((5, 5, 0.1)), mass=PLATE, position=(0, 0, 0.1), friction=0.8)  # .4 with the ground
    for i in range(BALLS):
        place = (2.0 * (i % 5) - 4, 2.0 * (i // 5) - 4, 0.2 + RADIUS)
        scene.add(Sphere(RADIUS), position=place, friction=1.0)  # .8 with the plate
    force = np.zeros((BALLS + 2, 3))
    force[plate] = PULL * ALONG
    scene.force(lambda t, state: (force, np.zeros_like(force)))
    ground = 0.4 * (PLATE + BALLS) * GRAVITY
    a = (PULL - ground) / (PLATE + BALLS * 2 / 7)  # a ball that rolls follows with 2/7
    rates = np.concatenate([[0, a], np.full(BALLS, 2 / 7 * a)])
    start = np.array([body.position for body in scene.bodies])
    turn = np.zeros((BALLS + 2, 3))
    turn[2:] = np.cross((0, 0, 1), (2 / 7 - 1) * a / RADIUS * ALONG)  # no slip on the plate

    def exact(t):
        t = t[:, None, None]
        velocity, spin = t * rates[:, None] * ALONG, t * turn
        half = 0.25 * t * spin  # half the angle turned by, about an axis that stays
        angle = np.linalg.norm(half, axis=-1, keepdims=True)
        axis = half / np.maximum(angle, 1e-300)
        q = np.concatenate([np.cos(angle), np.sin(angle) * axis], axis=-1)
        return Motion(start + 0.5 * t * velocity, q, velocity, spin)

    return Case(
        "rolling_plate",
        scene,
        duration,
        exact,
        speed_error(a * duration),
        "of the plate's speed",
        "SimBenchmark (leggedrobotics, 2018), rolling test; friction of the ground 137.34 N, a_plate = .7385 "
        "and a_ball = .2110 m/s²: Newton's law with rolling, a_ball = 2/7 a_plate.",
        "Friction that treats two axes apart bears up to √2 times as much aslant, and the plate sticks.",
    )
