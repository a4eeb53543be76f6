"""The exact friction cone: laws by definition, an oracle by polynomial roots, SciPy, statics, isotropy."""

import numpy as np
import pytest
import scipy.optimize
import scipy.sparse
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.compiled import plain
from reference.factored import Factored
from reference.lcp import LCP, ConeProblem, cone_apgd, cone_gauss_seidel, cone_newton
from reference.lcp.cone_gauss_seidel import diagonal_blocks
from reference.lcp.one_contact import solve_contact

METHODS = cone_gauss_seidel, cone_apgd, cone_newton
LAWS = "ncp", "ccp"


def random_problem(seed, contacts=4, size=3, law="ncp", ridge=0.3, push=0.5):
    random = np.random.default_rng(seed)
    n = contacts * size
    G = random.normal(size=(n, n + 1))
    A, b = G @ G.T / n + ridge * np.eye(n), random.normal(size=n)
    b[::size] -= push
    return ConeProblem(A, b, np.abs(random.normal(size=contacts)) * 0.6, law=law, dimension=size)


def violation(problem, λ):
    """The worst violation of the law by λ, each condition on its own, with no projection."""
    w, worst = problem.A @ λ + problem.b, 0.0
    for μ, w_k, λ_k in zip(problem.mu, w.reshape(-1, problem.size), λ.reshape(-1, problem.size), strict=True):
        slip, pull = np.linalg.norm(w_k[1:]), np.linalg.norm(λ_k[1:])
        lift = (
            w_k[0] if problem.law == "ncp" else w_k[0] - μ * slip
        )  # the convex law's w lies in the dual cone
        against = w_k[1:] @ λ_k[1:] + μ * λ_k[0] * slip  # 0 where friction is greatest, and against the slip
        worst = max(worst, -λ_k[0], pull - μ * λ_k[0], -lift, abs(λ_k[0] * lift), abs(against))
    return worst


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("law", LAWS)
def test_the_two_laws_on_one_contact(method, law):
    """CASES.md: NCP (.1, −.05, 0) with w_n = 0; CCP (.48, −.24, 0), which lifts off at w_n = .38."""
    known = LCP_PROBLEMS["sliding_contact"](law)
    solution = method(known.problem)
    assert solution.solved and known.error(solution.lam) < 1e-9
    assert np.allclose(solution.w, (0, 0.95, 0) if law == "ncp" else (0.38, 0.76, 0), atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_without_friction_a_contact_still_does_not_pull(method):
    """μ = 0: the cone is a ray, and a negative λ_n is not on it."""
    problem = ConeProblem(np.diag([2.0, 1, 3, 1]), [1.0, 0, -1, 0], 0.0, dimension=2)
    assert problem.residual([-0.5, 0, 1 / 3, 0]) > 0.1
    assert np.allclose(method(problem).lam, [0, 0, 1 / 3, 0])


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("size", [2, 3])
def test_one_contact_always_succeeds(law, size):
    """One sweep each, from nearly singular to diagonal, from hardly any friction to μ = 100."""
    for seed in range(150):
        random = np.random.default_rng(seed)
        G = random.normal(size=(size, size + 1)) * 10.0 ** random.uniform(-0.5, 0.5, size=(size, 1))
        μ = 10.0 ** random.uniform(-3, 2) if seed % 10 else 0.0
        problem = ConeProblem(G @ G.T, random.normal(size=size), [μ], law=law)
        solution = cone_gauss_seidel(problem, max_iterations=2, tolerance=1e-8)
        assert solution.solved and solution.iterations <= 1, (seed, solution.residual)


def sliding_forces(A, q, μ):
    """All λ of Coulomb's sliding, by the roots of a quartic in α that is interpolated, not derived."""

    def λ_at(α):
        return np.linalg.solve(A + α * np.diag([0, 1, 1]), -q)

    def quartic(α):
        λ, size = λ_at(α), np.linalg.det(A + α * np.diag([0, 1, 1]))
        return (λ[1] ** 2 + λ[2] ** 2 - μ**2 * λ[0] ** 2) * size**2

    scale = np.trace(A)
    points = scale * np.cos(np.pi * (np.arange(5) + 0.5) / 5) + 1.5 * scale
    roots = np.roots(np.polyfit(points / scale, [quartic(α) for α in points], 4)) * scale
    real = [r.real for r in roots if abs(r.imag) < 1e-6 * scale and r.real > 0]
    return [λ for λ in map(λ_at, real) if λ[0] > 0]


@pytest.mark.parametrize("seed", range(40))
def test_sliding_against_the_quartic(seed):
    random = np.random.default_rng(seed)
    G = random.normal(size=(3, 4))
    A, q, μ = G @ G.T + 0.2 * np.eye(3), random.normal(size=3) - [1, 0, 0], 0.3
    λ = np.array(solve_contact(A, *q, μ, True))
    if λ[0] > 0 and np.hypot(λ[1], λ[2]) > 0.999999 * μ * λ[0]:
        nearest = min(np.abs(λ - other).max() for other in sliding_forces(A, q, μ))
        assert nearest < 1e-6 * np.abs(λ).max()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("size", [2, 3])
@pytest.mark.parametrize("seed", range(3))
def test_all_methods_obey_the_law(seed, size, law):
    problem = random_problem(seed, size=size, law=law)
    for method in METHODS:
        solution = method(problem)
        assert solution.solved and violation(problem, solution.lam) < 1e-8, (method.__name__, solution.reason)


@pytest.mark.parametrize("seed", range(3))
def test_the_convex_law_is_a_minimum(seed):
    """SciPy's general constrained minimiser finds the same."""
    problem = random_problem(seed, contacts=2, law="ccp")
    A, b, μ = problem.A, problem.b, problem.mu
    inside = lambda x: μ * x[::3] - np.hypot(x[1::3], x[2::3])
    cone = {"type": "ineq", "fun": inside}
    start = np.array([1.0, 0.01, 0.01, 1.0, 0.01, 0.01])
    found = scipy.optimize.minimize(
        lambda x: 0.5 * x @ A @ x + b @ x, start, jac=lambda x: A @ x + b, constraints=[cone], method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 500},
    )  # fmt: skip
    for method in METHODS:
        λ = method(problem).lam
        assert 0.5 * λ @ A @ λ + b @ λ == pytest.approx(found.fun, abs=1e-7)


@given(st.integers(0, 2**32 - 1), st.sampled_from(METHODS), st.sampled_from(LAWS), st.integers(2, 3),
       st.sampled_from([0.0, 1e-9, 0.3]), st.integers(0, 3))  # fmt: skip
@settings(max_examples=80, deadline=None)
def test_nothing_wrong_is_called_solved(seed, method, law, size, ridge, contacts):
    random = np.random.default_rng(seed)
    n = contacts * size
    G = random.integers(-2, 3, size=(n, max(n - 1, 0)))
    A, b = G @ G.T + ridge * np.eye(n), random.integers(-2, 3, size=n)
    problem = ConeProblem(A, b, random.choice([0, 0.5, 1, 3], size=contacts), law=law, dimension=size)
    solution = method(problem, max_iterations=100)
    hidden = solution.reason.startswith("The residual looks like")  # by the rounding of a huge λ
    assert solution.solved == (solution.residual <= 1e-10 and not hidden)
    assert not hidden or (solution.status == "diverged" and np.abs(solution.lam).max() > 1e6)
    if solution.solved:
        assert violation(problem, solution.lam) < 1e-6 * max(1, np.abs(solution.lam).max(initial=0)) ** 2


def table(pull, μ=0.5, legs=4, law="ncp"):
    """A table of 1 kg on legs, pulled sideways for a second by ``pull`` (2,); its mass is known to A."""
    angle = 2 * np.pi * np.arange(legs) / legs + 0.3
    arm = np.stack([0.4 * np.cos(angle), 0.3 * np.sin(angle), np.full(legs, -0.2)], axis=1)
    mass = np.diag([1, 1, 1, 0.05, 0.06, 0.08])
    J, axes = np.zeros((legs, 3, 1, 6)), np.eye(3)[[2, 0, 1]]
    J[..., 0, :3], J[..., 0, 3:] = axes, np.cross(arm[:, None], axes)
    J = J.reshape(3 * legs, 1, 6)
    force = np.array([*pull, -9.81, 0, 0, 0])
    force[3:] = np.cross([0, 0, -0.2], force[:3] * [1, 1, 0])  # pulled at the height of the ground
    b = J[:, 0] @ np.linalg.solve(mass, force)
    A = Factored(np.zeros((3 * legs, 1), int), J, J @ np.linalg.inv(mass), 1, mass=mass[None])
    return ConeProblem(A, b, np.full(legs, μ), law=law)


@pytest.mark.parametrize("method", METHODS)
def test_friction_is_isotropic(method):
    """A point sticks up to μ m g in every direction, to 1e-6, and slides beyond."""
    for angle in np.linspace(0, 2 * np.pi, 17):
        along = np.array([0, np.cos(angle), np.sin(angle)])
        for share, slips in ((1 - 1e-6, False), (1 + 1e-6, True)):
            solution = method(
                ConeProblem(np.eye(3), 4.905 * share * along - [9.81, 0, 0], 0.5), tolerance=1e-12
            )
            slip = 4.905e-6 if slips else 0.0
            assert solution.solved and np.allclose(solution.w, slip * along, atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_a_table_sticks_and_slides_alike_in_every_direction(method):
    """Four legs, of which three would do: λ is not unique, the velocity and the sum of λ_n are."""
    greatest, margin = 0.5 * 9.81, 1e-6 if method is cone_newton else 0.1
    for angle in (0.3, 4.4):
        along = np.array([np.cos(angle), np.sin(angle)])
        sticks = method(table(along * greatest * (1 - margin)), max_iterations=20000)
        assert sticks.solved and np.abs(sticks.w).max() < 1e-6
        slides = method(table(along * greatest * (1 + margin)), max_iterations=20000)
        velocity = slides.w.reshape(-1, 3).mean(axis=0)[1:]
        assert slides.solved and np.allclose(velocity, along * greatest * margin, atol=1e-6)
        assert np.sum(slides.lam[::3]) == pytest.approx(9.81, rel=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_every_form_of_A_has_the_same_answer(method):
    problem = random_problem(1)
    factored = Factored.from_matrices(np.linalg.cholesky(problem.A), np.ones(problem.n))
    for A in (scipy.sparse.csr_array(problem.A), factored):
        other = method(ConeProblem(A, problem.b, problem.mu))
        assert other.solved and np.allclose(other.lam, method(problem).lam, atol=1e-8)
        assert np.allclose(diagonal_blocks(ConeProblem(A, problem.b, problem.mu)), diagonal_blocks(problem))


@pytest.mark.parametrize("factored", [True, False])
def test_newton_in_the_velocities_is_quick_on_the_heavy_stack(factored):
    known = LCP_PROBLEMS["column"](50, 1000, factored=factored)
    solution = cone_newton(known.problem, tolerance=1e-12 if factored else 1e-9)
    assert solution.solved and solution.iterations < 20
    assert known.error(solution.lam) < (1e-9 if factored else 1e-6)
    assert len(solution.record) == solution.iterations and solution.record[-1] < 1e-8


def test_newton_in_the_velocities_keeps_to_bounds():
    A, random = LCP_PROBLEMS["planted"](n=6).problem.A, np.random.default_rng(3)
    problem = LCP(A, random.normal(size=6), [-1, -np.inf, 0, 0, -2, 0], [1, np.inf, 0.2, np.inf, 2, 0])
    assert cone_newton(problem).solved


def test_what_they_cannot_do_is_said():
    for method in METHODS:
        assert method(ConeProblem([[1, 2], [0, 1]], [-1, -1], 0.5)).status == "unsuitable"  # not symmetric
        assert method(ConeProblem(-np.eye(3), [-1, 0, 0], 0.5)).status == "unsuitable"
        assert method(LCP([[1, 2], [2, 1]], [-1, -1])).status == "unsuitable"
        with pytest.raises(ValueError, match="max_iterations must be"):
            method(random_problem(0), max_iterations=-1)
    with pytest.raises(ValueError, match="mass must be the M"):
        Factored(
            np.zeros((1, 1), int), np.ones((1, 1, 1)), np.ones((1, 1, 1)), 1, mass=2 * np.ones((1, 1, 1))
        )


def test_one_contact_compiled_equals_plain():
    for seed in range(20):
        random = np.random.default_rng(seed)
        G, q = random.normal(size=(3, 4)), random.normal(size=3) - [1, 0, 0]
        for coulomb in (True, False):
            compiled, uncompiled = (
                f(G @ G.T, *q, 0.6, coulomb) for f in (solve_contact, plain(solve_contact))
            )
            assert np.allclose(compiled, uncompiled, rtol=1e-12, atol=1e-15)
