"""Murty's least-index method: of all rows that are wrong, pivot the one with the lowest number.

    while there is a row with λ_i beyond a bound, or w_i of the wrong sign:
        the first such row: INSIDE → the bound that it has passed;  at a bound → INSIDE

No ratio test, no covering vector, nothing to break ties with. For a P-matrix (all principal minors positive)
no choice of places ever comes back, because rows before i are solved anew whenever row i changes and each
row's w_i rises with its λ_i. For other matrices it may go round in circles, and that is noticed. On hard
examples it takes 2ⁿ − 1 pivots.

Slides S13, S14; lectures/06_pivoting_lcp.md. Source: Murty, Opsearch 11 (1974) 123; Cottle, Pang & Stone, The
Linear Complementarity Problem (2009), chapter 4.
"""

from ..compiled import compiled_apart
from .pivoting import INSIDE, LOWER, UPPER
from .principal import came_back, move, slack, swap, tiny_in, wrong
from .rounds import by_principal_pivots
from .solution import CYCLE, MAX_ITERATIONS, SOLVED, UNSUITABLE

_SAYS = {
    "unsuitable": "A pivot of the least-index method is 0: A is no P-matrix (a principal minor vanishes). "
    "Take lemke.",
    "cycle": "The least-index method came back to rows it had chosen before, and would go round for ever: "
    "A is no P-matrix, or rounding has blurred that it is. Take lemke.",
}


@compiled_apart
def least_index(state, most):
    """Pivot the first wrong row until there is none, at most ``most`` times; returns (pivots, code)."""
    n = len(state.y)
    for k in range(most + 1):
        tolerance, i = slack(state), 0
        while i < n and wrong(state, i, tolerance) == 0:
            i += 1
        if i == n:
            return k, SOLVED
        if k == most:
            return k, MAX_ITERATIONS
        if not abs(state.T[i, i]) > tiny_in(state.T, i):
            return k, UNSUITABLE
        side = wrong(state, i, tolerance)
        swap(state, i)
        if state.place[i] != INSIDE:
            state.place[i] = INSIDE
            move(state, i, 0.0)
        else:
            state.place[i] = LOWER if side < 0 else UPPER
            move(state, i, state.lower[i] if side < 0 else state.upper[i])
        if came_back(state, 0):
            return k + 1, CYCLE
    return most, MAX_ITERATIONS


def murty(problem, start=None, tolerance=1e-10, max_iterations=1000, *, record=False):
    """Solve an LCP by Murty's least-index method; bounds, and friction bounds in passes (``rounds``).

    start (n,): its rows strictly between their bounds begin with w = 0; None: none does. One iteration is one
    pivot. record: ``solution.record`` is the list of ``Tableau`` that it went through. For P-matrices it
    always ends, after up to 2ⁿ pivots and more; others may be ``unsuitable`` or end in a ``cycle``. A is made
    dense. Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    return by_principal_pivots(
        problem, start, tolerance, max_iterations, least_index, lambda form, k: (), record, _SAYS
    )
