"""Accelerated projected gradient descent (Nesterov), with restarts: what S14's Newton is to Gauss–Seidel, for
problems too large to factor.

For symmetric positive A the LCP asks for the smallest energy ½ λᵀAλ + bᵀλ within the bounds, whose gradient
is w. Each iteration goes down from a point y that lies ahead of λ:

    λ⁺ = P(y − w(y) / (L d)),    y⁺ = λ⁺ + β (λ⁺ − λ),    β from Nesterov's θ

Plain descent needs as many iterations as the condition number, this the root of it. 1/L is the step: L is
doubled until ½ ΔᵀAΔ ≤ ½ L Σ d Δ² for the Δ = λ⁺ − y just made, and shrunk by a tenth after each. d_i = A_ii
makes one step fit rows of all units. Where the step leads uphill, w(y) · (λ⁺ − λ) > 0, the momentum is
dropped: θ = 1, y = λ⁺ (O'Donoghue & Candès). One product A λ an iteration; A y is put together from two.

P is the clip to bounds here, and the projection on friction cones in ``cone_apgd``, which also moves b on the
way (``renew``).

Slides S14; lectures/08_newton_lcp.md. Source: Nesterov, Soviet Math. Doklady 27 (1983) 372; O'Donoghue &
Candès, Found. Comput. Math. 15 (2015) 715; Mazhar, Heyn, Negrut & Tasora, ACM TOG 34 (2015) 32.
"""

import numpy as np

from ..compiled import compiled
from .iteration import BLOWN_UP, iterate
from .merit import clip, merit
from .operators import product
from .problem import ConeProblem
from .solution import DIVERGED, MAX_ITERATIONS, SOLVED
from .symmetry import why_no_box

_DOUBLINGS = 60


@compiled
def accelerate(follow, row, rows, change, project, measure, renew, A, terms, λ, scale, tolerance, history, d):
    """Iterate until the residual is at most the tolerance; returns (iterations, code).

    The first four are those of ``operators``; project(terms, λ), measure(terms, λ, w) and
    renew(terms, λ, w, shift) those of the set that λ must keep to. d (n,): a weight for each row. λ (n,) is
    start and answer.
    """
    w, shift = λ.copy(), 0 * λ
    project(terms, λ)
    product(follow, row, A, λ, w)
    w += terms.b
    y, w_y, new, w_new = λ.copy(), w.copy(), λ.copy(), w.copy()
    L, θ = first_slope(follow, row, A, d, new, w_new), 1.0
    for k in range(len(history) - 1):
        history[k] = measure(terms, λ, w) / scale
        if not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            return k, SOLVED if history[k] <= tolerance else DIVERGED
        if renew(terms, λ, w, shift):
            y[:], w_y[:], θ = λ, w, 1.0
        for _ in range(_DOUBLINGS):
            curve, size = 0.0, 0.0
            for i in range(len(λ)):
                new[i] = y[i] - (w_y[i] + shift[i]) / (L * d[i])
            project(terms, new)
            product(follow, row, A, new, w_new)
            for i in range(len(λ)):
                w_new[i] += terms.b[i]
                curve += (new[i] - y[i]) * (w_new[i] - w_y[i])
                size += d[i] * (new[i] - y[i]) ** 2
            if not curve > L * size:
                break
            L *= 2
        θ = go_ahead(λ, w, y, w_y, new, w_new, shift, θ)
        L *= 0.9
    return len(history) - 1, MAX_ITERATIONS


@compiled
def go_ahead(λ, w, y, w_y, new, w_new, shift, θ):
    """λ ← new, and y ahead of it by Nesterov's rule, or no momentum where new lies uphill. Returns θ."""
    uphill = 0.0
    for i in range(len(λ)):
        uphill += (w_y[i] + shift[i]) * (new[i] - λ[i])
    next_θ = 0.5 * (θ * np.sqrt(θ * θ + 4) - θ * θ)
    β = θ * (1 - θ) / (θ * θ + next_θ)
    if uphill > 0:
        next_θ, β = 1.0, 0.0
    for i in range(len(λ)):
        y[i] = new[i] + β * (new[i] - λ[i])
        w_y[i] = w_new[i] + β * (w_new[i] - w[i])  # w is linear in λ, so this needs no product
        λ[i], w[i] = new[i], w_new[i]
    return next_θ


@compiled
def first_slope(follow, row, A, d, x, out):
    """A first guess at L, the largest slope of w over d: what A makes of λ = 1/√d. x and out are spent."""
    for i in range(len(x)):
        x[i] = 1 / np.sqrt(d[i])
    product(follow, row, A, x, out)
    total = 0.0
    for i in range(len(x)):
        total += out[i] ** 2 / d[i]
    return np.sqrt(total / len(x)) if total > 0 else 1.0


@compiled
def clip_all(terms, λ):
    """λ (n,) brought into its bounds, in place."""
    for i in range(len(λ)):
        λ[i] = clip(λ[i], terms.lower[i], terms.upper[i])


@compiled
def keep(terms, λ, w, shift):
    """Bounds ask for no shift."""
    return False


def weights(problem):
    """d (n,), one a row."""
    d = problem.terms.d
    return np.repeat(d, problem.size) if isinstance(problem, ConeProblem) else d


def apgd(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve an LCP by accelerated projected gradients: bounds, A dense, sparse or factored.

    start (n,): λ to begin with, clipped to the bounds first; None: λ⁰. For symmetric positive (semi)definite
    A, singular too; ``unsuitable`` where A is not symmetric, and where bounds depend on λ (friction). One
    iteration is a product A λ, sometimes more. Returns a ``Solution``. Raises ValueError or TypeError.
    """
    functions = clip_all, merit, keep
    return iterate(
        accelerate, problem, start, tolerance, max_iterations,
        options=(weights,), functions=functions, why_not=why_no_box,
    )  # fmt: skip
