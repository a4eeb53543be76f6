"""One smooth problem of ``cone_newton``: Newton's method with step halving, for fixed λ and ``Law``.

The matrix M + ρ Jᵀ P′ J has one block a body, not one a contact, and stays regular where contacts are
redundant. It changes only with what sticks, slides or parts; where nothing of that changes, its factor
serves again.

Slides S14; lectures/08_newton_lcp.md. Source: Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart
from .augmented import ALONE, OPEN, SLIDES, evaluate, inner
from .envelope import Envelope, add_block, cholesky_in_envelope, make_envelope, solve_in_envelope

MOST_NEWTON, MOST_HALVINGS = 50, 30


class Factor(NamedTuple):
    """The matrix's factor, and for which states it was made."""

    envelope: Envelope
    L: np.ndarray
    made: np.ndarray  # (B,)


@compiled
def make_factor(rows, n, k):
    """Room for the factor; made for no states yet."""
    envelope = make_envelope(rows.bodies, n, k)
    return Factor(envelope, np.empty(envelope.start[-1]), np.full(len(rows.μ), -1))


@compiled_apart
def solve_smooth(rows, M, free, λ, law, factor, u, tolerance, out, trial):
    """Newton's method for one pass, with step halving: u in place, what ``evaluate`` finds there in out."""
    value = evaluate(rows, M, free, λ, law, u, out)
    move, tried = np.empty_like(u), np.empty_like(u)
    rest, before, whole = worst_rate(M, out.gradient), np.inf, False
    for _ in range(MOST_NEWTON):
        fresh = stands_for(rows, factor.made, out.state)
        if rest <= tolerance or (whole and fresh and rest > 0.5 * before):  # good, or as rounding lets it be
            return
        if not fresh:
            fill_matrix(rows, M, law.ρ, out, factor)
            cholesky_in_envelope(factor.envelope, factor.L)
        solve_in_envelope(factor.envelope, factor.L, out.gradient, move)
        downhill, length, new = 0.0, 1.0, np.inf
        for i in range(len(u)):
            downhill -= inner(out.gradient[i], move[i])
        for _ in range(MOST_HALVINGS):
            for i in range(len(u)):
                for a in range(u.shape[1]):
                    tried[i, a] = u[i, a] - length * move[i, a]
            new = evaluate(rows, M, free, λ, law, tried, trial)
            if new <= value + 1e-4 * length * downhill + 1e-13 * abs(value):
                break
            length *= 0.5
        whole, value, before = length == 1.0, new, rest
        u[:], out.w[:], out.λ[:], out.slope[:] = tried, trial.w, trial.λ, trial.slope
        out.state[:], out.gradient[:] = trial.state, trial.gradient
        rest = worst_rate(M, out.gradient)


@compiled
def stands_for(rows, made, state):
    """Whether the matrix made for some states serves these too; what slides in space always changes it."""
    for q in range(len(state)):
        slides = state[q] == SLIDES or state[q] == ALONE + 1 or state[q] == ALONE + 3
        if made[q] != state[q] or (slides and rows.block[q + 1] - rows.block[q] == 3):
            return False
    return True


@compiled
def worst_rate(M, gradient):
    """The worst entry of M⁻¹ times the gradient, roughly: by the diagonal of M."""
    worst = 0.0
    for i in range(len(gradient)):
        for a in range(gradient.shape[1]):
            worst = max(worst, abs(gradient[i, a]) / M[i, a, a])
    return worst


@compiled_apart
def fill_matrix(rows, M, ρ, out, factor):
    """M + ρ Jᵀ P′ J, block by block."""
    k, envelope, L = M.shape[1], factor.envelope, factor.L
    L[:] = 0
    factor.made[:] = out.state
    unit, weighted = np.zeros(k), np.empty(k)
    for i in range(len(M)):
        for a in range(k):
            unit[a] = 1.0
            add_block(envelope, L, i, i, k, unit, M[i, a], 1.0)
            unit[a] = 0.0
    for q in range(len(rows.μ)):
        if out.state[q] == OPEN:
            continue
        first, end = rows.block[q], rows.block[q + 1]
        for r in range(first, end):
            for side in range(2):
                i = rows.bodies[r, side]
                if i < 0:
                    continue
                weighted[:] = 0
                for s in range(first, end):
                    for a in range(k):
                        weighted[a] += out.slope[r, s - first] * rows.J[s, side, a]
                for other in range(2):
                    j = rows.bodies[r, other]
                    if j >= 0:
                        add_block(envelope, L, i, j, k, weighted, rows.J[r, other], ρ[q])
