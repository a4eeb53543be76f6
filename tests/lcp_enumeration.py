"""All solutions of a small LCP by trying each piece of each row: an oracle that shares nothing with ours."""

import itertools
from fractions import Fraction

import numpy as np


def exact_solution(A, b):
    """The solution of a square system in fractions, or None where it is singular."""
    n = len(b)
    rows = [[Fraction(x) for x in (*a, c)] for a, c in zip(A, b, strict=True)]
    for k in range(n):
        pivot = next((r for r in range(k, n) if rows[r][k] != 0), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for r in range(n):
            if r != k:
                rows[r] = [x - rows[r][k] * y for x, y in zip(rows[r], rows[k], strict=True)]
    return [row[n] for row in rows]


def solutions(A, b, lower, upper):
    """Isolated solutions λ (lists of fractions): each row at one of its bounds, or with w = 0."""
    n, found = len(b), []
    A = [[Fraction(float(x)) for x in row] for row in A]
    b = [Fraction(float(x)) for x in b]
    pieces = [
        [p for p, bound in (("l", l), ("u", u)) if np.isfinite(bound)] + ["w"]
        for l, u in zip(lower, upper, strict=True)
    ]
    for choice in itertools.product(*pieces):
        λ = [Fraction(0)] * n
        for i, piece in enumerate(choice):
            if piece != "w":
                λ[i] = Fraction(float(lower[i] if piece == "l" else upper[i]))
        free = [i for i in range(n) if choice[i] == "w"]
        known = [b[i] + sum(A[i][j] * λ[j] for j in range(n) if j not in free) for i in range(n)]
        inner = exact_solution([[A[i][j] for j in free] for i in free], [-known[i] for i in free])
        if inner is None:
            continue
        for i, value in zip(free, inner, strict=True):
            λ[i] = value
        if holds(A, b, lower, upper, λ):
            found.append(λ)
    return found


def holds(A, b, lower, upper, λ):
    """Whether λ solves it, in fractions, by the definition."""
    for i in range(len(b)):
        w = b[i] + sum(A[i][j] * λ[j] for j in range(len(b)))
        if not lower[i] <= λ[i] <= upper[i]:
            return False
        if (w > 0 and λ[i] != lower[i]) or (w < 0 and λ[i] != upper[i]):
            return False
    return True


def nearly(A, b, lower, upper, λ, tolerance):
    """Whether λ solves it but for ``tolerance``, by the definition: for answers that are not isolated."""
    w = np.asarray(A) @ λ + b
    inside = np.all(λ >= lower - tolerance) and np.all(λ <= upper + tolerance)
    up = (w <= tolerance) | (np.abs(λ - lower) <= tolerance)  # w > 0 only at the lower bound
    down = (w >= -tolerance) | (np.abs(λ - upper) <= tolerance)
    return bool(inside and up.all() and down.all())
