"""Newton's method for contact with the exact friction cone, in the space of the velocities.

The velocities after a step are those nearest to the free ones, in the measure of the kinetic energy, that the
constraints allow. The augmented Lagrangian turns this into smooth problems, one after another, with
λ̂(u) = P(λ − ρ (J u + c)) and P the projection on the cone of each contact or on the bounds of each row:

    solve    M (u − u_free) = Jᵀ λ̂(u)    by Newton's method, with M + ρ Jᵀ P′ J for its matrix
    then     λ ← λ̂(u)

A weight ρ = 1/(ε A_cc) makes each pass shrink the error by ε/(ε + σ), σ the smallest eigenvalue of the
scaled A that is not 0: few passes, however heavy the top of a stack is.

Coulomb's law (``ncp``) is not the gradient of anything, but becomes convex with a *shift* μ|w_t| added to
w_n, taken from the pass before. With what sticks it is 0, and nothing is lost. Where passes stop helping, the
other way is taken: friction's *limit* μ λ_n from the pass before (see ``coulomb``); where that stops, sweeps
over the contacts (``contact_sweeps``), and the shift again from there. Where a pass has too many states to
try, it begins from inside the cones (``cone_interior``), and the shifts are mixed from then on (``shift``).

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97 (augmented
Lagrangian as proximal point method); Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton); De
Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225 (the shift).
"""

import numpy as np

from ..compiled import compiled, compiled_apart, inner
from ..factored import add_rows
from .augmented import ContactRows, dot, make_law, make_pass
from .cone_interior import start_inside
from .contact_sweeps import fill_moves, sweep_contacts, velocity
from .coulomb import begin_shift, renew_limit, renew_shift
from .iteration import checked, solved_already, unsuitable
from .problem import ConeProblem
from .shift import make_memory, mix_shifts
from .smooth_pass import make_factor, solve_smooth
from .solution import MAX_ITERATIONS, SOLVED, finish
from .symmetry import why_no_box, why_no_cone
from .velocity_form import velocity_form

__all__ = ["ContactRows", "cone_newton", "cone_newton_kernel"]

NEAR, SMALLEST = 1e-6, 1e-10  # ε at first, and where passes shrink the error too slowly
NEARER = (NEAR, NEAR, 1e-4, 1e-4, 1e-3, 1e-2, 1e-2)  # w's rounding makes 1e-16/ε in λ: to polish, a larger ε
NEAR_LIMIT, LARGEST, QUICKEST = 1e-4, 1.0, 1e-12  # where λ sets the limits, and so its rounding counts
WILD = 10.0  # times the worst free w: limits that lead astray
PATIENCE, SWEEPS = 6, 32  # passes that may not halve the error (see ``patience``); sweeps at first
FEW, MANY, FROM_INSIDE = 12, 50, 1e-4  # Newton steps in a pass; ε after more than a few of them


@compiled_apart
def cone_newton_kernel(rows, M, free, softness, coulomb, λ, tolerance, max_iterations, history, near=NEAR):
    """u (n, k) and λ (m,), which holds the start and is changed in place. M (n, k, k), free (n, k).

    softness (B,): γ of each block's first row, which gives way: w = J u + c + γ λ. Returns (u, passes,
    error): the error is the worst violation of w by λ's change in the last pass, m/s, over the worst free
    one; history gets that of each pass, as far as it is long. near: ε to begin with.
    """
    (n, k), blocks = free.shape, len(rows.μ)
    out, trial, law = make_pass(rows, n, k), make_pass(rows, n, k), make_law(blocks)
    factor, moves, size = make_factor(rows, n, k), np.empty(rows.J.shape), np.empty(blocks)
    fill_moves(rows, M, moves)
    u, scale = free.copy(), block_sizes(rows, moves, free, size)
    if scale == 0:
        λ[:] = 0
        return u, 0, 0.0
    add_rows(rows.bodies, moves, λ, u)
    wanted = tolerance * scale
    begin_law(rows, u, coulomb, law)
    ε, error, drift, limits, best, since, sweeps = near, np.inf, np.inf, False, np.inf, 0, SWEEPS
    raised, may_rest, kept, kept_error = False, True, λ.copy(), np.inf
    most, memory = FEW, make_memory(blocks)
    for passes in range(max_iterations):
        weigh(ε, size, softness, law, factor)
        allowed = MANY if limits else most
        steps = solve_smooth(rows, M, free, λ, law, factor, u, 0.1 * wanted, out, trial, allowed)
        if steps == FEW == allowed:  # too many states to try: come from inside the cones
            ε, drift, most = FROM_INSIDE, np.inf, MANY
            start_inside(rows, M, free, λ, u, size, scale, factor, out)
            begin_law(rows, u, coulomb, law)
            weigh(ε, size, softness, law, factor)
            solve_smooth(rows, M, free, λ, law, factor, u, 0.1 * wanted, out, trial, most)
        last, before, drift, changed = error, drift, renew(rows, out, λ, law.ρ) / scale, 0.0
        if coulomb:
            changed = renew_law(rows, λ, u, out.w, size, drift * scale, limits, most, memory, law) / scale
        error = max(drift, changed)
        if passes < len(history):
            history[passes] = error
        if error <= tolerance:
            return u, passes + 1, error
        since = 0 if error < 0.5 * best else since + 1
        best = error if limits and error > 100 * last else min(best, error)  # λ has got somewhere else
        if coulomb and (since >= patience(limits, most) or (limits and not error < WILD)):  # the other way
            if limits:
                sweep_from_best(rows, moves, softness, free, λ, u, kept, error <= kept_error, wanted, sweeps)
                begin_law(rows, u, coulomb, law)
                sweeps *= 2
            else:
                kept_error = keep_better(λ, error, kept, kept_error)
                renew_limit(rows, λ, size, law)
            limits, raised, may_rest, best, since = not limits, False, True, np.inf, 0
            error, drift, ε = np.inf, np.inf, NEAR_LIMIT if limits else near
        elif limits and raised:
            raised = False  # what ε just left over shows in this pass's error
        else:
            may_rest = may_rest and (drift <= tolerance or ε <= NEAR_LIMIT)
            rests, keeps = may_rest and drift <= tolerance, drift <= max(0.25 * before, changed)
            new = limit_weight(ε, error, last, rests) if limits else shift_weight(ε, keeps or most == MANY)
            raised, ε = new > ε, new
    sweep_from_best(rows, moves, softness, free, λ, u, kept, error <= kept_error, wanted, 0)
    return u, max_iterations, min(error, kept_error)


@compiled(door=False)
def begin_law(rows, u, coulomb, law):
    """As ``begin_shift``, where the law is Coulomb's."""
    if coulomb:
        begin_shift(rows, u, law)


@compiled(door=False)
def renew_law(rows, λ, u, w, size, drift, limits, most, memory, law):
    """What the next pass takes from this one. Returns the worst change, m/s."""
    if limits:
        return renew_limit(rows, λ, size, law)
    return mix_shifts(rows, w, law.shift, memory, drift) if most == MANY else renew_shift(rows, u, law)


@inner
def shift_weight(ε, keeps):
    """The next ε: the same, or a smaller one where passes shrink the error too slowly."""
    return ε if keeps or ε <= SMALLEST else 0.01 * ε


@inner
def patience(limits, most):
    """How many passes may not halve the error: shifts that are mixed take their time."""
    if limits:
        return 2 * PATIENCE
    return PATIENCE if most == FEW else 4 * PATIENCE


@compiled
def sweep_from_best(rows, moves, softness, free, λ, u, kept, better, tolerance, sweeps):
    """So many sweeps over the contacts from λ, or from the one kept, unless λ is better; λ and u in place."""
    if not better:
        λ[:] = kept
    u[:] = free
    add_rows(rows.bodies, moves, λ, u)
    sweep_contacts(rows, moves, softness, True, λ, u, tolerance, sweeps)


@compiled
def keep_better(λ, error, kept, kept_error):
    """Keep λ if its error is smaller; returns the error of what is kept."""
    if error < kept_error:
        kept[:] = λ
    return min(error, kept_error)


@inner
def limit_weight(ε, error, last, rests):
    """The next ε where friction has limits, from how the error went. Where λ creeps on, long steps get it
    over with; where w is right whatever λ is, short ones let it rest.
    """
    if error < 0.5 * last:
        return max(ε, NEAR_LIMIT)
    return min(100 * ε, LARGEST) if rests else max(1e-4 * ε, QUICKEST)


@inner
def weigh(ε, size, softness, law, factor):
    """ρ = 1/(ε A_cc), what gives way for it; and the factor was made for another."""
    for q in range(len(size)):
        ρ = 1 / (ε * size[q])
        if ρ != law.ρ[q]:
            factor.made[q] = -1
        law.ρ[q], law.give[q] = ρ, 1 + ρ * softness[q]


@compiled_apart
def block_sizes(rows, moves, free, size):
    """A's largest diagonal entry of each block; returns the worst |w| of the free velocities."""
    scale = 0.0
    for q in range(len(size)):
        size[q] = 0.0
        for r in range(rows.block[q], rows.block[q + 1]):
            diagonal = 0.0
            for side in range(2):
                if rows.bodies[r, side] >= 0:
                    diagonal += dot(rows.J[r, side], moves[r, side])
            size[q] = max(size[q], diagonal)
            scale = max(scale, abs(velocity(rows, r, free)))
    return scale


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
    rows, M, softness = form
    free, first = np.zeros(M.shape[:2]), problem.residual(λ)
    with np.errstate(all="ignore"):
        for near in NEARER:
            if done == most or problem.residual(λ) <= tolerance or not np.isfinite(λ).all():
                break
            left = most - done if done == 0 else min(most - done, 5)
            _, passes, _ = cone_newton_kernel(
                rows, M, free, softness, coulomb, λ, tolerance, left, errors[done:], near
            )
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
