"""Rows in space: φ, J and J̇ u of each kind.

Arrays are handed on one by one, not in their tuples: Numba would count references to each of them at each
call (measured: 15 times the cost of the arithmetic).

Slides S5, S6; lectures/03_jacobian.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import lean, merged
from ..joints import ANGULAR, DISTANCE, LINEAR
from ..rotation import cross, dot, minus, plus, vector
from .frames import turned


class Ends(NamedTuple):
    """What a joint's rows share, world frame: the two points and the motion of the one against the other."""

    r_i: tuple  # m: from the centre of mass of i to its point
    r_j: tuple
    Δ: tuple  # m: from i's point to j's
    Δv: tuple  # m/s: its rate
    inward: tuple  # m/s²: its second derivative where u̇ = 0, each point being drawn towards its centre
    ω_i: tuple  # rad/s
    ω_j: tuple


@merged
def fill_rows_in_space(rows, state, out):
    """φ, J and J̇ u of all rows; the frames must have been filled in."""
    kind, bodies, joint, p, e, e2, c = rows.kind, rows.bodies, rows.joint, rows.p, rows.e, rows.e2, rows.c
    φ, J, rate, frame = out
    for k in range(len(kind)):
        i, j = bodies[k, 0], bodies[k, 1]
        if k == 0 or joint[k] != joint[k - 1]:
            ends = ends_in_space(state.x, state.v, state.ω, frame, i, j, vector(p[k], 0), vector(p[k], 1))
        axis = turned(frame, i, vector(e, k))
        if kind[k] == LINEAR:
            fill_linear(ends, axis, k, φ, J, rate)
        elif kind[k] == DISTANCE:
            fill_distance(ends, k, φ, J, rate)
        elif kind[k] == ANGULAR:
            fill_angular(ends, axis, turned(frame, j, vector(c, k)), k, φ, J, rate)
        else:
            second, third = turned(frame, i, vector(e2, k)), turned(frame, j, vector(c, k))
            fill_turn(ends, axis, second, third, k, φ, J, rate)
        φ[k] -= rows.target[k]


@merged
def ends_in_space(x, v, ω, frame, i, j, a_i, a_j):
    """The ``Ends`` of a joint between i and j, at the point a_i of i and a_j of j, in their own frames."""
    r_i, p_i, v_i, ω_i = point(x, v, ω, frame, i, a_i)
    r_j, p_j, v_j, ω_j = point(x, v, ω, frame, j, a_j)
    inward = minus(cross(ω_j, cross(ω_j, r_j)), cross(ω_i, cross(ω_i, r_i)))
    return Ends(r_i, r_j, minus(p_j, p_i), minus(v_j, v_i), inward, ω_i, ω_j)


@lean
def point(x, v, ω, frame, i, a):
    """Arm, position and velocity of the point a of body i, and its ω; i = −1: the world, at rest."""
    still = (0.0, 0.0, 0.0)
    if i < 0:
        return still, a, still, still
    if i >= len(frame):  # a point mass
        return still, vector(x, i), vector(v, i), still
    r, spin = turned(frame, i, a), vector(ω, i)
    return r, plus(vector(x, i), r), plus(vector(v, i), cross(spin, r)), spin


@merged
def fill_linear(ends, e, k, φ, J, rate):
    """φ = e·Δ, with e turning with i: ė = ω_i × e."""
    ė = cross(ends.ω_i, e)
    φ[k] = dot(e, ends.Δ)
    rate[k] = dot(e, ends.inward) + 2 * dot(ė, ends.Δv) + dot(cross(ends.ω_i, ė), ends.Δ)
    put(J, k, e, cross(plus(ends.r_i, ends.Δ), e), cross(ends.r_j, e))


@merged
def fill_distance(ends, k, φ, J, rate):
    """φ = |Δ|, along n = Δ/|Δ|; where the points coincide there is no direction, and n = 0."""
    Δ, Δv = ends.Δ, ends.Δv
    φ[k] = np.sqrt(dot(Δ, Δ))
    inverse = 1 / φ[k] if φ[k] > 0 else 0.0
    n = (inverse * Δ[0], inverse * Δ[1], inverse * Δ[2])
    along = dot(n, Δv)
    rate[k] = dot(n, ends.inward) + inverse * (dot(Δv, Δv) - along * along)
    put(J, k, n, cross(ends.r_i, n), cross(ends.r_j, n))


@merged
def fill_angular(ends, a, c, k, φ, J, rate):
    """φ = a·c, with ȧ = ω_i × a and ċ = ω_j × c."""
    ȧ, ċ = cross(ends.ω_i, a), cross(ends.ω_j, c)
    φ[k] = dot(a, c)
    rate[k] = dot(cross(ends.ω_i, ȧ), c) + 2 * dot(ȧ, ċ) + dot(a, cross(ends.ω_j, ċ))
    put_turning(J, k, cross(c, a))


@merged
def fill_turn(ends, e1, e2, c, k, φ, J, rate):
    """φ: the angle from e1 to c about e3 = e1 × e2, from −π to π. J̇ u = ė3·(ω_j − ω_i)."""
    e3 = cross(e1, e2)
    φ[k] = np.arctan2(dot(c, e2), dot(c, e1))
    rate[k] = dot(cross(ends.ω_i, e3), minus(ends.ω_j, ends.ω_i))
    put_turning(J, k, e3)


@lean
def put(J, k, e, moment_i, moment_j):
    """Row k of J: −(e, r_i × e) for body i and (e, r_j × e) for body j (S5)."""
    J[k, 0, 0], J[k, 0, 1], J[k, 0, 2] = -e[0], -e[1], -e[2]
    J[k, 0, 3], J[k, 0, 4], J[k, 0, 5] = -moment_i[0], -moment_i[1], -moment_i[2]
    J[k, 1, 0], J[k, 1, 1], J[k, 1, 2] = e
    J[k, 1, 3], J[k, 1, 4], J[k, 1, 5] = moment_j


@lean
def put_turning(J, k, axis):
    """Row k of J: −axis for the ω of body i, axis for that of body j; nothing for v (S5)."""
    put(J, k, (0.0, 0.0, 0.0), axis, axis)
