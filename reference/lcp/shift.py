"""The shift μ|w_t| of Coulomb's law where much slides at once: a mixture of the shifts before (Anderson's).

With a given shift the law is convex, and has an answer w; that w asks for a shift of its own (``coulomb``). A
fixed point is Coulomb's law. In a heap in which all slides on all, taking what w asks for gains a fifth a
pass. Of the last few shifts, the mixture whose changes cancel best takes 30 passes for twelve digits.

Slides S10, S14; lectures/08_newton_lcp.md. Source: De Saxcé & Feng, Math. Comput. Modelling 28 (1998) 225;
Anderson, J. ACM 12 (1965) 547; Walker & Ni, SIAM J. Numer. Anal. 49 (2011) 1715.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart
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
