"""Rows as arrays: what is constant, and what a state makes of it.

Slides S5–S7; lectures/03_jacobian.md.
"""

from typing import NamedTuple

import numpy as np


class Rows(NamedTuple):
    """m rows as arrays, constants. Points and directions are in their body's principal frame, or the world's.

    The rows of one joint stand together, and share the points of the first of them: so these are worked out
    once a joint.
    """

    kind: np.ndarray  # (m,) int
    bodies: np.ndarray  # (m, 2) int: i and j as rows of the state; −1: fixed in the world
    joint: np.ndarray  # (m,) int: which joint it belongs to
    p: np.ndarray  # (m, 2, 3) m: the point on i, on j
    e: np.ndarray  # (m, 3): on i
    e2: np.ndarray  # (m, 3): on i
    c: np.ndarray  # (m, 3): on j
    target: np.ndarray  # (m,): what is taken off φ; m or rad
    stiffness: np.ndarray  # (m,): of a soft row, N/m or N m/rad; 0 for others
    damping: np.ndarray  # (m,): of a soft row, N s/m or N m s; 0 for others
    speed: np.ndarray  # (m,): what w must be, m/s or rad/s; not 0 for motors only
    lower: np.ndarray  # (m,) N or N m: bounds of λ; −inf and inf for a row that holds whatever it takes
    upper: np.ndarray  # (m,)


class Jacobian(NamedTuple):
    """What m rows are for one state; made once and filled anew for each."""

    φ: np.ndarray  # (m,) m or rad
    J: np.ndarray  # (m, 2, k)
    rate: np.ndarray  # (m,): J̇ u, m/s² or rad/s²
    frame: np.ndarray  # (r, 9): the rotation matrix of each rotating body; in the plane (r, 2): cos, sin


def make_jacobian(m, r, d):
    """Room for m rows in d dimensions, of r rotating bodies."""
    size, width = (9, 6) if d == 3 else (2, 3)
    return Jacobian(np.zeros(m), np.zeros((m, 2, width)), np.zeros(m), np.zeros((r, size)))
