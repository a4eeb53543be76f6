"""Rows of J in space: three numbers for each velocity, force, arm and direction.

Slides S5–S7; lectures/03_jacobian.md.
"""

import numpy as np

from .compiled import compiled, compiled_apart
from .joints import ANGULAR, DISTANCE, LINEAR
from .rotation import cross


@compiled_apart
def fill_rows_in_space(index, geometry, x, q, v, ω, frame, φ, J, rate):
    """All rows, in space; ``fill_rows`` says what the arrays are."""
    fill_frames(q, frame)
    for k in range(len(index)):
        kind, i, j = index[k, 0], index[k, 1], index[k, 2]
        ω_i, ω_j = spin(ω, i), spin(ω, j)
        e = turned(frame, i, three(geometry, k, 6))
        if kind == LINEAR or kind == DISTANCE:
            r_i, p_i, v_i = point(frame, x, v, ω_i, i, three(geometry, k, 0))
            r_j, p_j, v_j = point(frame, x, v, ω_j, j, three(geometry, k, 3))
            Δ, Δv = minus(p_j, p_i), minus(v_j, v_i)
            inward = minus(cross(ω_j, cross(ω_j, r_j)), cross(ω_i, cross(ω_i, r_i)))  # Δ̈ at u̇ = 0
            if kind == LINEAR:
                r_i = plus(r_i, Δ)
                φ[k], rate[k] = linear(e, Δ, Δv, inward, ω_i)
            else:
                e, φ[k], rate[k] = distance(Δ, Δv, inward)
            put(J, k, e, cross(r_i, e), cross(r_j, e))
            continue
        c = turned(frame, j, three(geometry, k, 12))
        if kind == ANGULAR:
            axis, φ[k], rate[k] = angular(e, c, ω_i, ω_j)
        else:
            axis, φ[k], rate[k] = turn(e, turned(frame, i, three(geometry, k, 9)), c, ω_i, ω_j)
        put(J, k, (0.0, 0.0, 0.0), axis, axis)


@compiled
def linear(e, Δ, Δv, inward, ω_i):
    """φ = e·Δ and J̇ u, where e turns with i: ė = ω_i × e."""
    ė = cross(ω_i, e)
    return dot(e, Δ), dot(e, inward) + 2 * dot(ė, Δv) + dot(cross(ω_i, ė), Δ)


@compiled
def distance(Δ, Δv, inward):
    """n = Δ/|Δ|, |Δ| and J̇ u: what the direction of Δ changes by adds the centripetal term."""
    length = np.sqrt(dot(Δ, Δ))
    n = (Δ[0] / length, Δ[1] / length, Δ[2] / length)
    return n, length, dot(n, inward) + (dot(Δv, Δv) - dot(n, Δv) ** 2) / length


@compiled
def angular(a, c, ω_i, ω_j):
    """c×a, φ = a·c and J̇ u, where a turns with i and c with j."""
    ȧ, ċ = cross(ω_i, a), cross(ω_j, c)
    rate = dot(cross(ω_i, ȧ), c) + 2 * dot(ȧ, ċ) + dot(a, cross(ω_j, ċ))
    return cross(c, a), dot(a, c), rate


@compiled
def turn(e1, e2, c, ω_i, ω_j):
    """e3, the angle of c from e1 towards e2, and J̇ u."""
    e3 = cross(e1, e2)
    return e3, np.arctan2(dot(c, e2), dot(c, e1)), dot(cross(ω_i, e3), minus(ω_j, ω_i))


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
def three(a, k, first):
    """Three numbers of row k."""
    return a[k, first], a[k, first + 1], a[k, first + 2]


@compiled
def fill_frames(q, frame):
    """The rotation matrix of each body, row by row."""
    for i in range(len(q)):
        w, x, y, z = q[i, 0], q[i, 1], q[i, 2], q[i, 3]
        frame[i, 0], frame[i, 4], frame[i, 8] = (
            1 - 2 * (y * y + z * z),
            1 - 2 * (x * x + z * z),
            1 - 2 * (x * x + y * y),
        )
        frame[i, 1], frame[i, 2], frame[i, 5] = 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (y * z - w * x)
        frame[i, 3], frame[i, 6], frame[i, 7] = 2 * (x * y + w * z), 2 * (x * z - w * y), 2 * (y * z + w * x)


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
def point(frame, x, v, ω, i, a):
    """Arm from the centre of mass, position and velocity of the point a of body i (−1: of the world)."""
    if i < 0:
        return (0.0, 0.0, 0.0), a, (0.0, 0.0, 0.0)
    r = turned(frame, i, a)
    return r, plus(three(x, i, 0), r), plus(three(v, i, 0), cross(ω, r))


@compiled
def spin(ω, i):
    """ω of body i; 0 for the world and for points."""
    if i < 0 or i >= len(ω):
        return 0.0, 0.0, 0.0
    return ω[i, 0], ω[i, 1], ω[i, 2]


