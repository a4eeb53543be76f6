"""Block methods: a contact's rows are solved together, then the next contact's.

D holds the blocks of A on its diagonal in place of single numbers. Each block is a small LCP of its own,

    w_B = A_BB λ_B + (what all other rows say),   each row clipped, friction by the newest λ_n (S17)

solved by sweeps within the block, over numbers at hand, until they change nothing more. Clipping A_BB⁻¹ w_B
instead would be wrong: a contact that slides keeps w_t ≠ 0, and A_BB⁻¹ would let it push λ_n.

Blocks may be larger than a contact: rows that push one another hard belong together.

Slides S15–S17; lectures/07_iterative_lcp.md. Source: Cottle, Pang & Stone, The Linear Complementarity Problem
(2009), section 5.2.
"""

from typing import NamedTuple

import numpy as np

from .. import inputs
from ..compiled import compiled, compiled_apart
from ..factored import Factored
from .gauss_seidel import how_often
from .iteration import BLOWN_UP, iterate
from .merit import bounds, clip, gap, larger
from .orders import contacts, natural_order
from .solution import DIVERGED, MAX_ITERATIONS, SOLVED


class Blocks(NamedTuple):
    """Which rows form blocks, and A between the rows of each."""

    order: np.ndarray  # (n,) the rows, block after block
    begin: np.ndarray  # (m + 1,) order[begin[k]:begin[k + 1]] is block k
    local: np.ndarray  # the numbers A_BB of all blocks, one after another, by rows
    offset: np.ndarray  # (m + 1,) where in ``local`` each begins
    widest: int


@compiled_apart
def solve_block(terms, blocks, k, λ, w, inner):
    """Make the w (widest,) of block k right by sweeps within it, at most ``inner``; λ and w are renewed."""
    first, size, at = blocks.begin[k], blocks.begin[k + 1] - blocks.begin[k], blocks.offset[k]
    for _ in range(inner):
        moved = False
        for p in range(size):
            i = blocks.order[first + p]
            low, high = bounds(terms, λ, i)
            Δ = clip(λ[i] - w[p] / terms.d[i], low, high) - λ[i]
            λ[i] += Δ
            moved = moved or abs(Δ) > 1e-15 * abs(λ[i])
            for q in range(size):
                w[q] += blocks.local[at + q * size + p] * Δ
        if not moved:
            break


@compiled
def block_sweeps(follow, row, rows, change, A, terms, λ, scale, tolerance, history, blocks, inner, every):
    """Sweep over the blocks, each from the newest λ: as ``gauss_seidel.sweeps``."""
    x, w, before = follow(A, λ), λ[: blocks.widest].copy(), λ[: blocks.widest].copy()  # of one block
    λ_old, x_old = λ.copy(), x.copy()
    for k in range(len(history) - 1):
        looking, worst = k % every == 0, 0.0
        if looking:
            λ_old[:] = λ
            x_old[:] = x
        for block in range(len(blocks.begin) - 1):
            first, end = blocks.begin[block], blocks.begin[block + 1]
            for p in range(end - first):
                i = blocks.order[first + p]
                before[p] = λ[i]
                if looking:
                    old, now = rows(A, i, λ_old, x_old, λ, x)
                    worst = larger(worst, abs(gap(terms, λ_old, i, old + terms.b[i])))
                else:
                    now = row(A, i, λ, x)
                w[p] = now + terms.b[i]
            solve_block(terms, blocks, block, λ, w, inner)
            for p in range(end - first):
                i = blocks.order[first + p]
                change(A, i, λ[i] - before[p], x)
        history[k] = worst / scale if looking else np.nan
        if looking and not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            λ[:] = λ_old
            return k, SOLVED if history[k] <= tolerance else DIVERGED
    return len(history) - 1, MAX_ITERATIONS


@compiled
def blocks_at_once(follow, row, rows, change, A, terms, λ, scale, tolerance, history, blocks, inner, ω):
    """Sweep over the blocks, each from the old λ, and go ω of the way: as ``jacobi.all_at_once``."""
    x, new, w = follow(A, λ), λ.copy(), λ[: blocks.widest].copy()
    for k in range(len(history) - 1):
        worst = 0.0
        for block in range(len(blocks.begin) - 1):
            first, end = blocks.begin[block], blocks.begin[block + 1]
            for p in range(end - first):
                i = blocks.order[first + p]
                w[p] = row(A, i, λ, x) + terms.b[i]
                worst = larger(worst, abs(gap(terms, λ, i, w[p])))
            solve_block(terms, blocks, block, new, w, inner)
        history[k] = worst / scale
        if not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            return k, SOLVED if history[k] <= tolerance else DIVERGED
        for i in blocks.order:
            Δ = ω * (new[i] - λ[i])
            λ[i] += Δ
            new[i] = λ[i]
            change(A, i, Δ, x)
    return len(history) - 1, MAX_ITERATIONS


def block_gauss_seidel(
    problem, start=None, tolerance=1e-10, max_iterations=1000, *, blocks=None, inner=20, every=None
):
    """Solve an LCP by projected Gauss–Seidel, block by block.

    blocks (n,): whole numbers, the same for rows of one block; None: contacts, a normal with its friction
    rows. inner: at most so many sweeps within a block. One iteration is a sweep over all blocks.
    Raises ValueError where a friction row isn't in the block of its normal. Else as ``gauss_seidel``.
    """
    options = _gathered(blocks), inputs.whole("inner", inner, least=1), how_often(every)
    return iterate(block_sweeps, problem, start, tolerance, max_iterations, options=options)


def block_jacobi(
    problem, start=None, tolerance=1e-10, max_iterations=1000, *, blocks=None, inner=20, omega=1.0
):
    """Solve an LCP by projected Jacobi over blocks: all at once from the old λ.

    omega: above 0, at most 1: how much of the way each block goes. blocks, inner as for
    ``block_gauss_seidel``. Converges as surely, or as little, as ``jacobi``.
    """
    ω = inputs.number("omega", omega, above=0)
    if ω > 1:
        raise ValueError(f"omega must be at most 1, or λ may leave its bounds, but is {omega!r}")
    options = _gathered(blocks), inputs.whole("inner", inner, least=1), ω
    return iterate(blocks_at_once, problem, start, tolerance, max_iterations, options=options)


def _gathered(blocks):
    """``gather_blocks`` as an option of ``iterate``."""
    return lambda problem: gather_blocks(problem, blocks)


def gather_blocks(problem, blocks=None):
    """The Blocks of a problem, in the order of their first rows; blocks as for ``block_gauss_seidel``."""
    order, contact = natural_order(problem), contacts(problem)
    label = contact if blocks is None else inputs.array("blocks", blocks, (problem.n,))
    torn = np.flatnonzero(label != label[contact])
    if len(torn):
        raise ValueError(
            f"blocks must keep a friction row with its normal, but row {torn[0]} is in block "
            f"{label[torn[0]]:g}, its normal in {label[contact[torn[0]]]:g}"
        )
    _, first, name = np.unique(label[order], return_index=True, return_inverse=True)
    order = order[np.argsort(first[name], kind="stable")]
    size = np.bincount(name)[np.argsort(first)] if problem.n else np.zeros(0, dtype=int)
    begin, offset = (np.concatenate([[0], np.cumsum(counts)]) for counts in (size, size**2))
    block = np.repeat(np.arange(len(size)), size**2)
    within = np.arange(offset[-1]) - offset[block]
    p, q = within // size[block], within % size[block]
    local = _entries(problem.A, order[begin[block] + p], order[begin[block] + q])
    return Blocks(order, begin, local, offset, int(size.max(initial=1)))


def _entries(A, i, j):
    """A_ij for arrays of row and column numbers."""
    if not isinstance(A, Factored):
        return np.asarray(A[i, j], dtype=float).ravel() if len(i) else np.zeros(0)
    same = (A.bodies[i][:, :, None] == A.bodies[j][:, None, :]) & (A.bodies[i] >= 0)[:, :, None]
    products = A.J[i] @ A.B[j].transpose(0, 2, 1)  # of each body of i with each of j
    return np.sum(products * same, axis=(1, 2)) + np.where(i == j, A.softness[i], 0)
