"""Newton's methods and the interior point method: counts, hard problems, SciPy, what they say of failure."""

import time

import numpy as np
import pytest
import scipy.optimize
import scipy.sparse

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.factored import Factored
from reference.lcp import LCP, fischer_newton, gauss_seidel, interior_point, min_map_newton
from reference.lcp.direct import solve
from reference.lcp.fischer import fischer, fischer_burmeister, jacobian
from reference.lcp.min_map import min_map, newton_step, pieces, times_transposed

NEWTONS = min_map_newton, fischer_newton
METHODS = *NEWTONS, interior_point
SOLVES = (
    "easy", "kostreva", "murty_2_8", "lemke_exponential", "murty_exponential", "jacobi_fails", "column",
    "heavy_on_light", "zero_diagonal", "degenerate", "planted", "several_solutions", "redundant", "painleve",
)  # fmt: skip


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", SOLVES)
def test_known_answers(name, method):
    known = LCP_PROBLEMS[name]()
    solution = method(known.problem)
    assert solution.solved and solution.iterations <= 30, solution.reason
    assert known.answer is None or known.error(solution.lam) < 1e-8
    assert len(solution.history) == solution.iterations + 1
    assert method is interior_point or solution.history[0] == pytest.approx(1)


@pytest.mark.parametrize(("n", "heavy"), [(10, 1), (20, 1), (10, 100), (50, 1000)])
def test_min_map_needs_n_steps_for_a_column_of_n(n, heavy):
    """CASES.md: 10, 20 and 10. Each step lets one more box find out that it is carried."""
    known = LCP_PROBLEMS["column"](n, heavy)
    solution = min_map_newton(known.problem, tolerance=1e-6)
    assert solution.iterations == n and known.error(solution.lam) < 1e-12
    assert fischer_newton(known.problem).iterations < 10
    assert interior_point(known.problem).iterations < 20


def test_kostreva_goes_round_and_the_line_search_gets_out():
    problem, rounds = LCP_PROBLEMS["kostreva"]().problem, 0
    for start in np.ndindex(3, 3, 3):
        plain = min_map_newton(problem, start, line_search=False)
        assert plain.solved or (plain.status == "cycle" and "go round" in plain.reason)
        rounds += plain.status == "cycle"
        for method in NEWTONS:
            solution = method(problem, start)
            assert solution.solved and np.allclose(solution.lam, 1 / 3) and solution.iterations < 20
    assert rounds > 10


def painleve_velocity(λ):
    """v and ω of the rod (length 2, mass 1, inertia 1/3) after the impulses; before: v = (−1, −.1), ω = 0."""
    n, t = λ[0], λ[1] - λ[2]
    return -1 + t, -0.1 + n, 3 * (-n / np.sqrt(5) + 2 * t / np.sqrt(5))


@pytest.mark.parametrize("method", METHODS)
def test_painleve(method):
    """CASES.md: v⁺ = (−.57, .285), ω = .637279. λ is not unique, this is."""
    λ = method(LCP_PROBLEMS["painleve"]().problem).lam
    assert np.allclose(painleve_velocity(λ), (-0.57, 0.285, 0.637279), atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_no_solution_is_said(method):
    solution = method(LCP_PROBLEMS["no_solution"]().problem)
    assert not solution.solved and len(solution.reason) > 60
    assert solution.status == ("infeasible" if method is interior_point else "cycle")


@pytest.mark.parametrize("seed", range(4))
def test_infeasibility_is_proved(seed):
    """y ≥ 0, Aᵀ y ≤ 0, y·b < 0: no λ ≥ 0 has w ≥ 0. SciPy's linear programming agrees."""
    random = np.random.default_rng(seed)
    G = random.normal(size=(6, 3))
    A, b = G @ G.T, random.normal(size=6) - 1.5
    feasible = scipy.optimize.linprog(np.zeros(6), A_ub=-A, b_ub=b).status == 0
    solution = interior_point(LCP(A, b))
    assert solution.solved == feasible
    if not feasible:
        y = solution.certificate["y"]
        assert solution.status == "infeasible" and y.min() >= 0 and (A.T @ y).max() < 1e-6 * -(y @ b)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", ["pd", "psd", "p"])
def test_random_problems(method, kind):
    for seed in range(15):
        known = LCP_PROBLEMS["planted"](kind, n=12, seed=seed)
        solution = method(known.problem)
        assert solution.solved, (seed, solution.reason)
        assert known.answer is None or known.error(solution.lam) < 1e-7


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("seed", range(5))
def test_bounds_and_every_form_of_A(method, seed):
    """The smallest ½ λᵀAλ + bᵀλ within bounds, some of them equal or infinite, by SciPy's solver."""
    random = np.random.default_rng(seed)
    A = LCP_PROBLEMS["planted"](n=9, seed=seed).problem.A
    b = 2 * random.normal(size=9)
    lower = np.array([-1, -np.inf, -np.inf, 0, 0, 0.3, -2, 0, 0])
    upper = np.array([1, np.inf, 0.2, np.inf, 2, 0.3, -1, np.inf, 0.1])
    found = scipy.optimize.minimize(
        lambda x: 0.5 * x @ A @ x + b @ x, np.clip(0, lower, upper), jac=lambda x: A @ x + b,
        bounds=list(zip(lower, upper, strict=True)), method="L-BFGS-B",
        options={"ftol": 1e-15, "gtol": 1e-10},
    )  # fmt: skip
    for form in (A, scipy.sparse.csr_array(A), Factored.from_matrices(np.linalg.cholesky(A), np.ones(9))):
        solution = method(LCP(form, b, lower, upper))
        assert solution.solved and np.allclose(solution.lam, found.x, atol=1e-5), solution.reason


@pytest.mark.parametrize("method", NEWTONS)
def test_friction_bounds_move_with_the_normal(method):
    """Against Gauss–Seidel where that converges, and by hand where a block is dragged."""
    for pull in (0.3, 0.9, -2.0):
        known = LCP_PROBLEMS["dragged_block"](pull)
        assert known.error(method(known.problem).lam) < 1e-9
    for seed in range(6):
        A, random = LCP_PROBLEMS["planted"](n=9, seed=seed).problem.A, np.random.default_rng(seed)
        problem = LCP(A, random.normal(size=9) - 1, friction=([1, 2, 4, 5], [0, 0, 3, 3], 0.4))
        slow, fast = gauss_seidel(problem, max_iterations=20000), method(problem)
        assert slow.solved and fast.solved and np.allclose(slow.lam, fast.lam, atol=1e-7)
    assert interior_point(problem).status == "unsuitable"


def mixed_problem(seed=0):
    """All kinds of rows, and a λ at which none of them is at a kink."""
    random = np.random.default_rng(seed)
    A = LCP_PROBLEMS["planted"]("p", n=8, seed=seed).problem.A
    lower, upper = [-1, -np.inf, -np.inf, 0, 0, 0, -1, 0], [1, np.inf, 0.5, np.inf, 2, 1, 1, np.inf]
    problem = LCP(A, random.normal(size=8), lower, upper, friction=([4, 5], [3, 3], 0.5))
    λ = random.normal(size=8)
    λ[3] = 0.7
    return problem, λ


def differences(function, λ, h=1e-6):
    """The Jacobian by central differences."""
    return np.stack([(function(λ + e) - function(λ - e)) / (2 * h) for e in h * np.eye(len(λ))], axis=1)


@pytest.mark.parametrize("seed", range(4))
def test_derivatives_by_differences(seed):
    problem, λ = mixed_problem(seed)
    derivatives = fischer(problem, λ)[1:]
    exact = differences(lambda x: fischer(problem, x)[0], λ)
    assert np.allclose(jacobian(problem, problem.A, *derivatives), exact, atol=1e-7)
    sparse = jacobian(problem, scipy.sparse.csr_array(problem.A), *derivatives)
    assert np.allclose(sparse.toarray(), exact, atol=1e-7)
    r, w = min_map(problem, λ)
    H, side = differences(lambda x: min_map(problem, x)[0], λ), pieces(problem, λ, w)
    assert np.allclose(H @ newton_step(problem, problem.A, λ, w, r, side), -r, atol=1e-6)
    assert np.allclose(times_transposed(problem, problem.A, λ, side, r), H.T @ r, atol=1e-6)


def test_fischer_burmeister():
    a, b = np.array([0, 0, 3, 1e9, -1, np.inf, 4]), np.array([0, 2, 0, 1e-9, 2, 5, 3])
    φ, φ_a, φ_b = fischer_burmeister(a, b)
    assert np.allclose(φ[[0, 1, 2, 5, 6]], [0, 0, 0, 5, 2]) and φ[3] == pytest.approx(1e-9, rel=1e-12)
    assert φ[4] == pytest.approx(1 - np.sqrt(5)) and φ_a[5] == 0 and φ_b[5] == 1
    assert np.all((φ_a >= 0) & (φ_b >= 0) & (φ_a + φ_b > 0))


def test_singular_systems_get_the_best_there_is():
    H = np.outer([1.0, 2, 3], [1.0, 2, 3])
    assert np.allclose(H @ solve(H, H @ np.ones(3)), H @ np.ones(3))
    x = solve(H, np.array([1.0, 0, 0]))
    assert np.allclose(H.T @ (H @ x - [1, 0, 0]), 0, atol=1e-9)
    large = scipy.sparse.block_diag([H] * 60, format="csr")
    r = large @ np.ones(180)
    assert np.allclose(large @ solve(large, r), r, atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_units_and_sizes(method):
    known = LCP_PROBLEMS["planted"]()
    A, b = known.problem.A, known.problem.b
    one = method(LCP(A, b))
    for factor in (1e-12, 1e12):
        scaled = method(LCP(A, factor * b))
        assert scaled.solved and np.allclose(scaled.lam, factor * one.lam, rtol=1e-7, atol=1e-10 * factor)
    for b in (-2.0, 3.0):
        assert np.allclose(method(LCP([[4]], [b])).lam, max(0, -b / 4))
    assert method(LCP(np.zeros((0, 0)), [])).solved


def test_sparse_ten_thousand():
    """A row of ten thousand blocks, of which each other is pulled: tridiagonal."""
    n = 10_000
    A = scipy.sparse.diags_array([-np.ones(n - 1), 2.1 * np.ones(n), -np.ones(n - 1)], offsets=[-1, 0, 1])
    b = np.random.default_rng(0).normal(size=n)
    solutions = [method(LCP(A, b)) for method in METHODS]
    for solution in solutions:
        assert solution.solved and np.allclose(solution.lam, solutions[0].lam, atol=1e-6)
    assert np.abs(np.minimum(solutions[0].lam, A @ solutions[0].lam + b)).max() < 1e-8


def test_newton_is_ten_times_as_fast_on_the_heavy_stack():
    """λ right to 1e-10 in under a tenth of the time that Gauss–Seidel needs for an error of 1e-3."""
    known = LCP_PROBLEMS["column"](50, 1000)
    gauss_seidel(known.problem, max_iterations=1)
    start = time.process_time()
    fast = min_map_newton(known.problem)
    middle = time.process_time()
    λ = None
    while λ is None or known.error(λ) > 1e-3:
        λ = gauss_seidel(known.problem, λ, tolerance=1e-14, max_iterations=20_000, every=1000).lam
    end = time.process_time()
    assert known.error(fast.lam) < 1e-10
    assert middle - start < 0.1 * (end - middle)


def test_bad_arguments():
    for method in METHODS:
        with pytest.raises(TypeError, match="problem must be an LCP"):
            method(np.eye(2))
        with pytest.raises(ValueError, match="tolerance must be"):
            method(LCP(np.eye(2), [-1, -1]), tolerance=0)
        assert method(LCP_PROBLEMS["sliding_contact"]().problem).status == "unsuitable"
    assert interior_point(LCP([[-1]], [-1])).status == "unsuitable"
