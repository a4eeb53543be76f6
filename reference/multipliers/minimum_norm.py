"""The shortest λ, for redundant joints: A is singular, and many λ give the same motion.

Of all λ with A λ = right this is the one with the smallest Σ λ_k², in the rows' own frame and SI units: it
adds up N and N m as if they were one. It does not depend on the masses: A λ = right fixes f_c = Jᵀ λ, and the
shortest λ of that is the pseudo-inverse of Jᵀ times f_c.

Cholesky's method, the largest remaining pivot first, stops where what remains is rounding: r rows I are
independent, and the others K are sums of them. With W = A_II⁻¹ A_IK the columns of N = (−W, 1) span all λ
that move nothing; taking those parts out of a λ that uses the rows I alone leaves the shortest.

    L Lᵀ λ_I = right_I,   (1 + Wᵀ W) y = −Wᵀ λ_I,   λ = (λ_I + W y, −y)

Slides S8, S9; lectures/04_embedding.md. Source: Golub & Van Loan, Matrix Computations (2013), sections 4.2.8
and 5.5; Higham, Accuracy and Stability of Numerical Algorithms (2002), section 10.3.
"""

import numpy as np

from ..compiled import merged
from .cholesky import cholesky, solve_cholesky
from .factor import assemble, make_factor, meeting_rows

# A pivot, over what was there before the elimination, below which a row is a sum of others. It is a square:
# 1e-3 of a row's length. Within a step the joints stand open by something of Δt², and redundant rows then
# differ by as much; taken for independent, they would lock a mechanism that moves, such as Bricard's.
DEPENDENT = 1e-6


def prepare(rows, system):
    """A ``Factor``: values is A, L of 1 + WᵀW, W transposed, m² each, two vectors; pattern order, then r."""
    m = len(rows.kind)
    return make_factor(
        meeting_rows(rows, lambda p, q: p * m + q), np.zeros((m + 1, 1), dtype=int), values=3 * m * m + 2 * m
    )


@merged
def factorise(m, factor, J, B):
    """The independent rows, L, W, and L of 1 + Wᵀ W. Returns the smallest pivot of the rows taken."""
    values, order = factor.values, factor.pattern
    assemble(factor.meeting, J, B, values)
    smallest = pivoted_cholesky(m, values, order, 3 * m * m)
    r = order[m, 0]
    gram, W = m * m, 2 * m * m
    for a in range(r, m):  # row a of W transposed: Lᵀ W = what the elimination left below L
        for p in range(r - 1, -1, -1):
            total = values[a * m + p]
            for q in range(p + 1, r):
                total -= values[q * m + p] * values[W + a * m + q]
            values[W + a * m + p] = total / values[p * m + p]
    n = m - r
    for a in range(n):
        for b in range(a + 1):
            total = 1.0 if a == b else 0.0
            for p in range(r):
                total += values[W + (r + a) * m + p] * values[W + (r + b) * m + p]
            values[gram + a * n + b] = total
    cholesky(values, gram, n)
    return smallest


@merged
def pivoted_cholesky(m, A, order, diagonal):
    """L of the rows in the order chosen, in place; their number r in order[m]; the diagonal is kept too."""
    for p in range(m):
        order[p, 0] = p
        A[diagonal + p] = A[p * m + p]
        for q in range(p):
            A[q * m + p] = A[p * m + q]
    smallest, r = 1.0, 0
    while r < m:
        best, ratio = r, -1.0
        for p in range(r, m):
            here = A[p * m + p] / A[diagonal + p]
            if here > ratio:
                best, ratio = p, here
        if not ratio > DEPENDENT:
            break
        smallest = min(smallest, ratio)
        swap(m, A, order, diagonal, r, best)
        pivot = np.sqrt(A[r * m + r])
        A[r * m + r] = pivot
        for p in range(r + 1, m):
            A[p * m + r] /= pivot
        for p in range(r + 1, m):
            for q in range(r + 1, p + 1):
                A[p * m + q] -= A[p * m + r] * A[q * m + r]
                A[q * m + p] = A[p * m + q]
        r += 1
    order[m, 0] = r
    return smallest


@merged
def swap(m, A, order, diagonal, p, q):
    """Change the places of rows and columns p and q."""
    order[p, 0], order[q, 0] = order[q, 0], order[p, 0]
    A[diagonal + p], A[diagonal + q] = A[diagonal + q], A[diagonal + p]
    for c in range(m):
        A[p * m + c], A[q * m + c] = A[q * m + c], A[p * m + c]
    for c in range(m):
        A[c * m + p], A[c * m + q] = A[c * m + q], A[c * m + p]


@merged
def substitute(m, factor, right, λ):
    """The shortest λ with A λ = right, after ``factorise``."""
    values, order = factor.values, factor.pattern
    r = order[m, 0]
    n, gram, W, x, y = m - r, m * m, 2 * m * m, 3 * m * m, 3 * m * m + m
    for p in range(r):
        total = right[order[p, 0]]
        for q in range(p):
            total -= values[p * m + q] * values[x + q]
        values[x + p] = total / values[p * m + p]
    for p in range(r - 1, -1, -1):
        total = values[x + p]
        for q in range(p + 1, r):
            total -= values[q * m + p] * values[x + q]
        values[x + p] = total / values[p * m + p]
    for a in range(n):
        total = 0.0
        for p in range(r):
            total -= values[W + (r + a) * m + p] * values[x + p]
        values[y + a] = total
    solve_cholesky(values, gram, n, values, y)
    for p in range(r):
        total = values[x + p]
        for a in range(n):
            total += values[W + (r + a) * m + p] * values[y + a]
        λ[order[p, 0]] = total
    for a in range(n):
        λ[order[r + a, 0]] = -values[y + a]
