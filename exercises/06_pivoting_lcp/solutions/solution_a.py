# Solution a of exercise 06: each choice solved afresh, by given.solve.

# %%
import itertools

import numpy as np

from exercises import load

given, check = load("06")


# %%
def holding_cones(A, b):
    """The number of complementary cones in which b lies."""
    count = 0
    for inside in itertools.product([False, True], repeat=len(b)):
        lam, w = given.solve(A, b, np.array(inside))
        count += min(lam.min(), w.min()) >= -given.SLACK
    return int(count)


# %%
def block_pivot(T, q, rows):
    """The principal pivot of several rows at once."""
    a, o = rows, np.setdiff1d(np.arange(len(q)), rows)
    new_T, new_q, inverse = np.empty_like(T), np.empty_like(q), np.linalg.inv(T[np.ix_(a, a)])
    new_T[np.ix_(a, a)] = inverse
    new_T[np.ix_(a, o)] = -inverse @ T[np.ix_(a, o)]
    new_T[np.ix_(o, a)] = T[np.ix_(o, a)] @ inverse
    new_T[np.ix_(o, o)] = T[np.ix_(o, o)] - T[np.ix_(o, a)] @ inverse @ T[np.ix_(a, o)]
    new_q[a] = -inverse @ q[a]
    new_q[o] = q[o] - T[np.ix_(o, a)] @ inverse @ q[a]
    return new_T, new_q


# %%
def proves(A, b, y):
    """Whether y proves that the problem has no solution."""
    force = A.T @ y
    holds = y.min() >= -given.SLACK and force.max() <= given.SLACK and y @ b < -given.SLACK
    return ("proof" if holds else "no proof"), force


# %%
def basic(A, b, inside):
    """The basic unknown of each row."""
    lam, w = given.solve(A, b, inside)
    return np.where(inside, lam, w)


def bard(A, b, most):
    """λ and the number of pivots by Bard's rule."""
    inside, pivots = np.zeros(len(b), dtype=bool), 0
    y = basic(A, b, inside)
    while y.min() < -given.SLACK and pivots < most:
        i = y.argmin()
        inside[i] = not inside[i]
        pivots += 1
        y = basic(A, b, inside)
    return np.where(inside, y, 0.0), pivots


# %%
def all_at_once(A, b):
    """Whether it is solved, the rounds, and λ of the choice where it stops."""
    inside, seen, rounds = np.zeros(len(b), dtype=bool), set(), 0
    y = basic(A, b, inside)
    while y.min() < -given.SLACK and inside.tobytes() not in seen:
        seen.add(inside.tobytes())
        inside = inside ^ (y < -given.SLACK)
        rounds += 1
        y = basic(A, b, inside)
    return "cycle" if y.min() < -given.SLACK else "solved", rounds, np.where(inside, y, 0.0)


# %%
def safeguarded(A, b, patience):
    """λ and the rounds of pivoting all wrong rows at once, with one alone where that doesn't get better."""
    inside, fewest, left, rounds = np.zeros(len(b), dtype=bool), len(b) + 1, patience, 0
    while True:
        y = basic(A, b, inside)
        wrong = np.flatnonzero(y < -given.SLACK)
        if len(wrong) == 0:
            return np.where(inside, y, 0.0), rounds
        if len(wrong) < fewest:
            fewest, left = len(wrong), patience
        elif left > 0:
            left -= 1
        else:
            wrong = wrong[-1:]
        inside[wrong] = ~inside[wrong]
        rounds += 1
