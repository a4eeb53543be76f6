"""Sparse L D Lᵀ: for many joints, of which each meets few others. A chain of n links costs n, not n³.

Which entries of L can be non-zero depends on who is joined to whom only, so it is found once, together with
an order of the rows in which few are. Row by row, L's entries are then computed from those of A.

Slides S8, S9; lectures/04_embedding.md. Source: Davis, Direct Methods for Sparse Linear Systems (2006),
chapter 4; the order: minimum degree, section 7.1.
"""

import heapq
from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from .pattern import Pairs, assemble, make_pairs, meeting_rows


class SparseFactor(NamedTuple):
    """L row by row, below its diagonal: row p has the entries from first[p] to first[p + 1]."""

    pairs: Pairs
    order: np.ndarray  # (m,): order[p] is the row of A that comes as p-th
    first: np.ndarray  # (m + 1,)
    column: np.ndarray  # (e,)
    values: np.ndarray  # (e + m,): entries of A, then those of L; the last m are the diagonal D
    by_column: np.ndarray  # (e,): L's entries again, column by column, as filled so far
    row_of: np.ndarray  # (e,): the rows of those
    start: np.ndarray  # (m,): where each column starts
    filled: np.ndarray  # (m,): how many of its entries are there
    work: np.ndarray  # (m,)


def prepare(rows, system):
    """The order of the rows and the pattern of L, with room for its entries."""
    meeting = meeting_rows(rows)
    m = len(rows.kind)
    order, below = minimum_degree(m, meeting)
    place = np.empty(m, dtype=int)
    place[order] = np.arange(m)
    of_row = [[] for _ in range(m)]  # columns of L in each row
    for q, deeper in enumerate(below):
        for p in deeper:
            of_row[place[p]].append(q)
    first = np.concatenate([[0], np.cumsum([len(columns) for columns in of_row])]).astype(int)
    column = np.array([q for columns in of_row for q in columns], dtype=int)
    where = {(p, q): first[p] + k for p, columns in enumerate(of_row) for k, q in enumerate(columns)}
    e = len(column)
    where.update({(p, p): e + p for p in range(m)})
    pairs = make_pairs(meeting, lambda p, q: where[max(place[p], place[q]), min(place[p], place[q])])
    counts = np.bincount(column, minlength=m)
    return SparseFactor(
        pairs,
        np.array(order, dtype=int),
        first,
        column,
        values=np.zeros(e + m),
        by_column=np.zeros(e),
        row_of=np.zeros(e, dtype=int),
        start=np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(int) if m else np.zeros(0, dtype=int),
        filled=np.zeros(m, dtype=int),
        work=np.zeros(m),
    )


def minimum_degree(m, meeting):
    """An order of the m rows, and for each in that order the rows that its column of L has below it.

    Eliminating a row joins all that it meets; next comes one that meets fewest, ties by number.
    """
    meets = [set() for _ in range(m)]
    for p, q, _, _ in meeting:
        if p != q:
            meets[p].add(q)
            meets[q].add(p)
    heap = [(len(others), k) for k, others in enumerate(meets)]
    heapq.heapify(heap)
    order, below, done = [], [], [False] * m
    while heap:
        degree, k = heapq.heappop(heap)
        if done[k] or degree != len(meets[k]):
            continue  # out of date: it was pushed again
        done[k] = True
        order.append(k)
        below.append(sorted(meets[k]))
        for p in meets[k]:
            meets[p] |= meets[k]
            meets[p] -= {p, k}
            heapq.heappush(heap, (len(meets[p]), p))
    return order, below


@compiled
def factorise(system, mechanism):
    """A = L D Lᵀ; D is nan where A is singular, to rounding."""
    factor = mechanism.factor
    assemble(factor.pairs, mechanism.jacobian.J, mechanism.B, factor.values)
    factor.filled[:] = 0
    y, e = factor.work, len(factor.column)
    for p in range(len(factor.order)):
        for s in range(factor.first[p], factor.first[p + 1]):
            y[factor.column[s]] = factor.values[s]
        pivot = factor.values[e + p]
        smallest = 1e-14 * pivot
        for s in range(factor.first[p], factor.first[p + 1]):  # solve for row p of L, column by column
            q = factor.column[s]
            l = y[q]
            for c in range(factor.start[q], factor.start[q] + factor.filled[q]):
                y[factor.row_of[c]] -= factor.by_column[c] * l
            scaled = l / factor.values[e + q]
            pivot -= scaled * l
            factor.values[s] = scaled
            end = factor.start[q] + factor.filled[q]
            factor.by_column[end] = scaled
            factor.row_of[end] = p
            factor.filled[q] += 1
        factor.values[e + p] = pivot if pivot > smallest else np.nan


@compiled
def substitute(mechanism, right, λ):
    """λ of A λ = right, after ``factorise``: down with L, divided by D, up with Lᵀ."""
    factor = mechanism.factor
    y, e, m = factor.work, len(factor.column), len(factor.order)
    for p in range(m):
        total = right[factor.order[p]]
        for s in range(factor.first[p], factor.first[p + 1]):
            total -= factor.values[s] * y[factor.column[s]]
        y[p] = total
    for p in range(m):
        y[p] /= factor.values[e + p]
    for p in range(m - 1, -1, -1):
        for s in range(factor.first[p], factor.first[p + 1]):
            y[factor.column[s]] -= factor.values[s] * y[p]
        λ[factor.order[p]] = y[p]
