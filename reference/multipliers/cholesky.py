"""Dense Cholesky: A = L Lᵀ. For a few joints that are not redundant: m³/6 multiplications.

Slides S8, S9; lectures/04_embedding.md. Source: Golub & Van Loan, Matrix Computations (2013), section 4.2.
"""

import numpy as np

from ..compiled import lean_apart, merged
from .factor import SINGULAR, assemble, make_factor, meeting_rows


def prepare(rows, system):
    """A ``Factor`` for these rows: values is A, then L, in the lower triangle, row by row (m²,)."""
    m = len(rows.kind)
    return make_factor(meeting_rows(rows, lambda p, q: p * m + q), values=m * m)


@merged
def factorise(m, factor, J, B):
    """A = L Lᵀ. Returns the smallest pivot relative to A's diagonal."""
    assemble(factor.meeting, J, B, factor.values)
    return cholesky(factor.values, 0, m)


@merged
def substitute(m, factor, right, λ):
    """λ of A λ = right, after ``factorise``."""
    for p in range(m):
        λ[p] = right[p]
    solve_cholesky(factor.values, 0, m, λ, 0)


@lean_apart
def cholesky(L, at, m):
    """L in place of a symmetric matrix's lower triangle, which starts at ``at`` in a flat array, row by row.

    Returns the smallest pivot relative to the diagonal. Where the matrix is singular, to rounding, L is nan,
    so that nothing wrong can be taken for an answer.
    """
    smallest = 1.0
    for p in range(m):
        row = at + p * m
        for q in range(p):
            other = at + q * m
            total = L[row + q]
            for c in range(q):
                total -= L[row + c] * L[other + c]
            L[row + q] = total / L[other + q]
        diagonal = L[row + p]
        pivot = diagonal
        for c in range(p):
            pivot -= L[row + c] * L[row + c]
        ratio = pivot / diagonal
        smallest = ratio if not ratio >= smallest else smallest
        L[row + p] = np.sqrt(pivot) if ratio > SINGULAR else np.nan
    return smallest


@lean_apart
def solve_cholesky(L, at, m, x, first):
    """x ← (L Lᵀ)⁻¹ x, for the m numbers from ``first`` on: down with L, up with Lᵀ; see ``cholesky``."""
    for p in range(m):
        total = x[first + p]
        for q in range(p):
            total -= L[at + p * m + q] * x[first + q]
        x[first + p] = total / L[at + p * m + p]
    for p in range(m - 1, -1, -1):
        total = x[first + p]
        for q in range(p + 1, m):
            total -= L[at + q * m + p] * x[first + q]
        x[first + p] = total / L[at + p * m + p]
