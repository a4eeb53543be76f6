"""A vertical plane in which bars move: the whole of a planar scene, or the x–z plane of space.

So one case serves both: pymunk takes it in two dimensions, pybullet in three. A point of the plane is (x, y),
y upwards; an angle turns x towards y. In space that is a turn about −y. Answers are written in the plane.

Slides S5, S9; lectures/04_embedding.md.
"""

import numpy as np

from ..joints import BallJoint, Distance, Hinge, Slider
from ..rotation import over_arrays, rotate
from ..scene import Scene
from ..shapes import Box, Disc, Point, Sphere
from .case import GRAVITY, Motion, checked_dimension

JOINTS = ("hinge", "ball", "distance")
SLENDER = 0.1  # of all bars: width and depth over length


class Upright:
    """A scene of bars in a vertical plane, in 2 or 3 dimensions, and its Motion from plane quantities."""

    def __init__(self, dimension, gravity=GRAVITY):
        self.dimension = checked_dimension(dimension)
        self.scene = Scene(gravity=self.vector((0.0, -gravity)))

    def vector(self, v):
        """A vector (…, 2) of the plane in the scene's dimensions (…, d)."""
        v = np.asarray(v, dtype=float)
        if self.dimension == 2:
            return v
        return np.stack([v[..., 0], np.zeros(v.shape[:-1]), v[..., 1]], axis=-1)

    def orientation(self, φ):
        """An angle (…,) as an orientation: (…,), or quaternions (…, 4)."""
        φ = np.asarray(φ, dtype=float)
        if self.dimension == 2:
            return φ
        zero = np.zeros(φ.shape)
        return np.stack([np.cos(φ / 2), zero, -np.sin(φ / 2), zero], axis=-1)

    def spin(self, ω):
        """An angular velocity (…,) in the scene's dimensions: (…,), or (…, 3)."""
        ω = np.asarray(ω, dtype=float)
        if self.dimension == 2:
            return ω
        return np.stack([np.zeros(ω.shape), -ω, np.zeros(ω.shape)], axis=-1)

    def bar(self, length, mass, centre, φ, velocity=(0.0, 0.0), ω=0.0):
        """Add a bar at the angle φ; returns its number. Its own x axis lies along it."""
        box = Box((length / 2, *[SLENDER * length / 2] * (self.dimension - 1)))
        return self.scene.add(
            box,
            mass=mass,
            position=self.vector(centre),
            orientation=self.orientation(φ),
            velocity=self.vector(velocity),
            angular_velocity=self.spin(ω),
            group="mechanism",
        )

    def point(self, mass, place, velocity=(0.0, 0.0)):
        """Add a point mass; returns its number."""
        return self.scene.add(Point(), mass=mass, position=self.vector(place), velocity=self.vector(velocity))

    def ball(self, radius, centre, **body):
        """Add a disc, in space a sphere; returns its number. Further arguments are ``scene.add``'s."""
        shape = Disc(radius) if self.dimension == 2 else Sphere(radius)
        return self.scene.add(shape, position=self.vector(centre), **body)

    def join(self, kind, a, b, point):
        """Join with a "hinge" or a "ball" at a point; a "distance" is from a's centre to the point."""
        point = self.vector(point)
        if kind == "hinge":
            axis = None if self.dimension == 2 else (0.0, -1.0, 0.0)
            self.scene.join(Hinge(a, b, point=point, axis=axis))
        elif kind == "ball":
            self.scene.join(BallJoint(a, b, point=point))
        else:
            self.scene.join(Distance(a, b, point_b=point))

    def slide(self, a, b, axis):
        """Join with a slider along an axis (2,)."""
        self.scene.join(Slider(a, b, axis=self.vector(axis)))

    def motion(self, place, φ, velocity, ω):
        """A Motion from positions (T, n, 2), angles (T, n), and their rates."""
        return Motion(self.vector(place), self.orientation(φ), self.vector(velocity), self.spin(ω))


def bar_inertia(mass, length):
    """Of a bar about its centre and the plane's normal, kg m²."""
    return mass * length**2 * (1 + SLENDER**2) / 12


def checked_joint(joint, dimension):
    """A kind of joint, or an error that says which there are."""
    if joint not in JOINTS:
        raise ValueError(f"joint must be one of {', '.join(JOINTS)}, but is {joint!r}")
    if joint == "ball" and dimension == 2:
        raise ValueError("joint must be 'hinge' or 'distance' in the plane, but is 'ball'")
    return joint


def end_error(scale, arm):
    """A measure: the farthest that the last body's end, at ``arm`` along its own x axis, is from its place.

    scale: m, by which it is divided.
    """

    def measure(run, motion):
        gap = _end(run, arm) - _end(motion, arm)
        return np.linalg.norm(gap, axis=-1).max() / scale

    return measure


def _end(motion, arm):
    q, place = motion.orientation[:, -1], motion.position[:, -1]
    if q.ndim == 1:
        return place + arm * np.stack([np.cos(q), np.sin(q)], axis=-1)
    return place + over_arrays(rotate)(q, np.array([arm, 0.0, 0.0]))
