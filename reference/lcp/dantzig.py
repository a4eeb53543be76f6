"""Cottle and Dantzig's principal pivoting: drive one row at a time until it is right, keeping right what is.

    take a wrong row d; let λ_d change, and all other rows follow with w_i = 0 or λ_i at its bound
    go on until  w_d = 0 or λ_d is at a bound: d is right, next row
              or λ_i of a row INSIDE meets a bound, or w_i of a row at a bound becomes 0: pivot row i, go on

Baraff's form takes the rows in order and heeds only those it has done, as if each contact were added to the
system when its turn comes; so does ODE's world step. ``order="index"`` is that form: rows without bounds
(joints) first, friction rows last, the bounds of each set when its turn comes, from the λ_n there is by then.
``order="worst"`` is the classical one: it drives the row that is most wrong and heeds all that are right.

Where A is positive semidefinite a pivot T_ii may be 0; then rows i and d are pivoted together.

Slides S13, S14, S17; lectures/06_pivoting_lcp.md. Sources: Cottle, Pang & Stone, The Linear Complementarity
Problem (2009), sections 4.2 and 4.3; Baraff, SIGGRAPH 1994, 23; Smith, Open Dynamics Engine (order and
friction).
"""

import numpy as np

from .. import inputs
from ..compiled import compiled, compiled_apart
from .pivoting import INSIDE, LOWER, UPPER
from .principal import came_back, move, slack, swap, swap_pair, tiny_in, wrong
from .rounds import by_principal_pivots
from .solution import CYCLE, MAX_ITERATIONS, RAY, SOLVED, UNSUITABLE

_SAYS = {
    "ray": "A row was driven and nothing stopped it: λ grows for ever and the row never becomes right. A is "
    "not positive definite; there may be no solution, or one that this method can't reach.",
    "infeasible": "Driving one row, λ grows for ever and w stays wrong. The direction y of λ proves that "
    "there is no solution: every right w has yᵀw ≥ 0, but yᵀ(A λ + b) < 0 for all λ within their bounds.",
    "unsuitable": "Two rows that should change places are bound to each other by a pivot of 0: A is neither "
    "a P-matrix nor positive semidefinite. Take lemke.",
    "cycle": "The method came back to the rows it had chosen before, and would go round for ever: the "
    "problem is degenerate, and A no P-matrix. Take lemke.",
}


@compiled_apart
def drive(state, most, order, worst, normal, mu):
    """Make one row after the other right, with at most ``most`` pivots; returns (pivots, code).

    order (n,): the rows as their turn comes. worst: take the most wrong one instead, and heed all that are
    right. normal, mu (n,): friction rows take their bounds when their turn comes.
    """
    n, done, turn, d = len(order), 0, 0, state.at[0]
    heeded = np.zeros(n, dtype=np.bool_)
    while not worst and d >= 0 and order[turn] != d:  # go on with a row whose drive was interrupted
        heeded[order[turn]] = True
        turn += 1
    while True:
        if d < 0 and worst:
            d = most_wrong(state, slack(state))
        elif d < 0:
            d = order[turn] if turn < n else -1
            if d >= 0 and normal[d] >= 0:
                set_friction(state, d, normal[d], mu[d])
        if d < 0:
            return done, SOLVED
        if worst:
            tolerance = slack(state)
            for i in range(n):
                heeded[i] = i != d and wrong(state, i, tolerance) == 0
        state.at[0] = d
        pivots, code = drive_row(state, d, heeded, most - done)
        done += pivots
        if code != SOLVED:
            return done, code
        heeded[d], state.at[0], d, turn = True, -1, -1, turn + 1


@compiled_apart
def most_wrong(state, tolerance):
    """The row that is most wrong, or −1."""
    found, largest = -1, 0.0
    for i in range(len(state.y)):
        side = wrong(state, i, tolerance)
        if side != 0:
            size = abs(state.y[i])
            if state.place[i] == INSIDE:
                size = state.lower[i] - state.y[i] if side < 0 else state.y[i] - state.upper[i]
            if size > largest:
                found, largest = i, size
    return found


@compiled
def set_friction(state, i, n, μ):
    """Set the bounds of friction row i, not yet driven, to ±μ times the λ_n there is now."""
    λ_n = state.y[n] if state.place[n] == INSIDE else state.x[n]
    state.upper[i] = μ * max(λ_n, 0.0)
    state.lower[i] = -state.upper[i]


@compiled_apart
def drive_row(state, d, heeded, most):
    """Drive row d until it is right: (pivots, code), SOLVED if it is."""
    pivots = 0
    while True:
        tolerance = slack(state)
        side, inside = wrong(state, d, tolerance), state.place[d] == INSIDE
        if inside and side == 0 and abs(state.x[d]) <= tolerance:
            move(state, d, 0.0)
            return pivots, SOLVED
        if not inside and side == 0 and (state.x[d] == state.lower[d] or state.x[d] == state.upper[d]):
            return pivots, SOLVED
        if pivots >= most:
            return pivots, MAX_ITERATIONS
        i, at_bound, σ = d, False, 0.0
        if not (inside and side != 0):
            σ = -1.0 if (state.x[d] if inside else state.y[d]) > 0 else 1.0  # so that w_d goes towards 0
            i, step, at_bound = first_stop(state, d, σ, heeded)
            if i < 0:  # w_d = 0 already, whatever λ_d is: a row that says what others say
                return pivots, SOLVED if side == 0 and not inside else RAY
            move(state, d, state.x[d] + σ * step)
        code = change_places(state, d, i, at_bound, σ)
        if code != SOLVED:
            return pivots, code
        pivots += 1
        if came_back(state, d):
            return pivots, CYCLE


@compiled_apart
def first_stop(state, d, σ, heeded):
    """(row, step, at_bound): which row first stops the change of row d's nonbasic unknown; row −1: none.

    at_bound: row d itself, whose λ meets its bound. Ties go to d itself, then to the lowest number.
    """
    T, y, x, lower, upper, place = state.T, state.y, state.x, state.lower, state.upper, state.place
    tiny, row, best, at_bound = tiny_in(T, d), -1, np.inf, False
    if place[d] == INSIDE:
        row, best = d, abs(x[d])
    else:
        if abs(T[d, d]) > tiny and T[d, d] * σ * y[d] <= 0:
            row, best = d, -y[d] / (T[d, d] * σ)
        room = upper[d] - x[d] if σ > 0 else x[d] - lower[d]
        if room < best:
            row, best, at_bound = d, room, True
    for i in range(len(y)):
        rate, room = T[i, d] * σ, np.inf
        if abs(rate) <= tiny or not (heeded[i] or i == d):
            continue
        if place[i] == INSIDE:
            room = (upper[i] - y[i]) / rate if rate > 0 else (lower[i] - y[i]) / rate
        elif i != d and lower[i] < upper[i]:
            falls, rises = rate < 0 and x[i] == lower[i], rate > 0 and x[i] == upper[i]
            room = -y[i] / rate if falls or rises else np.inf
        room = max(room, 0.0)
        if room < best:
            row, best, at_bound = i, room, i == d
    return row, best, at_bound


@compiled_apart
def change_places(state, d, i, at_bound, σ):
    """Row i has stopped row d: pivot it, and set exactly what it has reached. SOLVED or UNSUITABLE."""
    T, place = state.T, state.place
    if i == d and place[d] == INSIDE and not at_bound and σ != 0:
        state.x[d] = 0.0  # w_d = 0 is reached
        return SOLVED
    if i == d and place[d] != INSIDE and at_bound:
        place[d] = UPPER if σ > 0 else LOWER
        move(state, d, state.upper[d] if σ > 0 else state.lower[d])
        return SOLVED
    if abs(T[i, i]) > tiny_in(T, i):
        swap(state, i)
        turn(state, i)
        return SOLVED
    if i == d or not (abs(T[i, d]) > tiny_in(T, d) and abs(T[d, i]) > tiny_in(T, i)):
        return UNSUITABLE
    swap_pair(state, i, d)
    turn(state, i)
    place[d] = INSIDE if place[d] != INSIDE else LOWER
    return SOLVED


@compiled
def turn(state, i):
    """Row i has been pivoted where it stood: its new nonbasic unknown is 0 or a bound, exactly."""
    if state.place[i] != INSIDE:
        state.place[i] = INSIDE
        move(state, i, 0.0)
    elif abs(state.x[i] - state.lower[i]) <= abs(state.x[i] - state.upper[i]):
        state.place[i] = LOWER
        move(state, i, state.lower[i])
    else:
        state.place[i] = UPPER
        move(state, i, state.upper[i])


def turns(form):
    """The rows (n,) as their turn comes: those without bounds, then the others, friction rows last."""
    free = np.isinf(form.lower) & np.isinf(form.upper) & (form.normal < 0)
    return np.lexsort((np.arange(len(free)), ~free, form.normal >= 0))


def dantzig(problem, start=None, tolerance=1e-10, max_iterations=1000, *, order="index", record=False):
    """Solve an LCP by principal pivoting, one row driven at a time; bounds, and friction in passes.

    order: "index" drives the rows in order and heeds those it has done (Baraff); "worst" drives the row most
    wrong and heeds all that are right (Cottle & Dantzig). start (n,): its rows strictly between their bounds
    begin with w = 0. One iteration is one pivot, or one row driven from bound to bound. record: the list of
    ``Tableau`` that it went through. Ends for P-matrices and positive semidefinite A, where w can be
    right at all. A is made dense. Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    inputs.choice("order", order, ("index", "worst"))

    def options(form, k):  # in the first pass the bounds of friction are set when their turn comes
        return turns(form), order == "worst", form.normal if k == 0 else np.full(len(form.b), -1), form.mu

    return by_principal_pivots(problem, start, tolerance, max_iterations, drive, options, record, _SAYS)
