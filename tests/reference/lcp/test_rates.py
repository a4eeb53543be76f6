"""Rates: closed forms of the literature, the spectrum, and what is measured, within 2 % (S15, S16)."""

import numpy as np
import pytest

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import LCP, SOLVERS, block_gauss_seidel, gauss_seidel, jacobi, sor
from reference.lcp.rates import best_omega, error_matrix, measured_rate, rate, sor_rate, sweeps_for


def slowness(ρ):
    """−ln ρ, which a number of sweeps is made of: 2 % of it is sharper than 2 % of ρ."""
    return -np.log(ρ)


@pytest.mark.parametrize("n", [4, 10, 20])
def test_a_column_in_closed_form(n):
    problem = LCP_PROBLEMS["column"](n).problem
    ρ = np.cos(np.pi / (2 * n))
    best = 2 / (1 + np.sin(np.pi / (2 * n)))
    assert rate(problem, "jacobi") == pytest.approx(ρ, rel=1e-9)
    assert rate(problem) == pytest.approx(ρ**2, rel=1e-9)
    assert best_omega(ρ) == pytest.approx(best, rel=1e-12)
    assert sor_rate(ρ, best) == pytest.approx(best - 1, rel=1e-6)
    assert sor_rate(ρ, 1.9) == pytest.approx(0.9) and sor_rate(ρ, 1) == pytest.approx(ρ**2)
    for ω in (0.5, 1.2, 1.5, 1.9):
        assert rate(problem, "sor", omega=ω) == pytest.approx(sor_rate(ρ, ω), rel=1e-6)
    assert rate(problem, "sor", omega=best) == pytest.approx(best - 1, rel=1e-6)


@pytest.mark.parametrize("n", [5, 10, 20])
def test_a_column_measured(n):
    problem, ρ = LCP_PROBLEMS["column"](n).problem, np.cos(np.pi / (2 * n))
    for method, predicted in ((jacobi, ρ), (gauss_seidel, ρ**2)):
        measured = measured_rate(method(problem, max_iterations=10_000), 20)
        assert slowness(measured) == pytest.approx(slowness(predicted), rel=0.02)
    best = best_omega(ρ)
    solution = sor(problem, tolerance=1e-12, omega=best)
    k = solution.iterations  # the largest eigenvalue is a double one, so that the error goes as k ρᵏ
    measured = measured_rate(solution, k // 2) / 2 ** (1 / (k - k // 2))
    assert measured == pytest.approx(best - 1, rel=0.02)


@pytest.mark.parametrize("ratio", [1, 10, 100])
def test_heavy_on_light(ratio):
    problem = LCP_PROBLEMS["heavy_on_light"](ratio).problem
    assert rate(problem) == pytest.approx(ratio / (1 + ratio), rel=1e-9)
    measured = measured_rate(gauss_seidel(problem, max_iterations=10_000))
    assert slowness(measured) == pytest.approx(slowness(ratio / (1 + ratio)), rel=0.02)


@pytest.mark.parametrize(
    ("n", "heavy", "counts"), [(10, 1, (493, 166)), (20, 1, (1865, 652)), (10, 100, (10801, 3808))]
)
def test_counts_of_the_literature(n, heavy, counts):
    """CASES.md: sweeps to 1e-6, Gauss–Seidel and SOR(1.5)."""
    problem = LCP_PROBLEMS["column"](n, heavy).problem
    assert (
        tuple(sor(problem, tolerance=1e-6, max_iterations=20_000, omega=ω).iterations for ω in (1, 1.5))
        == counts
    )


SPLITTINGS = (
    "jacobi", "damped_jacobi", "gauss_seidel", "symmetric_gauss_seidel", "sor", "red_black", "block_jacobi",
    "block_gauss_seidel",
)  # fmt: skip


@pytest.mark.parametrize("name", SPLITTINGS)
def test_every_splitting_measured(name):
    problem = LCP_PROBLEMS["column"](10).problem
    solution = SOLVERS[name](problem, tolerance=1e-12, max_iterations=20_000)
    measured = measured_rate(solution, solution.iterations // 2)
    assert slowness(measured) == pytest.approx(slowness(rate(problem, name)), rel=0.02)


@pytest.mark.parametrize("aspect", [0.1, 3, 10, 30])
@pytest.mark.parametrize("inertia", [1, 0.1, 0.01])
def test_long_narrow_objects_and_small_inertia(aspect, inertia):
    """One box on two contacts: ρ = ((1 − κ)/(1 + κ))², κ = m r²/I (S15)."""
    problem = LCP_PROBLEMS["tower"](1, aspect, inertia).problem
    κ = 3 / (1 + aspect**2) / inertia
    predicted = ((1 - κ) / (1 + κ)) ** 2
    assert rate(problem) == pytest.approx(predicted, rel=1e-6)
    solution = gauss_seidel(problem, max_iterations=100_000)
    assert solution.solved
    if 0.3 < predicted:
        assert slowness(measured_rate(solution, 4)) == pytest.approx(slowness(predicted), rel=0.02)


@pytest.mark.parametrize(("aspect", "inertia"), [(1, 1), (10, 1), (1, 0.02)])
def test_blocks_of_a_support_forget_aspect_and_inertia(aspect, inertia):
    """The two contacts below a box as one block: a tower is a column again."""
    problem = LCP_PROBLEMS["tower"](5, aspect, inertia).problem
    blocks = np.arange(10) // 2
    assert rate(problem, "block_gauss_seidel", blocks=blocks) == pytest.approx(np.cos(np.pi / 10) ** 2)
    solution = block_gauss_seidel(problem, blocks=blocks, inner=10_000)
    assert slowness(measured_rate(solution)) == pytest.approx(slowness(np.cos(np.pi / 10) ** 2), rel=0.02)
    assert rate(problem) > rate(problem, "block_gauss_seidel", blocks=blocks)
    assert rate(problem, "jacobi") > 1 and jacobi(problem).status == "diverged"


def test_rows_at_a_bound_are_left_out():
    known = LCP_PROBLEMS["planted"](n=40, seed=4)
    free = known.answer > 0
    A = known.problem.A[np.ix_(free, free)]
    by_hand = np.linalg.solve(np.tril(A), -np.triu(A, 1))
    assert np.allclose(error_matrix(known.problem, free=free), by_hand)
    assert rate(known.problem, free=free) == pytest.approx(np.abs(np.linalg.eigvals(by_hand)).max())


def test_a_small_residual_may_leave_all_of_it_wrong():
    """50 boxes, the top one × 1000: r below a thousandth of the largest λ, and λ is 97 % wrong."""
    known = LCP_PROBLEMS["column"](50, 1000)
    solution = gauss_seidel(known.problem, max_iterations=1000)
    r = known.problem.residual(solution.lam) * known.problem.scale
    assert r < 1e-3 * solution.lam.max() and known.error(solution.lam) > 0.96
    assert rate(known.problem) > 0.9999


def test_sweeps_for():
    assert sweeps_for(0.1, 1e-6) == pytest.approx(6) and sweeps_for(1) == np.inf and sweeps_for(0) == 1


def test_bad_arguments():
    problem = LCP_PROBLEMS["column"](4).problem
    for arguments, error, words in (
        ({"method": "lemke"}, ValueError, "method must be one of"),
        ({"free": [1, 0, 1, 1]}, ValueError, "free must be 4 booleans"),
        ({"problem": LCP([[0, 1], [1, 0]], [1, 1])}, ValueError, "positive diagonal"),
        ({"problem": np.eye(2)}, TypeError, "must be an LCP"),
    ):
        with pytest.raises(error, match=words):
            rate(**{"problem": problem, **arguments})
    with pytest.raises(ValueError, match="jacobi_rate must be below 1"):
        best_omega(1)
    assert np.isnan(measured_rate(gauss_seidel(problem, max_iterations=3), 10))
