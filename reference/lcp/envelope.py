"""Cholesky's factor within its envelope: for matrices whose entries can be brought near the diagonal.

A symmetric matrix of n blocks k × k, one block row a body, is kept row by row from its first entry to its
diagonal, and so is its factor: what lies left of the first entry of a row stays 0. The bodies are put in an
order (Cuthill and McKee's, reversed) in which those that meet stand near each other: a stack or a chain
then has bandwidth 1, a wall of bricks that of its shorter side. Cost: n times the bandwidth squared.

Slides S8, S14; lectures/08_newton_lcp.md. Source: Cuthill & McKee, Proc. 24th ACM National Conference
(1969); George & Liu, Computer Solution of Large Sparse Positive Definite Systems (1981), chapter 4.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart, inner, inner_apart


class Envelope(NamedTuple):
    """Where the entries are. Row r, in the order of elimination, holds columns first[r] … r."""

    place: np.ndarray  # (n,): body → its place in the order
    first: np.ndarray  # (n k,)
    start: np.ndarray  # (n k + 1,): where row r begins among the values


@compiled_apart
def make_envelope(pairs, n, k):
    """The Envelope for n bodies with k velocities each; pairs (m, 2): bodies that meet; −1: the world."""
    start, other = neighbours(pairs, n)
    place = order_bodies(start, other, n)
    first_body = place.copy()
    for q in range(len(pairs)):
        i, j = pairs[q, 0], pairs[q, 1]
        if i >= 0 and j >= 0:
            first_body[i] = min(first_body[i], place[j])
            first_body[j] = min(first_body[j], place[i])
    first, begin = np.empty(n * k, np.int64), np.empty(n * k + 1, np.int64)
    for i in range(n):
        for a in range(k):
            first[k * place[i] + a] = k * first_body[i]
    begin[0] = 0
    for r in range(n * k):
        begin[r + 1] = begin[r] + r - first[r] + 1
    return Envelope(place, first, begin)


@compiled
def neighbours(pairs, n):
    """Whom each body meets: other[start[i]:start[i + 1]], with repetitions."""
    start = np.zeros(n + 1, np.int64)
    for q in range(len(pairs)):
        i, j = pairs[q, 0], pairs[q, 1]
        if i >= 0 and j >= 0:
            start[i + 1] += 1
            start[j + 1] += 1
    for i in range(n):
        start[i + 1] += start[i]
    other, filled = np.empty(start[n], np.int64), start[:n].copy()
    for q in range(len(pairs)):
        i, j = pairs[q, 0], pairs[q, 1]
        if i >= 0 and j >= 0:
            other[filled[i]], other[filled[j]] = j, i
            filled[i] += 1
            filled[j] += 1
    return start, other


@compiled
def order_bodies(start, other, n):
    """Reverse Cuthill–McKee: breadth first from an end of each connected part, then backwards."""
    queue, place = np.empty(n, np.int64), np.full(n, -1)
    done = 0
    for root in range(n):
        if place[root] >= 0:
            continue
        last = breadth_first(start, other, root, queue, place, done)
        end = queue[last - 1]  # the farthest body: an end of the part
        for q in range(done, last):
            place[queue[q]] = -1
        done = breadth_first(start, other, end, queue, place, done)
    for i in range(n):
        place[i] = n - 1 - place[i]
    return place


@inner_apart
def breadth_first(start, other, root, queue, place, done):
    """Put all that can be reached from root into the queue after place ``done``; returns the new end."""
    queue[done], place[root] = root, done
    head, tail = done, done + 1
    while head < tail:
        i = queue[head]
        head += 1
        for q in range(start[i], start[i + 1]):
            j = other[q]
            if place[j] < 0:
                queue[tail], place[j] = j, tail
                tail += 1
    return tail


@inner
def add_block(envelope, values, i, j, k, row, column, weight):
    """Add weight · row ⊗ column to the block of bodies i and j; only what is kept: row ≥ column."""
    p, q = k * envelope.place[i], k * envelope.place[j]
    if q > p:
        return
    for a in range(k):
        at = envelope.start[p + a] - envelope.first[p + a] + q
        most = a + 1 if p == q else k
        scaled = weight * row[a]
        for b in range(most):
            values[at + b] += scaled * column[b]


@inner_apart
def cholesky_in_envelope(envelope, L):
    """L Lᵀ = the matrix, in place, row by row. Returns whether all pivots were positive."""
    first, start = envelope.first, envelope.start
    for i in range(len(first)):
        row = start[i] - first[i]
        for j in range(first[i], i):
            other = start[j] - first[j]
            total = L[row + j]
            for c in range(max(first[i], first[j]), j):
                total -= L[row + c] * L[other + c]
            L[row + j] = total / L[other + j]
        pivot = L[row + i]
        for c in range(first[i], i):
            pivot -= L[row + c] ** 2
        if not pivot > 0:
            return False
        L[row + i] = np.sqrt(pivot)
    return True


@inner_apart
def solve_in_envelope(envelope, L, x, y, out):
    """out (n, k) of L Lᵀ out = x (n, k), both in the order of the bodies; y (n k,): room."""
    first, start, place = envelope.first, envelope.start, envelope.place
    n, k = x.shape
    for i in range(n):
        for a in range(k):
            y[k * place[i] + a] = x[i, a]
    for r in range(n * k):
        row, total = start[r] - first[r], y[r]
        for c in range(first[r], r):
            total -= L[row + c] * y[c]
        y[r] = total / L[row + r]
    for r in range(n * k - 1, -1, -1):
        row = start[r] - first[r]
        y[r] /= L[row + r]
        for c in range(first[r], r):
            y[c] -= L[row + c] * y[r]
    for i in range(n):
        for a in range(k):
            out[i, a] = y[k * place[i] + a]
