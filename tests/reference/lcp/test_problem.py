"""What a problem takes, and what it refuses, in words that name the argument."""

import numpy as np
import pytest
import scipy.sparse

from reference.factored import Factored
from reference.lcp import LCP, ConeProblem

I2, b2 = np.eye(2), np.ones(2)
BAD_LCP = [
    ({"A": np.ones((2, 3)), "b": b2}, ValueError, "A must be square"),
    ({"A": np.ones(2), "b": b2}, ValueError, "A must be square"),
    ({"A": [[1, 2], [3]], "b": b2}, ValueError, "A must be a square matrix"),
    ({"A": scipy.sparse.csr_array(np.ones((2, 3))), "b": b2}, ValueError, "A must be square"),
    ({"A": "matrix", "b": b2}, TypeError, "A must be a dense array"),
    ({"A": [["a"]], "b": [1]}, TypeError, "A must be an array of numbers"),
    ({"A": 1j * I2, "b": b2}, TypeError, "A must hold real numbers"),
    ({"A": scipy.sparse.csr_array(1j * I2), "b": b2}, TypeError, "A must hold real numbers"),
    ({"A": [[1, np.nan], [0, 1]], "b": b2}, ValueError, "A must hold finite"),
    ({"A": scipy.sparse.csr_array([[np.inf, 0], [0, 1]]), "b": b2}, ValueError, "A must hold finite"),
    ({"A": I2, "b": np.ones(3)}, ValueError, "b must have shape"),
    ({"A": I2, "b": 1.0}, ValueError, "b must have shape"),
    ({"A": I2, "b": [1, np.inf]}, ValueError, "b must hold finite"),
    ({"A": I2, "b": b2, "lower": np.nan}, ValueError, "lower must not hold NaN"),
    ({"A": I2, "b": b2, "upper": [1, np.nan]}, ValueError, "upper must not hold NaN.*row 1"),
    ({"A": I2, "b": b2, "lower": [0, 2], "upper": 1}, ValueError, "lower must be at most upper.*row 1"),
    ({"A": I2, "b": b2, "upper": -1}, ValueError, "lower must be at most upper"),
    ({"A": I2, "b": b2, "lower": np.inf}, ValueError, "lower must leave room"),
    ({"A": I2, "b": b2, "lower": -np.inf, "upper": -np.inf}, ValueError, "upper must leave room"),
    ({"A": I2, "b": b2, "lower": [0, 0, 0]}, ValueError, "lower must be a number or have shape"),
    ({"A": I2, "b": b2, "upper": "high"}, TypeError, "upper must be a number"),
    ({"A": I2, "b": b2, "friction": 3}, TypeError, "friction must be three things"),
    ({"A": I2, "b": b2, "friction": ([1], [0], -0.1)}, ValueError, "mu must be at least 0"),
    ({"A": I2, "b": b2, "friction": ([1], [0], np.nan)}, ValueError, "mu must be a finite number"),
    ({"A": I2, "b": b2, "friction": ([1], [0], [0.1, 0.2])}, ValueError, "mu must have shape"),
    ({"A": I2, "b": b2, "friction": ([1], [2], 0.1)}, ValueError, "normals must be from 0 to 1"),
    ({"A": I2, "b": b2, "friction": ([-1], [0], 0.1)}, ValueError, "rows must be from 0 to 1"),
    ({"A": I2, "b": b2, "friction": ([1], [1], 0.1)}, ValueError, "row 1 is its own normal"),
    ({"A": np.eye(3), "b": np.ones(3), "friction": ([1, 2], [0, 1], 0.1)}, ValueError, "normal of another"),
    ({"A": I2, "b": b2, "friction": ([1, 1], [0, 0], 0.1)}, ValueError, "twice"),
    ({"A": I2, "b": b2, "friction": ([1], [0, 0], 0.1)}, ValueError, "a normal for each row"),
    ({"A": I2, "b": b2, "friction": ([0.5], [0], 0.1)}, TypeError, "whole numbers"),
]
BAD_CONE = [
    ({"A": np.eye(3), "b": np.ones(3), "mu": -1}, ValueError, "mu must be at least 0"),
    ({"A": np.eye(3), "b": np.ones(3), "mu": [np.nan]}, ValueError, "mu must hold finite"),
    ({"A": np.eye(3), "b": np.ones(3), "mu": np.inf}, ValueError, "mu must be a finite"),
    ({"A": np.eye(3), "b": np.ones(3), "mu": [0.5, 0.5]}, ValueError, "b must have blocks"),
    ({"A": np.eye(5), "b": np.ones(5), "mu": 0.5}, ValueError, "b must have blocks"),
    (
        {"A": np.eye(3), "b": np.ones(3), "mu": 0.5, "law": "coulomb"},
        ValueError,
        "law must be one of ccp, ncp",
    ),
    ({"A": np.eye(3), "b": np.ones(3), "mu": 0.5, "dimension": 4}, ValueError, "dimension must be 3"),
    ({"A": np.eye(3), "b": np.ones(3), "mu": 0.5, "dimension": 2}, ValueError, "b must have blocks"),
    ({"A": np.eye(3), "b": np.ones(2), "mu": 0.5}, ValueError, "b must have shape"),
]


@pytest.mark.parametrize(("arguments", "error", "words"), BAD_LCP)
def test_bad_lcp(arguments, error, words):
    with pytest.raises(error, match=words):
        LCP(**arguments)


@pytest.mark.parametrize(("arguments", "error", "words"), BAD_CONE)
def test_bad_cone_problem(arguments, error, words):
    with pytest.raises(error, match=words):
        ConeProblem(**arguments)


@pytest.mark.parametrize(
    "form", [f"{name}_array" for name in ["bsr", "coo", "csc", "csr", "dia", "dok", "lil"]]
)
def test_any_sparse_format(form):
    A = np.array([[2.0, 0, 1], [0, 3, 0], [1, 0, 0]])
    problem = LCP(getattr(scipy.sparse, form)(A), [1, 2, 3])
    assert np.array_equal(problem.A.toarray(), A)
    assert np.array_equal(problem.terms.d, [2, 3, 1])
    assert np.allclose(problem.w(np.array([1, 2, 3])), A @ [1, 2, 3] + [1, 2, 3])


def test_problem_keeps_a_copy():
    A, b = np.eye(2), np.ones(2)
    problem = LCP(A, b)
    A[:], b[:] = 7, 7
    assert np.array_equal(problem.A, np.eye(2)) and np.array_equal(problem.b, np.ones(2))


def test_friction_rows_replace_bounds():
    problem = LCP(np.eye(3), np.ones(3), lower=[0, 1, -1], upper=5, friction=([1], [0], 0.5))
    low, high = problem.bounds([2, 0, 0])
    assert np.array_equal(low, [0, -1, -1]) and np.array_equal(high, [5, 1, 5])
    assert np.array_equal(problem.origin, [0, 0, 0])


@pytest.mark.parametrize(
    ("n", "mu", "dimension", "size"),
    [(6, 0.5, None, 3), (6, 0.5, 2, 2), (4, 0.5, None, 2), (6, [1, 1, 1], None, 2), (6, [1, 1], None, 3),
     (0, 0.5, None, 3), (0, [], None, 3), (3, [0.0], None, 3), (2, [0.0], None, 2)],
)  # fmt: skip
def test_block_size(n, mu, dimension, size):
    problem = ConeProblem(np.eye(n), np.zeros(n), mu, dimension=dimension)
    assert problem.size == size and len(problem.mu) == n // size


def test_no_rows():
    for problem in (LCP(np.zeros((0, 0)), []), LCP([], []), LCP(scipy.sparse.csr_array((0, 0)), [])):
        assert problem.n == 0 and problem.residual([]) == 0
        assert [len(x) for x in problem.bounds([])] == [0, 0]
    empty = Factored(np.zeros((0, 2), int), np.zeros((0, 2, 6)), np.zeros((0, 2, 6)), 3)
    assert LCP(empty, [], friction=([], [], 0.5)).residual([]) == 0
