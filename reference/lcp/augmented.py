"""The augmented Lagrangian of contact at given velocities u: its value, its gradient, and λ̂(u).

    L(u) = ½ (u − u_free)ᵀ M (u − u_free) + Σ over blocks of (y·P(y) − ½ ‖P(y)‖²) / ρ,    y = λ − ρ (J u + c)

P is the projection on the friction cone of a contact, or on the bounds of a single row; λ̂ = P(y) is the λ
that these velocities call for, and M (u − u_free) − Jᵀ λ̂ the gradient. P has kinks where a contact changes
from open to sticking to sliding, and is smooth between; P′ is its Jacobian, one of them at a kink.

Coulomb's law has w_n + μ|w_t| where the cone's own, convex law has w_n (De Saxcé). With this *shift* held at
a number all of the above stands. Where the shift *follows* w, λ̂ is Coulomb's, but M (u − u_free) − Jᵀ λ̂ is no
longer the gradient of anything, and its Jacobian M + ρ Jᵀ P′ Φ′ J isn't symmetric; Φ′: that of w_n + μ|w_t|.

A row may give way, w = J u + c + γ λ. Then λ̂ = P(λ − ρ (J u + c + γ λ̂)), which need not be iterated: it is
the projection of y in which the row's share of the distance is weighed by 1 + ρ γ.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97; De Saxcé &
Feng, Math. Comput. Modelling 28 (1998) 225 (the shift); Alart & Curnier, CMAME 92 (1991) 353 (such a
Jacobian).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart

OPEN, STICKS, SLIDES = 0, 1, 2  # 3: slides the other way, in the plane
ALONE = 4  # friction with a limit of its own; + 2: pressed, + 1: slides


class ContactRows(NamedTuple):
    """m rows in blocks: a contact's (n, t) or (n, t1, t2), or a single row with bounds."""

    bodies: np.ndarray  # (m, 2): i and j; −1: what doesn't move
    J: np.ndarray  # (m, 2, k)
    c: np.ndarray  # (m,): what J u must be added to: w = J u + c
    block: np.ndarray  # (B + 1,): block q holds rows block[q] … block[q + 1] − 1
    μ: np.ndarray  # (B,) of a contact; −1: a single row
    lower: np.ndarray  # (m,) bounds of λ of single rows
    upper: np.ndarray  # (m,)


class Law(NamedTuple):
    """What changes from pass to pass, (B,) each."""

    ρ: np.ndarray  # the weight
    give: np.ndarray  # 1 + ρ γ of the first row: 1 where it is rigid
    shift: np.ndarray  # added to w_n, m/s, unless it follows
    limit: np.ndarray  # of friction, by itself; −1: the cone
    answer: np.ndarray  # (B, 2): the shift before, and the μ|w_t| that it led to


class Pass(NamedTuple):
    """What ``evaluate`` fills in for a velocity u."""

    w: np.ndarray  # (m,)
    λ: np.ndarray  # (m,): λ̂
    slope: np.ndarray  # (m, 3): P′, or P′ Φ′ where the shift follows, the rows of each block
    state: np.ndarray  # (B,): 0 open, 1 sticks, 2 slides
    gradient: np.ndarray  # (n, k)


@compiled
def make_law(blocks):
    """Rigid, no shift, no limit; ρ is still to be set."""
    return Law(
        np.empty(blocks), np.ones(blocks), np.zeros(blocks), np.full(blocks, -1.0), np.zeros((blocks, 2))
    )


@compiled
def make_pass(rows, n, k):
    """Room for a pass over n bodies."""
    m, blocks = len(rows.c), len(rows.μ)
    return Pass(np.empty(m), np.empty(m), np.zeros((m, 3)), np.zeros(blocks, np.int64), np.empty((n, k)))


@inner
def dot(a, b):
    """Σ a_k b_k."""
    total = 0.0
    for k in range(len(a)):
        total += a[k] * b[k]
    return total


@inner_apart
def evaluate(rows, M, free, λ, law, follows, u, out):
    """The augmented Lagrangian at u, with λ̂, P′ and the gradient into ``out``; follows: the shift follows."""
    value, k = 0.0, u.shape[1]
    for i in range(len(u)):
        for a in range(k):
            total = 0.0
            for b in range(k):
                total += M[i, a, b] * (u[i, b] - free[i, b])
            out.gradient[i, a] = total
            value += 0.5 * total * (u[i, a] - free[i, a])
    for q in range(len(rows.μ)):
        first, end, along = rows.block[q], rows.block[q + 1], 0.0
        for r in range(first, end):
            w = rows.c[r]
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    w += dot(rows.J[r, side], u[i])
            out.w[r] = w
            out.λ[r] = λ[r] - law.ρ[q] * w
            along += w * w if r > first else 0.0
        along = np.sqrt(along)
        out.λ[first] -= law.ρ[q] * (max(rows.μ[q], 0.0) * along if follows else law.shift[q])
        value += project(rows, q, first, end, law.give[q], law.limit[q], out) / law.ρ[q]
        if follows and along > 0:
            follow(rows.μ[q] / along, first, end, out)
        for r in range(first, end):
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    for a in range(k):
                        out.gradient[i, a] -= rows.J[r, side, a] * out.λ[r]
    return value


@inner
def follow(share, first, end, out):
    """P′ becomes P′ Φ′: what depends on w_n depends on w_t, too; share: μ/|w_t|."""
    for r in range(first, end):
        for s in range(first + 1, end):
            out.slope[r, s - first] += out.slope[r, 0] * share * out.w[s]


@inner
def project(rows, q, first, end, give, limit, out):
    """P of block q in place, P′ and the state; returns the block's term of L times ρ, whose gradient P is.

    give, limit: the block's in ``Law``.
    """
    y, μ = out.λ, rows.μ[q]
    for r in range(first, end):
        put_slope(out.slope, r, 0.0, 0.0, 0.0)
    if μ < 0:
        before = y[first]
        y[first] = min(max(before / give, rows.lower[first]), rows.upper[first])
        out.state[q] = STICKS if y[first] == before / give else OPEN
        out.slope[first, 0] = out.state[q] / give
        return before * y[first] - 0.5 * give * y[first] ** 2
    n, along = y[first], 0.0
    for r in range(first + 1, end):
        along += y[r] ** 2
    tangential = np.sqrt(along)
    if limit >= 0:
        return press(first, end, n, tangential, give, limit, q, out)
    if n >= 0 and tangential <= μ * n / give:  # within the cone: it sticks
        out.state[q], y[first] = STICKS, n / give
        out.slope[first, 0] = 1 / give
        for r in range(first + 1, end):
            out.slope[r, r - first] = 1.0
        return 0.5 * (n * n / give + along)
    if μ * tangential <= -n:  # within the polar cone: it parts
        out.state[q] = OPEN
        for r in range(first, end):
            y[r] = 0.0
        return 0.0
    return slide(rows, q, n, tangential, give, out)


@inner
def slide(rows, q, n, tangential, give, out):
    """P on the cone's surface: f (1, μ t), with t the unit vector along which y pulls, f its share of y."""
    μ, first, d = rows.μ[q], rows.block[q], rows.block[q + 1] - rows.block[q]
    t1 = out.λ[first + 1] / tangential
    t2 = out.λ[first + 2] / tangential if d == 3 else 0.0
    share = 1 / (give + μ * μ)
    f = (n + μ * tangential) * share
    across = μ * f / tangential if d == 3 else 0.0  # turning t is all that the second tangent adds
    put_slope(out.slope, first, share, share * μ * t1, share * μ * t2)
    both = share * μ * μ * t1 * t2 - across * t1 * t2
    put_slope(out.slope, first + 1, share * μ * t1, share * μ * μ * t1 * t1 + across * t2 * t2, both)
    out.λ[first], out.λ[first + 1] = f, μ * f * t1
    if d == 3:
        put_slope(out.slope, first + 2, share * μ * t2, both, share * μ * μ * t2 * t2 + across * t1 * t1)
        out.λ[first + 2] = μ * f * t2
    out.state[q] = SLIDES if t1 > 0 or d == 3 else SLIDES + 1
    return 0.5 * (give + μ * μ) * f * f


@inner
def press(first, end, n, tangential, give, limit, q, out):
    """P where friction has a limit of its own: normal and tangents each by themselves."""
    pressed, slides = n > 0, tangential > limit
    out.state[q] = ALONE + 2 * int(pressed) + int(slides)
    out.λ[first] = n / give if pressed else 0.0
    put_slope(out.slope, first, 1 / give if pressed else 0.0, 0.0, 0.0)
    value = 0.5 * n * out.λ[first]
    if not slides:
        for r in range(first + 1, end):
            out.slope[r, r - first] = 1.0
        return value + 0.5 * tangential**2
    share, t1 = limit / tangential, out.λ[first + 1] / tangential
    out.λ[first + 1] = limit * t1
    if end - first == 3:  # t turns; in the plane nothing of friction at its limit changes
        t2 = out.λ[first + 2] / tangential
        put_slope(out.slope, first + 1, 0.0, share * t2 * t2, -share * t1 * t2)
        put_slope(out.slope, first + 2, 0.0, -share * t1 * t2, share * t1 * t1)
        out.λ[first + 2] = limit * t2
    return value + limit * tangential - 0.5 * limit**2


@inner
def put_slope(slope, r, a, b, c):
    """Row r of P′."""
    slope[r, 0], slope[r, 1], slope[r, 2] = a, b, c
