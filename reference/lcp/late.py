"""Exchanges done late: four in one pass over the tableau, which costs little more than one.

An exchange is a sum: the tableau with row r and column s emptied, plus f gᵀ, where f is the old column s,
with 1 in row r, and g the new row r. To choose the next pivot takes one column and the constants, not all of
it. So such products are kept apart until there are four, f_0 g_0ᵀ + … + f_3 g_3ᵀ = Fᵀ G, and then T + Fᵀ G
is computed at once. What counts is how often T goes through memory, not the sums: at n = 100 a pivot takes
half as long this way.

Slides S13; lectures/06_pivoting_lcp.md. Source: after the delayed updates of Demmel, Applied Numerical Linear
Algebra (1997), section 2.6.
"""

import numpy as np

from ..compiled import compiled, compiled_apart

TOGETHER = 4  # rows of F and G
DOUBT = 1e-9  # much more than rounding: then it takes a closer look


@compiled
def read_column(T, F, G, late, j, out):
    """Fill out (m,) with column j of T + Fᵀ G, of which the first ``late`` rows are in use."""
    for i in range(len(out)):
        out[i] = T[i, j]
    for k in range(late):
        for i in range(len(out)):
            out[i] += F[k, i] * G[k, j]


@compiled_apart
def settle(T, F, G, late):
    """T + Fᵀ G put into T: nothing is late any more."""
    for k in range(late):
        for i in range(len(T)):
            for j in range(T.shape[1]):
                T[i, j] += F[k, i] * G[k, j]


@compiled_apart
def settle_four(T, F, G):
    """The same with all four, in one pass, and two rows of T at once, for which G is read once."""
    m = len(T)
    for i in range(m // 2):
        f_0, f_1, f_2, f_3 = F[0, 2 * i], F[1, 2 * i], F[2, 2 * i], F[3, 2 * i]
        h_0, h_1, h_2, h_3 = F[0, 2 * i + 1], F[1, 2 * i + 1], F[2, 2 * i + 1], F[3, 2 * i + 1]
        for j in range(T.shape[1]):
            g_0, g_1, g_2, g_3 = G[0, j], G[1, j], G[2, j], G[3, j]
            T[2 * i, j] += (f_0 * g_0 + f_1 * g_1) + (f_2 * g_2 + f_3 * g_3)
            T[2 * i + 1, j] += (h_0 * g_0 + h_1 * g_1) + (h_2 * g_2 + h_3 * g_3)
    settle(T[2 * (m // 2) :], F[:, 2 * (m // 2) :], G, TOGETHER)  # where m is odd


@compiled_apart
def exchange_late(T, F, G, late, r, s, column):
    """What ``tableau.exchange`` does to T + Fᵀ G; returns how many rows of F and G are in use then.

    T (m, k), F (4, m), G (4, k): changed in place. column (m,): column s of T + Fᵀ G.
    """
    inverse, g = 1.0 / column[r], G[late]
    for j in range(len(g)):
        g[j] = T[r, j]
        T[r, j] = 0.0
    for k in range(late):
        f = F[k, r]
        for j in range(len(g)):
            g[j] += f * G[k, j]
        F[k, r] = G[k, s] = 0.0
    for i in range(len(column)):
        F[late, i] = column[i]
        T[i, s] = 0.0
    for j in range(len(g)):
        g[j] *= -inverse
    F[late, r], g[s] = 1.0, inverse
    if late + 1 < TOGETHER:
        return late + 1
    settle_four(T, F, G)
    return 0


@compiled
def clear_row(slope, value):
    """The row whose value (m,) is the first to become 0, falling by slope (m,), where that is beyond doubt.

    −1 where none does, m where two may at once, or nearly.
    """
    row, least, largest, top = -1, np.inf, 0.0, 0.0
    for i in range(len(value)):
        largest, top = max(largest, abs(slope[i])), max(top, abs(value[i]))
        if slope[i] < 0 and max(value[i], 0.0) < -slope[i] * least:
            row, least = i, max(value[i], 0.0) / -slope[i]
    if row < 0:
        return row
    for i in range(len(value)):
        if i != row and slope[i] < 0 and value[i] + slope[i] * least <= DOUBT * top:
            return len(value)
    return row if slope[row] < -DOUBT * largest else len(value)
