"""What the pivoting methods share: A made dense, numbers made comparable, and the answer made accurate.

**Made comparable.** Rows and columns are multiplied by powers of two, A → R A C, λ → C⁻¹λ, w → R w, until
the largest number of each is about 1. Signs and ratios within a row don't change, so no method takes another
pivot for it, and powers of two don't round; but what is "nearly zero" then means the same everywhere.

**Made accurate.** A tableau gathers rounding with each pivot. In the end only *which* rows have w = 0 is
taken from it, and those equations are solved afresh (``refined``).

**Made sure.** Where a method runs off along a ray it leaves y, the direction of λ. If no λ within its bounds
makes yᵀw ≥ 0, though every right w has yᵀw ≥ 0, then there is no solution at all (``proves_infeasible``).

Slides S13, S14; lectures/06_pivoting_lcp.md. Source for the certificate: Cottle, Pang & Stone, The Linear
Complementarity Problem (2009), section 2.7 (Farkas).
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from .iteration import checked, solved_already, unsuitable
from .problem import LCP

LARGEST = 3000  # rows: a tableau of as many is 72 MB, and takes minutes
INSIDE, LOWER, UPPER = 0, 1, 2  # where a row is: w = 0 and λ between its bounds, λ at the lower, at the upper


class Scaled(NamedTuple):
    """A problem in units of its own: λ = unit · λ̂, and w = ŵ / weight."""

    A: np.ndarray
    b: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    normal: np.ndarray
    mu: np.ndarray
    unit: np.ndarray
    weight: np.ndarray


def dense(A):
    """A as a dense array (n, n), not to be written into: A itself, where it is one."""
    return A if isinstance(A, np.ndarray) else np.ascontiguousarray(A.toarray())


def why_not(problem, largest=LARGEST):
    """Why no pivoting method can treat a problem; "" where they can."""
    if not isinstance(problem, LCP):
        return "Pivoting needs flat sides, and can't treat the exact friction cone: take a cone method."
    if problem.n > largest:
        return (
            f"Pivoting makes A dense and takes about n pivots of n² operations, so this method stops at "
            f"{largest} rows, and the problem has {problem.n}: take an iterative method."
        )
    if not 0 < problem.scale < np.inf:
        return "b/A_ii overflows: the numbers of this problem are too far apart."
    return ""


def begun(problem, start, tolerance, max_iterations, largest=LARGEST):
    """(λ, tolerance, max_iterations, Solution or None): arguments checked; the Solution where all is said.

    Raises ValueError or TypeError, which name the argument.
    """
    λ, tolerance, most = checked(problem, start, tolerance, max_iterations)
    solution = None
    if start is not None or problem.scale == 0:  # else λ is λ⁰, which is no solution
        solution = solved_already(problem, λ, tolerance)
    reason = "" if solution else why_not(problem, largest)
    return λ, tolerance, most, unsuitable(problem, λ, tolerance, reason) if reason else solution


def scaled(problem):
    """The Scaled form of an LCP."""
    A = dense(problem.A)
    row, column = equilibrated(A)
    with np.errstate(all="ignore"):
        if problem.n and not (np.array_equal(row, column) and (row == 1).all()):
            A = A * (row[:, None] * column)
        beta = power_of_two(1 / np.abs(row * problem.w_at_origin).max(initial=0))
        unit, weight = column / beta, beta * row
        lower, upper = problem.lower / unit, problem.upper / unit
    normal, mu = problem.terms.normal, problem.terms.mu
    if problem.has_friction:
        mu = mu * np.where(normal >= 0, unit[normal], 1) / unit
    return Scaled(A, weight * problem.b, lower, upper, normal, mu, unit, weight)


@compiled
def power_of_two(x):
    """The power of two nearest to x > 0; 1 for what is not a positive number."""
    return np.exp2(np.floor(np.log2(x) + 0.5)) if 0 < x < np.inf else 1.0


@compiled
def equilibrated(A):
    """(row, column), powers of two (n,) each, that bring the largest of each row and column of A near 1."""
    n, size = len(A), np.abs(A)
    row, column = np.ones(n), np.ones(n)
    for _ in range(3):
        by_row, by_column = peaks(size)
        if near_one(by_row) and near_one(by_column):
            break
        for i in range(n):
            by_row[i], by_column[i] = power_of_two(by_row[i] ** -0.5), power_of_two(by_column[i] ** -0.5)
        for i in range(n):
            size[i] *= by_row[i] * by_column
        row *= by_row
        column *= by_column
    return row, column


@compiled
def peaks(size):
    """(by_row, by_column): the largest of each row and column of size (n, n) ≥ 0.

    Read as whole numbers, the bits of such doubles have the same order; and of whole numbers, none of which
    can be NaN, a compiler may compare several at once.
    """
    n, bits = len(size), size.view(np.int64)
    by_row, by_column = np.zeros(n, np.int64), np.zeros(n, np.int64)
    for i in range(n):
        largest = np.int64(0)
        for j in range(n):
            largest = max(largest, bits[i, j])
            by_column[j] = max(by_column[j], bits[i, j])
        by_row[i] = largest
    return by_row.view(np.float64), by_column.view(np.float64)


@compiled
def near_one(largest):
    """Whether all numbers (n,) but zeros are near 1."""
    fine = True
    for peak in largest:
        fine = fine and (peak == 0 or 0.49 < peak < 2.1)
    return fine


def refined(problem, λ, place):
    """λ (n,) with the equations w = 0 of the rows INSIDE solved afresh, the other rows at their bounds.

    place (n,): INSIDE, LOWER or UPPER. A friction row at a bound moves with its normal's λ. Where the
    equations are singular, the nearest of their solutions. The λ given, where that is the better one.
    """
    low, high = bounds(problem, λ)
    guess = np.clip(np.where(place == LOWER, low, np.where(place == UPPER, high, λ)), low, high)
    best, least = guess, problem.residual(guess)
    free = np.flatnonzero(place == INSIDE)
    for k in range(2):
        if not len(free) or least <= (0 if k == 0 else 1e-14):
            break
        with np.errstate(all="ignore"):
            improved = guess + _correction(problem, guess, place, free)
            improved = np.clip(improved, *bounds(problem, improved))
        residual = problem.residual(improved)
        if not residual < least:
            break
        best, least, guess = improved, residual, improved
    return best


def bounds(problem, λ):
    """The bounds (n,), (n,) at this λ; those that stand still are not copied."""
    return problem.bounds(λ) if problem.has_friction else (problem.lower, problem.upper)


def _correction(problem, λ, place, free):
    """The change of λ (n,) that makes w = 0 in the rows ``free``, by a fresh solve."""
    normal, μ = problem.terms.normal, problem.terms.mu
    follow = np.flatnonzero((normal >= 0) & (place != INSIDE))  # these move with their normals
    sign = np.where(place[follow] == UPPER, 1, -1) * μ[follow]
    A, change = dense(problem.A), np.zeros(problem.n)
    system = A[free]
    if len(follow):
        np.add.at(system.T, normal[follow], (system[:, follow] * sign).T)
    system, w = system[:, free], problem.w(λ)[free]
    try:
        step = np.linalg.solve(system, -w)
    except np.linalg.LinAlgError:
        step = np.full(len(free), np.inf)
    if not np.isfinite(step).all():
        step = np.linalg.lstsq(system, -w, rcond=1e-12)[0] if np.isfinite(system).all() else step
    change[free] = step
    change[follow] = sign * change[normal[follow]]
    return change


def proves_infeasible(problem, y):
    """Whether y (n,) proves that no λ within its bounds makes w what it must be.

    Every right w has yᵀw ≥ 0 if y_i ≥ 0 where w_i ≥ 0 is asked, y_i ≤ 0 where w_i ≤ 0 is, and y_i = 0 where
    w_i may have either sign. y proves it if yᵀ(A λ + b) < 0 for all λ within their bounds.
    """
    size = np.abs(y).max(initial=0)
    if not 0 < size < np.inf or not isinstance(problem, LCP):
        return False
    y, terms = y / size, problem.terms
    may_rise = np.isfinite(terms.lower) | (terms.normal >= 0)  # w_i > 0 is right at the lower bound
    may_fall = np.isfinite(terms.upper) | (terms.normal >= 0)
    if (y[may_rise] < 0).any() or (y[may_fall] > 0).any():
        return False
    A = dense(problem.A)
    force, noise = y @ A, 1e-12 * (np.abs(y) @ np.abs(A))
    force[np.abs(force) <= noise] = 0
    for t in np.flatnonzero((terms.normal >= 0) & (force != 0)):
        if terms.lower[terms.normal[t]] < 0:
            return False
        force[terms.normal[t]] += abs(force[t]) * terms.mu[t]
        force[t] = 0
    with np.errstate(all="ignore"):
        best = np.where(force > 0, terms.upper, np.where(force < 0, terms.lower, 0.0))
        parts = np.where(force == 0, 0.0, force * best)
    size = np.abs(parts).sum() + np.abs(y) @ np.abs(problem.b)
    return bool(np.isfinite(size) and parts.sum() + y @ problem.b < -1e-9 * size)
