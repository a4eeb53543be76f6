"""Projected Jacobi: renew all λ at once from the old ones, then clip.

    λ_i ← clip(λ_i − ω w_i / A_ii, lower_i, upper_i),    w = A λ + b with the λ before the sweep

The order of the rows doesn't matter, except that a friction row is clipped by the λ_n just renewed, so normal
rows come first here too (S17). The residual costs nothing: w is that of the λ before the sweep.

Renewing all at once overshoots where rows push one another: with ω = 1 it converges for symmetric positive
definite A only if 2D − A is so, too. With a smaller ω (damped) it always does, namely for ω < 2/λ_max, the
largest eigenvalue of D⁻¹A. That is at most the largest row sum of |A_ij|/A_ii (Gershgorin). For the factored
operator, which has no row sums at hand, each body shares itself out among the k rows that concern it:

    λᵀ A λ = Σ_bodies |Σ_i L⁻¹J_i λ_i|² ≤ Σ_bodies k Σ_i |L⁻¹J_i λ_i|²
    λ_max ≤ max_i Σ_bodies k a_i / A_ii

with L Lᵀ the body's mass matrix and a_i = J_i M⁻¹ J_iᵀ its part of A_ii.

Slides S15, S17; lectures/07_iterative_lcp.md. Sources: Cottle, Pang & Stone, The Linear Complementarity
Problem (2009), section 5.2; the sharing: Tonge, Benevolenski & Voroshilov, ACM Trans. Graph. 31 (2012) 105.
"""

import numpy as np
import scipy.sparse

from .. import inputs
from ..compiled import compiled
from ..factored import Factored
from .iteration import BLOWN_UP, iterate
from .merit import bounds, clip, gap, larger
from .orders import natural_order
from .solution import DIVERGED, MAX_ITERATIONS, SOLVED

_SAFE = 1.9  # of the 2 below which damped Jacobi converges


@compiled
def all_at_once(follow, row, rows, change, A, terms, λ, scale, tolerance, history, order, ω):
    """Sweep, renewing all rows from the old λ, until the residual is at most the tolerance: (sweeps, code).

    Arguments as those of ``gauss_seidel.sweeps``; history[k] is the residual after k sweeps.
    """
    x, new, step = follow(A, λ), λ.copy(), ω / terms.d
    for k in range(len(history) - 1):
        worst = 0.0
        for i in order:
            w = row(A, i, λ, x) + terms.b[i]
            worst = larger(worst, abs(gap(terms, λ, i, w)))
            low, high = bounds(terms, new, i)
            new[i] = clip(λ[i] - step[i] * w, low, high)
        history[k] = worst / scale
        if not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            return k, SOLVED if history[k] <= tolerance else DIVERGED
        for i in order:
            Δ = new[i] - λ[i]
            λ[i] = new[i]
            change(A, i, Δ, x)
    return len(history) - 1, MAX_ITERATIONS


def jacobi(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve an LCP by projected Jacobi: bounds and friction bounds, A dense, sparse or factored.

    start (n,): λ to begin with; None: λ⁰ = clip(0, lower, upper). One iteration is a sweep over all rows.
    Converges surely only if 2D − A is symmetric positive definite beside A (S15): coupled rows overshoot.
    Where A_ii ≤ 0 for some row the problem is ``unsuitable``. Returns a ``Solution``.
    Raises ValueError or TypeError for bad arguments.
    """
    return iterate(all_at_once, problem, start, tolerance, max_iterations, options=(natural_order, 1.0))


def damped_jacobi(problem, start=None, tolerance=1e-10, max_iterations=1000, *, omega=None):
    """Solve an LCP by projected Jacobi with steps shortened by ω, above 0.

    omega: None: ``safe_damping``, with which it converges for every symmetric positive definite A without
    friction. All else as for ``jacobi``.
    """
    ω = safe_damping if omega is None else inputs.number("omega", omega, above=0)
    return iterate(all_at_once, problem, start, tolerance, max_iterations, options=(natural_order, ω))


def safe_damping(problem):
    """ω = min(1, 1.9/g), where g bounds λ_max(D⁻¹A): the module says how."""
    bound = (
        _shares(problem.A) if isinstance(problem.A, Factored) else _row_sums(problem.A)
    ) / problem.terms.d
    largest = bound.max(initial=1.0)
    return min(1.0, _SAFE / largest) if np.isfinite(largest) else 1.0


def _row_sums(A):
    """Σ_j |A_ij| (n,)."""
    return np.asarray(abs(A).sum(axis=1)).ravel() if scipy.sparse.issparse(A) else np.abs(A).sum(axis=1)


def _shares(A):
    """Σ over the bodies of a row of k a_i (n,), k how many rows concern the body; and the softness."""
    there = A.bodies >= 0
    k = np.bincount(A.bodies[there], minlength=A.count)
    part = np.abs(np.sum(A.J * A.B, axis=2))
    return np.sum(np.where(there, k[A.bodies] * part, 0), axis=1) + A.softness
