"""The pivoting methods: pivots counted, failures told apart and proved, tableaux written down."""

import numpy as np
import pytest
import scipy.sparse

import random_lcps
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.compiled import plain
from reference.factored import Factored
from reference.lcp import LCP, SOLVERS, dantzig, enumeration, gauss_seidel, lemke, murty
from reference.lcp.lemke_path import follow_path
from reference.lcp.murty import least_index
from reference.lcp.pivoting import proves_infeasible, scaled
from reference.lcp.rounds import begin
from reference.lcp.tableau import exchange, exchange_pair

PIVOTING = enumeration, murty, dantzig, lemke
ANSWERED = ["easy", "kostreva", "murty_2_8", "jacobi_fails", "degenerate", "painleve", "redundant"]
ANSWERED += ["several_solutions", "dragged_block", "heavy_on_light"]


def problem_of(name, **parameters):
    return LCP_PROBLEMS[name](**parameters).problem


# --- counts (CASES.md) --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("method", "options", "name", "parameters", "pivots"),
    [
        (lemke, {}, "kostreva", {}, 4),
        (murty, {}, "kostreva", {}, 5),
        (lemke, {}, "murty_2_8", {}, 5),
        (lemke, {}, "column", {"n": 10}, 11),
        (lemke, {}, "column", {"n": 20}, 21),
        (lemke, {}, "column", {"n": 10, "heavy": 100}, 11),
        *[(lemke, {}, "lemke_exponential", {"n": n}, 2**n) for n in range(1, 11)],
        *[(lemke, {"ties": "first"}, "lemke_exponential", {"n": n}, 2**n) for n in (1, 5, 9)],
        *[(murty, {}, "lemke_exponential", {"n": n}, 1) for n in (1, 5, 10)],
        *[(murty, {}, "murty_exponential", {"n": n}, 2**n - 1) for n in range(1, 10)],
        *[(lemke, {"ties": "first"}, "murty_exponential", {"n": n}, 2 * n) for n in (1, 5, 9)],
        *[(lemke, {}, "murty_exponential", {"n": n}, 2) for n in (1, 5, 9)],
    ],
)
def test_pivots(method, options, name, parameters, pivots):
    known = LCP_PROBLEMS[name](**parameters)
    solution = method(known.problem, max_iterations=2000, **options)
    assert solution.solved and solution.iterations == pivots
    assert known.error(solution.lam) < 1e-12


def test_first_index_ties_cycle():
    solution = lemke(problem_of("kostreva"), ties="first", max_iterations=10**6)
    assert solution.status == "cycle" and solution.iterations < 30 and "lexicographic" in solution.reason


@pytest.mark.parametrize("method", PIVOTING)
@pytest.mark.parametrize("name", ANSWERED)
def test_known_answers(method, name):
    known = LCP_PROBLEMS[name]()
    solution = method(known.problem)
    assert solution.solved and solution.residual <= 1e-13, solution.reason
    if known.answer is not None:
        assert known.error(solution.lam) < 1e-13


def test_any_covering_vector():
    random, known = np.random.default_rng(0), LCP_PROBLEMS["planted"](kind="p")
    paths = set()
    for _ in range(10):
        solution = lemke(known.problem, cover=0.1 + random.random(20))
        assert solution.solved and known.error(solution.lam) < 1e-12
        paths.add(solution.iterations)
    assert len(paths) > 1
    only = np.where(known.problem.b < 0, 1.0, 0.0)  # only where it must be
    assert lemke(known.problem, cover=only).solved
    with pytest.raises(ValueError, match="cover must be positive where w is wrong"):
        lemke(known.problem, cover=1 - only)
    with pytest.raises(ValueError, match="cover must be at least 0"):
        lemke(known.problem, cover=-only)
    with pytest.raises(ValueError, match="cover must have shape"):
        lemke(known.problem, cover=[1, 2])


# --- what has no solution, or several -----------------------------------------------------------------------


def test_no_solution_is_proved():
    problem = problem_of("no_solution")
    for method in (dantzig, lemke):
        solution = method(problem)
        y = solution.certificate["y"]
        assert solution.status == "infeasible" and (y >= 0).all()
        assert np.allclose(y @ problem.A, 0) and y @ problem.b < 0  # so yᵀw < 0, whatever λ is
        assert not proves_infeasible(problem, -y) and not proves_infeasible(problem, [1.0, 0.0])
    solution = enumeration(problem)
    proof = solution.certificate
    assert solution.status == "infeasible" and len(proof["y"]) == 4
    for on, y in zip(proof["z_may_be_positive"], proof["y"], strict=True):
        assert (y @ np.where(on, -proof["M"], np.eye(2)) > -1e-12).all() and y @ proof["q"] < 0
    assert murty(problem).status == "unsuitable"


def test_solutions_in_flat_cones_only():
    """w = (0, λ_1 − 1): all λ_1 ≥ 1, λ_2 = 0 solve it, and no complementary basis is regular."""
    solution = enumeration(LCP([[0, 0], [1, 0]], (0, -1)))
    assert solution.solved and solution.lam[0] >= 1 and solution.lam[1] == 0


def test_ray_is_not_called_infeasible():
    """A game of two: its solution exists, and Lemke's path does not lead there."""
    problem = problem_of("zero_diagonal")
    for method in (dantzig, lemke):
        solution = method(problem)
        assert solution.status == "ray" and solution.certificate is None
    assert murty(problem).status == "unsuitable" and enumeration(problem).solved


def test_several_solutions_are_listed():
    found = enumeration(problem_of("several_solutions"))
    expected = [(1, 0), (0, 1), (1 / 3, 1 / 3)]
    assert found.solved and "3 that differ" in found.reason and len(found.record) == 3
    assert all(any(np.allclose(λ, other) for other in found.record) for λ in expected)


def test_murty_cycles_where_A_is_no_p_matrix():
    solution = murty(LCP([[1, 3], [3, 1]], (-1, -1)))
    assert solution.solved  # two pivots are enough for this one
    A = np.array([[1, 2, 0], [0, 1, 2], [2, 0, 1]]) @ np.diag([1, 1, -1])
    solution = murty(LCP(A, -np.ones(3)), max_iterations=10**6)
    assert solution.status in ("cycle", "unsuitable") and solution.iterations < 100


def test_what_is_too_large_is_said():
    solution = enumeration(problem_of("planted"))
    assert solution.status == "unsuitable" and "1.05e+06" in solution.reason
    large = LCP(scipy.sparse.eye_array(3001, format="csr"), -np.ones(3001))
    for method in PIVOTING:
        solution = method(large)
        assert solution.status == "unsuitable" and "3001" in solution.reason
        cone = method(problem_of("sliding_contact"))
        assert cone.status == "unsuitable" and "cone" in cone.reason


# --- bounds, friction, forms, units -------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(10))
def test_bounds_of_every_sort(seed):
    """Free rows, both bounds, one, equal ones: all methods agree with Gauss–Seidel on a positive A."""
    random, n = np.random.default_rng(seed), 9
    A, b = LCP_PROBLEMS["planted"](n=n, seed=seed).problem.A, 2 * random.normal(size=n)
    lower, upper = np.array(random_lcps.LIMITS)[random.integers(0, len(random_lcps.LIMITS), n)].T
    problem = LCP(A, b, lower, upper)
    expected = gauss_seidel(problem, tolerance=1e-12, max_iterations=20000)
    assert expected.solved
    for method in PIVOTING:
        solution = method(problem)
        assert solution.solved and np.allclose(solution.lam, expected.lam, atol=1e-9)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("mu", [0, 0.3, 0.9])
def test_friction(seed, mu):
    """Three contacts of (n, t): the answer is checked by the definition; by all methods it is the same."""
    A = LCP_PROBLEMS["planted"](n=6, seed=seed).problem.A + 2 * np.eye(6)
    b = np.random.default_rng(seed).normal(size=6) - np.array([2, 0, 2, 0, 2, 0])
    friction = [1, 3, 5], [0, 2, 4], mu
    problem = LCP(A, b, friction=friction)
    answers = [method(problem) for method in PIVOTING]
    for solution in answers:
        assert solution.solved, solution.reason
        assert random_lcps.is_answer(A, b, np.zeros(6), np.full(6, np.inf), friction, solution.lam)
        assert np.allclose(solution.lam, answers[0].lam, atol=1e-9)


def test_redundant_joints():
    """Two rows without bounds that say the same, beside a contact: λ isn't unique, w is."""
    J = np.array([[1.0, 0, 0], [1, 0, 0], [0, 1, 1]])
    problem = LCP(J @ J.T, [-1, -1, -2], lower=[-np.inf, -np.inf, 0])
    for method in (enumeration, dantzig, lemke):
        solution = method(problem)
        assert solution.solved and np.allclose(solution.lam[:2].sum(), 1) and np.allclose(solution.lam[2], 1)
    against = LCP(J @ J.T, [-1, -1.5, -2], lower=[-np.inf, -np.inf, 0])  # they contradict one another
    for method in (enumeration, dantzig, lemke):
        assert method(against).status == "infeasible"


@pytest.mark.parametrize("method", PIVOTING)
def test_sparse_and_factored(method):
    sparse, factored = problem_of("column", n=6), problem_of("column", n=6, factored=True)
    assert isinstance(factored.A, Factored)
    for problem in (sparse, factored):
        assert np.allclose(method(problem).lam, [6, 5, 4, 3, 2, 1], rtol=1e-13)


@pytest.mark.parametrize("method", PIVOTING)
@pytest.mark.parametrize("factor", [1e-12, 1e12])
def test_units_change_no_pivot(method, factor):
    known = LCP_PROBLEMS["planted"]("p", n=6 if method is enumeration else 10, seed=3)  # 3ⁿ pieces
    A, b = known.problem.A, known.problem.b
    one = method(LCP(A, b, upper=1.2))
    for problem, times in ((LCP(A, factor * b, upper=1.2 * factor), factor),
                           (LCP(factor * A, b, upper=1.2 / factor), 1 / factor)):  # fmt: skip
        other = method(problem)
        assert one.solved and other.solved and other.iterations == one.iterations
        assert np.allclose(other.lam, times * one.lam, rtol=1e-11, atol=0)


@pytest.mark.parametrize("method", PIVOTING)
@pytest.mark.parametrize("n", [0, 1])
def test_no_row_and_one(method, n):
    for b in (-2.0, 0.0, 3.0):
        solution = method(LCP(4 * np.eye(n), np.full(n, b)))
        assert solution.solved and np.allclose(solution.lam, max(0, -b / 4)) and len(solution.lam) == n
        assert len(solution.history) == 1 + (solution.iterations > 0)
    assert method(LCP(np.eye(n), np.ones(n), lower=2, upper=2)).solved
    assert method(LCP(np.eye(n), np.ones(n), lower=-np.inf)).solved


@pytest.mark.parametrize("method", [murty, dantzig, lemke])
def test_too_few_pivots_are_told(method):
    solution = method(problem_of("column", n=10), max_iterations=4)
    assert (
        solution.status == "max_iterations" and solution.iterations == 4 and "allow more" in solution.reason
    )
    assert method(problem_of("column", n=10), max_iterations=0).iterations == 0


def test_start():
    known = LCP_PROBLEMS["planted"](n=30, seed=5)
    assert murty(known.problem, start=known.answer).iterations == 0
    near = known.answer + 0.01 * (known.answer > 0)
    assert murty(known.problem, start=near).iterations < murty(known.problem).iterations
    with pytest.raises(ValueError, match="order must be one of"):
        dantzig(known.problem, order="best")
    with pytest.raises(ValueError, match="ties must be one of"):
        lemke(known.problem, ties="last")


def test_accuracy_where_gauss_seidel_has_none():
    """Top × 1000 on a column of 50: λ to ten digits, at 51 pivots."""
    known = LCP_PROBLEMS["column"](50, 1000)
    for method in (murty, dantzig, lemke):
        solution = method(known.problem)
        assert solution.solved and known.error(solution.lam) < 1e-10 and solution.iterations <= 51


# --- tableaux and kernels -----------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(5))
def test_exchange_keeps_the_equations(seed):
    random = np.random.default_rng(seed)
    T, x = random.normal(size=(4, 5)), random.normal(size=5)
    T[2, 2] = 0
    y = T @ x
    once = T.copy()
    exchange(once, 1, 3)
    swapped = x.copy()
    swapped[3] = y[1]
    expected = y.copy()
    expected[1] = x[3]
    assert np.allclose(once @ swapped, expected)
    exchange(once, 1, 3)
    assert np.allclose(once, T)
    exchange_pair(T, 2, 0)
    x[[0, 2]], y[[0, 2]] = y[[0, 2]], x[[0, 2]]
    assert np.allclose(T @ x, y)


@pytest.mark.parametrize("method", [murty, dantzig, lemke])
def test_record(method):
    known = LCP_PROBLEMS["planted"]("p", n=6, seed=2)
    solution = method(known.problem, record=True)
    assert len(solution.record) == solution.iterations + 1 and method(known.problem).record == []
    assert solution.iterations == method(known.problem).iterations
    last = solution.record[-1]
    values = dict(zip(last.rows, last.constants, strict=True))
    letter = "z" if method is lemke else "λ"
    for i, λ in enumerate(solution.lam):
        if f"{letter}_{i}" in values and method is not lemke:
            assert values[f"{letter}_{i}"] == pytest.approx(λ)
        assert (f"w_{i}" in values) != (f"{letter}_{i}" in values)
    for before, after in zip(solution.record, solution.record[1:], strict=False):
        gone = set(before.rows) - set(after.rows)
        assert len(gone) == 1 and gone <= set(after.columns)  # one leaves, and is nonbasic now
    text = str(solution.record[0])
    assert text.splitlines()[0].startswith("at first") and len(text.splitlines()) == 8 and "w_3" in text


def test_compiled_equals_plain():
    known = LCP_PROBLEMS["planted"]("p", n=12, seed=1)
    form = scaled(known.problem)
    both = []
    for kernel in (least_index, plain(least_index)):
        state = begin(form.A, form.b, form.lower, form.upper, np.zeros(12))
        both.append((state, kernel(state, 100)))
    assert both[0][1] == both[1][1]
    for one, other in zip(both[0][0], both[1][0], strict=True):
        assert np.allclose(one, other, rtol=1e-12, atol=1e-13)
    paths = []
    for kernel in (follow_path, plain(follow_path)):
        T = np.column_stack([form.A, np.ones(12), form.b])
        basic, nonbasic = np.arange(12), np.arange(12, 25)
        result = kernel(T, basic, nonbasic, np.array([12, 0, 2]), 100, True, np.full(12, -1))
        paths.append((result, T, basic))
    assert paths[0][0] == paths[1][0] and np.array_equal(paths[0][2], paths[1][2])
    assert np.allclose(paths[0][1], paths[1][1], rtol=1e-12, atol=1e-12)


def test_solvers_are_listed():
    assert set(SOLVERS) >= {"enumeration", "murty", "dantzig", "lemke", "gauss_seidel"}
