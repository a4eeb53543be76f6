"""Random LCPs through every solver: nothing wrong is called solved, nothing raises, proofs prove."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import lcp_enumeration
import random_lcps
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import LCP, SOLVERS, STATUSES

PIVOTING = "murty", "dantzig", "lemke"
ITERATIONS = {"max_iterations": 200}


def solve_all(problem):
    """name -> Solution of every solver that takes an LCP."""
    return {name: solver(problem, **ITERATIONS) for name, solver in SOLVERS.items()}


def judge(seed, brute_force=True):
    """Every solver on one random problem; returns name -> status."""
    A, b, lower, upper, friction, kind = random_lcps.parts(seed)
    solutions = solve_all(LCP(A, b, lower, upper, friction=friction))
    for name, solution in solutions.items():
        where = f"seed {seed}, {name}: {solution}"
        assert solution.status in STATUSES and len(solution.reason) > 30, where
        assert solution.solved == (solution.residual <= 1e-10), where
        if solution.solved:
            assert random_lcps.is_answer(A, b, lower, upper, friction, solution.lam), where
    status = {name: solution.status for name, solution in solutions.items()}
    if "infeasible" in status.values():
        assert "solved" not in status.values(), f"seed {seed}: {status}"
        if friction is None and brute_force:
            assert not meaningful(A, lcp_enumeration.solutions(A, b, lower, upper)), f"seed {seed}: {status}"
    check_proofs(seed, solutions, A, b, lower, upper, friction)
    if friction is None and kind == "p":
        assert all(status[name] == "solved" for name in (*PIVOTING, "enumeration")), f"seed {seed}: {status}"
    return status


def meaningful(A, solutions):
    """Those solutions that rounding didn't make: where A is singular but for its last digits, there may be
    one at λ of 1e16.
    """
    return [λ for λ in solutions if regular(A, np.flatnonzero(np.array(λ, dtype=float)))]


def regular(A, on):
    sizes = np.linalg.svd(A[np.ix_(on, on)], compute_uv=False) if len(on) else np.ones(1)
    return sizes[-1] > 1e-12 * sizes[0]


def check_proofs(seed, solutions, A, b, lower, upper, friction):
    for name, solution in solutions.items():
        if solution.status != "infeasible":
            continue
        if name == "enumeration":
            proof = solution.certificate
            for on, y in zip(proof["z_may_be_positive"], proof["y"], strict=True):
                cone = np.where(on, -proof["M"], np.eye(len(on)))
                assert (y @ cone).min() >= -1e-8 * np.abs(y).max() and y @ proof["q"] < 0, f"seed {seed}"
        elif friction is None:
            assert random_lcps.nothing_feasible(A, b, lower, upper), f"seed {seed}, {name}: {solution}"


@pytest.mark.parametrize("block", range(6))
def test_nothing_wrong_is_called_solved(block):
    for k in range(200):
        judge([block, k], brute_force=k % 10 == 0)


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
