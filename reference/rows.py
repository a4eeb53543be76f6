"""Rows of J: for each row of a joint its position φ, its Jacobian J with w = J u, and J̇ u.

A row concerns two bodies, so J is kept as (m, 2, k): for each row k numbers for body i and k for body j,
those of v, then those of ω: k = 6 in space, 3 in the plane. All velocities and forces are in the world frame, w and λ along the
joint's own axes. φ̇ = J u holds off the constraint too (TURN: as long as the axes agree), so that Newton's
method on φ works with the same J.

    LINEAR    φ = e·Δ,   Δ = p_j − p_i;   w = e·(v_j + ω_j×r_j − v_i − ω_i×(r_i + Δ))
    ANGULAR   φ = a·c;                    w = (c×a)·(ω_j − ω_i)
    DISTANCE  φ = |Δ| − length;           w = n·(v_j + ω_j×r_j − v_i − ω_i×r_i),   n = Δ/|Δ|
    TURN      φ = angle about e3;         w = e3·(ω_j − ω_i)

r_i, r_j: from the centre of mass to the point. LINEAR: e turns with i, hence the arm r_i + Δ, which reaches
j's point.

Slides S5–S7; lectures/03_jacobian.md.
"""

from typing import NamedTuple

import numpy as np

from .bodies import planar
from .compiled import compiled
from .rows_in_plane import fill_rows_in_plane
from .rows_in_space import fill_rows_in_space


class Rows(NamedTuple):
    """m rows as arrays, constants. Points and directions are in their body's principal frame, or the world's.

    The kernels read four arrays; the names below are views of their columns, for reading and filling in.
    """

    index: np.ndarray  # (m, 3) int: kind; i and j as rows of the state, −1: fixed in the world
    geometry: np.ndarray  # (m, 15): p_i, p_j, e, e2, c
    law: np.ndarray  # (m, 6): target, stiffness, damping, speed, lower, upper
    joint: np.ndarray  # (m,) int: which joint it belongs to

    @property
    def kind(self):
        """(m,) int: LINEAR, ANGULAR, DISTANCE or TURN."""
        return self.index[:, 0]

    @property
    def bodies(self):
        """(m, 2) int: i and j as rows of the state; −1: fixed in the world."""
        return self.index[:, 1:]

    @property
    def p(self):
        """(m, 2, 3) m: the point on i, on j."""
        return self.geometry[:, :6].reshape(-1, 2, 3)

    @property
    def e(self):
        """(m, 3): a direction on i."""
        return self.geometry[:, 6:9]

    @property
    def e2(self):
        """(m, 3): another one, on i."""
        return self.geometry[:, 9:12]

    @property
    def c(self):
        """(m, 3): a direction on j."""
        return self.geometry[:, 12:]

    @property
    def target(self):
        """(m,): what is taken off φ; m or rad."""
        return self.law[:, 0]

    @property
    def stiffness(self):
        """(m,): of a soft row, N/m or N m/rad; 0 for others."""
        return self.law[:, 1]

    @property
    def damping(self):
        """(m,): of a soft row, N s/m or N m s; 0 for others."""
        return self.law[:, 2]

    @property
    def speed(self):
        """(m,): what w must be, m/s or rad/s; not 0 for motors only."""
        return self.law[:, 3]

    @property
    def lower(self):
        """(m,) N or N m: the least λ; −inf for a row that holds whatever it takes."""
        return self.law[:, 4]

    @property
    def upper(self):
        """(m,) N or N m: the largest λ."""
        return self.law[:, 5]


def make_rows(m):
    """Room for m rows: all 0, λ without bounds."""
    rows = Rows(np.zeros((m, 3), dtype=int), np.zeros((m, 15)), np.zeros((m, 6)), np.zeros(m, dtype=int))
    rows.bodies[:], rows.lower[:], rows.upper[:] = -1, -np.inf, np.inf
    return rows


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


@compiled
def fill_rows(rows, state, out):
    """φ, J and J̇ u of all rows, for this state."""
    if planar(state):
        fill_rows_in_plane(
            rows.index, rows.geometry, state.x, state.q, state.v, state.ω, out.frame, out.φ, out.J, out.rate
        )
    else:
        fill_rows_in_space(
            rows.index, rows.geometry, state.x, state.q, state.v, state.ω, out.frame, out.φ, out.J, out.rate
        )
    φ, law = out.φ, rows.law
    for k in range(len(φ)):
        φ[k] -= law[k, 0]
