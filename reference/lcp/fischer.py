"""Newton's method on the Fischer–Burmeister equation: complementarity with the corner rounded off.

    φ(a, b) = a + b − √(a² + b²) = 0    if and only if    a ≥ 0, b ≥ 0, a b = 0

With a = λ_i − lower_i and b = w_i/d_i the LCP is φ = 0, row by row; with two bounds φ is nested as the clip
is: φ(λ − lower, −φ(upper − λ, −w/d)). φ has a kink at (0, 0) only, and ψ = ½ ‖φ‖² none at all: it has a
gradient everywhere, so that the line search always has a way down until the gradient is 0. For P₀-matrices
that is a solution. The price: each system has all n rows.

    (D_λ + D_w A/d) Δ = −φ,    D_λ = ∂φ/∂λ,  D_w = ∂φ/∂(w/d)

At the kink any limit of gradients nearby will do (an element of the generalised Jacobian): we take that along
the diagonal, a = b > 0. A friction row's bounds ±μ λ_n add ∂φ/∂λ_n to its normal's column.

Slides S14; lectures/08_newton_lcp.md. Source: Fischer, Optimization 24 (1992) 269; Billups, PhD thesis,
University of Wisconsin (1995), for two bounds; De Luca, Facchinei & Kanzow, Math. Programming 75 (1996) 407.
"""

import numpy as np
import scipy.sparse

from .direct import formed, solve
from .iteration import checked, solved_already, unsuitable
from .line_search import descend
from .min_map import STANDS
from .problem import LCP
from .solution import CYCLE, DIVERGED, MAX_ITERATIONS, SOLVED, finish

_LONG = 50  # iterations in which the residual should go down by a hundredth at least


def fischer_newton(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve an LCP by Newton's method on φ = 0: bounds, friction bounds, A of any form.

    start (n,): λ to begin with; None: λ⁰. One iteration is a linear system of all n rows, direct (a
    factored A is formed), and a line search. Where ψ has a minimum that is no solution, λ stands still
    there, which is told (``cycle``). Returns a ``Solution``. Raises ValueError or TypeError for bad
    arguments.
    """
    λ, tolerance, most = checked(problem, start, tolerance, max_iterations)
    already = solved_already(problem, λ, tolerance)
    if already:
        return already
    if not isinstance(problem, LCP):
        return unsuitable(problem, λ, tolerance, "This method is for bounds: for cones take a cone method.")
    with np.errstate(all="ignore"):
        λ, history, code, reason = _iterate(problem, λ, tolerance, most)
    return finish(problem, λ, len(history) - 1, code, tolerance, history=history, reason=reason)


def _iterate(problem, λ, tolerance, most):
    A, history = formed(problem.A), []
    for k in range(most + 1):
        history.append(problem.residual(λ))
        if not tolerance < history[-1] < np.inf:
            return λ, history, SOLVED if history[-1] <= tolerance else DIVERGED, None
        if k == most:
            break
        φ, D_λ, D_w, D_n = fischer(problem, λ)
        H = jacobian(problem, A, D_λ, D_w, D_n)
        there = descend(lambda x: fischer(problem, x)[0], λ, φ, solve(H, -φ), H.T @ φ)
        slow = k >= _LONG and history[-1] > 0.99 * history[-_LONG] and history[-1] > 1e-3
        if there is None or slow:
            return λ, history, CYCLE, STANDS.format(residual=history[-1])
        λ = there
    return λ, history, MAX_ITERATIONS, None


def fischer_burmeister(a, b):
    """φ(a, b), ∂φ/∂a and ∂φ/∂b, elementwise; a may be inf, where φ = b."""
    far = np.isinf(a)
    a = np.where(far, 1, a)
    s, total = np.hypot(a, b), a + b
    # a + b − s loses all digits where one of a, b is small beside the other: 2ab/(a + b + s) is the same
    φ = np.where(total > 0, 2 * a * b / np.where(total > 0, total + s, 1), total - s)
    kink = s == 0
    s = np.where(kink, 1, s)
    corner = 1 - np.sqrt(0.5)
    φ_a, φ_b = np.where(kink, corner, 1 - a / s), np.where(kink, corner, 1 - b / s)
    return np.where(far, b, φ), np.where(far, 0, φ_a), np.where(far, 1, φ_b)


def fischer(problem, λ):
    """φ (n,), and its derivatives by λ, by w/d and by the λ_n of a friction row's normal, each (n,)."""
    v = problem.w(λ) / problem.terms.d
    low, high = problem.bounds(λ)
    inner, by_high, by_v = fischer_burmeister(high - λ, -v)
    φ, by_low, by_inner = fischer_burmeister(λ - low, -inner)
    normal, μ = problem.terms.normal, problem.terms.mu
    moves = np.where((normal >= 0) & (λ[normal] >= 0), μ, 0.0)
    return φ, by_low + by_inner * by_high, by_inner * by_v, moves * (by_low - by_inner * by_high)


def jacobian(problem, A, D_λ, D_w, D_n):
    """H = D_λ + D_w A/d, and D_n in the normals' columns: dense or sparse, as A is."""
    d, n = problem.terms.d, problem.n
    share, rows = D_w / d, np.flatnonzero(D_n)
    if not scipy.sparse.issparse(A):
        H = share[:, None] * A
        H[np.arange(n), np.arange(n)] += D_λ
        H[rows, problem.terms.normal[rows]] += D_n[rows]
        return H
    H = scipy.sparse.diags_array(share) @ A + scipy.sparse.diags_array(D_λ)
    if len(rows):
        H = H + scipy.sparse.csr_array((D_n[rows], (rows, problem.terms.normal[rows])), shape=(n, n))
    return H
