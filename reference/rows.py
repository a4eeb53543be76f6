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
from .joints import ANGULAR, DISTANCE, LINEAR
from .rotation import cross, quaternion, vector


class Rows(NamedTuple):
    """m rows as arrays, constants. Points and directions are in their body's principal frame, or the world's."""

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


@compiled
def fill_rows(rows, state, out):
    """φ, J and J̇ u of all rows, for this state."""
    fill_frames(state, out.frame)
    for k in range(len(rows.kind)):
        if planar(state):
            fill_row_in_plane(rows, state, k, out)
        else:
            fill_row_in_space(rows, state, k, out)
        out.φ[k] -= rows.target[k]


@compiled
def fill_row_in_space(rows, state, k, out):
    """Row k, in space."""
    i, j = rows.bodies[k, 0], rows.bodies[k, 1]
    ω_i, ω_j = spin(state, i), spin(state, j)
    e = turned(out.frame, i, vector(rows.e, k))
    if rows.kind[k] == LINEAR or rows.kind[k] == DISTANCE:
        r_i, p_i, v_i = point(out.frame, state, i, rows.p, k, 0)
        r_j, p_j, v_j = point(out.frame, state, j, rows.p, k, 1)
        Δ, Δv = minus(p_j, p_i), minus(v_j, v_i)
        inward = minus(cross(ω_j, cross(ω_j, r_j)), cross(ω_i, cross(ω_i, r_i)))  # Δ's acceleration at u̇ = 0
        if rows.kind[k] == LINEAR:
            ė = cross(ω_i, e)
            r_i = plus(r_i, Δ)
            out.φ[k] = dot(e, Δ)
            out.rate[k] = dot(e, inward) + 2 * dot(ė, Δv) + dot(cross(ω_i, ė), Δ)
        else:
            length = np.sqrt(dot(Δ, Δ))
            e = (Δ[0] / length, Δ[1] / length, Δ[2] / length)
            out.φ[k] = length
            out.rate[k] = dot(e, inward) + (dot(Δv, Δv) - dot(e, Δv) ** 2) / length
        put(out.J, k, e, cross(r_i, e), cross(r_j, e))
        return
    c = turned(out.frame, j, vector(rows.c, k))
    if rows.kind[k] == ANGULAR:
        axis, ė, ċ = cross(c, e), cross(ω_i, e), cross(ω_j, c)
        out.φ[k] = dot(e, c)
        out.rate[k] = dot(cross(ω_i, ė), c) + 2 * dot(ė, ċ) + dot(e, cross(ω_j, ċ))
    else:
        e2 = turned(out.frame, i, vector(rows.e2, k))
        axis = cross(e, e2)
        out.φ[k] = np.arctan2(dot(c, e2), dot(c, e))
        out.rate[k] = dot(cross(ω_i, axis), minus(ω_j, ω_i))
    put(out.J, k, (0.0, 0.0, 0.0), axis, axis)


@compiled
def fill_row_in_plane(rows, state, k, out):
    """Row k, in the plane: the same with ω and the moments along the third axis."""
    i, j = rows.bodies[k, 0], rows.bodies[k, 1]
    J = out.J
    if rows.kind[k] != LINEAR and rows.kind[k] != DISTANCE:  # a TURN
        J[k, 0, 0], J[k, 0, 1], J[k, 0, 2] = 0.0, 0.0, -1.0
        J[k, 1, 0], J[k, 1, 1], J[k, 1, 2] = 0.0, 0.0, 1.0
        out.φ[k] = angle(state, j) - angle(state, i)
        out.rate[k] = 0.0
        return
    ω_i, ω_j = planar_spin(state, i), planar_spin(state, j)
    r_i, p_i, v_i = point_in_plane(out.frame, state, i, rows.p, k, 0)
    r_j, p_j, v_j = point_in_plane(out.frame, state, j, rows.p, k, 1)
    Δx, Δy = p_j[0] - p_i[0], p_j[1] - p_i[1]
    vx, vy = v_j[0] - v_i[0], v_j[1] - v_i[1]
    x, y = ω_i**2 * r_i[0] - ω_j**2 * r_j[0], ω_i**2 * r_i[1] - ω_j**2 * r_j[1]
    if rows.kind[k] == LINEAR:
        ex, ey = turned_in_plane(out.frame, i, rows.e[k, 0], rows.e[k, 1])
        r_i = (r_i[0] + Δx, r_i[1] + Δy)
        out.φ[k] = ex * Δx + ey * Δy
        out.rate[k] = ex * x + ey * y + 2 * ω_i * (ex * vy - ey * vx) - ω_i**2 * out.φ[k]
    else:
        length = np.sqrt(Δx**2 + Δy**2)
        ex, ey = Δx / length, Δy / length
        out.φ[k] = length
        out.rate[k] = ex * x + ey * y + (ex * vy - ey * vx) ** 2 / length
    J[k, 0, 0], J[k, 0, 1], J[k, 0, 2] = -ex, -ey, -(r_i[0] * ey - r_i[1] * ex)
    J[k, 1, 0], J[k, 1, 1], J[k, 1, 2] = ex, ey, r_j[0] * ey - r_j[1] * ex


@compiled
def put(J, k, e, moment_i, moment_j):
    """Row k of J in space: −(e, r_i × e) for body i and (e, r_j × e) for body j (S5)."""
    J[k, 0, 0], J[k, 0, 1], J[k, 0, 2] = -e[0], -e[1], -e[2]
    J[k, 0, 3], J[k, 0, 4], J[k, 0, 5] = -moment_i[0], -moment_i[1], -moment_i[2]
    J[k, 1, 0], J[k, 1, 1], J[k, 1, 2] = e
    J[k, 1, 3], J[k, 1, 4], J[k, 1, 5] = moment_j


@compiled
def dot(a, b):
    """a · b in space."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def minus(a, b):
    """a − b in space."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@compiled
def plus(a, b):
    """a + b in space."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@compiled
def fill_frames(state, frame):
    """The rotation matrix of each body, row by row; in the plane its cosine and sine."""
    for i in range(len(frame)):
        if planar(state):
            frame[i, 0], frame[i, 1] = np.cos(state.q[i, 0]), np.sin(state.q[i, 0])
            continue
        w, x, y, z = quaternion(state.q, i)
        frame[i, 0], frame[i, 1], frame[i, 2] = (
            1 - 2 * (y * y + z * z),
            2 * (x * y - w * z),
            2 * (x * z + w * y),
        )
        frame[i, 3], frame[i, 4], frame[i, 5] = (
            2 * (x * y + w * z),
            1 - 2 * (x * x + z * z),
            2 * (y * z - w * x),
        )
        frame[i, 6], frame[i, 7], frame[i, 8] = (
            2 * (x * z - w * y),
            2 * (y * z + w * x),
            1 - 2 * (x * x + y * y),
        )


@compiled
def turned(frame, i, a):
    """The vector a, fixed to body i, in the world frame; a itself for the world and for points."""
    if i < 0 or i >= len(frame):
        return a
    return (
        frame[i, 0] * a[0] + frame[i, 1] * a[1] + frame[i, 2] * a[2],
        frame[i, 3] * a[0] + frame[i, 4] * a[1] + frame[i, 5] * a[2],
        frame[i, 6] * a[0] + frame[i, 7] * a[1] + frame[i, 8] * a[2],
    )


@compiled
def turned_in_plane(frame, i, x, y):
    """The same in the plane."""
    if i < 0 or i >= len(frame):
        return x, y
    return frame[i, 0] * x - frame[i, 1] * y, frame[i, 1] * x + frame[i, 0] * y


@compiled
def point(frame, state, i, p, k, side):
    """Arm from the centre of mass, position and velocity of row k's point on body i (−1: the world)."""
    a = (p[k, side, 0], p[k, side, 1], p[k, side, 2])
    if i < 0:
        return (0.0, 0.0, 0.0), a, (0.0, 0.0, 0.0)
    r = turned(frame, i, a)
    x, v = vector(state.x, i), vector(state.v, i)
    return r, plus(x, r), plus(v, cross(spin(state, i), r))


@compiled
def point_in_plane(frame, state, i, p, k, side):
    """The same in the plane."""
    if i < 0:
        return (0.0, 0.0), (p[k, side, 0], p[k, side, 1]), (0.0, 0.0)
    r = turned_in_plane(frame, i, p[k, side, 0], p[k, side, 1])
    ω = planar_spin(state, i)
    return (
        r,
        (state.x[i, 0] + r[0], state.x[i, 1] + r[1]),
        (state.v[i, 0] - ω * r[1], state.v[i, 1] + ω * r[0]),
    )


@compiled
def spin(state, i):
    """ω of body i; 0 for the world and for points."""
    if i < 0 or i >= len(state.q):
        return 0.0, 0.0, 0.0
    return vector(state.ω, i)


@compiled
def planar_spin(state, i):
    """The same in the plane, a number."""
    return state.ω[i, 0] if 0 <= i < len(state.q) else 0.0


@compiled
def angle(state, i):
    """The angle of body i in the plane; 0 for the world."""
    return state.q[i, 0] if i >= 0 else 0.0
