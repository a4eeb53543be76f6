"""Projected Gauss–Seidel against planted answers, enumeration in fractions, and rates in closed form."""

import numpy as np
import pytest
import scipy.sparse
from hypothesis import given, settings
from hypothesis import strategies as st

import lcp_enumeration
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.compiled import bind, compiled, plain
from reference.factored import Factored
from reference.lcp import LCP, SOLVERS, STATUSES, gauss_seidel
from reference.lcp.gauss_seidel import natural_order, sweeps
from reference.lcp.operators import (
    Factors,
    arrays,
    change_factored,
    change_matrix,
    follow_factored,
    follow_matrix,
    for_form,
    row_factored,
    row_matrix,
    rows_factored,
    rows_matrix,
)


def forms(A):
    """The same positive definite A as dense, sparse and factored."""
    return A, scipy.sparse.coo_array(A), Factored.from_matrices(np.linalg.cholesky(A), np.ones(len(A)))


CAN = {
    "easy": {}, "lemke_exponential": {}, "murty_exponential": {}, "jacobi_fails": {}, "column": {},
    "heavy_on_light": {"ratio": 20}, "degenerate": {}, "dragged_block": {"pull": 0.9}, "planted": {},
}  # fmt: skip


@pytest.mark.parametrize("name", CAN)
def test_known_answers(name):
    known = LCP_PROBLEMS[name](**CAN[name])
    solution = gauss_seidel(known.problem, max_iterations=20000)
    assert solution.solved and solution.residual <= 1e-10, solution.reason
    assert known.error(solution.lam) < 1e-7  # the residual times the condition number, 1e3 at most


@pytest.mark.parametrize(
    ("name", "status"),
    [("kostreva", "max_iterations"), ("murty_2_8", "max_iterations"), ("no_solution", "max_iterations"),
     ("zero_diagonal", "unsuitable"), ("painleve", "unsuitable"), ("sliding_contact", "unsuitable")],
)  # fmt: skip
def test_what_it_cannot_do_is_said(name, status):
    solution = gauss_seidel(LCP_PROBLEMS[name]().problem)
    assert solution.status == status and not solution.solved and solution.residual > 0.1
    assert len(solution.reason) > 30 and len(solution.history) == solution.iterations + 1


def test_blow_up_is_said():
    solution = gauss_seidel(LCP([[1, 3], [3, 1]], [-1, -1], lower=-np.inf))
    assert solution.status == "diverged" and solution.iterations < 100
    assert gauss_seidel(LCP([[1e-200]], [-1e200])).status == "unsuitable"


@pytest.mark.parametrize("n", [5, 10, 20])
def test_rate_on_a_column_is_cos_squared(n):
    history = gauss_seidel(LCP_PROBLEMS["column"](n).problem, max_iterations=4000).history
    assert (history[-1] / history[-11]) ** 0.1 == pytest.approx(np.cos(np.pi / (2 * n)) ** 2, rel=1e-3)


@pytest.mark.parametrize("ratio", [1, 10, 100])
def test_rate_of_heavy_on_light(ratio):
    history = gauss_seidel(LCP_PROBLEMS["heavy_on_light"](ratio).problem, max_iterations=9000).history
    assert (history[-1] / history[-6]) ** 0.2 == pytest.approx(ratio / (1 + ratio), rel=1e-4)


@pytest.mark.parametrize(("n", "heavy", "sweeps"), [(10, 1, 493), (20, 1, 1865), (10, 100, 10801)])
def test_sweeps_down_a_column(n, heavy, sweeps):
    """CASES.md's counts, which are those of a residual of 1e-6."""
    problem = LCP_PROBLEMS["column"](n, heavy).problem
    assert gauss_seidel(problem, tolerance=1e-6, max_iterations=20000).iterations == sweeps


@pytest.mark.parametrize("seed", range(8))
def test_every_form_of_A_does_the_same_sweeps(seed):
    known = LCP_PROBLEMS["planted"](seed=seed, n=15)
    A, b = known.problem.A, known.problem.b
    friction = ([1, 2, 7], [0, 0, 8], 0.4)
    for extra in ({}, {"lower": -1, "upper": 0.5}, {"friction": friction}):
        results = [
            gauss_seidel(LCP(form, b, **extra), max_iterations=7, tolerance=1e-30) for form in forms(A)
        ]
        for result in results[1:]:
            assert np.allclose(result.lam, results[0].lam, rtol=1e-11, atol=1e-12)
            assert np.allclose(result.history, results[0].history, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_history_is_the_residual_of_each_iterate(seed):
    A, b = LCP_PROBLEMS["planted"](seed=seed).problem.A, np.random.default_rng(seed).normal(size=20) - 1
    problem = LCP(A, b, friction=([1, 2], [0, 0], 0.5))
    whole = gauss_seidel(problem, max_iterations=6, tolerance=1e-30)
    assert len(whole.history) == 7 and whole.history[0] == pytest.approx(1)
    for k in range(7):
        part = gauss_seidel(problem, max_iterations=k, tolerance=1e-30)
        assert whole.history[k] == pytest.approx(part.residual, rel=1e-9)
        assert part.residual == problem.residual(part.lam) and np.allclose(part.w, problem.w(part.lam))
    thin = gauss_seidel(problem, max_iterations=6, tolerance=1e-30, every=3)
    assert np.array_equal(np.isnan(thin.history), [0, 1, 1, 0, 1, 1, 0])
    assert np.allclose(thin.lam, whole.lam, rtol=1e-12, atol=1e-15)  # sums in another order
    assert thin.history[3] == pytest.approx(whole.history[3], rel=1e-9)


def one_sweep(A, b, λ, lower, upper, friction, order):
    """A sweep as S17 says it, over a dense A."""
    for i in order:
        λ[i] -= (A[i] @ λ + b[i]) / A[i, i]
        if i in friction:
            normal, mu = friction[i]
            λ[i] = np.clip(λ[i], -mu * λ[normal], mu * λ[normal])
        else:
            λ[i] = np.clip(λ[i], lower[i], upper[i])


@pytest.mark.parametrize(
    "rows", [([1, 2, 4, 5], [0, 0, 3, 3]), ([0, 1, 3, 4], [2, 2, 5, 5]), ([4, 2], [0, 3])]
)
def test_friction_is_clipped_by_the_normal_just_renewed(rows):
    A, b = LCP_PROBLEMS["planted"](n=6).problem.A, np.array([-1, 0.8, -0.7, -1, 2, -0.3])
    problem = LCP(A, b, friction=(*rows, 0.5))
    friction = {row: (normal, 0.5) for row, normal in zip(*rows, strict=True)}
    order = list(natural_order(problem))
    assert sorted(order) == list(range(6))
    assert all(order.index(normal) < order.index(row) for row, (normal, _) in friction.items())
    λ = np.zeros(6)
    for k in range(1, 4):
        one_sweep(A, b, λ, np.zeros(6), np.full(6, np.inf), friction, order)
        got = gauss_seidel(problem, max_iterations=k, tolerance=1e-30).lam
        assert np.allclose(got, λ, rtol=1e-12, atol=1e-14)


def test_compiled_equals_plain():
    known = LCP_PROBLEMS["planted"](n=8)
    b, friction = known.problem.b, ([1, 2], [0, 0], 0.4)
    for A in forms(known.problem.A):
        problem = LCP(A, b, friction=friction)
        A = arrays(problem.A)
        pieces = follow_matrix, row_matrix, rows_matrix, change_matrix
        if isinstance(A, Factors):
            pieces = follow_factored, row_factored, rows_factored, change_factored
        λ, history = np.zeros(8), np.empty(6)
        options = natural_order(problem), 1.3, 2
        plain(sweeps)(*map(plain, pieces), A, problem.terms, λ, problem.scale, 1e-30, history, *options)
        λ_2, history_2 = np.zeros(8), np.empty(6)
        kernel = for_form(sweeps, type(A))
        kernel(A, problem.terms, λ_2, problem.scale, 1e-30, history_2, *options)
        assert np.allclose(λ, λ_2, rtol=1e-12, atol=1e-15)
        assert np.allclose(history[:5], history_2[:5], rtol=1e-12, atol=1e-15, equal_nan=True)


@compiled
def run(solve, steps, A, terms, λ, scale, history, order, counts):
    """What a simulation does with a kernel: it calls it each step, from where λ was (a warm start)."""
    for k in range(steps):
        counts[k], _ = solve(A, terms, λ, scale, 1e-10, history, order, 1.0, 1)


def test_a_step_binds_the_kernel():
    problem = LCP_PROBLEMS["column"](5).problem
    A, λ, counts = arrays(problem.A), np.zeros(5), np.zeros(2)
    steps = bind(run, for_form(sweeps, type(A)))
    steps(2, A, problem.terms, λ, problem.scale, np.empty(901), natural_order(problem), counts)
    assert list(counts) == [gauss_seidel(problem).iterations, 0] and np.allclose(λ, [5, 4, 3, 2, 1])


@pytest.mark.parametrize("factor", [1e-12, 1e12])
def test_units_change_nothing(factor):
    known = LCP_PROBLEMS["planted"]()
    A, b = known.problem.A, known.problem.b
    one, scaled = gauss_seidel(LCP(A, b)), gauss_seidel(LCP(A, factor * b))
    assert one.solved and scaled.solved and scaled.iterations == one.iterations
    assert np.allclose(scaled.lam, factor * one.lam, rtol=1e-9, atol=0)


def small_problems():
    """n ≤ 4 of small whole numbers: singular, degenerate, unsolvable and ambiguous ones among them."""
    number = st.integers(-3, 3)
    bound = st.sampled_from([(0, np.inf), (-np.inf, np.inf), (-1, 1), (0, 2), (1, 1), (-np.inf, 0)])
    return st.integers(0, 4).flatmap(
        lambda n: st.tuples(
            st.lists(st.lists(number, min_size=n, max_size=n), min_size=n, max_size=n),
            st.lists(number, min_size=n, max_size=n),
            st.lists(bound, min_size=n, max_size=n),
            st.booleans(),
        )
    )


@given(small_problems(), st.sampled_from(sorted(SOLVERS)))
@settings(max_examples=150, deadline=None)
def test_nothing_wrong_is_called_solved(parts, name):
    A, b, limits, semidefinite = parts
    n = len(b)
    A, b = np.array(A, dtype=float).reshape(n, n), np.array(b, dtype=float)
    A = A @ A.T if semidefinite else A
    lower, upper = np.array(limits, dtype=float).reshape(n, 2).T
    solution = SOLVERS[name](LCP(A, b, lower, upper), max_iterations=200)
    assert solution.status in STATUSES and solution.solved == (solution.residual <= 1e-10)
    if solution.solved:
        answers = lcp_enumeration.solutions(A, b, lower, upper)
        nearest = min(
            (np.abs(solution.lam - np.array(λ, dtype=float)).max(initial=0) for λ in answers), default=np.inf
        )
        assert nearest < 1e-6 or lcp_enumeration.nearly(A, b, lower, upper, solution.lam, 1e-8)


@given(st.integers(0, 2**32 - 1), st.sampled_from(["pd", "psd", "p", "copositive"]), st.integers(1, 30))
@settings(max_examples=60, deadline=None)
def test_planted(seed, kind, n):
    known = LCP_PROBLEMS["planted"](kind, n=n, seed=seed)
    solution = gauss_seidel(known.problem)
    assert solution.solved == (known.problem.residual(solution.lam) <= 1e-10)
    if kind == "pd":
        assert gauss_seidel(known.problem, max_iterations=20000).solved
    if solution.solved and known.answer is not None:
        assert known.error(solution.lam) < 1e-7


@pytest.mark.parametrize("n", [0, 1])
def test_no_row_and_one(n):
    for b in (-2.0, 0.0, 3.0):
        solution = gauss_seidel(LCP(4 * np.eye(n), np.full(n, b)))
        assert solution.solved and np.allclose(solution.lam, max(0, -b / 4)) and len(solution.lam) == n
        assert len(solution.history) == solution.iterations + 1


def test_start():
    problem = LCP([[2, 1], [1, 2]], (-5, -6))
    solution = gauss_seidel(problem, start=[4 / 3, 7 / 3])
    assert solution.solved and solution.iterations == 0
    far = gauss_seidel(problem, start=[-1e6, 1e6])
    assert far.solved and far.history[0] > 1e4
    nothing = gauss_seidel(LCP(np.eye(2), [1, 0]), start=[3, 4])  # λ⁰ solves exactly, and only 0 will do
    assert nothing.solved and np.array_equal(nothing.lam, [0, 0])
    start = np.ones(2)
    gauss_seidel(problem, start=start)
    assert np.array_equal(start, [1, 1])


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"problem": np.eye(2)}, TypeError, "problem must be an LCP"),
        ({"start": [1, 2, 3]}, ValueError, "start must have shape"),
        ({"start": [np.nan, 1]}, ValueError, "start must hold finite"),
        ({"tolerance": 0}, ValueError, "tolerance must be"),
        ({"tolerance": np.nan}, ValueError, "tolerance must be"),
        ({"tolerance": "small"}, TypeError, "tolerance must be a number"),
        ({"max_iterations": -1}, ValueError, "max_iterations must be"),
        ({"max_iterations": 2.5}, TypeError, "max_iterations must be"),
        ({"max_iterations": 10**12}, ValueError, "max_iterations must be at most"),
        ({"every": 0}, ValueError, "every must be"),
    ],
)
def test_bad_arguments(arguments, error, words):
    arguments = {"problem": LCP(np.eye(2), [-1, -1]), **arguments}
    with pytest.raises(error, match=words):
        gauss_seidel(**arguments)
