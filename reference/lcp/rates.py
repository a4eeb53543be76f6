"""How fast a splitting must converge: from the spectrum, before it is run, and from a history, after.

A = D − F: the sweep that solves D λ' = F λ − b leaves, of an error e = λ − λ*, in the rows that stay inside
their bounds

    e' = G e,    G = D⁻¹F = I − D⁻¹A,    and after many sweeps each makes it ρ(G) times as large

ρ is the largest |eigenvalue|, the **rate**: ln(10)/−ln(ρ) sweeps make a digit. For Jacobi D is the diagonal
over ω, for Gauss–Seidel and SOR the diagonal over ω and what is below it, for the symmetric sweep one G after
another, for blocks the blocks of A. Rows at a bound have no error, and are left out.

For A that couples its rows like a chain, or like a chessboard, Young's theorem leads from Jacobi's ρ to all:
Gauss–Seidel ρ², the best ω 2/(1 + √(1 − ρ²)), and its rate ω − 1.

Slides S15, S16; lectures/07_iterative_lcp.md. Source: Young, Iterative Solution of Large Linear Systems
(1971), chapters 4 to 6.
"""

import numpy as np

from .. import inputs
from .block import gather_blocks
from .jacobi import safe_damping
from .orders import coloured_order, natural_order, there_and_back
from .problem import LCP

_LARGEST = 3000  # rows: beyond, the eigenvalues of a dense matrix take minutes


def rate(problem, method="gauss_seidel", *, free=None, omega=None, blocks=None):
    """ρ(G) of a method on an LCP: below 1 where it converges, once no row changes sides any more.

    method: the name of a splitting method of ``SOLVERS``. free (n,) booleans: the rows inside their bounds;
    None: all of them. omega, blocks: as for that method, None its default.
    Raises ValueError where the method has no G, A_ii isn't positive, or A is too large; TypeError where the
    problem isn't an LCP.
    """
    G = error_matrix(problem, method, free=free, omega=omega, blocks=blocks)
    return float(np.abs(np.linalg.eigvals(G)).max(initial=0))


def error_matrix(problem, method="gauss_seidel", *, free=None, omega=None, blocks=None):
    """G (m, m), for the m free rows in the order of their numbers; arguments as for ``rate``."""
    if not isinstance(problem, LCP):
        raise TypeError(f"problem must be an LCP, but is of type {type(problem).__name__}")
    inputs.choice("method", method, _DIVISORS)
    if problem.n > _LARGEST:
        raise ValueError(f"problem must have at most {_LARGEST} rows for its spectrum, but has {problem.n}")
    rows = np.arange(problem.n) if free is None else np.flatnonzero(_mask(free, problem.n))
    A = problem.A if isinstance(problem.A, np.ndarray) else problem.A.toarray()
    if not (A.diagonal()[rows] > 0).all():
        raise ValueError("A must have a positive diagonal to be divided by, in all rows that are free")
    A, G = A[np.ix_(rows, rows)], np.eye(len(rows))
    for D in _DIVISORS[method](problem, omega, blocks):
        G = G - np.linalg.solve(D[np.ix_(rows, rows)], A @ G)
    return G


def measured_rate(solution, last=10):
    """The factor by which the residual of a ``Solution`` fell in each of its last iterations, on average.

    last: over how many. NaN where fewer are known, or one of both ends is 0.
    """
    last = inputs.whole("last", last, least=1)
    known = np.flatnonzero(np.isfinite(solution.history) & (solution.history > 0))
    before = known[known <= solution.iterations - last]
    if not len(before) or known[-1] == before[-1]:
        return np.nan
    first, end = before[-1], known[-1]
    return float((solution.history[end] / solution.history[first]) ** (1 / (end - first)))


def sweeps_for(rate, reduction=1e-6):
    """How many sweeps make an error so much smaller at this rate: ln(reduction)/ln(rate), inf from 1 on."""
    rate, reduction = inputs.number("rate", rate, least=0), inputs.number("reduction", reduction, above=0)
    if rate >= 1:
        return np.inf
    return float(np.log(reduction) / np.log(rate)) if rate > 0 else 1.0


def best_omega(jacobi_rate):
    """The ω with which SOR converges fastest, where A couples its rows like a chain: 2/(1 + √(1 − ρ²)).

    jacobi_rate: ρ of Jacobi, below 1. Raises ValueError or TypeError.
    """
    ρ = inputs.number("jacobi_rate", jacobi_rate, least=0)
    if ρ >= 1:
        raise ValueError(f"jacobi_rate must be below 1, but is {jacobi_rate!r}")
    return 2 / (1 + np.sqrt(1 - ρ * ρ))


def sor_rate(jacobi_rate, omega):
    """SOR's rate at any ω, from Jacobi's, where A couples its rows like a chain (Young's theorem).

    The root of its quadratic up to the best ω; ω − 1 from there on.
    """
    ω, best = inputs.number("omega", omega, above=0), best_omega(jacobi_rate)
    if ω >= best:
        return ω - 1
    root = (ω * jacobi_rate + np.sqrt((ω * jacobi_rate) ** 2 - 4 * (ω - 1))) / 2
    return root * root


def _mask(free, n):
    mask = np.asarray(free)
    if mask.shape != (n,) or mask.dtype != bool:
        raise ValueError(f"free must be {n} booleans, but is of shape {mask.shape}, {mask.dtype}")
    return mask


def _diagonal(problem, ω):
    return [np.diag(problem.A.diagonal() / ω)]


def _renewed(problem, order, ω):
    """D of one sweep: A_ij where row j is renewed before row i, and the diagonal over ω."""
    A = problem.A if isinstance(problem.A, np.ndarray) else problem.A.toarray()
    place = np.empty(problem.n, dtype=int)
    place[order] = np.arange(problem.n)
    return A * (place[None, :] < place[:, None]) + np.diag(A.diagonal() / ω)


def _both_ways(problem, ω, blocks):
    order, n = there_and_back(problem), problem.n
    return [_renewed(problem, order[:n], 1.0), _renewed(problem, order[n:], 1.0)]


def _blocks(problem, ω, blocks, below):
    """D of a block method: the blocks of A, and for Gauss–Seidel what is below them."""
    gathered = gather_blocks(problem, blocks)
    A = problem.A if isinstance(problem.A, np.ndarray) else problem.A.toarray()
    block = np.empty(problem.n, dtype=int)
    block[gathered.order] = np.repeat(np.arange(len(gathered.begin) - 1), np.diff(gathered.begin))
    difference = block[:, None] - block[None, :]
    return [A * (difference == 0) / ω + A * (below & (difference > 0))]


_DIVISORS = {  # method: a list of D for each sweep that an iteration has
    "jacobi": lambda problem, ω, blocks: _diagonal(problem, 1.0),
    "damped_jacobi": lambda problem, ω, blocks: _diagonal(problem, ω or safe_damping(problem)),
    "gauss_seidel": lambda problem, ω, blocks: [_renewed(problem, natural_order(problem), 1.0)],
    "sor": lambda problem, ω, blocks: [_renewed(problem, natural_order(problem), ω or 1.6)],
    "red_black": lambda problem, ω, blocks: [_renewed(problem, coloured_order(problem), ω or 1.0)],
    "symmetric_gauss_seidel": _both_ways,
    "block_jacobi": lambda problem, ω, blocks: _blocks(problem, ω or 1.0, blocks, False),
    "block_gauss_seidel": lambda problem, ω, blocks: _blocks(problem, 1.0, blocks, True),
}
