"""Conjugate and accelerated gradients: the counts of CASES.md, and what they can and can't do."""

import numpy as np
import pytest
import scipy.sparse

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.compiled import plain
from reference.factored import Factored
from reference.lcp import LCP, apgd, gauss_seidel, nncg
from reference.lcp.apgd import accelerate, clip_all, keep
from reference.lcp.gauss_seidel import natural_order
from reference.lcp.merit import merit
from reference.lcp.nncg import conjugate_sweeps
from reference.lcp.operators import arrays, change_matrix, follow_matrix, for_form, row_matrix, rows_matrix

METHODS = nncg, apgd
PIECES = follow_matrix, row_matrix, rows_matrix, change_matrix


@pytest.mark.parametrize(
    ("method", "n", "heavy", "published"),
    [(nncg, 10, 1, 77), (nncg, 20, 1, 159), (nncg, 10, 100, 388),
     (apgd, 10, 1, 147), (apgd, 20, 1, 247), (apgd, 10, 100, 480)],
)  # fmt: skip
def test_iterations_down_a_column(method, n, heavy, published):
    """CASES.md's counts are for other details of the same methods: ours may be fewer, and a little more."""
    known = LCP_PROBLEMS["column"](n, heavy)
    solution = method(known.problem, tolerance=1e-6)
    assert solution.solved and 0.6 * published < solution.iterations < 1.05 * published
    assert (
        solution.iterations < gauss_seidel(known.problem, tolerance=1e-6, max_iterations=20000).iterations / 3
    )
    assert known.error(method(known.problem, tolerance=1e-12, max_iterations=5000).lam) < 1e-9


@pytest.mark.parametrize("method", METHODS)
def test_every_form_of_A_gives_the_same(method):
    known = LCP_PROBLEMS["planted"](n=15)
    A, b = known.problem.A, known.problem.b
    for extra in ({}, {"lower": -1, "upper": 0.5}):
        forms = A, scipy.sparse.coo_array(A), Factored.from_matrices(np.linalg.cholesky(A), np.ones(15))
        results = [method(LCP(form, b, **extra), max_iterations=9, tolerance=1e-30) for form in forms]
        for result in results:
            assert np.allclose(result.lam, results[0].lam, rtol=1e-9, atol=1e-10)
            assert np.allclose(result.history, results[0].history, rtol=1e-7, atol=1e-10)
        assert method(LCP(A, b, **extra)).solved


@pytest.mark.parametrize("method", METHODS)
def test_history_is_the_residual_of_each_iterate(method):
    problem = LCP_PROBLEMS["column"](6).problem
    whole = method(problem, max_iterations=8, tolerance=1e-30)
    for k in range(9):
        assert whole.history[k] == pytest.approx(method(problem, max_iterations=k, tolerance=1e-30).residual)


def test_friction_goes_row_by_row():
    A = LCP_PROBLEMS["planted"](n=9).problem.A
    problem = LCP(A, np.random.default_rng(0).normal(size=9) - 1, friction=([1, 2, 4], [0, 0, 3], 0.4))
    slow, fast = gauss_seidel(problem, max_iterations=20000), nncg(problem)
    assert fast.solved and np.allclose(slow.lam, fast.lam, atol=1e-7)
    refused = apgd(problem)
    assert refused.status == "unsuitable" and "friction" in refused.reason


def test_what_they_cannot_do_is_said():
    assert apgd(LCP_PROBLEMS["kostreva"]().problem).status == "unsuitable"  # not symmetric
    assert nncg(LCP_PROBLEMS["zero_diagonal"]().problem).status == "unsuitable"
    for method in METHODS:
        assert not method(LCP_PROBLEMS["no_solution"]().problem).solved
        assert not method(LCP_PROBLEMS["murty_2_8"]().problem).solved
        assert method(LCP_PROBLEMS["sliding_contact"]().problem).status == "unsuitable"
        assert method(LCP_PROBLEMS["redundant"]().problem).solved  # singular, and no harm


@pytest.mark.parametrize("factor", [1e-12, 1e12])
@pytest.mark.parametrize("method", METHODS)
def test_units_change_nothing(method, factor):
    known = LCP_PROBLEMS["planted"]()
    one, scaled = (method(LCP(known.problem.A, f * known.problem.b)) for f in (1, factor))
    assert one.solved and scaled.solved and abs(one.iterations - scaled.iterations) <= 1
    units = 10.0 ** np.arange(-6, 14)[:20]
    turned = method(LCP(known.problem.A * units * units[:, None], known.problem.b * units))
    assert turned.iterations <= 2 * one.iterations  # rows of torques beside rows of forces


def test_compiled_equals_plain(monkeypatch):
    problem = LCP_PROBLEMS["planted"](n=8).problem
    A = arrays(problem.A)
    both = (
        (conjugate_sweeps, (), (natural_order(problem),)),
        (accelerate, (clip_all, merit, keep), (problem.terms.d,)),
    )
    for method, functions, options in both:
        inside = plain(method).__globals__
        helpers = [name for name in ("sweep_once", "product", "first_slope", "go_ahead") if name in inside]
        λ, history, λ_2, history_2 = np.zeros(8), np.zeros(9), np.zeros(8), np.zeros(9)
        rest = problem.scale, 1e-30
        with monkeypatch.context() as plainly:  # functions that take functions can't be called compiled
            for name in helpers:
                plainly.setitem(inside, name, plain(inside[name]))
            plain(method)(*map(plain, PIECES + functions), A, problem.terms, λ, *rest, history, *options)
        for_form(method, type(A), *functions)(A, problem.terms, λ_2, *rest, history_2, *options)
        assert np.allclose(λ, λ_2, rtol=1e-12, atol=1e-15)
        assert np.allclose(history, history_2, rtol=1e-9, atol=1e-14)
