"""Coulomb's law from the convex one: the shift μ|w_t| of w_n, renewed until it is the one that it leads to.

With a given shift the law is convex, and has an answer w; that w asks for a shift of its own. A fixed point
is Coulomb's law. Two ways to hasten towards it:

    each contact by itself      the secant method, from its last two answers; it is enough where few slide
    all together                Anderson's: of the last four shifts, the mixture whose changes cancel best.
                                In a heap in which all slides on all, the plain iteration gains a fifth a
                                pass, and the secant may run away; this takes 30 passes for twelve digits.

Slides S10, S14; lectures/08_newton_lcp.md. Source: De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225;
Anderson, J. ACM 12 (1965) 547; Walker & Ni, SIAM J. Numer. Anal. 49 (2011) 1715.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart
from .augmented import dot
from .block_cholesky import factorise_one

DEPTH, RIDGE, WELL = 3, 1e-10, 0.1


class Memory(NamedTuple):
    """Shifts of before and how they would have changed, newest anywhere; and room."""

    shift: np.ndarray  # (DEPTH, B)
    change: np.ndarray  # (DEPTH, B)
    now: np.ndarray  # (B,)
    N: np.ndarray  # (DEPTH, DEPTH)
    γ: np.ndarray  # (DEPTH,)
    count: np.ndarray  # (1,): how many there have been


@compiled
def make_memory(blocks):
    """A ``Memory`` of nothing."""
    return Memory(
        np.zeros((DEPTH, blocks)),
        np.zeros((DEPTH, blocks)),
        np.zeros(blocks),
        np.zeros((DEPTH, DEPTH)),
        np.zeros(DEPTH),
        np.zeros(1, np.int64),
    )


@inner_apart
def begin_shift(rows, u, shift, answer):
    """The shift that belongs to u, and an ``answer`` that knows of nothing before it."""
    for q in range(len(shift)):
        along = 0.0
        for r in range(rows.block[q] + 1, rows.block[q + 1]):
            w = rows.c[r]
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    w += dot(rows.J[r, side], u[i])
            along += w * w
        shift[q] = max(rows.μ[q], 0.0) * np.sqrt(along)
        answer[q, 0], answer[q, 1] = np.inf, 0.0


@inner
def renew_shift(rows, w, shift, answer):
    """The shift ← μ|w_t|, which makes the law Coulomb's. Returns the worst change, a velocity.

    μ|w_t| answers to a change of the shift, by μ²/(1 + μ²) of it where A is a multiple of 1. ``answer`` (B,
    2) holds each contact's shift and μ|w_t| of the pass before; they tell by how much, and the shift goes
    where it answers to itself (the secant method).
    """
    worst = 0.0
    for q in range(len(shift)):
        first = rows.block[q]
        if rows.μ[q] <= 0:
            continue
        along = 0.0
        for r in range(first + 1, rows.block[q + 1]):
            along += w[r] ** 2
        new = rows.μ[q] * np.sqrt(along)
        change, changed = new - shift[q], shift[q] - answer[q, 0]
        worst = max(worst, abs(change))
        share = (new - answer[q, 1]) / changed if abs(changed) > 1e-12 * abs(new) else 0.0
        answer[q, 0], answer[q, 1] = shift[q], new
        shift[q] = max(0.0, shift[q] + change / (1 - min(max(share, -1.0), 0.8)))
    return worst


@inner_apart
def mix_shifts(rows, w, shift, memory, drift):
    """The next shift from the last few, if the convex law is solved well enough: drift, m/s, tells how well.

    Returns the worst change that w asks for, m/s.
    """
    now, worst = memory.now, 0.0
    for q in range(len(shift)):
        along = 0.0
        for r in range(rows.block[q] + 1, rows.block[q + 1]):
            along += w[r] ** 2
        now[q] = max(rows.μ[q], 0.0) * np.sqrt(along) - shift[q]
        worst = max(worst, abs(now[q]))
    if drift > WELL * worst:
        return worst
    known = min(memory.count[0], DEPTH)
    weigh_changes(memory, known)
    slot = memory.count[0] % DEPTH
    for q in range(len(shift)):
        new = shift[q] + now[q]
        for i in range(known):
            new -= memory.γ[i] * (shift[q] - memory.shift[i, q] + now[q] - memory.change[i, q])
        memory.shift[slot, q], memory.change[slot, q] = shift[q], now[q]
        shift[q] = max(0.0, new)
    memory.count[0] += 1
    return worst


@inner
def weigh_changes(memory, known):
    """γ that makes the change now − Σ γ_i (now − change_i) smallest, by the normal equations."""
    now, change, N, γ = memory.now, memory.change, memory.N, memory.γ
    for i in range(known):
        γ[i] = 0.0
        for j in range(known):
            N[i, j] = 0.0
        for q in range(len(now)):
            off = now[q] - change[i, q]
            γ[i] += off * now[q]
            for j in range(known):
                N[i, j] += off * (now[q] - change[j, q])
    for i in range(known):
        N[i, i] *= 1 + RIDGE
        N[i, i] += 1e-300
    if not factorise_one(N[:known, :known]):
        for i in range(known):
            γ[i] = 0.0
        return
    for i in range(known):
        for j in range(i):
            γ[i] -= N[i, j] * γ[j]
        γ[i] /= N[i, i]
    for i in range(known - 1, -1, -1):
        for j in range(i + 1, known):
            γ[i] -= N[j, i] * γ[j]
        γ[i] /= N[i, i]
