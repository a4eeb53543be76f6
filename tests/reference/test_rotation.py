"""Quaternions against SciPy's Rotation, and against finite differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from reference import rotation
from reference.compiled import plain
from reference.rotation import over_arrays

RANDOM = np.random.default_rng(1)
Q = RANDOM.normal(size=(50, 4))
Q /= np.linalg.norm(Q, axis=1, keepdims=True)
P = np.roll(Q, 1, axis=0)
R = RANDOM.normal(size=(50, 3))
numbers = st.floats(-1e3, 1e3, allow_subnormal=False)


def scipy_rotation(q):
    return Rotation.from_quat(q, scalar_first=True)


def test_product_conjugate_and_rotation_are_scipys():
    product = over_arrays(rotation.multiply)(P, Q)
    assert (
        np.abs(
            (scipy_rotation(P) * scipy_rotation(Q)).as_matrix() - scipy_rotation(product).as_matrix()
        ).max()
        < 1e-14
    )
    assert np.abs(over_arrays(rotation.rotate)(Q, R) - scipy_rotation(Q).apply(R)).max() < 1e-14
    back = [plain(rotation.rotate_back)(q, r) for q, r in zip(Q, R, strict=True)]
    assert np.abs(back - scipy_rotation(Q).inv().apply(R)).max() < 1e-14
    assert np.abs(rotation.rotation_matrix(Q) - scipy_rotation(Q).as_matrix()).max() < 1e-14


def test_matrix_and_back():
    for q in [*Q, (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)]:
        again = rotation.quaternion_of_matrix(rotation.rotation_matrix(q))
        assert again[0] >= 0 and min(np.abs(again - q).max(), np.abs(again + q).max()) < 1e-14


@given(st.tuples(numbers, numbers, numbers))
def test_exponential_is_scipys_and_has_norm_one(φ):
    q = np.array(plain(rotation.exponential)(φ))
    assert abs(np.linalg.norm(q) - 1) < 1e-15 * 4
    error = rotation.rotation_angle(q, Rotation.from_rotvec(φ).as_quat(scalar_first=True))
    assert error < 1e-15 * (10 + np.linalg.norm(φ))


@pytest.mark.parametrize("size", [0, 1e-300, 1e-160, 1e-20, 1e-9])
def test_exponential_of_almost_nothing(size):
    q = np.array(rotation.exponential((size, 0.0, 0.0)))
    assert np.abs(q - (1, size / 2, 0, 0)).max() <= 1e-16 * size


def test_cayley_agrees_with_exponential_to_third_order():
    errors = []
    for h in (0.1, 0.05):
        φ = (h, -2 * h, 0.5 * h)
        q, p = np.array(rotation.cayley(φ)), np.array(rotation.exponential(φ))
        assert abs(np.linalg.norm(q) - 1) < 1e-15
        errors.append(rotation.rotation_angle(q, p))
    assert abs(np.log2(errors[0] / errors[1]) - 3) < 0.02


def test_the_matrix_that_takes_omega_to_the_rate_of_q():
    """E(q) ω against the central difference of exp(ω t) ⊗ q, by SciPy."""
    h = 1e-5
    for q, ω in zip(Q, R, strict=True):
        ends = [
            (Rotation.from_rotvec(s * h * ω) * scipy_rotation(q)).as_quat(scalar_first=True) for s in (1, -1)
        ]
        ends = [end if end @ q > 0 else -end for end in ends]
        assert np.abs(rotation.quaternion_rate_matrix(q) @ ω - (ends[0] - ends[1]) / (2 * h)).max() < 1e-9
        assert np.abs(rotation.quaternion_rate(q, ω) - rotation.quaternion_rate_matrix(q) @ ω).max() < 1e-15
    assert np.abs(np.einsum("nij,ni->nj", rotation.quaternion_rate_matrix(Q), Q)).max() < 1e-16 * 2


def test_angle_between_attitudes_is_exact_when_tiny_and_ignores_the_sign_of_q():
    for angle in (0, 1e-12, 1e-7, 1, 3, np.pi):
        turned = over_arrays(rotation.multiply)(
            over_arrays(rotation.exponential)(angle * np.array([0.6, 0, 0.8])), Q
        )
        assert np.abs(rotation.rotation_angle(Q, -turned) - angle).max() < 1e-15 * 4


def test_skew_plane_and_solve():
    a, b = R[0], R[1]
    assert np.abs(rotation.skew(a) @ b - np.cross(a, b)).max() < 1e-15
    assert np.allclose(
        rotation.rotate_in_plane(0.3, a[:2]), Rotation.from_rotvec((0, 0, 0.3)).apply([*a[:2], 0])[:2]
    )
    A = RANDOM.normal(size=(3, 3))
    assert np.allclose(rotation.solve3(*map(tuple, A), tuple(b)), np.linalg.solve(A, b), rtol=1e-12)
