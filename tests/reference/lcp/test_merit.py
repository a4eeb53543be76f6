"""The measure of error, against its definition written out and values by hand."""

import numpy as np
import pytest
import scipy.sparse
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.compiled import plain
from reference.factored import Factored
from reference.lcp import LCP, ConeProblem
from reference.lcp.merit import cone_merit, merit, project_on_cone


def by_definition(A, b, lower, upper, λ, friction=None):
    """DESIGN's formula, with NumPy's clip, in as many words."""

    def worst(λ):
        l, u = lower.copy(), upper.copy()
        if friction is not None:
            rows, normals, mu = friction
            l[rows], u[rows] = -mu * λ[normals], mu * λ[normals]
        w = A @ λ + b
        return np.max(np.abs(λ - np.clip(λ - w / d, l, u)))

    d = np.where(np.diag(A) > 0, np.diag(A), np.abs(A).max(axis=1))
    d = np.where(d > 0, d, 1)
    origin = np.clip(0, lower, upper)
    if friction is not None:
        origin[friction[0]] = 0
    return worst(λ) / worst(origin)


@pytest.mark.parametrize("seed", range(30))
def test_residual_is_the_formula(seed):
    random = np.random.default_rng(seed)
    n = 6
    A, b, λ = random.normal(size=(n, n)), random.normal(size=n), random.normal(size=n)
    A[0, 0] = 0
    A[1] = 0
    lower = np.where(random.random(n) < 0.3, -np.inf, -random.random(n))
    upper = np.where(random.random(n) < 0.3, np.inf, random.random(n))
    lower[2] = upper[2] = 0.25
    expected = by_definition(A, b, lower, upper, λ)
    for form in (A, scipy.sparse.coo_array(A), A.tolist()):
        assert LCP(form, b, lower, upper).residual(λ) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("seed", range(10))
def test_friction_bounds_are_those_of_this_very_normal(seed):
    random = np.random.default_rng(seed)
    A, b, λ = random.normal(size=(6, 6)), random.normal(size=6), np.abs(random.normal(size=6))
    b[0] = -1
    rows, normals, mu = np.array([1, 2, 4, 5]), np.array([0, 0, 3, 3]), np.array([0.5, 0.5, 0, 1.2])
    problem = LCP(A, b, friction=(rows, normals, mu))
    lower, upper = np.zeros(6), np.full(6, np.inf)
    expected = by_definition(A, b, lower, upper, λ, (rows, normals, mu))
    assert problem.residual(λ) == pytest.approx(expected, rel=1e-12)
    low, high = problem.bounds(λ)
    assert np.allclose(high[rows], mu * λ[normals]) and np.allclose(low[rows], -mu * λ[normals])


def test_by_hand():
    assert LCP([[2.0]], [-4.0]).scale == 2
    assert LCP([[2.0]], [-4.0]).residual([1.0]) == 0.5
    assert LCP([[2.0]], [-4.0], upper=1).residual([1.0]) == 0
    assert LCP([[-2.0]], [-4.0]).scale == 2  # d = max |A_ij|
    assert LCP([[0.0]], [-4.0]).scale == 4  # d = 1
    assert LCP([[1.0]], [3.0]).residual([0.0]) == 0  # 0/0
    assert LCP([[1.0]], [3.0]).residual([1e-20]) == np.inf  # only λ⁰ will do
    assert LCP([[1.0]], [-4.0], lower=1, upper=1).residual([1.0]) == 0


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e300])
def test_what_is_not_finite_is_never_solved(bad):
    for problem in (
        LCP(np.full((2, 2), 1e10), [-1, 1]),
        LCP(np.eye(2), [1, 1]),
    ):
        assert problem.residual([bad, 0]) > 1
    if not np.isfinite(bad):
        assert LCP(np.zeros((2, 2)), [0, 0]).residual([bad, 0]) == np.inf
    cone = ConeProblem(1e10 * np.eye(3), [-1, 0, 0], 0.5)
    assert cone.residual([bad, 0, 0]) > 1 and cone.residual([1, bad, 0]) > 1


def test_numbers_too_far_apart_are_never_solved():
    problem = LCP([[1e-200]], [-1e200])
    assert problem.scale == np.inf and problem.residual([1.0]) == np.inf and problem.residual([0.0]) == np.inf


def test_a_small_w_is_not_lost_beside_a_big_λ():
    assert LCP([[1, 0], [0, 1]], [-1e20, -1]).residual([1e20, 1.5]) == pytest.approx(5e-21)
    assert LCP([[0, 0], [0, 1e-3]], [1, -1], lower=-np.inf).residual([1e20, 0]) == 1


@given(
    st.integers(0, 2**32 - 1),
    st.floats(-12, 12),
    st.floats(-12, 12),
)
@settings(max_examples=60, deadline=None)
def test_scaling_changes_nothing(seed, λ_exponent, w_exponent):
    random = np.random.default_rng(seed)
    A, b, λ = random.normal(size=(4, 4)), random.normal(size=4), random.normal(size=4)
    b[0] = -1
    A[0, 0] = 1
    s, t = 10.0**λ_exponent, 10.0**w_exponent
    one, other = LCP(A, b, -1, 2), LCP(A * t / s, b * t, -s, 2 * s)
    assert other.residual(s * λ) == pytest.approx(one.residual(λ), rel=1e-9)


@pytest.mark.parametrize(("law", "answer"), [("ncp", (0.1, -0.05, 0)), ("ccp", (0.48, -0.24, 0))])
def test_cone_laws_by_hand(law, answer):
    for size in (3, 2):
        problem = ConeProblem(np.eye(size), [-0.1, 1, 0][:size], 0.5, law=law)
        assert problem.size == size
        assert problem.residual(np.array(answer[:size])) < 1e-15
        other = (0.1, -0.05, 0) if law == "ccp" else (0.48, -0.24, 0)
        assert problem.residual(np.array(other[:size])) > 0.05


@pytest.mark.parametrize("seed", range(20))
def test_projection_is_the_nearest_point(seed):
    random = np.random.default_rng(seed)
    μ, p = random.random() * 2, random.normal(size=3)
    nearest = np.array(project_on_cone(μ, *p))
    assert np.hypot(*nearest[1:]) <= μ * nearest[0] + 1e-15
    n = random.random(4000) * 3
    t = random.normal(size=(4000, 2))
    t *= (μ * n * np.sqrt(random.random(4000)) / np.hypot(*t.T))[:, None]
    inside = np.column_stack([n, t])
    assert np.linalg.norm(p - nearest) <= np.linalg.norm(p - inside, axis=1).min() + 1e-12


@pytest.mark.parametrize("seed", range(10))
def test_compiled_equals_plain(seed):
    random = np.random.default_rng(seed)
    A, b, λ = random.normal(size=(6, 6)), random.normal(size=6), random.normal(size=6)
    problem = LCP(A, b, friction=([1, 2, 4], [0, 0, 3], 0.5))
    w = problem.w(λ)
    assert merit(problem.terms, λ, w) == pytest.approx(plain(merit)(problem.terms, λ, w), rel=1e-12)
    for law in ("ncp", "ccp"):
        cone = ConeProblem(A, b, 0.5, law=law)
        assert cone_merit(cone.terms, λ, w) == pytest.approx(plain(cone_merit)(cone.terms, λ, w), rel=1e-12)


def test_factored_has_the_same_scales():
    J = np.array([[1.0, -1, 0], [0, 0, 0], [0, 2, 1]])
    A = Factored.from_matrices(J, [1.0, 2, 3], softness=[0, 0, 0.5])
    d = LCP(A, np.zeros(3)).terms.d
    assert np.allclose(d, [3, 1, 11.5])
