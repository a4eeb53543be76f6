"""Nonlinear conjugate gradients over projected Gauss–Seidel.

A sweep takes λ to λ*, and −(λ* − λ) serves as a gradient: it is 0 just where λ solves the problem. Fletcher
and Reeves' rule then makes a direction of all steps so far, and each sweep is followed by a step along it:

    Δ = λ* − λ,    β = ‖Δ‖² / ‖Δ of the sweep before‖²,    λ ← λ* + β p,    p ← β p + Δ

Where the Δ have grown, β > 1, the direction is forgotten: p = 0, and the method starts anew from a plain
sweep. That is all that holds it, since there is no function that each step must make smaller. What the step
takes out of the bounds, the next sweep brings back. An iteration is a sweep and two sums over the rows, so it
costs what Gauss–Seidel costs, and on a stack it needs the root of the sweeps.

Slides S14, S16; lectures/08_newton_lcp.md. Source: Silcowitz, Niebe & Erleben, The Visual Computer 26 (2010)
893; Fletcher & Reeves, The Computer Journal 7 (1964) 149.
"""

import numpy as np

from ..compiled import compiled
from .gauss_seidel import natural_order
from .iteration import BLOWN_UP, iterate
from .merit import bounds, clip, gap, larger
from .solution import DIVERGED, MAX_ITERATIONS, SOLVED


@compiled
def sweep_once(row, rows, change, A, terms, λ, x, λ_old, x_old, order):
    """One sweep of Gauss–Seidel in place. Returns the merit of the λ before, and ‖Δ‖²."""
    worst, size = 0.0, 0.0
    for i in order:
        before, now = rows(A, i, λ_old, x_old, λ, x)
        worst = larger(worst, abs(gap(terms, λ_old, i, before + terms.b[i])))
        low, high = bounds(terms, λ, i)
        Δ = clip(λ[i] - (now + terms.b[i]) / terms.d[i], low, high) - λ[i]
        λ[i] += Δ
        change(A, i, Δ, x)
        size += (λ[i] - λ_old[i]) ** 2 * terms.d[i]  # d makes energies of squares: units change nothing
    return worst, size


@compiled
def conjugate_sweeps(follow, row, rows, change, A, terms, λ, scale, tolerance, history, order):
    """Sweeps and steps along p until the residual is at most the tolerance; returns (iterations, code).

    The arguments are those of ``gauss_seidel.sweeps``. history[k] is the residual before sweep k.
    """
    x = follow(A, λ)
    λ_old, x_old, p, size_before = λ.copy(), x.copy(), 0 * λ, np.inf
    for k in range(len(history) - 1):
        λ_old[:] = λ
        x_old[:] = x
        worst, size = sweep_once(row, rows, change, A, terms, λ, x, λ_old, x_old, order)
        history[k] = worst / scale
        if not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            λ[:] = λ_old
            return k, SOLVED if history[k] <= tolerance else DIVERGED
        β, size_before = size / size_before, size
        if not β <= 1:
            p[:] = 0
            continue
        for i in range(len(λ)):
            Δ = λ[i] - λ_old[i]
            λ[i] += β * p[i]
            p[i] = β * p[i] + Δ
        x = follow(A, λ)
    return len(history) - 1, MAX_ITERATIONS


def nncg(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve an LCP by nonlinear conjugate gradients: bounds, friction bounds, A dense, sparse or factored.

    start (n,): λ to begin with; None: λ⁰. One iteration is a sweep and a step along p. Serves where
    Gauss–Seidel converges but takes its time: symmetric positive definite A. Where some A_ii ≤ 0 the problem
    is ``unsuitable``. Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    return iterate(conjugate_sweeps, problem, start, tolerance, max_iterations, options=(natural_order,))
