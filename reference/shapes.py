"""The shapes a body can have, with their inertia.

Lengths in m. A shape is fixed in its body's frame, its centre of mass at the origin. ``dimensions`` says
whether it can stand in the plane (2), in space (3), or both.

Slides S4, S10; lectures/02_equation_of_motion.md. Moments of inertia: Goldstein, Classical Mechanics (1980),
chapter 5; the stadium (the capsule in the plane) and the polygon by Green's theorem.
"""

import math
from dataclasses import dataclass

import numpy as np

from . import inputs


def _set(shape, **values):
    """Store checked values in a frozen dataclass."""
    for name, value in values.items():
        object.__setattr__(shape, name, value)


@dataclass(frozen=True)
class Sphere:
    """A solid ball of the given radius."""

    radius: float
    dimensions = (3,)

    def __post_init__(self):
        _set(self, radius=inputs.number("radius", self.radius, above=0))

    def inertia(self, mass, dimension=3):
        """⅖ m r², about every axis: (3, 3)."""
        return 0.4 * mass * self.radius**2 * np.eye(3)


@dataclass(frozen=True)
class Box:
    """A box with the given half extents: three in space, two in the plane."""

    half_extents: tuple

    def __post_init__(self):
        size = np.size(self.half_extents)
        if size not in (2, 3):
            raise ValueError(f"half_extents must be 2 or 3 lengths, but is {self.half_extents!r}")
        _set(self, half_extents=tuple(inputs.number("half_extents", e, above=0) for e in self.half_extents))

    @property
    def dimensions(self):
        """(2,) or (3,): as many as there are half extents."""
        return (len(self.half_extents),)

    def inertia(self, mass, dimension=None):
        """⅓ m (b² + c²) about each axis (3, 3); in the plane ⅓ m (a² + b²)."""
        squares = np.square(self.half_extents)
        if len(squares) == 2:
            return mass * squares.sum() / 3
        return np.diag(mass * (squares.sum() - squares) / 3)


@dataclass(frozen=True)
class Capsule:
    """A cylinder of length 2 ``half_length`` with half balls on its ends; along z (y in the plane)."""

    radius: float
    half_length: float
    dimensions = (2, 3)

    def __post_init__(self):
        _set(
            self,
            radius=inputs.number("radius", self.radius, above=0),
            half_length=inputs.number("half_length", self.half_length, least=0),
        )

    def inertia(self, mass, dimension=3):
        """(3, 3) in space; a number for ``dimension=2``, where the capsule is a stadium."""
        r, h = self.radius, self.half_length
        if dimension == 2:
            straight, round_ = 4 * h * r, math.pi * r**2  # areas
            m_straight, m_round = mass * np.array([straight, round_]) / (straight + round_)
            return m_straight * (h**2 + r**2) / 3 + m_round * (r**2 / 2 + h**2 + 8 * h * r / (3 * math.pi))
        straight, round_ = 2 * math.pi * r**2 * h, 4 / 3 * math.pi * r**3  # volumes
        m_straight, m_round = mass * np.array([straight, round_]) / (straight + round_)
        along = m_straight * r**2 / 2 + m_round * 2 / 5 * r**2
        across = m_straight * (r**2 / 4 + h**2 / 3) + m_round * (2 / 5 * r**2 + h**2 + 3 / 4 * h * r)
        return np.diag([across, across, along])


@dataclass(frozen=True)
class Plane:
    """The half space below a plane with the given outward normal (of any length); always static."""

    normal: tuple

    def __post_init__(self):
        size = np.size(self.normal)
        if size not in (2, 3):
            raise ValueError(f"normal must have 2 or 3 components, but is {self.normal!r}")
        _set(self, normal=tuple(inputs.direction("normal", self.normal, size).tolist()))

    @property
    def dimensions(self):
        """(2,) or (3,): as many as the normal has components."""
        return (len(self.normal),)


@dataclass(frozen=True)
class Disc:
    """A solid disc in the plane."""

    radius: float
    dimensions = (2,)

    def __post_init__(self):
        _set(self, radius=inputs.number("radius", self.radius, above=0))

    def inertia(self, mass, dimension=2):
        """½ m r²."""
        return 0.5 * mass * self.radius**2


@dataclass(frozen=True)
class Polygon:
    """A solid convex polygon in the plane; its vertices in order, either way round.

    The vertices may be given from any origin: they are stored anticlockwise and relative to their centroid,
    which is the body's centre of mass. Raises ValueError for fewer than 3 vertices, no area, or a dent.
    """

    vertices: tuple
    dimensions = (2,)

    def __post_init__(self):
        try:
            count = len(self.vertices)
        except TypeError:
            raise TypeError(f"vertices must be at least 3 points (x, y), but are {self.vertices!r}") from None
        points = inputs.array("vertices", self.vertices, (count, 2))
        if count < 3:
            raise ValueError(f"vertices must be at least 3 points, but are {self.vertices!r}")
        area, centroid, _ = _area_moments(points)
        if area < 0:
            points = points[::-1]
        edges = np.roll(points, -1, axis=0) - points
        turns = _cross(edges, np.roll(edges, -1, axis=0))
        size = np.square(edges).sum()
        if abs(area) <= 1e-12 * size or turns.min() < -1e-12 * size or not _once_round(edges):
            raise ValueError(
                f"vertices must go once round a convex polygon with an area, but are {self.vertices!r}"
            )
        _set(self, vertices=tuple(map(tuple, (points - centroid).tolist())))

    def inertia(self, mass, dimension=2):
        """m/A ∫ r² dA about the centroid."""
        area, _, second_moment = _area_moments(np.array(self.vertices))
        return mass * second_moment / area


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _area_moments(points):
    """Area (negative if clockwise), centroid (2,) and ∫ r² dA about the origin, by Green's theorem."""
    following = np.roll(points, -1, axis=0)
    crosses = _cross(points, following)
    area = crosses.sum() / 2
    if area == 0:
        return 0.0, points.mean(axis=0), 0.0
    centroid = crosses @ (points + following) / (6 * area)
    second = crosses @ (points**2 + points * following + following**2).sum(axis=1) / 12
    return area, centroid, second


def _once_round(edges):
    """Whether the directions of the edges turn by 2π in all: a star turns more often."""
    following = np.roll(edges, -1, axis=0)
    turns = np.arctan2(_cross(edges, following), (edges * following).sum(axis=1))
    return abs(turns.sum() - 2 * math.pi) < 1e-6


@dataclass(frozen=True)
class Point:
    """A point mass: no size, no rotation, no contact."""

    dimensions = (2, 3)


SHAPES = (Sphere, Box, Capsule, Plane, Disc, Polygon, Point)
