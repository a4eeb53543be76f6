"""The catalogue: each answer is one, by the definition and not by our own measure; each claim holds."""

import numpy as np
import pytest

import lcp_enumeration
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import LCP


def dense(problem):
    return problem.A if isinstance(problem.A, np.ndarray) else problem.A.toarray()


@pytest.mark.parametrize("name", LCP_PROBLEMS)
def test_answers_are_answers(name):
    known = LCP_PROBLEMS[name]()
    assert known.source and known.what_is_hard
    if known.answer is None:
        return
    assert known.error(known.answer) == 0 and known.problem.residual(known.answer) < 1e-14
    if isinstance(known.problem, LCP) and not known.problem.has_friction:
        A, b = dense(known.problem), known.problem.b
        assert lcp_enumeration.nearly(A, b, known.problem.lower, known.problem.upper, known.answer, 1e-9)


@pytest.mark.parametrize(
    ("name", "count"),
    [("easy", 1), ("kostreva", 1), ("murty_2_8", 1), ("jacobi_fails", 1), ("zero_diagonal", 1),
     ("no_solution", 0), ("several_solutions", 3)],
)  # fmt: skip
def test_number_of_solutions(name, count):
    known = LCP_PROBLEMS[name]()
    problem = known.problem
    found = lcp_enumeration.solutions(problem.A, problem.b, problem.lower, problem.upper)
    assert len({tuple(λ) for λ in found}) == count
    assert known.solvable == (count > 0)
    if known.answer is not None:
        assert np.allclose(np.array(found[0], dtype=float), known.answer, rtol=1e-14)


@pytest.mark.parametrize("law", ["ncp", "ccp"])
def test_sliding_contact(law):
    assert (
        LCP_PROBLEMS["sliding_contact"](law).problem.residual(LCP_PROBLEMS["sliding_contact"](law).answer)
        < 1e-15
    )


def test_painleve_stops_the_tip():
    """Enumeration finds λ, which is not unique, and with each the velocity that CASES.md gives, v_t = 0."""
    problem = LCP_PROBLEMS["painleve"]().problem
    found = lcp_enumeration.solutions(problem.A, problem.b, problem.lower, problem.upper)
    assert len(found) > 1
    for λ in found:
        λ = np.array(λ, dtype=float)
        assert abs(problem.A[1] @ λ + problem.b[1] - λ[3]) < 1e-12  # row 1 is v_t + σ, and σ = |v_t| = 0


def test_column_is_the_scene_it_says():
    A = dense(LCP_PROBLEMS["column"](4, 10).problem)
    assert np.allclose(A, [[1, -1, 0, 0], [-1, 2, -1, 0], [0, -1, 2, -1], [0, 0, -1, 1.1]])
    assert np.array_equal(LCP_PROBLEMS["column"](4, 10).answer, [13, 12, 11, 10])
    factored = LCP_PROBLEMS["column"](4, 10, factored=True).problem.A
    assert np.allclose(factored @ np.arange(4.0), A @ np.arange(4.0))


@pytest.mark.parametrize("kind", ["pd", "psd", "p", "copositive"])
@pytest.mark.parametrize("seed", range(3))
def test_planted_matrices_are_of_their_kind(kind, seed):
    A = LCP_PROBLEMS["planted"](kind, n=7, seed=seed).problem.A
    eigenvalues = np.linalg.eigvalsh(A + A.T)
    if kind == "psd":
        assert np.linalg.matrix_rank(A) == 3 and eigenvalues[0] > -1e-12
    elif kind == "copositive":
        assert A.min() >= 0
    else:
        assert eigenvalues[0] > 0.1 and np.allclose(A, A.T) == (kind == "pd")


def test_unknown_names_are_told():
    with pytest.raises(KeyError, match="problem must be one of easy"):
        LCP_PROBLEMS["nothing"]
    with pytest.raises(ValueError, match="kind must be one of"):
        LCP_PROBLEMS["planted"]("odd")
