"""Lemke's method beside QuantEcon's compiled one, where it is installed: same pivots, same λ, and time.

It is not among the course's requirements: it would bring SymPy and more along for this one comparison.
"""

import time

import numpy as np
import pytest

from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.lcp import LCP, lemke

lcp_lemke = pytest.importorskip("quantecon.optimize", reason="QuantEcon is not installed").lcp_lemke


@pytest.mark.parametrize("kind", ["pd", "p"])
@pytest.mark.parametrize("n", [5, 40, 120])
def test_same_path(kind, n):
    for seed in range(5):
        known = LCP_PROBLEMS["planted"](kind, n=n, seed=seed)
        ours, theirs = lemke(known.problem), lcp_lemke(known.problem.A, known.problem.b)
        assert ours.solved and theirs.success and ours.iterations == theirs.num_iter
        assert np.allclose(ours.lam, theirs.z, rtol=1e-9, atol=1e-10)
        assert known.error(ours.lam) <= max(2 * known.error(theirs.z), 1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("n", [300, 500])
def test_not_slower(n):
    known = LCP_PROBLEMS["planted"]("pd", n=n, seed=1)
    A, b, times = known.problem.A, known.problem.b, ([], [])
    for _ in range(9):
        for spent, solve in zip(times, (lambda: lemke(LCP(A, b)), lambda: lcp_lemke(A, b)), strict=True):
            begun = time.process_time()
            solve()
            spent.append(time.process_time() - begun)
    assert np.median(times[0]) <= np.median(times[1])
