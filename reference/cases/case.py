"""What a case is: a scene whose exact motion is known, and how far off a run of it is.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..rotation import rotation_angle
from ..scene import Scene

GRAVITY = 9.81  # m/s²


class Motion(NamedTuple):
    """The exact motion at the times (T,): arrays shaped as a Trajectory's, n bodies in d dimensions, world
    frame.

    position, velocity (T, n, d), m and m/s; orientation (T, n, 4), or (T, n) in the plane, rad;
    angular_velocity (T, n, 3), or (T, n), rad/s. What doesn't turn has the identity, and 0.
    """

    position: np.ndarray
    orientation: np.ndarray
    velocity: np.ndarray
    angular_velocity: np.ndarray


@dataclass(frozen=True)
class Case:
    """A scene with a known answer.

    ``exact(t)`` gives the Motion at the times t (T,). ``measure(run, motion)`` turns the gap between a run
    and the exact motion at the run's own times into one number in ``unit``; 0 is perfect.
    """

    name: str
    scene: Scene
    duration: float
    exact: Callable[[np.ndarray], Motion]
    measure: Callable
    unit: str
    source: str
    what_is_hard: str

    def error(self, run):
        """The run's error, one number, over all its records. A run that broke down has an infinite one."""
        if run.status != "ok":
            return np.inf
        value = float(self.measure(run, self.exact(np.asarray(run.time))))
        return value if np.isfinite(value) else np.inf


class Catalogue(dict):
    """Names to things; an unknown name gives an error that lists the known ones."""

    def __init__(self, kind, entries):
        super().__init__(entries)
        self.kind = kind

    def __missing__(self, name):
        raise KeyError(f"{self.kind} must be one of {', '.join(self)}, but is {name!r}")


def at_rest(shape, dimension):
    """Orientation and angular velocity of bodies that don't turn: shape (T, n)."""
    if dimension == 2:
        return np.zeros(shape), np.zeros(shape)
    return np.broadcast_to([1.0, 0, 0, 0], (*shape, 4)), np.zeros((*shape, 3))


def position_error(scale):
    """A measure: the largest distance of a body from where it should be, divided by ``scale`` (m)."""
    return lambda run, motion: np.linalg.norm(run.position - motion.position, axis=-1).max() / scale


def attitude_error(run, motion):
    """A measure: the largest angle (rad) by which a body is turned wrongly."""
    if motion.orientation.ndim == 2:
        return np.abs(run.orientation - motion.orientation).max()
    return rotation_angle(run.orientation, motion.orientation).max()


def flight_error(scale):
    """A measure: the larger of the relative position error and the attitude error in rad."""
    place = position_error(scale)
    return lambda run, motion: max(place(run, motion), attitude_error(run, motion))


def positive(**values):
    """Check numbers that must be positive and finite; the error names the first that isn't."""
    for name, value in values.items():
        if not (np.isfinite(value) and value > 0):
            raise ValueError(f"{name} must be a positive number, but is {value!r}")


def checked_dimension(dimension):
    """2 or 3, or an error that says so."""
    if dimension not in (2, 3):
        raise ValueError(f"dimension must be 2 (in the plane) or 3 (in space), but is {dimension!r}")
    return dimension
