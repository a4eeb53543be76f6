"""The factors L U of a sparse matrix of blocks k × k, one block row a body, column after column.

    L_jj U_jj = A_jj − Σ_q L_jq U_qj
    L_ij = (A_ij − Σ_q L_iq U_qj) U_jj⁻¹,        U_ji = L_jj⁻¹ (A_ji − Σ_q L_jq U_qi)        i after j

The matrix need not be symmetric, but where it has a block ij it has one ji. Only blocks that the ``Pattern``
has are touched; an order that leaves few of them is the whole art (``body_order``). Cost, for n discs in a
heap, about n^1.5, and for a stack n.

Slides S8, S14; lectures/08_newton_lcp.md. Source: Davis, Direct Methods for Sparse Linear Systems (2006),
sections 4.10 (supernodes: here a body's k velocities) and 6.1 (LU from the left).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart
from .body_order import Pattern, find_pattern


class BlockFactor(NamedTuple):
    """The matrix, and then its factors in the same places."""

    pattern: Pattern
    diagonal: np.ndarray  # (n, k, k): L_jj, whose diagonal is 1 and not kept, under U_jj
    below: np.ndarray  # (blocks, k, k): L_ij
    above: np.ndarray  # (blocks, k, k): U_ji, at the same place as L_ij
    where: np.ndarray  # (n,), and another to compute in
    ordered: np.ndarray  # (n, k)


@compiled
def make_block_factor(pairs, n, k):
    """Room for n bodies with k velocities each; pairs (m, 2): bodies that meet; −1: the world."""
    pattern = find_pattern(pairs, n)
    blocks = len(pattern.row)
    return BlockFactor(
        pattern,
        np.empty((n, k, k)),
        np.empty((blocks, k, k)),
        np.empty((blocks, k, k)),
        np.empty(n, np.int64),
        np.empty((n, k)),
    )


@inner
def clear(factor):
    """All blocks 0."""
    for blocks in (factor.diagonal, factor.below, factor.above):
        for q in range(len(blocks)):
            for a in range(blocks.shape[1]):
                for b in range(blocks.shape[2]):
                    blocks[q, a, b] = 0.0


@inner
def find_block(pattern, p, q):
    """Where the block of row p and column q < p stands."""
    low, high = pattern.start[q], pattern.start[q + 1]
    while high - low > 1:
        middle = (low + high) // 2
        if pattern.row[middle] <= p:
            low = middle
        else:
            high = middle
    return low


@inner
def add_block(factor, i, j, row, column, weight):
    """Add weight · row ⊗ column to the block of bodies i and j."""
    p, q = factor.pattern.place[i], factor.pattern.place[j]
    if p == q:
        block = factor.diagonal[p]
    elif p > q:
        block = factor.below[find_block(factor.pattern, p, q)]
    else:
        block = factor.above[find_block(factor.pattern, q, p)]
    for a in range(len(row)):
        scaled = weight * row[a]
        for b in range(len(column)):
            block[a, b] += scaled * column[b]


@inner
def factorise(factor, symmetric):
    """The matrix becomes its factors. Returns whether all pivots could be divided by.

    symmetric: it is, so what stands above the diagonal need not be looked at, and half the work is saved.
    """
    p, f = factor.pattern, factor
    return factorise_blocks(
        p.start, p.row, p.left, p.column, p.at, f.diagonal, f.below, f.above, f.where, symmetric
    )


@inner
def solve(factor, x, out):
    """out (n, k) of L U out = x (n, k), both in the order of the bodies."""
    p, f = factor.pattern, factor
    solve_blocks(p.place, p.start, p.row, f.diagonal, f.below, f.above, x, f.ordered, out)


@inner_apart
def factorise_blocks(start, row, left, column, at, diagonal, below, above, where, symmetric):
    """``factorise``, array by array."""
    for j in range(len(diagonal)):
        for q in range(start[j], start[j + 1]):
            where[row[q]] = q
        for q in range(left[j], left[j + 1]):
            first, end = at[q], start[column[q] + 1]
            subtract_product(diagonal[j], below[first], above[first])
            for r in range(first + 1, end):
                subtract_product(below[where[row[r]]], below[r], above[first])
                if not symmetric:
                    subtract_product(above[where[row[r]]], below[first], above[r])
        if not factorise_one(diagonal[j]):
            return False
        for q in range(start[j], start[j + 1]):
            if symmetric:
                transpose(below[q], above[q])
            divide_by_upper(below[q], diagonal[j])
            divide_by_lower(above[q], diagonal[j])
    return True


@inner
def transpose(A, to):
    """Aᵀ."""
    for a in range(len(A)):
        for b in range(len(A)):
            to[b, a] = A[a, b]


@inner
def subtract_product(C, A, B):
    """C −= A B, all (k, k)."""
    k = len(C)
    for a in range(k):
        for c in range(k):
            scale = A[a, c]
            for b in range(k):
                C[a, b] -= scale * B[c, b]


@inner
def factorise_one(A):
    """One block's own L and U, in place. Returns whether its pivots could be divided by."""
    for i in range(len(A)):
        for j in range(len(A)):
            for c in range(min(i, j)):
                A[i, j] -= A[i, c] * A[c, j]
            if i > j:
                A[i, j] /= A[j, j]
        if not 0 < abs(A[i, i]) < np.inf:
            return False
    return True


@inner
def divide_by_upper(B, LU):
    """B ← B U⁻¹."""
    for a in range(len(B)):
        for i in range(len(LU)):
            for c in range(i):
                B[a, i] -= B[a, c] * LU[c, i]
            B[a, i] /= LU[i, i]


@inner
def divide_by_lower(B, LU):
    """B ← L⁻¹ B."""
    for i in range(len(LU)):
        for c in range(i):
            for a in range(len(B)):
                B[i, a] -= LU[i, c] * B[c, a]


@inner_apart
def solve_blocks(place, start, row, diagonal, below, above, x, y, out):
    """``solve``, array by array."""
    n, k = x.shape
    for i in range(n):
        for a in range(k):
            y[place[i], a] = x[i, a]
    for p in range(n):
        for a in range(k):
            for c in range(a):
                y[p, a] -= diagonal[p, a, c] * y[p, c]
        for q in range(start[p], start[p + 1]):
            for a in range(k):
                for c in range(k):
                    y[row[q], a] -= below[q, a, c] * y[p, c]
    for p in range(n - 1, -1, -1):
        for q in range(start[p], start[p + 1]):
            for a in range(k):
                for c in range(k):
                    y[p, a] -= above[q, a, c] * y[row[q], c]
        for a in range(k - 1, -1, -1):
            for c in range(a + 1, k):
                y[p, a] -= diagonal[p, a, c] * y[p, c]
            y[p, a] /= diagonal[p, a, a]
    for i in range(n):
        for a in range(k):
            out[i, a] = y[place[i], a]
