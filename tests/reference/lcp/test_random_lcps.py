"""Random LCPs through every solver: nothing wrong is called solved, nothing raises, proofs prove."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import random_lcps
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import LCP, SOLVERS, STATUSES

PIVOTING = "murty", "dantzig", "lemke"
SHORT = {
    "min_map_newton": 20,
    "fischer_newton": 20,
}  # most solve it in 10; line searches that don't take long


def solve_all(problem):
    """name -> Solution of every solver."""
    return {name: solver(problem, max_iterations=SHORT.get(name, 200)) for name, solver in SOLVERS.items()}


def judge(seed, brute_force=True):
    """Every solver on one random problem; returns name -> status. brute_force: search for solutions, too."""
    A, b, lower, upper, friction, kind = random_lcps.parts(seed)
    solutions = solve_all(LCP(A, b, lower, upper, friction=friction))
    status = {name: solution.status for name, solution in solutions.items()}
    most, judged = random_lcps.largest_gap(A, b, lower, upper, friction), set()
    for name, solution in solutions.items():
        assert solution.status in STATUSES and len(solution.reason) > 30, f"seed {seed}, {name}"
        if solution.solved:
            assert solution.residual <= 1e-10, f"seed {seed}, {name}"
            if solution.lam.tobytes() not in judged:  # several solvers often end in the same digits
                right = random_lcps.is_answer(A, b, lower, upper, friction, solution.lam, most)
                assert right, f"seed {seed}, {name}: λ = {solution.lam}"
            judged.add(solution.lam.tobytes())
    assert not {"solved", "infeasible"} <= set(status.values()), f"seed {seed}: {status}"
    if brute_force and {"solved", "infeasible"} & set(status.values()):
        found = random_lcps.solvable(A, b, lower, upper, friction)
        assert found == ("solved" in status.values()), f"seed {seed}: {status}"
    check_proofs(seed, solutions, A, b, lower, upper, friction)
    if friction is None and kind == "p":
        check_unique(seed, solutions, A, b, lower, upper)
    return status


def check_unique(seed, solutions, A, b, lower, upper):
    """A is positive definite, so a P-matrix: pivoting solves it, and all that is called solved is one λ."""
    pivoting = [solutions[name] for name in (*PIVOTING, "enumeration")]
    assert all(solution.solved for solution in pivoting), f"seed {seed}: {pivoting}"
    size = max(np.abs(solution.lam).max(initial=0) for solution in pivoting)
    within = random_lcps.farthest(A, b, lower, upper, pivoting[0].lam)
    for one, other in itertools.combinations((s for s in solutions.values() if s.solved), 2):
        apart = np.linalg.norm(one.lam - other.lam)
        assert apart <= 2 * within, f"seed {seed}: {one.lam} and {other.lam}"
    if len(b):
        for one, other in itertools.pairwise(pivoting):
            assert np.abs(one.lam - other.lam).max() <= 1e-9 * np.linalg.cond(A) * size, f"seed {seed}"


def check_proofs(seed, solutions, A, b, lower, upper, friction):
    """Certificates prove what they say: by planes for each cone, or by a linear program."""
    for name, solution in solutions.items():
        if solution.status != "infeasible":
            continue
        if "M" in solution.certificate:
            check_planes(seed, solution.certificate)
        elif friction is None:
            assert random_lcps.nothing_feasible(A, b, lower, upper), f"seed {seed}, {name}: {solution.lam}"


def check_planes(seed, proof):
    """y · column ≥ 0 for the columns of each cone and y · q < 0, so no combination ≥ 0 of them is q.

    Rounding leaves y · column at −ε. Then a combination x is only shut out while ε Σx < −y · q: so no x
    smaller than a million times q is asked, beside columns of about 1.
    """
    M, q = proof["M"], proof["q"]
    for on, y in zip(proof["z_may_be_positive"], proof["y"], strict=True):
        below = max(0.0, -(y @ np.where(on, -M, np.eye(len(on)))).min())
        assert -(y @ q) > 1e6 * below * np.abs(q).max(), f"seed {seed}: {y}"


@pytest.mark.parametrize("block", range(6))
def test_nothing_wrong_is_called_solved(block):
    for k in range(200):
        judge([block, k], brute_force=k % 10 == 0)


@pytest.mark.parametrize("k", [5977, 14624, 62484])
def test_seeds_that_told_something(k):
    """λ⁰ all but right, its residual mere rounding; rows that contradict each other, hidden by λ = 7e15;
    rows whose b are 1e6 apart, where a plane of ``enumeration`` was 3e-10 off.
    """
    judge([99, k])


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=150, deadline=None)
def test_whatever_the_seed(seed):
    judge(seed)


@pytest.mark.study
def test_a_hundred_thousand():
    """100,000 problems, 9 minutes or more; prints how often each solver ended in which way."""
    count = {}
    for k in range(100_000):
        for name, status in judge([99, k], brute_force=k % 10 == 0).items():
            count[name, status] = count.get((name, status), 0) + 1
    for (name, status), times in sorted(count.items()):
        print(f"{name:15} {status:15} {times}")


@pytest.mark.parametrize("unit", [1e-12, 1.0, 1e12])
@pytest.mark.parametrize("name", sorted(SOLVERS))
def test_a_row_of_zeros_in_any_units(name, unit):
    """w_1 = 2 whatever λ is, so λ_1 must be at its lower bound; beside λ_0 of 1e12 the residual wouldn't see
    that it isn't.
    """
    A, b, lower, upper = (
        np.diag([1 / unit, 0]),
        np.array([-1.0, 2]),
        np.array([0, -unit]),
        np.array([np.inf, unit]),
    )
    problem = LCP(A, b, lower, upper)
    assert problem.residual([unit, 0.0]) < 1e-10 or unit < 1e12
    for start in (None, [unit, 0.0], [unit, unit]):
        solution = SOLVERS[name](problem, start)
        assert not solution.solved or random_lcps.is_answer(A, b, lower, upper, None, solution.lam)
    if name in ("enumeration", "dantzig", "lemke", "min_map_newton", "fischer_newton"):
        assert solution.solved and len(solution.record) <= 1
    assert not SOLVERS[name](LCP(A, b, [0, -np.inf], upper)).solved


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("n", [5, 20, 60])
def test_pivoting_always_solves_p_matrices_and_agrees(n, seed):
    random = np.random.default_rng([n, seed])
    A = LCP_PROBLEMS["planted"](("pd", "p")[seed % 2], n=n, seed=seed).problem.A
    b = random.normal(size=n) if seed % 3 else random.integers(-1, 2, n).astype(float)
    boxed = {"lower": -random.random(n), "upper": np.where(random.random(n) < 0.3, np.inf, random.random(n))}
    for bounds in ({}, boxed):
        problem = LCP(A, b, **bounds)
        answers = [SOLVERS[name](problem, max_iterations=10**6) for name in PIVOTING]
        answers.append(SOLVERS["dantzig"](problem, order="worst"))
        assert all(solution.solved for solution in answers), [solution.reason for solution in answers]
        size = np.abs(answers[0].lam).max()
        for one, other in itertools.pairwise(answers):
            assert np.abs(one.lam - other.lam).max() <= 1e-9 * np.linalg.cond(A) * size


@pytest.mark.parametrize("kind", ["psd", "copositive"])
@pytest.mark.parametrize("seed", range(15))
def test_lemke_solves_what_theory_says(kind, seed):
    """Planted, so solvable: Lemke's method must find a solution, since these are copositive-plus or strictly
    copositive; and Dantzig's where A is semidefinite.
    """
    problem = LCP_PROBLEMS["planted"](kind, n=5 + 3 * seed, seed=seed).problem
    assert SOLVERS["lemke"](problem).solved
    if kind == "psd":
        assert SOLVERS["dantzig"](problem).solved
