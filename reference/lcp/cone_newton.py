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
sweeps over the contacts lead (``contact_sweeps``).

A face that slides and turns in space may have many answers. The path from inside ends at one of them, and the
nearer to its end, the more it is rounding that says which. There the passes take over early.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97 (augmented
Lagrangian as proximal point method); Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton); De
Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225 (the shift).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled_apart, inner, inner_apart
from ..factored import add_rows
from .augmented import ContactRows, Law, Pass, evaluate, make_law, make_pass
from .cone_interior import start_inside
from .contact_sweeps import block_sizes, fill_moves, sweep_contacts, velocities
from .coulomb import begin_shift, breach, no_limit, renew_limit, renew_shift, worst_change
from .iteration import checked, solved_already, unsuitable
from .problem import ConeProblem
from .smooth_pass import Factor, copy_all, make_factor, solve_smooth, worst_rate
from .solution import MAX_ITERATIONS, SOLVED, finish
from .symmetry import why_no_box, why_no_cone
from .velocity_form import velocity_form

__all__ = ["ContactRows", "cone_newton", "cone_newton_kernel"]

NEAR = 1e-4  # ε at first
WEIGHTS = (1e-6, 1e-8, 1e-10, 1e-4, 1e-2)  # and then: smaller where passes are slow, larger to polish, for
POLISH = (1e-4, 1e-3, 1e-2, 1e-6, 1e-8, 1e-4, 1e-2)  # w's rounding is 1e-16/ε of λ; and from near the answer
SINGLE, TURNS = 2, 10  # so few contacts are first solved one by one, exactly, and so often
FEW, MANY = 12, 25  # Newton steps in a pass, from a start that may be far, and from inside
LIMITED = (1e-8, 1e-10, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-4)  # of passes with limits: λ must get somewhere
ROUGH, CLOSE = 1e-3, 1e-8  # errors until which to come from inside
SWEEPS, MOST_STARTS = 8, 6  # sweeps at first, then twice as many each time; how often passes begin again
NEARLY = 1e-9  # an error from which beginning again leads nowhere: it is rounding
NEARER = (NEAR, NEAR, 1e-4, 1e-4, 1e-3, 1e-2, 1e-2)  # to polish λ itself, as ``problem.residual`` asks
KNOWN = 1e-13  # share of the terms of w to which w is known: rounding, as the weights ρ enlarge it
ROOM = 1e-3  # of the tolerance, for which no shift need follow


class Room(NamedTuple):
    """What the passes compute in."""

    out: Pass
    trial: Pass
    law: Law
    factor: Factor
    size: np.ndarray  # (B,): A_cc
    kept: np.ndarray  # (n, k)


@compiled_apart
def cone_newton_kernel(rows, M, free, softness, coulomb, λ, tolerance, max_iterations, history, near=NEAR):
    """u (n, k) and λ (m,), which holds the start and is changed in place. M (n, k, k), free (n, k).

    softness (B,): γ of each block's first row, which gives way: w = J u + c + γ λ. Returns (u, passes,
    error): how far they are from the law (``coulomb.breach``) and from M (u − free) = Jᵀ λ, m/s, over the
    worst free |w|; history gets that of each pass, as far as it is long. near: ε to begin with. Where sweeps
    over one or two contacts get there, they count as one pass.
    """
    (n, k), blocks = free.shape, len(rows.μ)
    room = Room(
        make_pass(rows, n, k), make_pass(rows, n, k), make_law(blocks), make_factor(rows, n, k),
        np.empty(blocks), np.empty((n, k)),
    )  # fmt: skip
    moves, u = np.empty(rows.J.shape), free.copy()
    fill_moves(rows, M, moves)
    scale, terms = block_sizes(rows, moves, free, room.size)
    if tolerance > 0:  # w can't be known better than the terms that it is a sum of
        scale = max(scale, KNOWN * terms / tolerance)
    if scale == 0:
        λ[:] = 0
        return u, 0, 0.0
    add_rows(rows.bodies, moves, λ, u)
    if blocks <= SINGLE:
        error = by_sweeps(rows, free, moves, softness, coulomb, λ, u, tolerance * scale, room.size) / scale
        if error <= tolerance:
            history[:1] = error
            return u, 1, error
    if coulomb:
        begin_shift(rows, velocities(rows, u), room.law)
    best_λ, best_u, best = λ.copy(), u.copy(), np.inf
    ε, weight, start, most, last, faces = near, -1, 0, FEW, np.inf, coulomb and has_faces(rows)
    passes = -1
    for passes in range(max_iterations):
        steps = solve_pass(rows, M, free, softness, coulomb, λ, u, ε, room, tolerance * scale, most)
        error = take_over(rows, M, softness, coulomb, λ, room) / scale
        if passes < len(history):
            history[passes] = error
        if error < best:
            best_λ[:], best_u[:], best = λ, u, error
        if error <= tolerance:
            return u, passes + 1, error
        weight += 0 if error < 0.5 * last else 1
        last = min(error, last)
        if weight < (len(WEIGHTS) if start == 0 else len(POLISH)) and not (steps == FEW == most):
            if weight >= 0:
                ε = WEIGHTS[weight] if start == 0 else POLISH[weight]
            continue
        start += start == 0 and not faces
        if start == MOST_STARTS or (start > 2 and best <= NEARLY):
            break
        λ[:], u[:] = best_λ, best_u
        begin_again(start, rows, M, free, moves, softness, coulomb, λ, u, tolerance * scale, scale, room)
        ε, weight, start, most, last = POLISH[0], 0, start + 1, MANY, np.inf
    λ[:] = best_λ
    return best_u, passes + 1, best


@compiled_apart
def by_sweeps(rows, free, moves, softness, coulomb, λ, u, wanted, size):
    """λ and u, in place, after a few sweeps over the contacts. Returns the error, m/s."""
    sweep_contacts(rows, moves, softness, coulomb, λ, u, 0.1 * wanted, TURNS)
    u[:] = free
    add_rows(rows.bodies, moves, λ, u)
    return breach(rows, size, softness, coulomb, λ, velocities(rows, u))


@inner_apart
def solve_pass(rows, M, free, softness, follows, λ, u, ε, room, wanted, most):
    """u for these λ, and with it λ̂ in room.out. Returns how many Newton steps its safe part took."""
    out, trial, law, factor, size, kept = room
    for q in range(len(size)):
        ρ = 1 / (ε * size[q])
        if ρ != law.ρ[q]:
            factor.made[q] = -1
        law.ρ[q], law.give[q] = ρ, 1 + ρ * softness[q]
    steps = solve_smooth(rows, M, free, λ, law, False, factor, u, 0.1 * wanted, out, trial, most)
    if not follows or worst_change(rows, out, law) <= ROOM * wanted:
        return steps
    copy_all(u, kept)
    held = max(breach(rows, size, softness, True, out.λ, out.w), worst_rate(M, out.gradient))
    solve_smooth(rows, M, free, λ, law, True, factor, u, 0.1 * wanted, out, trial, FEW)
    if not max(breach(rows, size, softness, True, out.λ, out.w), worst_rate(M, out.gradient)) < held:
        copy_all(kept, u)
        evaluate(rows, M, free, λ, law, False, u, out)
    return steps


@compiled_apart
def begin_again(start, rows, M, free, moves, softness, coulomb, λ, u, wanted, scale, room):
    """Another λ and u to begin with, from the best so far: in place. start: how often there has been one."""
    if start < 2:
        near = CLOSE if start else ROUGH
        start_inside(rows, M, free, coulomb, near, λ, u, room.size, scale, room.factor, room.out)
    elif start == 2 and coulomb:
        for ε in LIMITED:
            renew_limit(rows, λ, room.law)
            solve_pass(rows, M, free, softness, False, λ, u, ε, room, wanted, MANY)
            take_over(rows, M, softness, False, λ, room)
        no_limit(room.law)
    else:
        u[:] = free
        add_rows(rows.bodies, moves, λ, u)
        sweep_contacts(rows, moves, softness, coulomb, λ, u, wanted, SWEEPS << start)
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


@inner_apart
def take_over(rows, M, softness, coulomb, λ, room):
    """λ ← λ̂, and the shift that belongs to it. Returns the error, m/s."""
    for r in range(len(λ)):
        λ[r] = room.out.λ[r]
    if coulomb:
        renew_shift(rows, room.out.w, room.law)
    off = breach(rows, room.size, softness, coulomb, λ, room.out.w)
    return max(off, worst_rate(M, room.out.gradient))


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
