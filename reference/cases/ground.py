"""A scene on level or leaning ground, for cases with contact; and what stands still.

A point is (x, z), z up from the ground: the whole of a planar scene, or the x–z plane of one in space.

Slides S10–S12; lectures/05_contact.md.
"""

import math

import numpy as np

from ..layout import Bodies
from ..shapes import Box, Plane
from .case import GRAVITY, Motion
from .upright import Upright


class Ground(Upright):
    """A scene with a half-space below z = 0 as body 0; gravity leans by ``slope`` rad towards +x."""

    def __init__(self, dimension, slope=0.0, friction=1.0, restitution=0.0):
        super().__init__(dimension)
        self.scene.gravity = self.vector((GRAVITY * math.sin(slope), -GRAVITY * math.cos(slope)))
        plane = Plane(tuple(self.vector((0.0, 1.0))))
        self.scene.add(plane, friction=friction, restitution=restitution)

    def box(self, half_width, half_height, centre, **body):
        """Add a box, as deep as it is wide; returns its number. Further arguments are ``scene.add``'s."""
        across = (half_width,) * (self.dimension - 1)
        return self.scene.add(Box((*across, half_height)), position=self.vector(centre), **body)

    def moving(self, place, φ, velocity, ω):
        """The Motion of the one body on the ground: from its place (T, 2), angle (T,), and their rates."""
        return self.motion(*(np.stack([0 * a, a], axis=1) for a in map(np.asarray, (place, φ, velocity, ω))))


def standing(scene):
    """The Motion of a scene in which nothing moves, for any times (T,)."""
    start = Bodies(scene)
    arrays = start.position, start.orientation, start.velocity, start.angular_velocity
    return lambda t: Motion(*(np.broadcast_to(a, (len(t), *a.shape)) for a in arrays))


def topples(distance):
    """A measure for what must fall: 0 if a body has moved by over ``distance``, m, at the end, else 1."""

    def measure(run, motion):
        moved = np.linalg.norm(run.position[-1] - run.position[0], axis=-1).max()
        return 0.0 if moved > distance else 1.0

    return measure


def speed_error(scale):
    """A measure: how far a velocity is off at the end, the worst body's, divided by ``scale`` m/s."""
    return lambda run, motion: np.linalg.norm(run.velocity[-1] - motion.velocity[-1], axis=-1).max() / scale


def counted(**numbers):
    """Check whole numbers that must be at least 1; the error names the first that isn't."""
    for name, value in numbers.items():
        if not (isinstance(value, int | np.integer) and value >= 1):
            raise ValueError(f"{name} must be a whole number of at least 1, but is {value!r}")
