"""Newton's method for contact with the exact friction cone, in the space of the velocities.

The velocities after a step are those nearest to the free ones, in the measure of the kinetic energy, that the
constraints allow. The augmented Lagrangian turns this into smooth problems, one after another, with
λ̂(u) = P(λ − ρ (J u + c)) and P the projection on the cone of each contact or on the bounds of each row:

    solve    M (u − u_free) = Jᵀ λ̂(u)    by Newton's method, with M + ρ Jᵀ P′ J for its matrix
    then     λ ← λ̂(u)

A weight ρ = 1/(ε A_cc) makes each pass shrink the error by ε/(ε + σ), σ the smallest eigenvalue of the
scaled A that is not 0: few passes, however heavy the top of a stack is.

Coulomb's law (``ncp``) is not the gradient of anything, but becomes convex with a *shift* μ|w_t| added to
w_n. A pass takes it from the pass before, and is solved so, safely; from there it lets the shift *follow* w
(see ``augmented``), which squares its error in each step, and keeps that if it is nearer to the law. Where
passes don't halve the error, or have too many states to try, they begin again: from inside the cones
(``cone_interior``); from where passes with friction's *limit* lead (``coulomb``); and at last from where
sweeps over the contacts lead (``contact_sweeps``). The best of all these counts.

Where few digits are asked for, sweeps give them sooner: of many contacts they are tried first.

A face that slides and turns in space may have many answers. The path from inside ends at one of them, and the
nearer to its end, the more it is rounding that says which. There the passes take over early.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97 (augmented
Lagrangian as proximal point method); Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton); De
Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225 (the shift).
"""

import numpy as np

from ..compiled import compiled_apart, inner
from ..factored import add_rows
from .augmented import ContactRows
from .cone_interior import start_inside
from .cone_passes import FEW, MANY, Best, keep_best, make_passes, make_room, solve_pass, take_over
from .contact_sweeps import block_sizes, fill_moves, sweep_contacts, velocities
from .coulomb import begin_shift, breach, no_limit, renew_limit
from .iteration import checked, solved_already, unsuitable
from .problem import ConeProblem
from .solution import MAX_ITERATIONS, SOLVED, finish
from .symmetry import why_no_box, why_no_cone
from .velocity_form import velocity_form

__all__ = ["ContactRows", "cone_newton", "cone_newton_kernel"]

NEAR = 1e-4  # ε at first
WEIGHTS = (1e-6, 1e-8, 1e-10, 1e-4, 1e-2)  # and then: smaller where passes are slow, larger to polish, for
POLISH = (1e-4, 1e-3, 1e-2, 1e-6, 1e-8, 1e-4, 1e-2)  # w's rounding is 1e-16/ε of λ; and from near the answer
SINGLE, TURNS = 2, 10  # so few contacts are first solved one by one, exactly, and so often
COARSE, MOST_TURNS = 1e-5, 200  # where such an error is enough, sweeps may do, some times as many,
MANY_CONTACTS = 1000  # and are tried first
LIMITED = (1e-8, 1e-10, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-4)  # of passes with limits: λ must get somewhere
ROUGH, CLOSE = 1e-3, 1e-8  # errors until which to come from inside
SWEEPS = 64  # at first; then twice as many each time
FROM_INSIDE, MOST_STARTS = 2, 6  # how often passes begin again: from inside, and in all
NEARLY = 1e-9  # an error from which beginning again leads nowhere: it is rounding
NEARER = (NEAR, NEAR, 1e-4, 1e-4, 1e-3, 1e-2, 1e-2)  # to polish λ itself, as ``problem.residual`` asks
KNOWN = 1e-13  # share of the terms of w to which w is known: rounding, as the weights ρ enlarge it


@compiled_apart
def cone_newton_kernel(
    rows, M, free, softness, coulomb, λ, tolerance, max_iterations, history, near=NEAR, thorough=True
):
    """u (n, k) and λ (m,), which holds the start and is changed in place. M (n, k, k), free (n, k).

    softness (B,): γ of each block's first row, which gives way: w = J u + c + γ λ. Returns (u, passes,
    error): how far they are from the law (``coulomb.breach``) and from M (u − free) = Jᵀ λ, m/s, over the
    worst free |w|; history gets that of each pass, as far as it is long. near: ε to begin with. thorough:
    whether to go on with passes that take long, and begin again from everywhere. Where sweeps get there at
    first, they count as one pass.
    """
    blocks, room = len(rows.μ), make_room(rows, *free.shape)
    moves, u = np.empty(rows.J.shape), free.copy()
    fill_moves(rows, M, moves)
    scale, terms = block_sizes(rows, moves, free, room.size)
    if tolerance > 0:  # w can't be known better than the terms that it is a sum of
        scale = max(scale, KNOWN * terms / tolerance)
    if scale == 0:
        λ[:] = 0
        return u, 0, 0.0
    add_rows(rows.bodies, moves, λ, u)
    best = Best(λ.copy(), u.copy(), np.full(1, np.inf))
    first = blocks <= SINGLE or (blocks > MANY_CONTACTS and tolerance >= COARSE)
    if first:
        error = by_sweeps(rows, free, moves, softness, coulomb, λ, u, tolerance * scale, room.size) / scale
        if keep_best(best, λ, u, error) <= tolerance:
            history[:1] = error
            return u, 1, error
    elif tolerance >= COARSE:  # sweeps may have to begin from here
        keep_best(best, λ, u, breach(rows, room.size, softness, coulomb, λ, velocities(rows, u)) / scale)
    if coulomb:
        begin_shift(rows, velocities(rows, u), room.law)
    passes = make_passes(
        rows, M, free, softness, coulomb, λ, u, near, WEIGHTS, FEW, room, best, tolerance, scale,
        max_iterations, history,
    )  # fmt: skip
    if tolerance >= COARSE and best.error[0] > tolerance and not first:
        λ[:] = best.λ
        error = by_sweeps(rows, free, moves, softness, coulomb, λ, u, tolerance * scale, room.size)
        keep_best(best, λ, u, error / scale)
    faces = coulomb and has_faces(rows)
    for start in range(0 if faces else 1, MOST_STARTS if thorough else FROM_INSIDE):
        enough = NEARLY if start > FROM_INSIDE else 0.0
        if best.error[0] <= max(tolerance, enough) or passes == max_iterations:
            break
        λ[:], u[:] = best.λ, best.u
        begin_again(start, rows, M, free, moves, softness, coulomb, λ, u, tolerance, scale, room)
        error = breach(rows, room.size, softness, coulomb, λ, velocities(rows, u)) / scale
        if keep_best(best, λ, u, error) > tolerance:
            passes += make_passes(
                rows, M, free, softness, coulomb, λ, u, NEAR, POLISH, MANY if thorough else FEW, room, best,
                tolerance, scale, max_iterations - passes, history[passes:],
            )  # fmt: skip
    λ[:] = best.λ
    return best.u, passes, best.error[0]


@compiled_apart
def by_sweeps(rows, free, moves, softness, coulomb, λ, u, wanted, size):
    """λ and u, in place, after sweeps over the contacts until they are right. Returns the error, m/s."""
    error = np.inf
    u[:] = free
    add_rows(rows.bodies, moves, λ, u)
    for _ in range(1 if len(size) <= SINGLE else MOST_TURNS):
        sweep_contacts(rows, moves, softness, coulomb, λ, u, 0.1 * wanted, TURNS)
        u[:] = free
        add_rows(rows.bodies, moves, λ, u)
        error = breach(rows, size, softness, coulomb, λ, velocities(rows, u))
        if error <= wanted:
            break
    return error


@compiled_apart
def begin_again(start, rows, M, free, moves, softness, coulomb, λ, u, tolerance, scale, room):
    """Another λ and u to begin with, from the best so far: in place. start: which way to get there."""
    if start < FROM_INSIDE:
        near = max(CLOSE if start else ROUGH, 0.1 * tolerance)
        start_inside(rows, M, free, coulomb, near, λ, u, room.size, scale, room.factor, room.out)
    elif start == FROM_INSIDE and coulomb and has_faces(rows):
        for ε in LIMITED:
            renew_limit(rows, λ, room.law)
            solve_pass(rows, M, free, softness, False, λ, u, ε, room, tolerance * scale, MANY)
            take_over(rows, M, softness, False, λ, room)
        no_limit(room.law)
    else:
        u[:] = free
        add_rows(rows.bodies, moves, λ, u)
        sweep_contacts(rows, moves, softness, coulomb, λ, u, 0.1 * tolerance * scale, SWEEPS << start)
    u[:] = free
    add_rows(rows.bodies, moves, λ, u)
    if coulomb:
        begin_shift(rows, velocities(rows, u), room.law)


@inner
def has_faces(rows):
    """Whether two bodies in space touch at three points or more."""
    count = 1
    for q in range(1, len(rows.μ)):
        r, before = rows.block[q], rows.block[q - 1]
        same = rows.bodies[r, 0] == rows.bodies[before, 0] and rows.bodies[r, 1] == rows.bodies[before, 1]
        count = count + 1 if same else 1
        if count == 3 and rows.block[q + 1] - r == 3:
            return True
    return False


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
    free, first, left = np.zeros(M.shape[:2]), problem.residual(λ), most
    with np.errstate(all="ignore"):
        for near in NEARER:
            _, passes, _ = cone_newton_kernel(
                rows, M, free, softness, coulomb, λ, tolerance, left, errors[done:], near
            )
            done += passes
            left = min(most - done, 5)
            if not left or problem.residual(λ) <= tolerance or not np.isfinite(λ).all():
                break
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
