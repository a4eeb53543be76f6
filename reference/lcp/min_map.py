"""Newton's method on the minimum map: guess which rows are free, solve for them, look again.

The LCP is the equation r(λ) = 0 with r_i = λ_i − clip(λ_i − w_i/d_i, lower_i, upper_i), of which every row is
one of three straight pieces (without bounds above it is min(λ_i, w_i/d_i)):

    free: r_i = w_i/d_i          at the lower bound: r_i = λ_i − lower_i          at the upper: r_i = λ_i −
    upper_i

Newton's step for these pieces puts the rows at a bound there, and solves A_FF Δ_F = −w_F − A_FB Δ_B for the
free ones: one linear system, as small as the free set. S11's "fix it at its limit and solve for the others"
is just that, with all rows changing sides at once. A friction row at its bound is ±μ λ_n, and takes its
normal's unknown along.

The λ that a full step leads to depends on the pieces alone. So if pieces come back that have been before, the
method would go round for ever (Kostreva's example). Then a line search takes over from the best λ so far,
until ψ = ½ ‖r‖² has halved; then full steps again. Full steps first, since ψ may have to rise: a column of n
boxes is solved in n of them, none of which makes ψ smaller.

Slides S11, S14; lectures/08_newton_lcp.md. Source: Pang, Math. Oper. Res. 15 (1990) 311; Harker & Pang,
Lectures in Applied Math. 26 (1990) 265; Hintermüller, Ito & Kunisch, SIAM J. Optim. 13 (2003) 865.
"""

import numpy as np
import scipy.sparse

from .direct import formed, solve
from .iteration import checked, solved_already, unsuitable
from .line_search import descend, energy
from .problem import LCP, relative
from .solution import CYCLE, DIVERGED, MAX_ITERATIONS, SOLVED, finish

FREE = 0  # −1 at the lower bound, 1 at the upper

_ROUND = (
    "The sets of free rows came back to one that had been before, and full Newton steps would go round for "
    "ever: allow the line search, or take another method."
)
STANDS = (
    "Neither Newton's step nor steepest descent makes the residual smaller: λ stands still, at a kink that "
    "is no solution, or as near as rounding lets it come; the residual is {residual:.2g}."
)


def min_map_newton(problem, start=None, tolerance=1e-10, max_iterations=1000, *, line_search=True):
    """Solve an LCP by Newton's method on the minimum map: bounds, friction bounds, A of any form.

    start (n,): λ to begin with; None: λ⁰. One iteration is a linear system of the free rows (a factored
    A is formed). line_search: False: full steps only, and ``cycle`` as soon as pieces come back.
    For P-matrices and contact problems; on others it may stand still, which is told (``cycle``). Returns a
    ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    λ, tolerance, most = checked(problem, start, tolerance, max_iterations)
    already = solved_already(problem, λ, tolerance)
    if already:
        return already
    if not isinstance(problem, LCP):
        return unsuitable(problem, λ, tolerance, "This method is for bounds: for cones take a cone method.")
    with np.errstate(all="ignore"):
        λ, history, code, reason = _iterate(problem, λ, tolerance, most, line_search)
    return finish(problem, λ, len(history) - 1, code, tolerance, history=history, reason=reason)


def _iterate(problem, λ, tolerance, most, line_search):
    A, seen, history, damped_above = formed(problem.A), set(), [], -1.0
    best, least = λ, np.inf
    for k in range(most + 1):
        r, w = min_map(problem, λ)
        history.append(relative(float(np.abs(r).max()), problem.scale))
        if not tolerance < history[-1] < np.inf:
            return λ, history, SOLVED if history[-1] <= tolerance else DIVERGED, None
        if k == most:
            break
        if energy(r) < least:
            best, least = λ, energy(r)
        side = pieces(problem, λ, w)
        if not damped_above < least:  # ψ has halved since the line search took over
            damped_above = -1.0
        if damped_above < 0 and side.tobytes() in seen:
            if not line_search:
                return λ, history, CYCLE, _ROUND
            λ, damped_above = best, 0.5 * least
            seen.clear()
            (r, w) = min_map(problem, λ)
            side = pieces(problem, λ, w)
        seen.add(side.tobytes())
        step = newton_step(problem, A, λ, w, r, side)
        there = λ + step
        if damped_above >= 0:
            gradient = times_transposed(problem, A, λ, side, r)
            there = descend(lambda x: min_map(problem, x)[0], λ, r, step, gradient)
            if there is None:
                return λ, history, CYCLE, STANDS.format(residual=history[-1])
        λ = there
    return λ, history, MAX_ITERATIONS, None


def min_map(problem, λ):
    """r (n,) and w (n,) at λ (n,); |r|'s largest is the merit."""
    w = problem.w(λ)
    low, high = problem.bounds(λ)
    return np.clip(w / problem.terms.d, λ - high, λ - low), w


def pieces(problem, λ, w):
    """On which piece each row is: −1 at the lower bound, 0 free, 1 at the upper (n,)."""
    low, high = problem.bounds(λ)
    aim = λ - w / problem.terms.d
    return np.where(aim > low, np.where(aim < high, FREE, 1), -1).astype(np.int8)


def coupling(problem, λ, side):
    """How a friction row's bound moves with its normal's λ (n,): ±μ at a bound, else 0."""
    normal, μ = problem.terms.normal, problem.terms.mu
    return np.where((normal >= 0) & (λ[normal] >= 0), side * μ, 0.0)


def newton_step(problem, A, λ, w, r, side):
    """Newton's step Δ (n,) for these pieces: the reduced system of the free rows."""
    free = np.flatnonzero(side == FREE)
    Δ, slope, normal = np.where(side == FREE, 0, -r), None, problem.terms.normal
    if problem.has_friction:
        slope = coupling(problem, λ, side)
        Δ = Δ + slope * np.where(slope != 0, Δ[normal], 0)
    rows = A[free]
    H = rows[:, free]
    if slope is not None and slope.any():
        tied = np.flatnonzero((slope != 0) & (side[normal] == FREE))
        place = np.searchsorted(free, normal[tied])
        C = scipy.sparse.csr_array((slope[tied], (tied, place)), shape=(problem.n, len(free)))
        H = H + rows @ C
        Δ[free] = solve(H, -w[free] - rows @ Δ)
        return Δ + C @ Δ[free]
    Δ[free] = solve(H, -w[free] - rows @ Δ)
    return Δ


def times_transposed(problem, A, λ, side, r):
    """Hᵀ r (n,), the gradient of ψ on these pieces."""
    free = side == FREE
    result = A.T @ np.where(free, r / problem.terms.d, 0) + np.where(free, 0, r)
    if problem.has_friction:
        slope = coupling(problem, λ, side)
        np.subtract.at(result, problem.terms.normal[slope != 0], (slope * r)[slope != 0])
    return result
