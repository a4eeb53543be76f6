"""The shortest λ, for redundant joints: A is singular, and many λ give the same motion.

Of all λ with A λ = right this is the one with the smallest Σ λ_k², in the rows' own frame and SI units: it
adds up N and N m as if they were one. Steps λ ← λ + (A + ε 1)⁻¹ (right − A λ) from 0 never leave the range of A,
where the shortest solution lies; each takes the error down by ε/(ε + smallest eigenvalue that is not 0).

Slides S8, S9; lectures/04_embedding.md. Source: Riley, Math. Tables Aids Comput. 9 (1955) 96; Golub & Van
Loan, Matrix Computations (2013), section 5.5.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from .cholesky import cholesky, solve_cholesky
from .pattern import Pairs, assemble, make_pairs, meeting_rows

REGULARISATION = 1e-7  # ε over the largest diagonal entry: its square root balances rounding and convergence
STEPS = 12


class RedundantFactor(NamedTuple):
    """A in the lower triangle (m, m), ``flat`` its memory; L of A + ε 1; the rest of the equation, a step."""

    pairs: Pairs
    flat: np.ndarray
    A: np.ndarray
    L: np.ndarray
    rest: np.ndarray
    change: np.ndarray


def prepare(rows, system):
    """Room for the factor of these rows."""
    m = len(rows.kind)
    flat = np.zeros(m * m)
    pairs = make_pairs(meeting_rows(rows), lambda p, q: p * m + q)
    return RedundantFactor(pairs, flat, flat.reshape(m, m), np.zeros((m, m)), np.zeros(m), np.zeros(m))


@compiled
def factorise(system, mechanism):
    """A, and A + ε 1 = L Lᵀ."""
    factor = mechanism.factor
    assemble(factor.pairs, mechanism.jacobian.J, mechanism.B, factor.flat)
    largest = 0.0
    for p in range(len(factor.A)):
        largest = max(largest, factor.A[p, p])
        for q in range(p):
            factor.A[q, p] = factor.A[p, q]
    factor.L[:] = factor.A
    for p in range(len(factor.A)):
        factor.L[p, p] += REGULARISATION * largest
    cholesky(factor.L)


@compiled
def substitute(mechanism, right, λ):
    """The shortest λ with A λ = right, after ``factorise``."""
    factor = mechanism.factor
    λ[:] = 0
    before = np.inf
    for _ in range(STEPS):
        size = 0.0
        for p in range(len(λ)):
            total = right[p]
            for q in range(len(λ)):
                total -= factor.A[p, q] * λ[q]
            factor.rest[p] = total
        solve_cholesky(factor.L, factor.rest, factor.change)
        for p in range(len(λ)):
            size = max(size, abs(factor.change[p]))
        if not size < 0.5 * before:  # rounding is all that is left
            return
        before = size
        for p in range(len(λ)):
            λ[p] += factor.change[p]
