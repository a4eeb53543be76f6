"""Rows in the plane: as in space, with ω and the moments along the third axis as numbers.

Arrays are handed on one by one, as in ``space``.

Slides S5, S6; lectures/03_jacobian.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import lean, merged
from ..joints import DISTANCE, LINEAR
from .frames import turned_in_plane


class Ends(NamedTuple):
    """What a joint's rows share, world frame: as in ``space``."""

    r_i: tuple
    r_j: tuple
    Δ: tuple
    Δv: tuple
    inward: tuple
    ω_i: float


@merged
def fill_rows_in_plane(rows, state, out):
    """φ, J and J̇ u of all rows; the frames must have been filled in."""
    kind, bodies, joint, p, e = rows.kind, rows.bodies, rows.joint, rows.p, rows.e
    φ, J, rate, frame = out
    for k in range(len(kind)):
        i, j = bodies[k, 0], bodies[k, 1]
        if k == 0 or joint[k] != joint[k - 1]:
            a_i, a_j = (p[k, 0, 0], p[k, 0, 1]), (p[k, 1, 0], p[k, 1, 1])
            ends = ends_in_plane(state.x, state.v, state.ω, frame, i, j, a_i, a_j)
        if kind[k] == LINEAR:
            fill_linear(ends, turned_in_plane(frame, i, (e[k, 0], e[k, 1])), k, φ, J, rate)
        elif kind[k] == DISTANCE:
            fill_distance(ends, k, φ, J, rate)
        else:
            φ[k] = angle(state.q, j) - angle(state.q, i)
            rate[k] = 0.0
            put(J, k, (0.0, 0.0), 1.0, 1.0)
        φ[k] -= rows.target[k]


@merged
def ends_in_plane(x, v, ω, frame, i, j, a_i, a_j):
    """The ``Ends`` of a joint between i and j, at the point a_i of i and a_j of j, in their own frames."""
    r_i, p_i, v_i, ω_i = point(x, v, ω, frame, i, a_i)
    r_j, p_j, v_j, ω_j = point(x, v, ω, frame, j, a_j)
    Δ, Δv = (p_j[0] - p_i[0], p_j[1] - p_i[1]), (v_j[0] - v_i[0], v_j[1] - v_i[1])
    ii, jj = ω_i * ω_i, ω_j * ω_j
    return Ends(r_i, r_j, Δ, Δv, (ii * r_i[0] - jj * r_j[0], ii * r_i[1] - jj * r_j[1]), ω_i)


@lean
def point(x, v, ω, frame, i, a):
    """Arm, position and velocity of the point a of body i, and its ω; i = −1: the world, at rest."""
    if i < 0:
        return (0.0, 0.0), a, (0.0, 0.0), 0.0
    if i >= len(frame):  # a point mass
        return (0.0, 0.0), (x[i, 0], x[i, 1]), (v[i, 0], v[i, 1]), 0.0
    r, spin = turned_in_plane(frame, i, a), ω[i, 0]
    return r, (x[i, 0] + r[0], x[i, 1] + r[1]), (v[i, 0] - spin * r[1], v[i, 1] + spin * r[0]), spin


@merged
def fill_linear(ends, e, k, φ, J, rate):
    """φ = e·Δ, with e turning with i: ė = ω_i × e."""
    r_i, Δ, Δv, ω_i = ends.r_i, ends.Δ, ends.Δv, ends.ω_i
    φ[k] = e[0] * Δ[0] + e[1] * Δ[1]
    rate[k] = e[0] * ends.inward[0] + e[1] * ends.inward[1] + 2 * ω_i * moment(e, Δv) - ω_i * ω_i * φ[k]
    put(J, k, e, moment((r_i[0] + Δ[0], r_i[1] + Δ[1]), e), moment(ends.r_j, e))


@merged
def fill_distance(ends, k, φ, J, rate):
    """φ = |Δ|, along n = Δ/|Δ|; where the points coincide there is no direction, and n = 0."""
    Δ = ends.Δ
    φ[k] = np.sqrt(Δ[0] * Δ[0] + Δ[1] * Δ[1])
    inverse = 1 / φ[k] if φ[k] > 0 else 0.0
    n = (inverse * Δ[0], inverse * Δ[1])
    across = moment(n, ends.Δv)
    rate[k] = n[0] * ends.inward[0] + n[1] * ends.inward[1] + inverse * across * across
    put(J, k, n, moment(ends.r_i, n), moment(ends.r_j, n))


@lean
def moment(r, e):
    """r × e, a number."""
    return r[0] * e[1] - r[1] * e[0]


@lean
def angle(q, i):
    """The angle of body i; 0 for the world and for points."""
    return q[i, 0] if 0 <= i < len(q) else 0.0


@lean
def put(J, k, e, moment_i, moment_j):
    """Row k of J: −(e, r_i × e) for body i and (e, r_j × e) for body j (S5)."""
    J[k, 0, 0], J[k, 0, 1], J[k, 0, 2] = -e[0], -e[1], -moment_i
    J[k, 1, 0], J[k, 1, 1], J[k, 1, 2] = e[0], e[1], moment_j
