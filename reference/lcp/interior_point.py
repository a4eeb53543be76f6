"""An interior point method: round off all corners at once, and sharpen them from step to step.

Each bound gets a z > 0 beside its distance s > 0, and the corner s z = 0 becomes the hyperbola s z = σμ:

    A λ + b = z_l − z_h,    (λ − lower) z_l = σμ,    (upper − λ) z_h = σμ,    everything positive

As μ → 0 the solutions of these smooth equations, the central path, lead to that of the LCP. A Newton step
on them comes down to one linear system of all rows,

    (A + z_l/s_l + z_h/s_h) Δλ = …

and stops short of the nearest bound. It is solved twice with one factor (Mehrotra): a trial with σ = 0
tells how much μ can fall, hence σ, and what the products Δs Δz will spoil. For positive semidefinite A,
symmetric or not, singular or not, 10 to 30 iterations do, whatever n: no set of rows has to be guessed.

Slides S14; lectures/08_newton_lcp.md. Source: Kojima, Megiddo, Noma & Yoshise, A Unified Approach to Interior
Point Algorithms for LCPs (1991); Mehrotra, SIAM J. Optim. 2 (1992) 575; Wright, Primal-Dual Interior-Point
Methods (1997), chapter 8.
"""

import numpy as np
import scipy.optimize
import scipy.sparse

from .direct import factored_solve, formed
from .iteration import checked, solved_already, unsuitable
from .problem import LCP
from .solution import CYCLE, DIVERGED, INFEASIBLE, MAX_ITERATIONS, SOLVED, finish

_SHORT = 1e-9  # a step so short leads nowhere
_FAR = 1e5  # times the scale of λ: where to look for a proof that there is no solution
_LARGEST = 1000  # rows up to which a proof is looked for
_STUCK = (
    "The steps have become too short to lead anywhere, with a residual of {residual:.2g}: the problem is not "
    "monotone (A not positive semidefinite), or has no solution, or rounding allows no more."
)
_PROOF = (
    "The problem has no solution: certificate['y'] is a y ≥ 0 with Aᵀ y ≤ 0 (to rounding) and "
    "y·(A lower + b) < 0, so that y·w < 0 for every λ ≥ lower, and w can't be ≥ 0."
)


def interior_point(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve a monotone LCP (A positive semidefinite) by an interior point method: bounds, A of any form.

    start (n,): only its size is used, since the method starts in the middle; None: λ⁰. One iteration is a
    linear system of all n rows, factored once (a factored A is formed). ``unsuitable`` for bounds that depend
    on λ (friction), and where some A_ii < 0. Says ``infeasible``, with a certificate, where λ runs off and
    a linear program finds one. Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    λ, tolerance, most = checked(problem, start, tolerance, max_iterations)
    already = solved_already(problem, λ, tolerance)
    if already:
        return already
    reason = _why_not(problem)
    if reason:
        return unsuitable(problem, λ, tolerance, reason)
    with np.errstate(all="ignore"):
        λ, history, code, reason, proof = _iterate(problem, tolerance, most)
    count = len(history) - 1
    return finish(problem, λ, count, code, tolerance, history=history, reason=reason, certificate=proof)


def _why_not(problem):
    if not isinstance(problem, LCP):
        return "This method is for bounds, not for friction cones: take a cone method."
    if problem.has_friction:
        return "This method needs fixed bounds, but friction's move with λ_n: that problem is not monotone."
    if problem.scale == np.inf:
        return "b over A's entries overflows: the numbers of this problem are too far apart."
    if problem.A.diagonal().min(initial=0) < 0:
        return "This method needs a positive semidefinite A, but some A_ii is negative."
    return ""


class _Middle:
    """The rows whose bounds leave room, and a point in the middle: λ, and z and s of both bounds."""

    def __init__(self, problem):
        low, high, d = problem.lower, problem.upper, problem.terms.d
        self.open = np.flatnonzero(low < high)  # the others are where they must be
        self.λ = problem.origin.copy()
        whole = formed(problem.A)
        self.A = whole[self.open][:, self.open]
        self.low, self.high = low[self.open], high[self.open]
        self.has_low, self.has_high = np.isfinite(self.low), np.isfinite(self.high)
        width = np.where(self.has_low & self.has_high, self.high - self.low, np.inf)
        inside = np.minimum(problem.scale, 0.5 * width)
        x = np.where(self.has_low, self.low + inside, np.where(self.has_high, self.high - inside, 0.0))
        self.λ[self.open] = x
        z = d[self.open] * problem.scale
        self.z_l, self.z_h = np.where(self.has_low, z, 0.0), np.where(self.has_high, z, 0.0)

    def slacks(self):
        """s_l and s_h: the distances to the bounds, 1 where there is none (their z is 0)."""
        x = self.λ[self.open]
        return np.where(self.has_low, x - self.low, 1.0), np.where(self.has_high, self.high - x, 1.0)


def _iterate(problem, tolerance, most):
    """(λ, history, code, reason, certificate)."""
    middle, history, far = _Middle(problem), [], _FAR * problem.scale
    for k in range(most + 1):
        residual = problem.residual(middle.λ)
        history.append(residual)
        if not tolerance < residual < np.inf:
            return middle.λ, history, SOLVED if residual <= tolerance else DIVERGED, None, None
        if k == most:
            break
        stuck = not _advance(problem, middle) > _SHORT
        if (stuck or np.abs(middle.λ).max() > far) and residual > tolerance:
            far = np.inf  # once is enough
            proof = _certificate(problem)
            if proof is not None:
                return middle.λ, [*history, residual], INFEASIBLE, _PROOF, {"y": proof}
        if stuck:
            return middle.λ, [*history, residual], CYCLE, _STUCK.format(residual=residual), None
    return middle.λ, history, MAX_ITERATIONS, None, None


def _advance(problem, at):
    """One step, predicted and corrected; returns its length, 1 for a whole one."""
    s_l, s_h = at.slacks()
    rest = problem.w(at.λ)[at.open] - at.z_l + at.z_h
    solve = factored_solve(_plus_diagonal(at.A, at.z_l / s_l + at.z_h / s_h))
    count = max(at.has_low.sum() + at.has_high.sum(), 1)

    def step(t_l, t_h):
        """Δλ, Δz_l, Δz_h for what s z is to change by."""
        Δ = solve(-rest + t_l / s_l - t_h / s_h)
        return Δ, (t_l - at.z_l * Δ) / s_l * at.has_low, (t_h + at.z_h * Δ) / s_h * at.has_high

    Δ, Δ_l, Δ_h = step(-at.z_l * s_l, -at.z_h * s_h)
    α = _room(at, s_l, s_h, Δ, Δ_l, Δ_h)
    μ = (at.z_l @ s_l + at.z_h @ s_h) / count
    aside_l, aside_h = (at.z_l + α * Δ_l) * (s_l + α * Δ), (at.z_h + α * Δ_h) * (s_h - α * Δ)
    aside = (aside_l[at.has_low].sum() + aside_h[at.has_high].sum()) / count
    σμ = (aside / μ) ** 3 * μ if μ > 0 else 0.0
    Δ, Δ_l, Δ_h = step(
        (σμ - Δ_l * Δ) * at.has_low - at.z_l * s_l, (σμ + Δ_h * Δ) * at.has_high - at.z_h * s_h
    )
    α = min(1.0, 0.99 * _room(at, s_l, s_h, Δ, Δ_l, Δ_h) if at.has_low.any() or at.has_high.any() else 1.0)
    at.λ[at.open] += α * Δ
    at.z_l += α * Δ_l
    at.z_h += α * Δ_h
    return α


def _room(at, s_l, s_h, Δ, Δ_l, Δ_h):
    """The longest step, at most 1/0.99, that keeps every s and z from below 0."""
    least = 0.99
    for has, value, change in (
        (at.has_low, s_l, Δ), (at.has_high, s_h, -Δ), (at.has_low, at.z_l, Δ_l), (at.has_high, at.z_h, Δ_h),
    ):  # fmt: skip
        least = max(least, (-change[has] / value[has]).max(initial=0))
    return 1 / least


def _plus_diagonal(A, diagonal):
    if scipy.sparse.issparse(A):
        return A + scipy.sparse.diags_array(diagonal)
    return A + np.diag(diagonal)


def _certificate(problem):
    """y ≥ 0 with Aᵀ y ≤ 0 and y·(A lower + b) < 0, by linear programming, or None."""
    if problem.n > _LARGEST or np.isinf(problem.lower).any() or np.isfinite(problem.upper).any():
        return None
    d = np.sqrt(problem.terms.d)
    A, b = formed(problem.A), problem.w(problem.lower) / d
    A = scipy.sparse.csr_array(A) / d[:, None] / d
    against = scipy.sparse.vstack([A.T, b[None] / np.abs(b).max()])
    most = np.append(np.zeros(problem.n), -1.0)
    found = scipy.optimize.linprog(np.ones(problem.n), A_ub=against, b_ub=most)
    return found.x / d if found.status == 0 else None
