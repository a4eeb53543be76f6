"""One step along the path inside the cones (``cone_interior``): where it stands, and where it leads.

    M du − Jᵀ dz = −(M (u − u_free) − Jᵀ z),    ds = p + Φ′ J du,    dz = r − W⁻² ds

with p = Φ(J u + c) − s what s lacks, and r what z is to change by, but for W⁻² times what s does. With ds and
dz put in, (M + Jᵀ W⁻² Φ′ J) du is left, which ``cone_interior`` solves.

Slides S14; lectures/08_newton_lcp.md. Source: Nesterov & Todd, SIAM J. Optim. 8 (1998) 324.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import inner, inner_apart
from .augmented import dot
from .coulomb import along
from .round_cone import to_boundary


class Inside(NamedTuple):
    """Room for s, z and what belongs to them, (m,) each but the last."""

    s: np.ndarray
    z: np.ndarray
    ds: np.ndarray
    dz: np.ndarray
    p: np.ndarray  # Φ − s
    r: np.ndarray  # what z is to change by, but for W⁻² times what s does
    turn: np.ndarray  # W's axis, of determinant 1
    t: np.ndarray  # w_t/|w_t| where the law is Coulomb's, else 0: what Φ′ differs from 1 by, in w_n's row
    square: np.ndarray  # (m, 3): W⁻²
    θ: np.ndarray  # (B,): W's size
    room: np.ndarray  # (4, 3)


@inner_apart
def look(rows, M, free, coulomb, u, inside, gradient, unit):
    """p = Φ(J u + c) − s, t, and the gradient M (u − free) − Jᵀ z. Returns the worst of p and it, m/s."""
    worst, k, p, t = 0.0, u.shape[1], inside.p, inside.t
    for i in range(len(u)):
        for a in range(k):
            total = 0.0
            for b in range(k):
                total += M[i, a, b] * (u[i, b] - free[i, b])
            gradient[i, a] = total
    for q in range(len(rows.μ)):
        first, end = rows.block[q], rows.block[q + 1]
        for r in range(first, end):
            p[r] = rows.c[r]
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    p[r] += dot(rows.J[r, side], u[i])
                    for a in range(k):
                        gradient[i, a] -= rows.J[r, side, a] * inside.z[r]
        slip = along(rows, q, p) if coulomb else 0.0
        p[first] += slip
        for r in range(first, end):
            t[r] = p[r] / slip if r > first and slip > 0 else 0.0
            p[r] -= inside.s[r]
            worst = max(worst, abs(p[r]) / unit[r])
    for i in range(len(u)):
        for a in range(k):
            worst = max(worst, abs(gradient[i, a]) / M[i, a, a])
    return worst


@inner
def weighted(rows, square, q, r, x):
    """Entry of row r of block q of W⁻² x."""
    total, first = 0.0, rows.block[q]
    for b in range(first, rows.block[q + 1]):
        total += square[r, b - first] * x[b]
    return total


@inner_apart
def pull(rows, out, inside, right):
    """right (n, k) = −gradient + Jᵀ (r − W⁻² p)."""
    for i in range(len(right)):
        for a in range(right.shape[1]):
            right[i, a] = -out.gradient[i, a]
    for q in range(len(rows.μ)):
        for c in range(rows.block[q], rows.block[q + 1]):
            force = inside.r[c] - weighted(rows, inside.square, q, c, inside.p)
            for side in range(2):
                i = rows.bodies[c, side]
                if i >= 0:
                    for a in range(right.shape[1]):
                        right[i, a] += rows.J[c, side, a] * force


@inner_apart
def move_along(rows, du, inside):
    """ds and dz that go with du. Returns how far to go, at most 1, until the first cone ends: 0 if that is
    not finite.
    """
    way, s, z, ds, dz = 1.0, inside.s, inside.z, inside.ds, inside.dz
    for q in range(len(rows.μ)):
        first, end = rows.block[q], rows.block[q + 1]
        for c in range(first, end):
            ds[c] = 0.0
            for side in range(2):
                i = rows.bodies[c, side]
                if i >= 0:
                    ds[c] += dot(rows.J[c, side], du[i])
            if c > first:
                ds[first] += inside.t[c] * ds[c]
        for c in range(first, end):
            ds[c] += inside.p[c]
        for c in range(first, end):
            dz[c] = inside.r[c] - weighted(rows, inside.square, q, c, ds)
            if not abs(ds[c]) + abs(dz[c]) < np.inf:
                return 0.0
        if inside.θ[q] < 0:
            ds[first] = 0.0
        else:
            way = min(way, to_boundary(s[first:end], ds[first:end]), to_boundary(z[first:end], dz[first:end]))
    return way


@inner
def advance(way, move, u, inside):
    """Go so much of the way."""
    for i in range(len(u)):
        for a in range(u.shape[1]):
            u[i, a] += way * move[i, a]
    for i in range(len(inside.s)):
        inside.s[i] += way * inside.ds[i]
        inside.z[i] += way * inside.dz[i]
