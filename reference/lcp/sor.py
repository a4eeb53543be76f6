"""SOR, and the other ways to sweep like Gauss–Seidel: there and back, or colour by colour.

They are Gauss–Seidel's own loop with another ω or another order of the rows:

    sor                       λ_i ← clip(λ_i − ω w_i / A_ii, …), ω above 1: over-relaxed (S16 takes about 1.6)
    symmetric_gauss_seidel    all rows forwards, then backwards: the error's matrix has real eigenvalues
    red_black                 rows that have nothing in common one after another: what could run in parallel

The best ω follows from Jacobi's rate ρ where A couples the rows like a chain (``rates.best_omega``); it is
close to 2 where Gauss–Seidel is slow. At ω ≥ 2 no splitting converges.

Slides S15–S17; lectures/07_iterative_lcp.md. Sources: Young, Iterative Solution of Large Linear Systems
(1971), for ω; Cryer, SIAM J. Control 9 (1971) 385, for the projected sweep.
"""

from .. import inputs
from .gauss_seidel import how_often, sweeps
from .iteration import iterate
from .orders import coloured_order, natural_order, there_and_back


def sor(problem, start=None, tolerance=1e-10, max_iterations=1000, *, omega=1.6, every=None):
    """Solve an LCP by projected successive over-relaxation.

    omega: above 0 and below 2; 1 is Gauss–Seidel, below that is under-relaxed. Converges for symmetric
    positive definite A without friction (S15). All else as for ``gauss_seidel``.
    """
    options = natural_order, relaxation(omega), how_often(every)
    return iterate(sweeps, problem, start, tolerance, max_iterations, options=options)


def symmetric_gauss_seidel(problem, start=None, tolerance=1e-10, max_iterations=1000, *, every=None):
    """Solve an LCP by projected Gauss–Seidel, sweeping forwards and backwards in turn.

    One iteration is two sweeps, there and back. All else as for ``gauss_seidel``.
    """
    options = there_and_back, 1.0, how_often(every)
    return iterate(sweeps, problem, start, tolerance, max_iterations, options=options)


def red_black(problem, start=None, tolerance=1e-10, max_iterations=1000, *, omega=1.0, every=None):
    """Solve an LCP by projected Gauss–Seidel or SOR, colour by colour (``orders.colours``).

    omega: as for ``sor``. All else as for ``gauss_seidel``.
    """
    options = coloured_order, relaxation(omega), how_often(every)
    return iterate(sweeps, problem, start, tolerance, max_iterations, options=options)


def relaxation(omega):
    """ω as a number above 0 and below 2. Raises ValueError or TypeError."""
    ω = inputs.number("omega", omega, above=0)
    if ω >= 2:
        raise ValueError(f"omega must be below 2, from which on nothing converges, but is {omega!r}")
    return ω
