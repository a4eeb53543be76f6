"""Projected Gauss–Seidel: renew λ one row at a time, and clip each right after it is renewed.

    λ_i ← clip(λ_i − ω w_i / A_ii, lower_i, upper_i),    w_i = Σ_j A_ij λ_j + b_i with all that is new already

ω = 1 is Gauss–Seidel: the row's own w becomes 0. Friction is clipped to ±μ times the λ_n just renewed, so a
normal row always comes before its friction rows (S17). A sweep over all rows costs as much as a product A λ.

The residual of the λ before a sweep needs w_i at that λ: the sweep sums it beside the w_i it works with, over
the numbers of A that it has in hand anyway. That makes a sweep up to a third dearer, so ``every`` may thin it
out; what is in the history is exact. One sweep too many is done at the end, whose λ is thrown away.

Slides S15–S17; lectures/07_iterative_lcp.md.
"""

import numpy as np

from .. import inputs
from ..compiled import compiled
from .iteration import BLOWN_UP, iterate
from .merit import bounds, clip, gap, larger
from .orders import natural_order
from .solution import DIVERGED, MAX_ITERATIONS, SOLVED

_MANY, _SELDOM = 2000, 8  # from so many rows on, the residual is looked at each 8 sweeps only


@compiled
def sweeps(follow, row, rows, change, A, terms, λ, scale, tolerance, history, order, ω, every):
    """Sweep over the rows in this order until the residual is at most the tolerance; returns (sweeps, code).

    ``follow, row, rows, change`` are those of ``operators``. λ (n,) is the start, and becomes the answer. At
    most len(history) − 1 sweeps; history[k] becomes the residual after k of them where k is a multiple of
    ``every``, NaN elsewhere; the last one is left to be measured.
    """
    x = follow(A, λ)
    λ_old, x_old, step = λ.copy(), x.copy(), ω / terms.d
    for k in range(len(history) - 1):
        looking, worst = k % every == 0, 0.0
        if looking:
            λ_old[:] = λ
            x_old[:] = x
        for i in order:
            if looking:
                before, now = rows(A, i, λ_old, x_old, λ, x)
                worst = larger(worst, abs(gap(terms, λ_old, i, before + terms.b[i])))
            else:
                now = row(A, i, λ, x)
            low, high = bounds(terms, λ, i)
            new = clip(λ[i] - step[i] * (now + terms.b[i]), low, high)
            Δ = new - λ[i]
            λ[i] = new
            change(A, i, Δ, x)
        history[k] = worst / scale if looking else np.nan
        if looking and not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            λ[:] = λ_old
            return k, SOLVED if history[k] <= tolerance else DIVERGED
    return len(history) - 1, MAX_ITERATIONS


def gauss_seidel(problem, start=None, tolerance=1e-10, max_iterations=1000, *, every=None):
    """Solve an LCP by projected Gauss–Seidel: bounds and friction bounds, A dense, sparse or factored.

    start (n,): λ to begin with; None: λ⁰ = clip(0, lower, upper). One iteration is a sweep over all rows.
    every: the residual is looked at each so many sweeps only, and ``history`` has NaN for the others; None:
    at each, or each 8 from 2,000 rows on, where looking would take a fifth of the time.
    Converges for symmetric positive definite A without friction (S15); slowly where heavy rests on light.
    Where A_ii ≤ 0 for some row the problem is ``unsuitable``. Returns a ``Solution``.
    Raises ValueError or TypeError for bad arguments. Sources: Cryer, SIAM J. Control 9 (1971) 385, for the
    projected sweep; Jourdan, Alart & Jean, CMAME 155 (1998) 31, for friction.
    """
    options = natural_order, 1.0, how_often(every)
    return iterate(sweeps, problem, start, tolerance, max_iterations, options=options)


def how_often(every):
    """``every`` as an option of ``sweeps``: checked, or chosen by the number of rows where it is None."""
    if every is None:
        return lambda problem: 1 if problem.n < _MANY else _SELDOM
    return inputs.whole("every", every, least=1)
