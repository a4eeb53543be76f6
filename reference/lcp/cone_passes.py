"""The passes of ``cone_newton``, one smooth problem each, and the best λ and u that any of them found.

Slides S10, S14; lectures/08_newton_lcp.md. Source: Rockafellar, Math. Oper. Res. 1 (1976) 97 (augmented
Lagrangian as proximal point method).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart
from .augmented import Law, Pass, evaluate, make_law, make_pass
from .coulomb import breach, renew_shift, worst_change
from .smooth_pass import Factor, copy_all, make_factor, solve_smooth, worst_rate

FEW, MANY = 12, 25  # Newton steps in a pass, from a start that may be far, and from inside
ROOM = 1e-3  # of the tolerance, for which no shift need follow


class Room(NamedTuple):
    """What the passes compute in."""

    out: Pass
    trial: Pass
    law: Law
    factor: Factor
    size: np.ndarray  # (B,): A_cc
    kept: np.ndarray  # (n, k)


class Best(NamedTuple):
    """The best so far."""

    λ: np.ndarray  # (m,)
    u: np.ndarray  # (n, k)
    error: np.ndarray  # (1,): over scale


@compiled
def make_room(rows, n, k):
    """Room for passes over n bodies."""
    blocks = len(rows.μ)
    return Room(
        make_pass(rows, n, k), make_pass(rows, n, k), make_law(blocks), make_factor(rows, n, k),
        np.empty(blocks), np.empty((n, k)),
    )  # fmt: skip


@inner_apart
def make_passes(rows, M, free, softness, coulomb, λ, u, ε, weights, most, room, best, tolerance, scale, left,
                history):  # fmt: skip
    """Passes until λ and u are right, or don't get nearer any more with any of these weights; at most so many
    as are left. Returns how many. most: Newton steps in each; where FEW aren't enough, it is given up.
    """
    weight, last = -1 if most == FEW else 0, np.inf
    for passes in range(left):
        steps = solve_pass(rows, M, free, softness, coulomb, λ, u, ε, room, tolerance * scale, most)
        error = take_over(rows, M, softness, coulomb, λ, room) / scale
        if passes < len(history):
            history[passes] = error
        keep_best(best, λ, u, error)
        weight += 0 if error < 0.5 * last else 1
        last = min(error, last)
        if error <= tolerance or weight == len(weights) or steps == most == FEW:
            return passes + 1
        if weight >= 0:
            ε = weights[weight]
    return left


@inner
def keep_best(best, λ, u, error):
    """Keep λ and u if their error, over scale, is the least so far. Returns the error."""
    if error < best.error[0]:
        best.error[0] = error
        for r in range(len(λ)):
            best.λ[r] = λ[r]
        copy_all(u, best.u)
    return error


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
    if not follows or steps == most == FEW or worst_change(rows, out, law) <= ROOM * wanted:
        return steps
    copy_all(u, kept)
    held = max(breach(rows, size, softness, True, out.λ, out.w), worst_rate(M, out.gradient))
    solve_smooth(rows, M, free, λ, law, True, factor, u, 0.1 * wanted, out, trial, FEW)
    if not max(breach(rows, size, softness, True, out.λ, out.w), worst_rate(M, out.gradient)) < held:
        copy_all(kept, u)
        evaluate(rows, M, free, λ, law, False, u, out)
    return steps


@inner_apart
def take_over(rows, M, softness, coulomb, λ, room):
    """λ ← λ̂, and the shift that belongs to it. Returns the error, m/s."""
    for r in range(len(λ)):
        λ[r] = room.out.λ[r]
    if coulomb:
        renew_shift(rows, room.out.w, room.law)
    off = breach(rows, room.size, softness, coulomb, λ, room.out.w)
    return max(off, worst_rate(M, room.out.gradient))
