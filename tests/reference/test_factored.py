"""The operator J M⁻¹ Jᵀ against matrices multiplied out by NumPy."""

import numpy as np
import pytest
import scipy.sparse

from reference.compiled import plain
from reference.factored import Factored, add_rows, multiply


def spelled_out(bodies, J, count):
    """J as a dense matrix (m, count k), filled number by number."""
    m, s, k = J.shape
    full = np.zeros((m, count * k))
    for i in range(m):
        for side in range(s):
            if bodies[i, side] >= 0:
                full[i, bodies[i, side] * k : (bodies[i, side] + 1) * k] += J[i, side]
    return full


def some_rows(seed, k=6, m=9, count=4):
    """Rows with the world, rows that name one body twice, and a mass matrix that is no diagonal."""
    random = np.random.default_rng(seed)
    bodies = random.integers(-1, count, (m, 2))
    bodies[0] = (2, 2)
    J = random.normal(size=(m, 2, k))
    inverse = np.zeros((count * k, count * k))
    for i in range(count):
        G = random.normal(size=(k, k))
        inverse[i * k : i * k + k, i * k : i * k + k] = G @ G.T + np.eye(k)
    B = np.zeros_like(J)
    for i in range(m):
        for side in range(2):
            body = bodies[i, side]
            if body >= 0:
                B[i, side] = J[i, side] @ inverse[body * k : body * k + k, body * k : body * k + k]
    softness = random.random(m)
    full = spelled_out(bodies, J, count)
    return Factored(bodies, J, B, count, softness), full @ inverse @ full.T + np.diag(softness), random


@pytest.mark.parametrize("k", [1, 3, 6])
@pytest.mark.parametrize("seed", range(5))
def test_equals_the_matrix(seed, k):
    A, dense, random = some_rows(seed, k)
    λ = random.normal(size=len(dense))
    assert A.shape == dense.shape
    assert np.allclose(A @ λ, dense @ λ, rtol=1e-12, atol=1e-12)
    assert np.allclose(A.diagonal(), np.diag(dense), rtol=1e-12)
    assert np.allclose(A.toarray(), dense, rtol=1e-12, atol=1e-12)
    assert np.allclose(A.tosparse().toarray(), dense, rtol=1e-12, atol=1e-12)
    assert np.allclose(A.row_peaks(np.array([0, 4])), np.abs(dense[[0, 4]]).max(axis=1), rtol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_from_matrices(seed):
    random = np.random.default_rng(seed)
    J = random.normal(size=(5, 7)) * (random.random((5, 7)) < 0.4)
    G = random.normal(size=(7, 7)) * (random.random((7, 7)) < 0.3)
    for inverse, full in ((1 + np.abs(G[0]), np.diag(1 + np.abs(G[0]))), (G @ G.T, G @ G.T)):
        for J_given in (J, scipy.sparse.coo_array(J)):
            A = Factored.from_matrices(J_given, inverse)
            assert np.allclose(A.toarray(), J @ full @ J.T, rtol=1e-12, atol=1e-12)
            λ = random.normal(size=5)
            assert np.allclose(A @ λ, J @ full @ J.T @ λ, rtol=1e-12, atol=1e-12)
    assert np.allclose(Factored.from_matrices(J, scipy.sparse.csr_array(full)).toarray(), J @ full @ J.T)


def test_no_rows_and_no_bodies():
    assert (Factored.from_matrices(np.zeros((0, 4)), np.ones(4)) @ np.zeros(0)).shape == (0,)
    assert np.array_equal(Factored.from_matrices(np.zeros((2, 0)), np.ones(0)).toarray(), np.zeros((2, 2)))


def test_compiled_equals_plain():
    A, _, random = some_rows(3)
    λ, results = random.normal(size=9), []
    for f, g in ((add_rows, multiply), (plain(add_rows), plain(multiply))):
        u, out = np.zeros((4, 6)), np.empty(9)
        f(A.bodies, A.B, λ, u)
        g(A.bodies, A.J, A.softness, λ, u, out)
        results.append(out)
    assert np.allclose(*results, rtol=1e-12, atol=1e-14)


J1 = np.ones((1, 2, 3))


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        (([[0, 2]], J1, J1, 2), ValueError, "bodies must be numbers of bodies, 0 to 1"),
        (([[-2, 0]], J1, J1, 2), ValueError, "bodies must be numbers of bodies"),
        (([[0.5, 0]], J1, J1, 2), TypeError, "bodies must be an array"),
        (([[0, 1]], J1[0], J1, 2), ValueError, "J must have shape"),
        (([[0, 1]], J1, J1[:, :, :2], 2), ValueError, "B must have shape"),
        (([[0, 1]], J1 * np.nan, J1, 2), ValueError, "J must hold finite"),
        (([[0, 1]], J1, J1, 2, [-1]), ValueError, "softness must be at least 0"),
        (([[0, 1]], J1, J1, 2, [1, 1]), ValueError, "softness must have shape"),
        (([[0, 1]], J1, J1, -1), ValueError, "count must be a whole number"),
    ],
)
def test_bad_input(arguments, error, words):
    with pytest.raises(error, match=words):
        Factored(*arguments)


@pytest.mark.parametrize(
    ("J", "inverse", "words"),
    [
        (np.ones(3), np.ones(3), "J must be a matrix"),
        (np.ones((2, 3)), np.ones(2), "mass_inverse must have shape"),
        (np.ones((2, 3)), np.eye(2), "mass_inverse must have shape"),
        (np.ones((2, 2)), [[1, 2], [0, 1]], "mass_inverse must be symmetric"),
        (scipy.sparse.csr_array([[np.nan, 1]]), np.ones(2), "J must hold finite"),
    ],
)
def test_bad_matrices(J, inverse, words):
    with pytest.raises(ValueError, match=words):
        Factored.from_matrices(J, inverse)


def test_bad_λ():
    with pytest.raises(ValueError, match="needs λ of shape"):
        Factored([[0, 1]], J1, J1, 2) @ np.ones(2)
