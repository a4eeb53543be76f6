"""All solvers over what is small, degenerate or in strange units: solved, or said in words why not."""

import numpy as np
import pytest

from reference.lcp import LCP, SOLVERS, ConeProblem

A, b = np.array([[2.0, 1], [1, 2]]), np.array([-5.0, -6])
PROBLEMS = {
    "one row": (LCP([[2.0]], [-3.0]), [1.5]),
    "bounds that coincide": (LCP(A, b, lower=[1, 0], upper=[1, np.inf]), [1, 2.5]),
    "all fixed": (LCP(A, b, lower=1, upper=1), [1, 1]),
    "no bounds": (LCP(A, b, lower=-np.inf), [4 / 3, 7 / 3]),
    "λ of 1e12": (LCP(1e-12 * A, b), [4e12 / 3, 7e12 / 3]),
    "λ of 1e-12": (LCP(1e12 * A, b), [4e-12 / 3, 7e-12 / 3]),
    "w of 1e12": (LCP(1e12 * A, 1e12 * b), [4 / 3, 7 / 3]),
}
FOR_CONES = "cone_gauss_seidel", "cone_apgd"


@pytest.mark.parametrize("name", sorted(SOLVERS))
def test_small_and_strange(name):
    """Well conditioned (3), so a residual of 1e-10 leaves λ right to 1e-9."""
    for what, (problem, answer) in PROBLEMS.items():
        solution = SOLVERS[name](problem)
        if name in FOR_CONES and what != "all fixed":  # that one λ⁰ solves
            assert solution.status == "unsuitable" and "friction cones" in solution.reason
        else:
            assert solution.solved, (what, solution.reason)
            assert np.allclose(solution.lam, answer, rtol=1e-9, atol=0), what


@pytest.mark.parametrize("name", sorted(SOLVERS))
def test_nothing_to_solve(name):
    for problem in (LCP(np.zeros((0, 0)), []), ConeProblem(np.zeros((0, 0)), [], [])):
        assert SOLVERS[name](problem).solved


@pytest.mark.parametrize("name", sorted(SOLVERS))
def test_what_a_method_cannot_treat_is_said(name):
    rubbing = LCP([[2.0, 0.5], [0.5, 2]], [-5.0, 6], friction=([1], [0], 0.5))
    skew = LCP([[2.0, 1.5], [0, 2]], b)
    for problem, words, refusing in (
        (rubbing, "friction", {"apgd", "interior_point", "cone_newton"}),
        (skew, "symmetric", {"apgd", "cone_newton"}),
    ):
        solution = SOLVERS[name](problem)
        assert solution.status == ("unsuitable" if name in refusing | {*FOR_CONES} else "solved")
        assert solution.solved or name in FOR_CONES or words in solution.reason.lower(), solution.reason


@pytest.mark.parametrize("name", sorted(SOLVERS))
def test_bad_arguments_are_named(name):
    problem = PROBLEMS["no bounds"][0]
    for key, bad in (
        ("start", [np.nan, 0.0]),
        ("start", [1.0, 2, 3]),
        ("tolerance", -1),
        ("tolerance", np.nan),
        ("max_iterations", -1),
        ("max_iterations", 1.5),
    ):
        with pytest.raises((ValueError, TypeError), match=key):
            SOLVERS[name](problem, **{key: bad})
    with pytest.raises(TypeError, match="problem"):
        SOLVERS[name](3)
