"""The parts of a scene as declared: a body, a spring, a pair. ``Scene`` checks and makes them.

Slides S4, S10; lectures/02_equation_of_motion.md.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Body:
    """One body as declared; arrays in the world frame at the start. ``inertia`` about the centre, body frame.

    inertia: (3, 3) in space, a number in the plane, None for a Point and for what is static.
    """

    shape: object
    mass: float
    static: bool
    position: np.ndarray
    orientation: np.ndarray | float
    velocity: np.ndarray
    angular_velocity: np.ndarray | float
    friction: float
    restitution: float
    inertia: np.ndarray | float | None
    group: object


@dataclass(frozen=True, eq=False)
class Spring:
    """A spring and damper in parallel between two points, each fixed on a body (None: fixed in the world).

    point_a, point_b: (d,) in world coordinates at the start; length: at rest, m.
    """

    a: int
    b: int | None
    stiffness: float
    damping: float
    length: float
    point_a: np.ndarray
    point_b: np.ndarray


@dataclass(frozen=True)
class Pair:
    """What two bodies have between them when they touch; None: made from the bodies' own values."""

    friction: float | None = None
    restitution: float | None = None
    collide: bool = True
