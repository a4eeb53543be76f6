"""Right answers of exercise 06, and what typical mistakes would answer instead. Grader's side only.

Each function takes a case's values by name, as `v`. The other parameters, with their right values as
defaults, build a mistake in: so a check can say which mistake an answer looks like.
"""

import itertools

import numpy as np

import exercises

given = exercises.part("06_pivoting_lcp", "given")


def values_of(A, b, inside):
    """The basic unknown of each row: λ where it is inside, w elsewhere."""
    lam, w = given.solve(A, b, inside)
    return np.where(inside, lam, w)


def holding_cones(v, heed_w=True, empty=True):
    """How many of the 2ⁿ choices solve it."""
    count = 0
    for choice in itertools.product([False, True], repeat=len(v["b"])):
        inside = np.array(choice)
        lam, w = given.solve(v["A"], v["b"], inside)
        good = lam.min() >= -given.SLACK and (not heed_w or w.min() >= -given.SLACK)
        count += good and (empty or inside.any())
    return int(count)


def block_pivot(v, constant=-1, beside=-1):
    """Factors on the signs of the constants and of the rows pivoted."""
    T, q, rows = v["T"], v["q"], v["rows"]
    a, o = rows, np.setdiff1d(np.arange(len(q)), rows)
    inverse, new_T, new_q = np.linalg.inv(T[np.ix_(a, a)]), np.empty_like(T), np.empty_like(q)
    new_T[np.ix_(a, a)] = inverse
    new_T[np.ix_(a, o)] = beside * inverse @ T[np.ix_(a, o)]
    new_T[np.ix_(o, a)] = T[np.ix_(o, a)] @ inverse
    new_T[np.ix_(o, o)] = T[np.ix_(o, o)] + beside * T[np.ix_(o, a)] @ inverse @ T[np.ix_(a, o)]
    new_q[a] = constant * inverse @ q[a]
    new_q[o] = q[o] + constant * T[np.ix_(o, a)] @ inverse @ q[a]
    return new_T, new_q


def proves(v, sign=True, transposed=True, strict=True):
    """(word, Aᵀ y): which of the three conditions are looked at, and how."""
    A, b, y = v["A"], v["b"], v["y"]
    force = A.T @ y if transposed else A @ y
    ahead = y @ b < -given.SLACK if strict else y @ b <= given.SLACK
    holds = (not sign or y.min() >= -given.SLACK) and force.max() <= given.SLACK and ahead
    return ("proof" if holds else "no proof"), force


def by_rule(v, pick, count=0):
    """Pivot the row that the rule picks until none is wrong, at most `most` times: (λ, pivots)."""
    inside, pivots = np.zeros(len(v["b"]), dtype=bool), 0
    while True:
        y = values_of(v["A"], v["b"], inside)
        if y.min() >= -given.SLACK or pivots == v["most"]:
            return np.where(inside, y, 0.0), pivots + count
        i = pick(y)
        inside[i] = not inside[i]
        pivots += 1


def bard(v, count=0):
    return by_rule(v, lambda y: int(y.argmin()), count)


def least_index(v):
    return by_rule(v, lambda y: int(np.argmax(y < -given.SLACK)))


def all_at_once(v, alone=False):
    """(status, rounds, λ) of pivoting all wrong rows at once, or the first alone."""
    inside, seen, rounds = np.zeros(len(v["b"]), dtype=bool), set(), 0
    while True:
        y = values_of(v["A"], v["b"], inside)
        wrong = y < -given.SLACK
        if not wrong.any() or tuple(inside) in seen:
            return "cycle" if wrong.any() else "solved", rounds, np.where(inside, y, 0.0)
        seen.add(tuple(inside))
        if alone:
            wrong &= np.arange(len(y)) == np.argmax(wrong)
        inside = inside ^ wrong
        rounds += 1


def safeguarded(v, last=True, reset=True):
    """(λ, rounds): all wrong rows at once while that gets better, else one of them alone."""
    n, patience = len(v["b"]), v["patience"]
    inside, fewest, left, rounds = np.zeros(n, dtype=bool), n + 1, patience, 0
    while rounds < 1000:
        y = values_of(v["A"], v["b"], inside)
        wrong = np.flatnonzero(y < -given.SLACK)
        if not len(wrong):
            return np.where(inside, y, 0.0), rounds
        if len(wrong) < fewest:
            fewest, left = len(wrong), patience if reset else left
        elif left > 0:
            left -= 1
        else:
            wrong = wrong[-1:] if last else wrong[:1]
        inside[wrong] = ~inside[wrong]
        rounds += 1
    return np.where(inside, y, 0.0), rounds
