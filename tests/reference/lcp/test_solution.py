"""What is called solved: only what the problem itself confirms."""

import numpy as np
import pytest

from reference.lcp import LCP, STATUSES
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
