"""One smooth problem of ``cone_newton``: Newton's method with step halving, for fixed λ and ``Law``.

The matrix M + ρ Jᵀ P′ J has one block a body, not one a contact, and stays regular where contacts are
redundant. It changes only with what sticks, slides or parts; where nothing of that changes, its factor
serves again. Step halving asks that the augmented Lagrangian falls; where the shift follows there is none,
and what is left of the equation of motion must fall instead: that may fail far from the answer.

Slides S14; lectures/08_newton_lcp.md. Source: Qi & Sun, Math. Programming 58 (1993) 353 (semismooth Newton).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart
from .augmented import ALONE, OPEN, SLIDES, dot, evaluate
from .block_lu import BlockFactor, add_block, clear, factorise, make_block_factor, solve

MOST_HALVINGS, ROUNDING = 30, 1e4  # times the tolerance: what rounding may be the reason of


class Factor(NamedTuple):
    """The matrix's factor, for which states it was made, and room to compute in."""

    blocks: BlockFactor
    made: np.ndarray  # (B,)
    move: np.ndarray  # (n, k): Newton's step
    tried: np.ndarray  # (n, k): u after a part of it
    row: np.ndarray  # (k,)


@compiled
def make_factor(rows, n, k):
    """Room for the factor; made for no states yet."""
    blocks, made = make_block_factor(rows.bodies, n, k), np.full(len(rows.μ), -1)
    return Factor(blocks, made, np.empty((n, k)), np.empty((n, k)), np.empty(k))


@inner_apart
def solve_smooth(rows, M, free, λ, law, follows, factor, u, tolerance, out, trial, most):
    """Newton's method for one pass, with step halving: u in place, what ``evaluate`` finds there in out.

    follows: the shift follows w. Returns how many steps it took: ``most`` if they were not enough.
    """
    value = evaluate(rows, M, free, λ, law, follows, u, out)
    move, tried = factor.move, factor.tried
    rest, before, whole = worst_rate(M, out.gradient), np.inf, False
    for step in range(most):
        fresh = not follows and stands_for(rows, factor.made, out.state)
        slow = whole and rest > 0.5 * before
        if rest <= tolerance or (slow and (fresh or rest <= ROUNDING * tolerance)):  # as rounding lets it be
            return step
        if not fresh:
            fill_matrix(rows, M, law.ρ, out, factor)
            if not factorise(factor.blocks, not follows):
                return most
            if follows:
                forget(factor)
        solve(factor.blocks, out.gradient, move)
        downhill, length, new, left = 0.0, 1.0, np.inf, np.inf
        for i in range(len(u)):
            downhill -= dot(out.gradient[i], move[i])
        for _ in range(MOST_HALVINGS):
            for i in range(len(u)):
                for a in range(u.shape[1]):
                    tried[i, a] = u[i, a] - length * move[i, a]
            new = evaluate(rows, M, free, λ, law, follows, tried, trial)
            left = worst_rate(M, trial.gradient)
            if left < rest if follows else new <= value + 1e-4 * length * downhill + 1e-13 * abs(value):
                break
            length *= 0.5
        if follows and not left < rest:
            return most
        whole, value, before, rest = length == 1.0, new, rest, left
        copy_all(tried, u)
        copy_pass(trial, out)
    return most


@inner
def forget(factor):
    """The factor is none of states alone."""
    for q in range(len(factor.made)):
        factor.made[q] = -1


@inner
def copy_pass(a, to):
    """What ``evaluate`` found, to where it stays."""
    for r in range(len(a.w)):
        to.w[r], to.λ[r] = a.w[r], a.λ[r]
    for q in range(len(a.state)):
        to.state[q] = a.state[q]
    copy_all(a.slope, to.slope)
    copy_all(a.gradient, to.gradient)


@inner
def copy_all(a, to):
    """Copy a matrix."""
    for i in range(a.shape[0]):
        for k in range(a.shape[1]):
            to[i, k] = a[i, k]


@inner
def stands_for(rows, made, state):
    """Whether the matrix made for some states serves these too; what slides in space always changes it."""
    for q in range(len(state)):
        slides = state[q] == SLIDES or state[q] == ALONE + 1 or state[q] == ALONE + 3
        if made[q] != state[q] or (slides and rows.block[q + 1] - rows.block[q] == 3):
            return False
    return True


@inner
def worst_rate(M, gradient):
    """The worst entry of M⁻¹ times the gradient, roughly: by the diagonal of M."""
    worst = 0.0
    for i in range(len(gradient)):
        for a in range(gradient.shape[1]):
            worst = max(worst, abs(gradient[i, a]) / M[i, a, a])
    return worst


@inner_apart
def fill_matrix(rows, M, ρ, out, factor):
    """M + ρ Jᵀ P′ J, block by block."""
    k, weighted = M.shape[1], factor.row
    clear(factor.blocks)
    for q in range(len(factor.made)):
        factor.made[q] = out.state[q]
    for i in range(len(M)):
        p = factor.blocks.pattern.place[i]
        for a in range(k):
            for b in range(k):
                factor.blocks.diagonal[p, a, b] = M[i, a, b]
    for q in range(len(rows.μ)):
        if out.state[q] == OPEN:
            continue
        first, end = rows.block[q], rows.block[q + 1]
        for r in range(first, end):
            for side in range(2):
                j = rows.bodies[r, side]
                if j < 0:
                    continue
                for a in range(k):
                    weighted[a] = 0.0
                    for s in range(first, end):
                        weighted[a] += out.slope[r, s - first] * rows.J[s, side, a]
                for other in range(2):
                    i = rows.bodies[r, other]
                    if i >= 0:
                        add_block(factor.blocks, i, j, rows.J[r, other], weighted, ρ[q])
