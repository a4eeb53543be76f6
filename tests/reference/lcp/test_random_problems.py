"""Thousands of small problems, singular, degenerate, unsolvable: no wrong answer called solved."""

import numpy as np
import pytest

import lcp_enumeration
from reference.lcp import LCP, SOLVERS, STATUSES

BOUNDS = (0, np.inf), (0, np.inf), (-np.inf, np.inf), (-1, 1), (0, 2), (1, 1), (-np.inf, 0)


def random_problem(random):
    """(A, b, lower, upper) of one to five rows, of small whole numbers or not, scaled by 1e±8."""
    n = int(random.integers(1, 6))
    A, b = random.integers(-3, 4, size=(n, n)).astype(float), random.integers(-3, 4, size=n).astype(float)
    if random.random() < 0.5:
        A = A[:, : random.integers(1, n + 1)]
        A = A @ A.T
    if random.random() < 0.3:
        A, b = A + 0.1 * random.normal(size=(n, n)), b + random.normal(size=n)
    lower, upper = np.transpose([BOUNDS[k] for k in random.integers(0, len(BOUNDS), size=n)])
    if random.random() < 0.5:
        lower, upper = np.zeros(n), np.full(n, np.inf)
    return A, b, lower.astype(float), upper.astype(float)


@pytest.mark.parametrize("name", sorted(SOLVERS))
@pytest.mark.parametrize(
    "count",
    [60, pytest.param(300, marks=pytest.mark.slow), pytest.param(3000, marks=pytest.mark.study)],
)
def test_no_wrong_answer_is_called_solved(name, count):
    random = np.random.default_rng(8)
    for k in range(count):
        A, b, lower, upper = random_problem(random)
        scale = 10.0 ** random.integers(-8, 9) if k % 3 == 0 and not np.isfinite(upper).any() else 1.0
        solution = SOLVERS[name](LCP(A, scale * b, lower, upper), max_iterations=60)
        assert solution.status in STATUSES and solution.solved == (solution.residual <= 1e-10)
        if solution.solved:
            size = 1 + np.abs(solution.lam / scale).max()
            assert lcp_enumeration.nearly(A, b, lower, upper, solution.lam / scale, 1e-7 * size), (k, A, b)
        if solution.status == "infeasible" and solution.certificate is not None:
            assert not lcp_enumeration.solutions(A, b, lower, upper), (k, A, b)
