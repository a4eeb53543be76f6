"""Newton's method for contact with the exact friction cone, in the space of the velocities.

The velocities after a step are those nearest to the free ones, in the measure of the kinetic energy, that the
constraints allow. The augmented Lagrangian turns this into smooth problems, one after another, with
λ̂(u) = P(λ − ρ (J u + c)) and P the projection on the cone of each contact or on the bounds of each row:

    solve    M (u − u_free) = Jᵀ λ̂(u)    by Newton's method, with M + ρ Jᵀ P′ J for its matrix
    then     λ ← λ̂(u)

A weight ρ = 1/(ε A_cc) makes each pass shrink the error by ε/(ε + σ), σ the smallest eigenvalue of the
scaled A that is not 0: few passes, however heavy the top of a stack is.

Coulomb's law (``ncp``) is not the gradient of anything, but becomes the convex law once μ|w_t| is added to
w_n: that *shift* is taken from the pass before. With what sticks it is 0, and nothing is lost.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97 (augmented
Lagrangian as proximal point method); Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton); De
Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225 (the shift).
"""

import numpy as np

from ..compiled import compiled_apart, inner, inner_apart
from .augmented import ContactRows, dot, make_pass
from .cone_interior import start_inside
from .iteration import checked, solved_already, unsuitable
from .problem import ConeProblem
from .shift import begin_shift, make_memory, mix_shifts, renew_shift
from .smooth_pass import make_factor, solve_smooth
from .solution import MAX_ITERATIONS, SOLVED, finish
from .symmetry import why_no_box, why_no_cone
from .velocity_form import velocity_form

__all__ = ["ContactRows", "cone_newton", "cone_newton_kernel"]

NEAR, SMALLEST = 1e-6, 1e-10  # ε at first, and where passes shrink the error too slowly
FEW, MANY, FROM_INSIDE = 12, 50, 1e-4  # Newton steps in a pass; ε after more than a few of them
NEARER = (NEAR, NEAR, 1e-4, 1e-4, 1e-3, 1e-2, 1e-2)  # w's rounding makes 1e-16/ε in λ: to polish, a larger ε


@compiled_apart
def cone_newton_kernel(rows, M, free, coulomb, λ, tolerance, max_iterations, history, near=NEAR):
    """u (n, k) and λ (m,), which holds the start and is changed in place. M (n, k, k), free (n, k).

    Returns (u, passes, error): the error is the worst violation of w by λ's change in the last pass, m/s,
    over the worst free one; history gets that of each pass, as far as it is long. near: ε to begin with.
    """
    n, k = free.shape
    blocks = len(rows.μ)
    out, trial = make_pass(rows, n, k), make_pass(rows, n, k)
    factor = make_factor(rows, n, k)
    size, shift, ρ = np.empty(blocks), np.zeros(blocks), np.empty(blocks)
    u, scale = free.copy(), block_sizes(rows, M, free, size)
    if scale == 0:
        for r in range(len(λ)):
            λ[r] = 0.0
        return u, 0, 0.0
    add_impulses(rows, M, λ, u)
    answer, memory = np.zeros((blocks, 2)), make_memory(blocks)
    if coulomb:
        begin_shift(rows, u, shift, answer)
    ε, error, drift, most, enough = near, np.inf, np.inf, FEW, 0.1 * tolerance * scale
    for passes in range(max_iterations):
        weigh(ε, size, ρ)
        steps = solve_smooth(rows, M, free, λ, ρ, shift, factor, u, enough, out, trial, most)
        if steps == most == FEW:  # too many states to try one after another: come from inside the cones
            start_inside(rows, M, free, λ, u, size, scale, factor, out)
            if coulomb:
                begin_shift(rows, u, shift, answer)
            ε, drift, most = FROM_INSIDE, np.inf, MANY
            weigh(ε, size, ρ)
            solve_smooth(rows, M, free, λ, ρ, shift, factor, u, enough, out, trial, most)
        before, drift = drift, renew(rows, out, λ, ρ) / scale
        shifted = 0.0
        if coulomb and most == FEW:
            shifted = renew_shift(rows, out.w, shift, answer) / scale
        elif coulomb:
            shifted = mix_shifts(rows, out.w, shift, memory, drift * scale) / scale
        error = max(drift, shifted)
        if passes < len(history):
            history[passes] = error
        if error <= tolerance:
            return u, passes + 1, error
        if drift > max(0.25 * before, shifted) and ε > SMALLEST and most == FEW:
            ε *= 0.01
            for q in range(blocks):
                factor.made[q] = -1
    return u, max_iterations, error


@inner_apart
def block_sizes(rows, M, free, size):
    """A's largest diagonal entry of each block; returns the worst |w| of the free velocities."""
    scale = 0.0
    for q in range(len(size)):
        size[q] = 0.0
        for r in range(rows.block[q], rows.block[q + 1]):
            w, diagonal = rows.c[r], 0.0
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    w += dot(rows.J[r, side], free[i])
                    diagonal += over_mass(M[i], rows.J[r, side])
            size[q] = max(size[q], diagonal)
            scale = max(scale, abs(w))
    return scale


@inner
def add_impulses(rows, M, λ, u):
    """u + M⁻¹ Jᵀ λ, roughly: with the diagonal of M, since it is only where Newton's method starts."""
    for r in range(len(λ)):
        for side in range(2):
            i = rows.bodies[r, side]
            if i >= 0:
                for a in range(u.shape[1]):
                    u[i, a] += rows.J[r, side, a] * λ[r] / M[i, a, a]


@inner
def over_mass(M, a):
    """a · M⁻¹ a for one body: in space masses first, then the inertia (3, 3); else a diagonal M."""
    if len(a) != 6:
        total = 0.0
        for c in range(len(a)):
            total += a[c] ** 2 / M[c, c]
        return total
    I = M[3:, 3:]
    x, y, z = a[3], a[4], a[5]
    p, q, s = (  # the cofactors of the first row, over the determinant below
        I[1, 1] * I[2, 2] - I[1, 2] ** 2,
        I[0, 2] * I[1, 2] - I[0, 1] * I[2, 2],
        I[0, 1] * I[1, 2] - I[0, 2] * I[1, 1],
    )
    determinant = I[0, 0] * p + I[0, 1] * q + I[0, 2] * s
    turning = p * x * x + 2 * (q * x * y + s * x * z + (I[0, 1] * I[0, 2] - I[0, 0] * I[1, 2]) * y * z)
    turning += (I[0, 0] * I[2, 2] - I[0, 2] ** 2) * y * y + (I[0, 0] * I[1, 1] - I[0, 1] ** 2) * z * z
    return (a[0] ** 2 + a[1] ** 2 + a[2] ** 2) / M[0, 0] + turning / determinant


@inner
def renew(rows, out, λ, ρ):
    """λ ← λ̂. Returns the worst change, as a velocity."""
    worst = 0.0
    for q in range(len(ρ)):
        for r in range(rows.block[q], rows.block[q + 1]):
            change = abs(out.λ[r] - λ[r]) / ρ[q]
            worst = max(worst, change) if change < np.inf else np.inf  # nan must not pass for 0
            λ[r] = out.λ[r]
    return worst


@inner
def weigh(ε, size, ρ):
    """ρ (B,), filled: 1/ε over A's entries."""
    for q in range(len(size)):
        ρ[q] = 1 / (ε * size[q])


def cone_newton(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve a ConeProblem of either law, or an LCP with bounds, by Newton's method in the velocities.

    start (m,): λ to begin with; None: λ⁰. One iteration is a pass: a smooth problem, solved by a few Newton
    steps. For symmetric positive semidefinite A; redundant contacts do no harm. A ``Factored`` A that knows
    its masses is solved body by body (see ``velocity_form``); any other A is factored into G Gᵀ first, for
    n of a few hundred. ``history`` has the residual of both ends; ``record`` the error of each pass,
    relative, in w. Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    λ, tolerance, most = checked(problem, start, tolerance, max_iterations)
    already = solved_already(problem, λ, tolerance)
    if already:
        return already
    form = reason = (why_no_cone if isinstance(problem, ConeProblem) else why_no_row)(problem)
    if not reason:
        form = velocity_form(problem)
        reason = "" if form else "This method needs a positive semidefinite A, but this one is not."
    if reason:
        return unsuitable(problem, λ, tolerance, reason)
    coulomb, done, errors = getattr(problem, "law", "") == "ncp", 0, np.empty(most)
    free, first = np.zeros(form[1].shape[:2]), problem.residual(λ)
    with np.errstate(all="ignore"):
        for near in NEARER:
            if done == most or problem.residual(λ) <= tolerance or not np.isfinite(λ).all():
                break
            left = most - done if done == 0 else min(most - done, 5)
            _, passes, _ = cone_newton_kernel(*form, free, coulomb, λ, tolerance, left, errors[done:], near)
            done += passes
    history = np.full(done + 1, np.nan)
    history[0] = first
    code = MAX_ITERATIONS if done == most else SOLVED
    return finish(problem, λ, done, code, tolerance, history=history, record=errors[:done].tolist())


def why_no_row(problem):
    """Why an LCP can't be treated row by row in the space of the velocities; "" where it can."""
    reason = why_no_box(problem)
    if not reason and (problem.A.diagonal() <= 0).any():
        return "This method needs positive A_ii: each row must be able to change its own w."
    return reason
