"""Cholesky's factor of a sparse matrix of blocks k × k, one block row a body, column after column.

    L_jj L_jjᵀ = A_jj − Σ_q L_jq L_jqᵀ,        L_ij = (A_ij − Σ_q L_iq L_jqᵀ) L_jj⁻ᵀ

Only blocks that the ``Pattern`` has are touched; an order that leaves few of them is the whole art
(``body_order``). Cost, for n discs in a heap, about n^1.5, and for a stack n.

Slides S8, S14; lectures/08_newton_lcp.md. Source: Davis, Direct Methods for Sparse Linear Systems (2006),
section 4.10 (supernodes: here a body's k velocities).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, inner, inner_apart
from .body_order import Pattern, find_pattern


class BlockFactor(NamedTuple):
    """The matrix, and then its factor in the same places."""

    pattern: Pattern
    diagonal: np.ndarray  # (n, k, k), the lower triangle
    below: np.ndarray  # (blocks, k, k)
    where: np.ndarray  # (n,), and others to compute in
    turned: np.ndarray  # (k, k)
    ordered: np.ndarray  # (n, k)


@compiled
def make_block_factor(pairs, n, k):
    """Room for n bodies with k velocities each; pairs (m, 2): bodies that meet; −1: the world."""
    pattern = find_pattern(pairs, n)
    return BlockFactor(
        pattern,
        np.empty((n, k, k)),
        np.empty((len(pattern.row), k, k)),
        np.empty(n, np.int64),
        np.empty((k, k)),
        np.empty((n, k)),
    )


@inner
def clear(factor):
    """All blocks 0."""
    for blocks in (factor.diagonal, factor.below):
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
    """Add weight · row ⊗ column to the block of bodies i and j; only what is kept: i not before j."""
    p, q = factor.pattern.place[i], factor.pattern.place[j]
    if q > p:
        return
    block = factor.diagonal[p] if p == q else factor.below[find_block(factor.pattern, p, q)]
    for a in range(len(row)):
        scaled = weight * row[a]
        for b in range(len(column)):
            block[a, b] += scaled * column[b]


@inner
def factorise(factor):
    """The matrix becomes its factor. Returns whether all pivots were positive."""
    p = factor.pattern
    return factorise_blocks(
        p.start, p.row, p.left, p.column, p.at, factor.diagonal, factor.below, factor.where, factor.turned
    )


@inner
def solve(factor, x, out):
    """out (n, k) of L Lᵀ out = x (n, k), both in the order of the bodies."""
    p = factor.pattern
    solve_blocks(p.place, p.start, p.row, factor.diagonal, factor.below, x, factor.ordered, out)


@inner_apart
def factorise_blocks(start, row, left, column, at, diagonal, below, where, turned):
    """``factorise``, array by array."""
    n, k = diagonal.shape[:2]
    for j in range(n):
        for q in range(start[j], start[j + 1]):
            where[row[q]] = q
        for q in range(left[j], left[j + 1]):
            first, end = at[q], start[column[q] + 1]
            for a in range(k):
                for b in range(k):
                    turned[b, a] = below[first, a, b]
            subtract_product(diagonal[j], below[first], turned)
            for r in range(first + 1, end):
                subtract_product(below[where[row[r]]], below[r], turned)
        if not factorise_one(diagonal[j]):
            return False
        for q in range(start[j], start[j + 1]):
            divide_by_transposed(below[q], diagonal[j])
    return True


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
    """One block's own factor, into its lower triangle. Returns whether its pivots were positive."""
    for i in range(len(A)):
        for j in range(i + 1):
            total = A[i, j]
            for c in range(j):
                total -= A[i, c] * A[j, c]
            if i > j:
                A[i, j] = total / A[j, j]
            elif total > 0:
                A[i, i] = np.sqrt(total)
            else:
                return False
    return True


@inner
def divide_by_transposed(B, L):
    """B ← B L⁻ᵀ with L lower triangular."""
    for a in range(len(B)):
        for i in range(len(L)):
            total = B[a, i]
            for c in range(i):
                total -= B[a, c] * L[i, c]
            B[a, i] = total / L[i, i]


@inner_apart
def solve_blocks(place, start, row, diagonal, below, x, y, out):
    """``solve``, array by array."""
    n, k = x.shape
    for i in range(n):
        for a in range(k):
            y[place[i], a] = x[i, a]
    for p in range(n):
        for a in range(k):
            for c in range(a):
                y[p, a] -= diagonal[p, a, c] * y[p, c]
            y[p, a] /= diagonal[p, a, a]
        for q in range(start[p], start[p + 1]):
            for a in range(k):
                for c in range(k):
                    y[row[q], a] -= below[q, a, c] * y[p, c]
    for p in range(n - 1, -1, -1):
        for q in range(start[p], start[p + 1]):
            for a in range(k):
                for c in range(k):
                    y[p, c] -= below[q, a, c] * y[row[q], a]
        for a in range(k - 1, -1, -1):
            for c in range(a + 1, k):
                y[p, a] -= diagonal[p, c, a] * y[p, c]
            y[p, a] /= diagonal[p, a, a]
    for i in range(n):
        for a in range(k):
            out[i, a] = y[place[i], a]
