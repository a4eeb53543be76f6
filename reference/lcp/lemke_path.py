"""Lemke's path, compiled: which row leaves, by the lexicographic rule, and pivot after pivot till z₀ leaves.

Of each vertex's two neighbours one is where the path came from. ``leaving_row`` says where it goes on, and
that takes one column of the tableau and the constants: so exchanges are done late, four at once (``late``),
but at a tie. ``lemke`` says what the path is good for.

Slides S13; lectures/06_pivoting_lcp.md. Source: Cottle, Pang & Stone, The Linear Complementarity Problem
(2009), sections 4.4 and 4.9.
"""

import numpy as np

from ..compiled import compiled, compiled_apart
from .late import TOGETHER, clear_row, exchange_late, read_column, settle
from .path_end import vertex
from .pivoting import equilibrated, power_of_two
from .solution import CYCLE, MAX_ITERATIONS, RAY, SOLVED

_TINY, _TIE = 1e-11, 1e-12


@compiled_apart
def follow_path(T, basic, nonbasic, at, most, lexicographic, saved):
    """Pivot along the path until z₀ leaves; returns (pivots, code).

    T (m, m + 2): columns of the nonbasic unknowns, then constants. basic (m,), nonbasic (m + 1,): i is w_i,
    m + i is z_i, 2m is z₀. at (3,): the entering column, then as in ``principal.came_back``. saved (m,).
    """
    m = len(basic)
    column, constants = np.empty(m), T[:, m + 1].copy()
    F, G, late = np.empty((TOGETHER, m)), np.empty((TOGETHER, m + 2)), 0  # Fᵀ G is still to be added to T
    place = np.empty(2 * m + 1, np.int64)  # in which column each nonbasic unknown is
    for j in range(m + 1):
        place[nonbasic[j]] = j
    for k in range(most):
        s = at[0]
        read_column(T, F, G, late, s, column)
        r = first_row(T, s, lexicographic) if nonbasic[s] == 2 * m else -1
        if r < 0:
            r = clear_row(column, constants)
        if r == m:
            settle(T, F, G, late)
            late, r = 0, leaving_row(T, basic, nonbasic, s, lexicographic)
        if r < 0:
            settle(T, F, G, late)
            return k, RAY
        move_constants(constants, column, r)
        late = exchange_late(T, F, G, late, r, s, column)
        left = basic[r]
        basic[r], nonbasic[s] = nonbasic[s], left
        if left == 2 * m:
            settle(T, F, G, late)
            return k + 1, SOLVED
        partner = left + m if left < m else left - m
        at[0] = place[partner]
        place[left] = s
        if is_saved(basic, saved):
            settle(T, F, G, late)
            return k + 1, CYCLE
        at[1] += 1
        if at[1] >= at[2]:
            at[1], at[2] = 0, 2 * at[2]
            saved[:] = basic
    settle(T, F, G, late)
    return most, MAX_ITERATIONS


@compiled
def move_constants(constants, column, r):
    """What the exchange of row r does to the constants (m,), ahead of the tableau: column (m,) enters."""
    step = constants[r] / -column[r]
    for i in range(len(constants)):
        constants[i] += column[i] * step
    constants[r] = step


@compiled
def is_saved(basic, saved):
    """Whether the basic unknowns (m,) are those saved."""
    i = 0
    while i < len(basic) and basic[i] == saved[i]:
        i += 1
    return i == len(basic)


@compiled
def straight(A, b, most, lexicographic):
    """All of it on a plain problem, from A and b to (λ, pivots, code), in one call.

    At n = 100 the pivots take less time than what would lie around them in Python.
    """
    n = len(b)
    row, column = equilibrated(A)
    beta = power_of_two(1 / np.abs(row * b).max())
    unit, weight = column / beta, beta * row
    T, largest = np.empty((n, n + 2)), weight.max()
    for i in range(n):
        for j in range(n):
            T[i, j] = row[i] * A[i, j] * column[j]
        T[i, n], T[i, n + 1] = weight[i] / largest, weight[i] * b[i]
    path = T, np.arange(n), np.arange(n, 2 * n + 1)
    if not (b < 0).any():
        return np.zeros(n), 0, SOLVED
    pivots, code = follow_path(*path, np.array([n, 0, 2]), most, lexicographic, np.full(n, -1))
    return vertex(*path, A, b, unit, weight), pivots, code


@compiled
def first_row(T, s, lexicographic):
    """The row that leaves when z₀ enters, in column s: the last to become right as z₀ grows."""
    row, least = -1, 0.0
    for i in range(len(T)):
        if T[i, s] > 0:
            ratio = T[i, -1] / T[i, s]
            if ratio < least or (ratio == least < 0 and lexicographic):
                row, least = i, ratio
    return row


@compiled_apart
def leaving_row(T, basic, nonbasic, s, lexicographic):
    """The row whose unknown is the first to become 0 as that of column s grows from 0; −1 if none is.

    A tie goes to z₀; then to the lexicographically least row, or to the first.
    """
    m = len(basic)
    largest, top = 0.0, 0.0
    for i in range(m):
        largest, top = max(largest, abs(T[i, s])), max(top, abs(T[i, m + 1]))
    tiny, least = _TINY * largest, np.inf
    for i in range(m):
        if T[i, s] < -tiny:
            least = min(least, max(T[i, m + 1], 0.0) / -T[i, s])
    row = -1
    for i in range(m):
        q = max(T[i, m + 1], 0.0)
        if T[i, s] < -tiny and q + T[i, s] * least <= _TIE * q + 1e-15 * top:
            if basic[i] == 2 * m:
                return i
            if row < 0 or (lexicographic and before(T, basic, nonbasic, s, i, row)):
                row = i
    return row


@compiled_apart
def before(T, basic, nonbasic, s, i, r):
    """Whether row i comes before row r in the lexicographic order of their ratios.

    With q + (ε, ε², …) in place of q, a row's value gets ε^k times its number in column k of the inverse of
    the basis: 1 where w_k is its own unknown, − the tableau's number where w_k is nonbasic.
    """
    m = len(basic)
    column = np.full(m, -1)
    for j in range(m + 1):
        if nonbasic[j] < m:
            column[nonbasic[j]] = j
    for k in range(m):
        of_i, of_r = 1.0 if basic[i] == k else 0.0, 1.0 if basic[r] == k else 0.0
        if column[k] >= 0:
            of_i, of_r = -T[i, column[k]], -T[r, column[k]]
        of_i, of_r = of_i / -T[i, s], of_r / -T[r, s]
        if abs(of_i - of_r) > _TIE * max(abs(of_i), abs(of_r)):
            return of_i < of_r
    return False
