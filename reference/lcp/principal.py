"""Principal pivots: row i's two unknowns, λ_i and w_i, only ever change places with each other.

Each row is in one of three places, and a tableau belongs to each choice of them:

    INSIDE   λ_i is basic, w_i = 0         LOWER, UPPER   w_i is basic, λ_i stands at that bound

With y the basic and x the nonbasic unknown of each row, y = T x + q. A method keeps T, x and y; ``swap`` is
the pivot of a row, ``move`` lets a nonbasic unknown go elsewhere and y follow.

Slides S13, S14, S17; lectures/06_pivoting_lcp.md. Source: Cottle, Pang & Stone, The Linear Complementarity
Problem (2009), chapter 4.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart
from .pivoting import INSIDE, LOWER, UPPER
from .tableau import exchange, exchange_pair

TINY = 1e-11  # relative to the largest of a column: a pivot below that is taken for 0
SLACK = 1e-12  # λ and w off by less, relative to the largest λ, are taken for right


class State(NamedTuple):
    """Where a method is, as arrays that its kernel changes in place."""

    T: np.ndarray  # (n, n)
    y: np.ndarray  # (n,) λ_i of the rows INSIDE, w_i of the others
    x: np.ndarray  # (n,) w_i of the rows INSIDE, λ_i of the others
    place: np.ndarray  # (n,) INSIDE, LOWER or UPPER
    lower: np.ndarray
    upper: np.ndarray
    at: np.ndarray  # (3,) the row being driven or −1, pivots since ``saved``, pivots until it is renewed
    saved: np.ndarray  # (n + 1,) where the method was some pivots ago, to notice that it comes back


@compiled_apart
def swap(state, i):
    """The principal pivot of row i: λ_i and w_i change places, and nothing moves."""
    exchange(state.T, i, i)
    state.y[i], state.x[i] = state.x[i], state.y[i]


@compiled_apart
def swap_pair(state, i, j):
    """The principal pivot of rows i and j at once, where T_ii = 0."""
    exchange_pair(state.T, i, j)
    for k in (i, j):
        state.y[k], state.x[k] = state.x[k], state.y[k]


@compiled_apart
def move(state, i, target):
    """Let the nonbasic unknown of row i go to ``target``, and the basic ones follow."""
    Δ = target - state.x[i]
    state.x[i] = target
    if Δ != 0:
        for k in range(len(state.y)):
            state.y[k] += state.T[k, i] * Δ


@compiled
def slack(state):
    """How far λ or w may be off and still count as right."""
    largest = 1.0
    for i in range(len(state.y)):
        largest = max(largest, abs(state.y[i]) if state.place[i] == INSIDE else 0.0)
    return SLACK * largest


@compiled
def wrong(state, i, slack):
    """0 where row i is right; −1 where its λ or w is too small, 1 where it is too large."""
    if state.place[i] == INSIDE:
        low, high = state.lower[i], state.upper[i]
        return -1 if state.y[i] < low - slack else 1 if state.y[i] > high + slack else 0
    if state.lower[i] == state.upper[i]:
        return 0
    if state.y[i] < -slack and not (state.place[i] == UPPER and state.x[i] == state.upper[i]):
        return -1
    if state.y[i] > slack and not (state.place[i] == LOWER and state.x[i] == state.lower[i]):
        return 1
    return 0


@compiled
def tiny_in(T, j):
    """Below this, a number of column j is taken for 0."""
    largest = 0.1
    for i in range(len(T)):
        largest = max(largest, abs(T[i, j]))
    return TINY * largest


@compiled
def standing(state, i):
    """Where row i is, as a number: its place, or 3 where λ_i has never moved from between its bounds."""
    between = state.x[i] != state.lower[i] and state.x[i] != state.upper[i]
    return 3 if between and state.place[i] != INSIDE else state.place[i]


@compiled_apart
def came_back(state, driven):
    """Whether the method has been just here before: Brent's way, which keeps one place to compare with."""
    n = len(state.y)
    same = state.saved[n] == driven
    for i in range(n):
        same = same and state.saved[i] == standing(state, i)
    state.at[1] += 1
    if not same and state.at[1] >= state.at[2]:
        state.at[1], state.at[2] = 0, 2 * state.at[2]
        for i in range(n):
            state.saved[i] = standing(state, i)
        state.saved[n] = driven
    return same
