"""What is called solved: only what the problem itself confirms."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

from reference.factored import Factored
from reference.lcp import LCP, SOLVERS, STATUSES, ConeProblem
from reference.lcp.solution import MAX_ITERATIONS, RAY, SOLVED, finish

PROBLEM = LCP([[2, 1], [1, 2]], (-5, -6))
RIGHT, WRONG = np.array([4 / 3, 7 / 3]), np.array([1.0, 1.0])


@pytest.mark.parametrize("believed", STATUSES)
def test_wrong_is_never_solved_and_right_always(believed):
    wrong, right = (finish(PROBLEM, λ, 3, believed, 1e-10) for λ in (WRONG, RIGHT))
    assert not wrong.solved and wrong.status != "solved" and wrong.residual > 0.1
    assert right.solved and right.status == "solved" and right.residual <= 1e-10
    assert wrong.reason.endswith(".") and "{" not in wrong.reason


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e308])
def test_what_is_not_finite_is_never_solved(value):
    solution = finish(PROBLEM, [value, value], 3, SOLVED, 1e-10)
    assert not solved_or_nan(solution) and solution.status == "diverged" and solution.residual == np.inf


def solved_or_nan(solution):
    return solution.solved or np.isnan(solution.residual)


def test_what_it_holds():
    λ = WRONG.copy()
    solution = finish(PROBLEM, λ, 2, MAX_ITERATIONS, 1e-6, history=[1, 0.5, 7])
    λ[:] = 9
    assert np.array_equal(solution.lam, WRONG) and np.allclose(solution.w, [-2, -3])
    assert solution.history[-1] == solution.residual and len(solution.history) == 3
    assert (solution.tolerance, solution.iterations) == (1e-6, 2)
    assert finish(PROBLEM, WRONG, 2, RAY, 1e-6, certificate={"ray": λ}).certificate["ray"] is λ
    assert finish(PROBLEM, WRONG, 2, RAY, 1e-6, reason="Because {so}.").reason == "Because {so}."
    assert finish(PROBLEM, RIGHT, 2, RAY, 1e-6, reason="Because.").reason != "Because."
    assert len(finish(PROBLEM, RIGHT, 5, SOLVED, 1e-6).history) == 2


def test_a_row_of_zeros_that_no_force_makes_right_is_never_solved():
    """Beside λ of 1e11 its w = −2 looks small; yet nothing can be done about it."""
    A, b = np.diag([4e-11, 0, 0]), np.array([-3.0, -2, -1])
    solution = finish(LCP(A, b), [7.5e10, 0, 0], 1, "solved", 1e-10)
    assert solution.status == "infeasible" and "Row 1 of A is 0" in solution.reason
    y = solution.certificate["y"]
    assert (y >= 0).all() and (y @ A <= 0).all() and y @ b < 0
    assert finish(LCP(A, [-3.0, 2, 1]), [7.5e10, 0, 0], 1, "solved", 1e-10).solved
    assert finish(LCP(A, b, upper=[np.inf, 5, 5]), [7.5e10, 5, 5], 1, "solved", 1e-10).solved


def test_what_rounding_could_hide_is_never_solved():
    """Two rows ask λ_0 + λ_1 = 0 and = 1/3. Beside 7e15, where doubles are 1 apart, and 3 λ is rounded to 4,
    both may seem right.
    """
    problem = LCP([[1, 1], [3, 3]], [0, -1], lower=-np.inf)
    many = np.outer(7e15 + np.arange(1000), [-1, 1])
    λ = next(λ for λ in many if problem.residual(λ) <= 1e-10)
    solution = finish(problem, λ, 1, SOLVED, 1e-10)
    assert solution.status == "diverged" and "as large as 7e+15" in solution.reason
    assert finish(problem, λ, 1, MAX_ITERATIONS, 1e-10).status == "max_iterations"
    assert finish(problem, λ, 1, "infeasible", 1e-10, reason="No.").reason == "No."
    for name in ("interior_point", "lemke", "enumeration", "dantzig", "fischer_newton"):
        assert not SOLVERS[name](problem).solved
        assert not SOLVERS[name](problem, λ).solved


@pytest.mark.parametrize("form", ["dense", "sparse", "factored"])
def test_what_rounding_could_hide_in_every_form(form):
    """A rod between two walls, pushed by 1: λ_0 − λ_1 = 1 has a line of solutions, far out on which nothing
    can be told from the numbers.
    """
    J = np.array([[1.0], [-1.0]])
    A = {"dense": J @ J.T, "sparse": scipy.sparse.csr_array(J @ J.T)}
    problem = LCP(A.get(form, Factored.from_matrices(J, [1.0])), [-1.0, 1.0])
    for size, solved in ((0, True), (1e4, True), (1e8, False), (1e16, False)):
        assert finish(problem, [1 + size, size], 1, SOLVED, 1e-10).solved == solved
    assert np.array_equal(problem.rounding(np.array([3.0, -2.0])), np.finfo(float).eps * np.full(2, 6.0))


def test_numbers_far_apart_are_no_reason_where_the_problem_is_made_of_them():
    """λ⁰ = (0, 1e8) is as good as right, so that its residual is mere rounding, and no measure for others."""
    A, b = np.array([[1.1e-7, 3e-8], [1e-8, 5e-8]]), [-3.0, 3.0]
    assert 0 < LCP(A, b, [-np.inf, 1e8], [np.inf, 1e8]).scale < 1e-8
    assert SOLVERS["lemke"](LCP(A, b, [-np.inf, 1e8], [np.inf, 1e8])).solved
    for unit in (1e-12, 1.0, 1e12):
        ill = LCP(scipy.linalg.hilbert(5) / unit, -np.ones(5))  # condition number 5e5
        assert SOLVERS["lemke"](ill).solved and SOLVERS["interior_point"](ill).solved


def test_unseen_cones():
    """The same for a cone: two contacts between which any force can be shut in."""
    block = np.array([[1.0, 0, 0, -1, 0, 0]])
    A = block.T @ block + np.diag([0, 1.0, 1, 0, 1, 1])
    problem = ConeProblem(A, [-1.0, 0, 0, 1, 0, 0], 0.5)
    for size, solved in ((0, True), (1e4, True), (1e8, False)):
        assert finish(problem, [1 + size, 0, 0, size, 0, 0], 1, SOLVED, 1e-10).solved == solved
