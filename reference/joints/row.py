"""A row: one thing that a joint keeps from changing, and how joints' rows are put together.

A row belongs to a joint from body i to body j, in the joint's own frame e1 e2 e3, which is fixed to i, with
e3 along the axis. It is one of four kinds, each with a position φ that must stay 0:

    LINEAR    φ = e · (p_j − p_i)      e fixed to i; p the joint's point, fixed to each body     m
    ANGULAR   φ = a · c                a fixed to i, c fixed to j, at right angles at the start   (rad)
    DISTANCE  φ = |p_j − p_i| − length                                                            m
    TURN      φ = the angle of j seen from i, about e3                                            rad

Slides S5, S6; lectures/03_jacobian.md.
"""

from typing import NamedTuple

import numpy as np

LINEAR, ANGULAR, DISTANCE, TURN = range(4)


class Row(NamedTuple):
    """One row at the start, in world coordinates; what a kind does not use is None or 0.

    p_i, p_j (d,) m: the point on i and on j. e (d,): on i. For ANGULAR: e on i, c on j (3,). For TURN in
    space: e is e1 on i, e2 on i, and c, on j, starts along e1. length: m.
    """

    kind: int
    p_i: np.ndarray = None
    p_j: np.ndarray = None
    e: np.ndarray = None
    e2: np.ndarray = None
    c: np.ndarray = None
    length: float = 0.0


def frame(axis):
    """Rows e1, e2, e3 = axis, right-handed, orthonormal (3, 3); in the plane e1, e2 = axis (2, 2)."""
    if len(axis) == 2:
        return np.array([[axis[1], -axis[0]], axis])
    e1 = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    e1 /= np.linalg.norm(e1)
    return np.array([e1, np.cross(axis, e1), axis])


def linear_rows(directions, p_i, p_j):
    """The points stay together along these directions."""
    return [Row(LINEAR, p_i, p_j, e) for e in directions]


def parallel_rows(e1, e2, e3):
    """j's axis e3 stays along i's: no turning about e1, none about e2. Signs such that w is ω·e1, ω·e2."""
    return [Row(ANGULAR, e=-e2, c=e3), Row(ANGULAR, e=e1, c=e3)]


def same_orientation(e):
    """j does not turn against i, about e1, e2, e3; in the plane one row."""
    if len(e) == 2:
        return [Row(TURN)]
    return [*parallel_rows(*e), Row(ANGULAR, e=-e[0], c=e[1])]
