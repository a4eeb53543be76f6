# Solution b of exercise 06: a tableau is kept, and pivoted row by row.

# %%
import numpy as np

from exercises import load

given, check = load("06")


# %%
def one_pivot(table, r):
    """The principal pivot of row r of the table (T | q), as a new table."""
    new = table - np.outer(table[:, r] / table[r, r], table[r])
    new[:, r] = table[:, r] / table[r, r]
    new[r] = -table[r] / table[r, r]
    new[r, r] = 1 / table[r, r]
    return new


def pivots_of(table, rows):
    """Several rows pivoted one after the other, each time the one with the largest pivot."""
    rows = list(rows)
    while rows:
        r = max(rows, key=lambda i: abs(table[i, i]))
        rows.remove(r)
        table = one_pivot(table, r)
    return table


def start(A, b):
    return np.column_stack([A, b])


# %%
def holding_cones(A, b):
    n, count = len(b), 0
    for code in range(2**n):
        alpha = [i for i in range(n) if code >> i & 1]
        columns = np.eye(n)
        columns[:, alpha] = -A[:, alpha]
        weights = np.linalg.solve(columns, b)
        count += int(np.all(weights >= -given.SLACK))
    return count


# %%
def block_pivot(T, q, rows):
    n = len(q)
    # y = T x + q as (1, −T) (y, x) = q: take other columns for the basis
    swap = np.zeros(n, dtype=bool)
    swap[rows] = True
    basis, beside = np.where(swap, -T, np.eye(n)), np.where(swap, np.eye(n), -T)
    return -np.linalg.solve(basis, beside), np.linalg.solve(basis, q)


# %%
def proves(A, b, y):
    n = len(b)
    columns = np.array([sum(y[i] * A[i, j] for i in range(n)) for j in range(n)])
    if any(y[j] < -given.SLACK or columns[j] > given.SLACK for j in range(n)):
        return "no proof", columns
    return "proof" if np.dot(y, b) < -given.SLACK else "no proof", columns


# %%
def bard(A, b, most):
    table, inside = start(A, b), np.zeros(len(b), dtype=bool)
    for pivots in range(most + 1):
        lowest = int(np.argmin(table[:, -1]))
        if table[lowest, -1] >= -given.SLACK or pivots == most:
            break
        table = one_pivot(table, lowest)
        inside[lowest] ^= True
    return table[:, -1] * inside, pivots


# %%
def all_at_once(A, b):
    table, inside, seen = start(A, b), np.zeros(len(b), dtype=bool), []
    while True:
        wrong = table[:, -1] < -given.SLACK
        again = any(np.array_equal(inside, other) for other in seen)
        if again or not wrong.any():
            return ("cycle" if wrong.any() else "solved"), len(seen), table[:, -1] * inside
        seen.append(inside)
        table, inside = pivots_of(table, np.flatnonzero(wrong)), inside != wrong


# %%
def safeguarded(A, b, patience):
    table, inside = start(A, b), np.zeros(len(b), dtype=bool)
    best, left, rounds = len(b) + 1, patience, 0
    while True:
        wrong = [i for i in range(len(b)) if table[i, -1] < -given.SLACK]
        if not wrong:
            return table[:, -1] * inside, rounds
        if len(wrong) < best:
            best, left = len(wrong), patience
        elif left:
            left -= 1
        else:
            wrong = [wrong[-1]]
        table, rounds = pivots_of(table, wrong), rounds + 1
        inside[wrong] = ~inside[wrong]
