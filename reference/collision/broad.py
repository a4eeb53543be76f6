"""The broad phase: which pairs of bounding boxes overlap, in a time that grows as the number of solids does.

A hierarchy of grids. Each solid lies in one cell of the grid whose cells are two to four times as wide as it
is, and looks for others in its own grid and in all coarser ones: there at most a few cells can hold what it
overlaps. So pebbles and boulders mix freely, and every pair is found once. The cells are kept in a hash
table. Planes are without end: each is tried with all solids.

Slides S10; lectures/05_contact.md. Source: Ericson, Real-Time Collision Detection (2005), section 7.2.
"""

import math
from typing import NamedTuple

import numpy as np

from ..compiled import inner
from .solids import PLANE

_FEW = 24  # so few solids are tried each with each
_LEVELS = 64  # sizes from 2⁻³² to 2³⁰ m
_NONE, _ENDLESS = -1, -2  # levels of what is not finite, and meets nobody, and of what is tried with all


class Grid(NamedTuple):
    """Room for the broad phase of s solids."""

    level: np.ndarray  # (s,) int, or _NONE, _ENDLESS
    cell: np.ndarray  # (s, d) int, its cell in its grid
    head: np.ndarray  # (buckets + 1,) int: a bucket's solids are member[head[b]] … member[head[b + 1]]
    member: np.ndarray  # (s,) int
    half: np.ndarray  # (levels,) the largest half extent in a grid; 0: an empty grid
    start: np.ndarray  # (s + 1,) int, for sorting


def make_grid(s, d):
    """A ``Grid`` for s solids in d dimensions."""
    buckets = 1 << max(2 * s - 1, 1).bit_length()
    return Grid(
        level=np.full(s, -1),
        cell=np.zeros((s, d), dtype=int),
        head=np.zeros(buckets + 1, dtype=int),
        member=np.zeros(s, dtype=int),
        half=np.zeros(_LEVELS),
        start=np.zeros(s + 1, dtype=int),
    )


@inner
def find_pairs(solids, grid, pairs, spare):
    """Fill pairs (capacity, 2) with solids a < b that may touch and whose bounding boxes overlap, sorted.

    Returns how many there are; if more than the capacity, ``pairs`` is not to be used. spare: like pairs.
    """
    found, s = 0, len(solids.kind)
    if s <= _FEW:
        for a in range(s):
            for b in range(a + 1, s):
                found = note(solids, a, b, pairs, found)
        return found
    fill(solids, grid)
    for a in range(s):
        if grid.level[a] == _ENDLESS:
            for b in range(s):
                if grid.level[b] != _ENDLESS or a < b:
                    found = note(solids, a, b, spare, found)
        elif grid.level[a] >= 0:
            found = look_around(solids, grid, a, spare, found)
    if found <= len(pairs):
        sort_pairs(spare, found, pairs, grid.start)
    return found


@inner
def note(solids, a, b, pairs, found):
    """Write the pair, lower number first, if it counts and there is room; returns how many count so far."""
    if not (overlap(solids, a, b) and may_touch(solids, min(a, b), max(a, b))):
        return found
    if found < len(pairs):
        pairs[found, 0], pairs[found, 1] = min(a, b), max(a, b)
    return found + 1


@inner
def overlap(solids, a, b):
    """Whether the bounding boxes overlap, and the centre is near enough to what is a plane.

    A solid doesn't overlap itself, nor does what is not finite.
    """
    for k in range(solids.low.shape[1]):
        if not (solids.low[a, k] <= solids.high[b, k] and solids.low[b, k] <= solids.high[a, k]):
            return False
    if solids.kind[a] == PLANE:
        return a != b and near_plane(solids, a, b)
    if solids.kind[b] == PLANE:
        return near_plane(solids, b, a)
    return a != b


@inner
def near_plane(solids, a, b):
    """Whether the ball that holds solid b, grown by the reach of both, comes to the plane a."""
    height = 0.0
    for k in range(solids.form.x.shape[1]):
        height += (solids.form.x[b, k] - solids.form.x[a, k]) * solids.form.axes[a, 0, k]
    return height <= solids.form.radius[b] + solids.reach[a] + solids.reach[b]


@inner
def may_touch(solids, a, b):
    """Whether a < b may touch: one of them moves, they are not of one group, and nobody has ruled it out."""
    if solids.slot[a] < 0 and solids.slot[b] < 0:
        return False
    if solids.group[a] >= 0 and solids.group[a] == solids.group[b]:
        return False
    return len(solids.apart) == 0 or row_of(solids.apart, a * len(solids.kind) + b) < 0


@inner
def row_of(keys, key):
    """Where a key stands in a sorted array; −1 where it doesn't."""
    low, high = 0, len(keys)
    while low < high:
        middle = (low + high) // 2
        if keys[middle] < key:
            low = middle + 1
        else:
            high = middle
    return low if low < len(keys) and keys[low] == key else -1


@inner
def width(level):
    """Of the cells of a grid, m."""
    return 2.0 ** (level - _LEVELS // 2 + 2)


@inner
def fill(solids, grid):
    """Put each solid into a cell, and the cells into the hash table."""
    s, d = grid.cell.shape
    grid.head[:] = 0
    grid.half[:] = 0
    for a in range(s):
        grid.level[a] = level = choose_level(solids, a)
        if level >= 0:
            for k in range(d):
                middle = 0.5 * (solids.low[a, k] + solids.high[a, k])
                grid.cell[a, k] = math.floor(middle / width(level))
                grid.half[level] = max(grid.half[level], solids.high[a, k] - middle)
            grid.head[bucket_of(grid, a)] += 1
    total = 0
    for b in range(len(grid.head)):
        total += grid.head[b]
        grid.head[b] = total
    for a in range(s - 1, -1, -1):
        if grid.level[a] >= 0:
            b = bucket_of(grid, a)
            grid.head[b] -= 1
            grid.member[grid.head[b]] = a


@inner
def choose_level(solids, a):
    """The grid whose cells are two to four times as wide as the solid; else ``_NONE`` or ``_ENDLESS``."""
    if solids.kind[a] == PLANE:
        return _ENDLESS
    extent, farthest = 0.0, 0.0
    for k in range(solids.low.shape[1]):
        low, high = solids.low[a, k], solids.high[a, k]
        if not (abs(low) < np.inf and abs(high) < np.inf):
            return _NONE
        extent, farthest = max(extent, high - low), max(farthest, abs(low), abs(high))
    if extent >= 2.0**30:
        return _ENDLESS
    level = max(math.frexp(extent)[1] + _LEVELS // 2 - 1, 0)  # frexp: 2ᵏ⁻¹ ≤ extent < 2ᵏ
    return level if farthest < 2.0**50 * width(level) else _ENDLESS


@inner
def bucket_of(grid, a):
    """The bucket of the cell in which a solid lies."""
    z = grid.cell[a, 2] if grid.cell.shape[1] == 3 else 0
    return bucket(grid, grid.level[a], grid.cell[a, 0], grid.cell[a, 1], z)


@inner
def bucket(grid, level, x, y, z):
    """The bucket of a cell: its numbers, each times a large prime, mixed."""
    mixed = x * 73856093 ^ y * 19349663 ^ z * 83492791 ^ level * 15485863
    mixed ^= mixed >> 15
    return mixed & (len(grid.head) - 2)


@inner
def look_around(solids, grid, a, pairs, found):
    """Note each pair of a and a solid in its own grid with a higher number, or in a coarser grid."""
    space = grid.cell.shape[1] == 3
    for level in range(grid.level[a], len(grid.half)):
        half, w = grid.half[level], width(level)
        if half == 0:
            continue
        low, high = solids.low, solids.high
        x_low, x_high = math.floor((low[a, 0] - half) / w), math.floor((high[a, 0] + half) / w)
        y_low, y_high = math.floor((low[a, 1] - half) / w), math.floor((high[a, 1] + half) / w)
        z_low, z_high = 0, 0
        if space:
            z_low, z_high = math.floor((low[a, 2] - half) / w), math.floor((high[a, 2] + half) / w)
        for x in range(x_low, x_high + 1):
            for y in range(y_low, y_high + 1):
                for z in range(z_low, z_high + 1):
                    key = bucket(grid, level, x, y, z)
                    for k in range(grid.head[key], grid.head[key + 1]):
                        b = grid.member[k]
                        if b < a and grid.level[b] == grid.level[a]:
                            continue
                        if grid.level[b] != level or grid.cell[b, 0] != x or grid.cell[b, 1] != y:
                            continue
                        if space and grid.cell[b, 2] != z:
                            continue
                        found = note(solids, a, b, pairs, found)
    return found


@inner
def sort_pairs(pairs, found, into, start):
    """Sort by the first solid, then the second: a counting sort, and an insertion sort of each short row."""
    start[:] = 0
    for p in range(found):
        start[pairs[p, 0] + 1] += 1
    for a in range(1, len(start)):
        start[a] += start[a - 1]
    for p in range(found):
        a, b = pairs[p, 0], pairs[p, 1]
        into[start[a], 0], into[start[a], 1] = a, b
        start[a] += 1
    for p in range(1, found):
        a, b, row = into[p, 0], into[p, 1], p
        while row > 0 and into[row - 1, 0] == a and into[row - 1, 1] > b:
            into[row, 1] = into[row - 1, 1]
            row -= 1
        into[row, 1] = b
