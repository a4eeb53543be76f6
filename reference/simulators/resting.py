"""What rests costs no solve: islands that the forces of the step before still hold are left out.

An island whose bodies all have velocity 0, and on which the forces of the step before, taken again, leave
nothing to be done (within the solver's tolerance), is solved already: u⁺ = 0, and λ stays. This is looked
up anew in each step, from the state alone. So a push, a ball that arrives, or another force wakes an
island at once, and nothing else is changed by its being left out.

Slides S12; lectures/05_contact.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, compiled_apart, inner
from ..contacts import label_islands, owner
from ..lcp.augmented import ContactRows, dot


class Moving(NamedTuple):
    """The problem without what rests, and without what meets nobody; bodies are numbered anew."""

    rows: ContactRows
    M: np.ndarray
    free: np.ndarray
    λ: np.ndarray
    body: np.ndarray  # which of all bodies each one is
    row: np.ndarray  # which of all rows each one is
    still: np.ndarray  # (n,) of all bodies: 1 where they rest


@compiled_apart
def leave_out_rest(rows, M, before, free, λ, tolerance):
    """The ``Moving`` part. M (n, k, k), before and free (n, k), λ (r,): from the forces before."""
    n, k = before.shape
    label, still = label_islands(rows.bodies, n), np.ones(n)
    find_still(rows, M, before, free, λ, label, still, np.zeros((3, n)), np.zeros((n, k)), tolerance)
    number, body = moving_bodies(rows, still)
    row, block, μ = moving_rows(rows, still)
    bodies = np.full((len(row), 2), -1)
    for r in range(len(row)):
        for side in range(2):
            i = rows.bodies[row[r], side]
            bodies[r, side] = number[i] if i >= 0 else -1
    part = ContactRows(bodies, rows.J[row], rows.c[row], block, μ, rows.lower[row], rows.upper[row])
    return Moving(part, M[body], free[body], λ[row], body, row, still)


@compiled
def moving_bodies(rows, still):
    """A number for each body (n,) that has rows and doesn't rest, else −1; and whose each number is."""
    number, count = np.full(len(still), -1), 0
    for r in range(len(rows.c)):
        for side in range(2):
            i = rows.bodies[r, side]
            if i >= 0 and still[i] == 0 and number[i] < 0:
                number[i], count = 0, count + 1
    body, count = np.empty(count, np.int64), 0
    for i in range(len(still)):
        if number[i] == 0:
            number[i], body[count] = count, i
            count += 1
    return number, body


@compiled
def moving_rows(rows, still):
    """Which rows are of bodies that don't rest; where their blocks begin; and the blocks' μ."""
    blocks, size = 0, 0
    for q in range(len(rows.μ)):
        if still[owner(rows.bodies, rows.block[q])] == 0:
            blocks, size = blocks + 1, size + rows.block[q + 1] - rows.block[q]
    row, block, μ = np.empty(size, np.int64), np.zeros(blocks + 1, np.int64), np.empty(blocks)
    blocks, size = 0, 0
    for q in range(len(rows.μ)):
        if still[owner(rows.bodies, rows.block[q])] > 0:
            continue
        for r in range(rows.block[q], rows.block[q + 1]):
            row[size] = r
            size += 1
        μ[blocks], block[blocks + 1] = rows.μ[q], size
        blocks += 1
    return row, block, μ


@compiled_apart
def put_back(moving, after, λ, free):
    """u⁺ of all bodies from that of the moving ones, and their λ into λ; free (n, k)."""
    whole = free.copy()
    for i in range(len(whole)):
        for a in range(whole.shape[1]):
            whole[i, a] = 0.0 if moving.still[i] > 0 else free[i, a]
    for i in range(len(moving.body)):
        for a in range(whole.shape[1]):
            whole[moving.body[i], a] = after[i, a]
    for r in range(len(moving.row)):
        λ[moving.row[r]] = moving.λ[r]
    return whole


@inner
def find_still(rows, M, before, free, λ, label, still, room, rest, tolerance):
    """still (n,): 1 where an island stays at rest with these λ. room (3, n) and rest (n, k): zeros."""
    n, k = before.shape
    wrong, push, off = room[0], room[1], room[2]
    for q in range(len(rows.μ)):
        if not fits(rows, q, λ):
            wrong[label[owner(rows.bodies, rows.block[q])]] = 1.0
    for r in range(len(λ)):
        for side in range(2):
            i = rows.bodies[r, side]
            if i >= 0:
                for a in range(k):
                    rest[i, a] += rows.J[r, side, a] * λ[r]
    for i in range(n):
        island = label[i]
        for a in range(k):
            if before[i, a] != 0 or not np.isfinite(free[i, a]):
                wrong[island] = 1.0
            push[island] = max(push[island], abs(free[i, a]))
            off[island] = max(off[island], abs(rest[i, a] + dot(M[i, a], free[i])) / M[i, a, a])
    for i in range(n):
        island = label[i]
        if wrong[island] > 0 or off[island] > tolerance * push[island]:
            still[i] = 0.0


@inner
def fits(rows, q, λ):
    """Whether the λ of block q are right for w = c, what is left where nothing moves."""
    first, μ = rows.block[q], rows.μ[q]
    if μ < 0:
        low, high = λ[first] <= rows.lower[first], λ[first] >= rows.upper[first]
        within = rows.lower[first] <= λ[first] <= rows.upper[first]
        return within and (rows.c[first] == 0 or (low and rows.c[first] > 0) or (high and rows.c[first] < 0))
    along = 0.0
    for r in range(first + 1, rows.block[q + 1]):
        along += λ[r] ** 2
    if rows.c[first] > 0:
        return λ[first] == 0 and along == 0
    return rows.c[first] == 0 and λ[first] >= 0 and np.sqrt(along) <= μ * λ[first] * (1 + 1e-12)
