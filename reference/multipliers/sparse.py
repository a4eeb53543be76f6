"""Sparse L D Lᵀ: for many joints, of which each meets few others. A chain of n links costs n, not n³.

Which entries of L can be non-zero depends only on who is joined to whom. So it is found once, in an order of
the rows that makes them few, and with it a list of all products to be subtracted: the loops that then run in
each stage read that list and decide nothing.

Slides S8, S9; lectures/04_embedding.md. Source: Davis, Direct Methods for Sparse Linear Systems (2006),
chapter 4; the order: minimum degree, section 7.1.
"""

import heapq

import numpy as np

from ..compiled import merged
from .factor import SINGULAR, assemble, make_factor, meeting_rows


def prepare(rows, system):
    """A ``Factor`` for these rows, of which L has e entries below its diagonal, column by column.

    values (m + e + m,): D; L's entries; a vector to work in. pattern (m + 1, 3): for each column the row of A
    that it stands for, where its entries start, and where its products do. links (…, 2): first the row of
    each entry; then each product, (place to subtract from, place of the first factor, of the second).
    """
    m = len(rows.kind)
    meeting = meeting_rows(rows, lambda p, q: 0)
    order, below = minimum_degree(m, meeting)
    place = np.empty(m, dtype=int)
    place[order] = np.arange(m)
    columns = [sorted(place[p] for p in rows_below) for rows_below in below]
    starts = m + np.concatenate([[0], np.cumsum([len(column) for column in columns])]).astype(int)
    where = {(q, q): q for q in range(m)}
    for q, column in enumerate(columns):
        where.update({(p, q): starts[q] + s for s, p in enumerate(column)})
    products, firsts = [], []
    for q, column in enumerate(columns):
        firsts.append(len(products))
        products += [
            (where[p, o], where[p, q], where[o, q]) for a, p in enumerate(column) for o in column[: a + 1]
        ]
    firsts.append(len(products))
    entry = [
        (*pair[:4], where[max(place[pair[0]], place[pair[1]]), min(place[pair[0]], place[pair[1]])])
        for pair in meeting
    ]
    e = starts[-1] - m
    table = [(p, 0, 0) for column in columns for p in column] + products
    pattern = np.column_stack([[*order, 0], starts, e + np.array(firsts)])
    return make_factor(entry, pattern, np.array(table, dtype=int).reshape(-1, 3), values=2 * m + e)


def minimum_degree(m, meeting):
    """An order of the m rows, and for each in that order the rows that its column of L has below it.

    Eliminating a row joins all that it meets; next comes one that meets fewest, ties by number.
    """
    meets = [set() for _ in range(m)]
    for p, q, *_ in meeting:
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
        below.append(meets[k])
        for p in meets[k]:
            meets[p] |= meets[k]
            meets[p] -= {p, k}
            heapq.heappush(heap, (len(meets[p]), p))
    return order, below


@merged
def factorise(m, factor, J, B):
    """A = L D Lᵀ. Returns the smallest pivot relative to A's diagonal."""
    values, pattern, links = factor.values, factor.pattern, factor.links
    assemble(factor.meeting, J, B, values)
    work = len(values) - m
    for q in range(m):
        values[work + q] = values[q]
    smallest = 1.0
    for q in range(m):
        ratio = values[q] / values[work + q]
        smallest = ratio if not ratio >= smallest else smallest
        inverse = 1 / values[q] if ratio > SINGULAR else np.nan
        for s in range(pattern[q, 2], pattern[q + 1, 2]):
            values[links[s, 0]] -= values[links[s, 1]] * values[links[s, 2]] * inverse
        for s in range(pattern[q, 1], pattern[q + 1, 1]):
            values[s] *= inverse
        values[q] = inverse
    return smallest


@merged
def substitute(m, factor, right, λ):
    """λ of A λ = right, after ``factorise``: down with L, times D⁻¹, up with Lᵀ."""
    values, pattern, links = factor.values, factor.pattern, factor.links
    work = len(values) - m
    for q in range(m):
        values[work + q] = right[pattern[q, 0]]
    for q in range(m):
        y = values[work + q]
        for s in range(pattern[q, 1], pattern[q + 1, 1]):
            values[work + links[s - m, 0]] -= values[s] * y
    for q in range(m - 1, -1, -1):
        y = values[work + q] * values[q]
        for s in range(pattern[q, 1], pattern[q + 1, 1]):
            y -= values[s] * values[work + links[s - m, 0]]
        values[work + q] = y
        λ[pattern[q, 0]] = y
