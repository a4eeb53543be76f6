"""The factors of a sparse matrix of blocks, against NumPy's solution; the order, against what is known."""

import numpy as np
import pytest

from reference.compiled import compiled
from reference.lcp.block_lu import add_block, clear, factorise, make_block_factor, solve
from reference.lcp.body_order import find_pattern


@compiled
def empty(pairs, n, k):
    """A factor of zeros. What is compiled without a door to Python is called by a compiled function."""
    factor = make_block_factor(pairs, n, k)
    clear(factor)
    return factor


@compiled
def add(factor, i, j, row, column, weight):
    add_block(factor, i, j, row, column, weight)


@compiled
def factorise_and_solve(factor, symmetric, x, out):
    good = factorise(factor, symmetric)
    if good:
        solve(factor, x, out)
    return good


def random_pairs(random, n, m):
    """m pairs of n bodies, some of them with the world (−1), some more than once."""
    pairs = random.integers(-1, n, size=(m, 2))
    return pairs[pairs[:, 0] != pairs[:, 1]]


def filled(n, pairs):
    """For each column in the order found: the rows that dense elimination fills, by the definition."""
    pattern = find_pattern(pairs, n)
    there = np.eye(n, dtype=bool)
    for i, j in pairs:
        if min(i, j) >= 0:
            p, q = pattern.place[i], pattern.place[j]
            there[p, q] = there[q, p] = True
    for p in range(n):
        met = np.flatnonzero(there[p + 1 :, p]) + p + 1
        there[np.ix_(met, met)] = True
    return pattern, [np.flatnonzero(there[p + 1 :, p]) + p + 1 for p in range(n)]


@pytest.mark.parametrize("seed", range(8))
def test_the_pattern_is_what_elimination_fills(seed):
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 30))
    pattern, columns = filled(n, random_pairs(random, n, 2 * n))
    assert sorted(pattern.place) == list(range(n))
    for p, rows in enumerate(columns):
        assert np.array_equal(pattern.row[pattern.start[p] : pattern.start[p + 1]], rows)
    for p in range(n):
        for q in range(pattern.left[p], pattern.left[p + 1]):
            assert pattern.row[pattern.at[q]] == p
            assert pattern.start[pattern.column[q]] <= pattern.at[q] < pattern.start[pattern.column[q] + 1]


def test_a_chain_and_a_tree_are_not_filled_and_a_grid_little():
    chain = np.array([(i, i + 1) for i in range(99)])
    star = np.array([(0, i) for i in range(1, 100)])
    assert len(find_pattern(chain, 100).row) == len(find_pattern(star, 100).row) == 99
    grid = [(i, i + 30) for i in range(870)] + [(i, i + 1) for i in range(900) if i % 30 < 29]
    blocks = len(find_pattern(np.array(grid), 900).row)
    assert 1740 <= blocks < 900 * 30 / 2  # half of what a band of 30 would hold, for 1740 that are there


@pytest.mark.parametrize("k", [3, 6])
@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_the_factors_solve_what_numpy_solves(seed, symmetric, k):
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 15))
    pairs = random_pairs(random, n, 3 * n)
    factor, whole = empty(pairs, n, k), np.zeros((n, k, n, k))
    for p, i in enumerate(factor.pattern.place):
        factor.diagonal[i] = whole[p, :, p] = np.eye(k)
    for pair in pairs:
        rows, columns = random.normal(size=(2, 2, k))
        columns = rows if symmetric else columns
        for a in range(2):
            for b in range(2):
                if pair[a] >= 0 and pair[b] >= 0:
                    add(factor, pair[a], pair[b], rows[a], columns[b], 0.1)
                    whole[pair[a], :, pair[b]] += 0.1 * np.outer(rows[a], columns[b])
    x, found = random.normal(size=(n, k)), np.zeros((n, k))
    assert factorise_and_solve(factor, symmetric, x, found)
    expected = np.linalg.solve(whole.reshape(n * k, n * k), x.ravel())
    np.testing.assert_allclose(found.ravel(), expected, rtol=1e-9, atol=1e-11)


def test_a_pivot_of_0_is_told():
    factor = empty(np.array([(0, 1)]), 2, 3)
    factor.diagonal[0] = np.eye(3)
    assert not factorise_and_solve(factor, False, np.ones((2, 3)), np.ones((2, 3)))
