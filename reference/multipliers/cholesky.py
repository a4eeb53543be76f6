"""Dense Cholesky: A = L Lᵀ. For a few joints that are not redundant: m³/3 operations.

Slides S8, S9; lectures/04_embedding.md. Source: Golub & Van Loan, Matrix Computations (2013), section 4.2.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from .pattern import Pairs, assemble, make_pairs, meeting_rows


class DenseFactor(NamedTuple):
    """A, then L, in its lower triangle (m, m); ``flat`` is the same memory."""

    pairs: Pairs
    flat: np.ndarray
    L: np.ndarray


def prepare(rows, system):
    """Room for the factor of these rows."""
    m = len(rows.kind)
    flat = np.zeros(m * m)
    return DenseFactor(make_pairs(meeting_rows(rows), lambda p, q: p * m + q), flat, flat.reshape(m, m))


@compiled
def factorise(system, mechanism):
    """A = L Lᵀ. Where A is singular, to rounding, L is nan, so that nothing wrong is taken for an answer."""
    factor = mechanism.factor
    assemble(factor.pairs, mechanism.jacobian.J, mechanism.B, factor.flat)
    cholesky(factor.L)


@compiled
def cholesky(L):
    """L in place of the lower triangle of a symmetric matrix; nan from where it isn't positive definite."""
    for p in range(len(L)):
        for q in range(p):
            total = L[p, q]
            for c in range(q):
                total -= L[p, c] * L[q, c]
            L[p, q] = total / L[q, q]
        pivot = L[p, p]
        for c in range(p):
            pivot -= L[p, c] ** 2
        L[p, p] = np.sqrt(pivot) if pivot > 1e-14 * L[p, p] else np.nan


@compiled
def solve_cholesky(L, right, λ):
    """L Lᵀ λ = right: down with L, up with Lᵀ; λ may be ``right`` itself."""
    m = len(L)
    for p in range(m):
        total = right[p]
        for q in range(p):
            total -= L[p, q] * λ[q]
        λ[p] = total / L[p, p]
    for p in range(m - 1, -1, -1):
        total = λ[p]
        for q in range(p + 1, m):
            total -= L[q, p] * λ[q]
        λ[p] = total / L[p, p]


@compiled
def substitute(mechanism, right, λ):
    """λ of A λ = right, after ``factorise``."""
    solve_cholesky(mechanism.factor.L, right, λ)
