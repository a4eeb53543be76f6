"""The one measure of error: how far λ is from the fixed point that every solution is.

λ solves the problem if and only if a step against w, brought back to what is allowed, leads nowhere:

    r_i(λ) = λ_i − clip(λ_i − w_i/d_i, lower_i, upper_i) = 0        w = A λ + b

Row by row that is S11's polyline: w = 0 inside the bounds, w ≥ 0 at the lower, w ≤ 0 at the upper one. d_i,
an inverse mass, makes lengths of λ out of w, so that changing units changes nothing. The **merit** is
max |r_i|; the **residual** is the merit divided by its value at λ⁰ = clip(0, lower, upper). A friction row's
bounds are ±μ times the λ_n *being judged*, not some earlier one (S17).

On a cone {‖λ_t‖ ≤ μ λ_n}: one d for the block, and the projection on the cone in place of the clip. That is
the convex law (CCP). Coulomb's law (NCP) first adds μ‖w_t‖ to w_n (De Saxcé & Feng 1998): without it a
sliding contact would be lifted by μ‖w_t‖.

A small residual bounds the error of λ only through the condition number: on a tall stack 1e-3 may leave λ
almost wholly wrong.

Slides S10–S14; lectures/06_pivoting_lcp.md. Sources: Cottle, Pang & Stone, The Linear Complementarity Problem
(2009), section 1.4; De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled


class Terms(NamedTuple):
    """What stands beside A in an LCP of n rows, as flat arrays for the kernels."""

    b: np.ndarray  # (n,)
    d: np.ndarray  # (n,) what makes a length of λ out of w
    lower: np.ndarray  # (n,) −inf for friction rows, whose bounds are those of ``bounds``
    upper: np.ndarray  # (n,) inf for friction rows
    normal: np.ndarray  # (n,) int: the row whose λ bounds this one; −1: not a friction row
    mu: np.ndarray  # (n,) 0 where there is no friction


class ConeTerms(NamedTuple):
    """What stands beside A in a cone problem of m blocks (n, t1, t2), or (n, t) in the plane."""

    b: np.ndarray  # (n,)
    d: np.ndarray  # (m,) one a block
    mu: np.ndarray  # (m,)
    size: int  # 3, or 2 in the plane
    coulomb: bool  # True: "ncp"; False: "ccp"


@compiled
def clip(value, low, high):
    """The value brought between low and high; NaN stays NaN, so that it is noticed."""
    if value < low:
        return low
    if value > high:
        return high
    return value


@compiled
def larger(worst, value):
    """The larger of two numbers; NaN as soon as one of them is."""
    return worst if value <= worst or worst != worst else value


@compiled
def bounds(terms, λ, i):
    """(low, high) of row i; a friction row's are ±μ λ_n, with this very λ."""
    if terms.normal[i] < 0:
        return terms.lower[i], terms.upper[i]
    most = terms.mu[i] * max(λ[terms.normal[i]], 0.0)
    return -most, most


@compiled
def gap(terms, λ, i, w):
    """r_i of row i, whose w is given.

    λ − clip(λ − x, low, high) is written as x clipped to λ − high … λ − low, which is the same, but doesn't
    lose a small x beside a big λ.
    """
    low, high = bounds(terms, λ, i)
    return clip(w / terms.d[i], λ[i] - high, λ[i] - low)


@compiled
def merit(terms, λ, w):
    """max |r_i| of an LCP at λ (n,), with w (n,) = A λ + b; inf where λ or w isn't finite."""
    worst = 0.0
    for i in range(len(λ)):
        if not (abs(λ[i]) < np.inf and abs(w[i]) < np.inf):
            return np.inf
        worst = larger(worst, abs(gap(terms, λ, i, w[i])))
    return worst


@compiled
def project_on_cone(μ, n, t1, t2):
    """The point of the cone {‖λ_t‖ ≤ μ λ_n} nearest to (n, t1, t2): three numbers."""
    t = np.hypot(t1, t2)
    if n >= 0 and t <= μ * n:  # where μ = 0, t = 0 is no more than μ n for a negative n, too
        return n, t1, t2
    along = (n + μ * t) / (1 + μ * μ)
    if along <= 0:  # in the polar cone: nearest is the tip
        return 0.0, 0.0, 0.0
    if along != along:
        return along, along, along
    return along, μ * along * (t1 / t), μ * along * (t2 / t)


@compiled
def cone_gap(terms, λ, k, w_n, w_1, w_2):
    """The three r of block k, whose w is given; in the plane the last is 0."""
    i, μ = k * terms.size, terms.mu[k]
    λ_n, λ_1, λ_2 = λ[i], λ[i + 1], λ[i + 2] if terms.size == 3 else 0.0
    if terms.coulomb:
        w_n = w_n + μ * np.hypot(w_1, w_2)
    x_n, x_1, x_2 = w_n / terms.d[k], w_1 / terms.d[k], w_2 / terms.d[k]
    n, t1, t2 = λ_n - x_n, λ_1 - x_1, λ_2 - x_2
    if n >= 0 and np.hypot(t1, t2) <= μ * n:
        return x_n, x_1, x_2  # inside: nothing is lost beside a big λ
    n, t1, t2 = project_on_cone(μ, n, t1, t2)
    return λ_n - n, λ_1 - t1, λ_2 - t2


@compiled
def cone_merit(terms, λ, w):
    """max |r_i| of a cone problem at λ (n,), with w (n,) = A λ + b; inf where λ or w isn't finite."""
    worst = 0.0
    for i in range(len(λ)):
        if not (abs(λ[i]) < np.inf and abs(w[i]) < np.inf):
            return np.inf
    for k in range(len(terms.mu)):
        i = k * terms.size
        r_n, r_1, r_2 = cone_gap(terms, λ, k, w[i], w[i + 1], w[i + 2] if terms.size == 3 else 0.0)
        for r in (r_n, r_1, r_2):
            worst = larger(worst, abs(r))
    return worst
