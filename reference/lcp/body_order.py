"""In which order to eliminate bodies, and which blocks of Cholesky's factor that leaves: minimum degree.

Eliminating a body joins all that it meets. Next comes one that meets the fewest: in a stack or a chain
nothing is ever added, in a heap little. What a body meets when its turn comes are the rows of its column.

What two eliminated bodies leave behind is not written out. Whoever met the body p keeps p in his list, and
p's column says who they all are; a column that is part of a newer one is crossed out. So no list ever grows.

Slides S8, S14; lectures/08_newton_lcp.md. Source: George & Liu, SIAM Review 31 (1989) 1 (minimum degree, with
such quotient graphs); Davis, Direct Methods for Sparse Linear Systems (2006), section 7.1.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart


class Pattern(NamedTuple):
    """Where the blocks of L are: column p, in the order of elimination, has rows row[start[p]] …, sorted."""

    place: np.ndarray  # (n,): body → its place in the order
    start: np.ndarray  # (n + 1,)
    row: np.ndarray  # (blocks,)
    left: np.ndarray  # (n + 1,): row p has the blocks at[left[p]] …, in the columns column[left[p]] …
    column: np.ndarray  # (blocks,)
    at: np.ndarray  # (blocks,)


class Graph(NamedTuple):
    """Who meets whom while bodies are eliminated."""

    begin: np.ndarray  # (n + 1,)
    length: np.ndarray  # (n,): body i meets other[begin[i]] … other[begin[i] + length[i] − 1], or whoever
    other: np.ndarray  # is in their columns if they are gone
    place: np.ndarray  # (n,): −1: still there
    column: np.ndarray  # (n, 2): where the column of an eliminated body begins and ends
    part: np.ndarray  # (n,): whether that column is part of a newer one
    seen: np.ndarray  # (n + 1,): marks, the last of which is the newest


@compiled_apart
def find_pattern(pairs, n):
    """The Pattern for n bodies; pairs (m, 2): bodies that meet; −1: the world."""
    begin, other = neighbours(pairs, n)
    degree = begin[1:] - begin[:n]
    graph = Graph(
        begin,
        degree.copy(),
        other,
        np.full(n, -1),
        np.zeros((n, 2), np.int64),
        np.zeros(n, np.bool_),
        np.zeros(n + 1, np.int64),
    )
    start, row = np.zeros(n + 1, np.int64), np.empty(4 * len(other) + n, np.int64)
    done, least = 0, 0
    while done < n:
        fewest = n
        for i in range(n):
            if graph.place[i] < 0 and degree[i] <= least:
                if start[done] + n > len(row):
                    row = np.concatenate((row, np.empty(len(row), np.int64)))
                start[done + 1] = eliminate(graph, i, done, row, start[done])
                for q in range(start[done], start[done + 1]):
                    degree[row[q]] = meet(graph, row[q], row, len(row)) - 1
                done += 1
            if graph.place[i] < 0:
                fewest = min(fewest, degree[i])
        least = fewest
    return sort_rows(graph.place, start, row)


@compiled
def meet(graph, i, row, end):
    """Write whom i meets, itself included, into row from ``end`` on, as far as it is long. Returns how many.

    All of them bear the newest mark then.
    """
    seen, place = graph.seen, graph.place
    seen[-1] += 1
    mark, count = seen[-1], 0
    seen[i] = mark
    for q in range(graph.begin[i], graph.begin[i] + graph.length[i]):
        e = graph.other[q]
        low, high = (0, 1) if place[e] < 0 else (graph.column[e, 0], graph.column[e, 1])
        for r in range(low, high):
            j = e if place[e] < 0 else row[r]
            if place[j] < 0 and seen[j] != mark:
                seen[j] = mark
                if end + count < len(row):
                    row[end + count] = j
                count += 1
    return count + 1


@compiled
def eliminate(graph, p, done, row, end):
    """Give p its place; its column goes into row from ``end`` on. Returns where it ends."""
    other, place, seen = graph.other, graph.place, graph.seen
    last = end + meet(graph, p, row, end) - 1
    mark, place[p] = seen[-1], done
    graph.column[p, 0], graph.column[p, 1] = end, last
    for q in range(graph.begin[p], graph.begin[p] + graph.length[p]):
        graph.part[other[q]] = place[other[q]] >= 0
    for q in range(end, last):
        i = row[q]
        kept = graph.begin[i]
        for r in range(graph.begin[i], graph.begin[i] + graph.length[i]):
            e = other[r]  # what p's column says already is struck out
            if e != p and not graph.part[e] and not (place[e] < 0 and seen[e] == mark):
                other[kept] = e
                kept += 1
        other[kept] = p
        graph.length[i] = kept + 1 - graph.begin[i]
    return last


@compiled
def neighbours(pairs, n):
    """Whom each body meets: other[begin[i]:begin[i + 1]], without repetitions."""
    count = np.zeros(n + 1, np.int64)
    for q in range(len(pairs)):
        i, j = pairs[q, 0], pairs[q, 1]
        if i >= 0 and j >= 0 and i != j:
            count[i + 1] += 1
            count[j + 1] += 1
    for i in range(n):
        count[i + 1] += count[i]
    other, filled = np.empty(count[n], np.int64), count[:n].copy()
    for q in range(len(pairs)):
        i, j = pairs[q, 0], pairs[q, 1]
        if i >= 0 and j >= 0 and i != j:
            other[filled[i]], other[filled[j]] = j, i
            filled[i] += 1
            filled[j] += 1
    begin, seen, kept = np.zeros(n + 1, np.int64), np.full(n, -1), 0
    for i in range(n):
        for q in range(count[i], count[i + 1]):
            if seen[other[q]] != i:
                seen[other[q]] = i
                other[kept] = other[q]
                kept += 1
        begin[i + 1] = kept
    return begin, other[:kept]


@compiled
def sort_rows(place, start, row):
    """The Pattern with places for bodies and each column's rows ascending: row by row, which sorts them."""
    n = len(place)
    left, blocks = np.zeros(n + 1, np.int64), start[n]
    for q in range(blocks):
        row[q] = place[row[q]]
        left[row[q] + 1] += 1
    for p in range(n):
        left[p + 1] += left[p]
    column, at, filled = np.empty(blocks, np.int64), np.empty(blocks, np.int64), left[:n].copy()
    for p in range(n):
        for q in range(start[p], start[p + 1]):
            column[filled[row[q]]] = p
            filled[row[q]] += 1
    sorted_row, filled = np.empty(blocks, np.int64), start[:n].copy()
    for p in range(n):
        for q in range(left[p], left[p + 1]):
            at[q] = filled[column[q]]
            sorted_row[at[q]] = p
            filled[column[q]] += 1
    return Pattern(place, start, sorted_row, left, column, at)
