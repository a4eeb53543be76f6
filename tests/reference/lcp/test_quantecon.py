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


def family(kind, n):
    """(A, b, λ): random; "degenerate": w = 0 in all rows, so λ and w are both 0 in half of them."""
    known = LCP_PROBLEMS["planted"]("pd" if kind == "degenerate" else kind, n=n, seed=1)
    A, λ = known.problem.A, known.answer
    return A, -A @ λ if kind == "degenerate" else known.problem.b, λ


def spent(*calls, turns):
    """Processor seconds of each call (turns, calls), in turns, so that all meet the same machine."""
    seconds = np.empty((turns, len(calls)))
    for turn in range(turns):
        for k, call in enumerate(calls):
            begun = time.process_time_ns()
            call()
            seconds[turn, k] = 1e-9 * (time.process_time_ns() - begun)
    return seconds


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pd", "p", "degenerate"])
@pytest.mark.parametrize("n", [10, 100, 200, 300, 400, 500])
def test_not_slower(n, kind):
    """From A and b to a Solution, checked and measured, beside their bare kernel: not slower from n = 100 on.

    The least of many turns counts: what else the machine does can only add. At n = 10 ours is nearly all
    Python, and may take a hundred microseconds (four times what it took alone).
    """
    A, b, λ = family(kind, n)
    calls = lambda: lemke(LCP(A, b)), lambda: lcp_lemke(A, b)
    for z in (calls[0]().lam, calls[1]().z):
        assert np.abs(z - λ).max() < 1e-10
    seconds = spent(*calls, turns=max(9, 20_000 // n))
    ours, theirs = seconds.min(axis=0)
    middle = np.median(seconds, axis=0)
    print(
        f"\n{kind:10} n = {n}: {1e6 * ours:.0f} µs, QuantEcon {1e6 * theirs:.0f}: theirs over ours ", end=""
    )
    print(f"{theirs / ours:.2f}, of medians {middle[1] / middle[0]:.2f}")
    assert ours < theirs or n < 100 and ours < 250e-6
