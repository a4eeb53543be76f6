"""From a rule of principal pivots to a solver: begin, pivot, compute afresh, and again for friction.

Friction (S17): rows whose bounds are ±μ λ_n are solved with bounds that stand still, which are then set anew
from the λ_n found, until they are those of that very λ_n. Each pass also tries the equations with the bounds
moving along, so two or three passes will mostly do; nothing says that they must come to an end.

A tableau gathers rounding. When a rule says that it is done, the tableau is computed afresh from the places,
and the rule may go on, three times at most.

Slides S13, S14, S17; lectures/06_pivoting_lcp.md. Source for the bounds of friction that stand still in each
pass: Smith, Open Dynamics Engine, whose world step does one such pass.
"""

import numpy as np

from .pivoting import INSIDE, LOWER, UPPER, begun, proves_infeasible, refined, scaled
from .principal import TINY, State, move, slack, swap, wrong
from .solution import MAX_ITERATIONS, RAY, SOLVED, STATUSES, finish
from .tableau import Tableau

_PASSES = 50  # over the friction bounds


def begin(A, b, lower, upper, λ):
    """The State in which λ is λ⁰ = clip(0, lower, upper), or where rows strictly inside of λ are INSIDE.

    A row that starts between its bounds counts as LOWER, but isn't right unless its w is 0.
    """
    n = len(b)
    x = np.clip(0.0, lower, upper)
    place = np.where((x == upper) & (x > lower), UPPER, LOWER)
    state = State(
        A.copy(), A @ x + b, x, place, lower.copy(), upper.copy(), np.array([-1, 0, 2]), np.full(n + 1, -1)
    )
    for i in np.flatnonzero((λ > lower) & (λ < upper) & (λ != x)):
        if abs(state.T[i, i]) > TINY * np.abs(state.T[:, i]).max():
            swap(state, i)
            place[i] = INSIDE
            move(state, i, 0.0)
    return state


def answer(state):
    """λ (n,) of a State."""
    return np.clip(np.where(state.place == INSIDE, state.y, state.x), state.lower, state.upper)


def _places(state):
    """Where each row is (n,); one that never moved and stands between its bounds counts as INSIDE."""
    at_bound = (state.x == state.lower) | (state.x == state.upper)
    return np.where((state.place != INSIDE) & ~at_bound, INSIDE, state.place)


def rebuilt(state, A, b):
    """The State at the same places with T and y computed afresh, rid of rounding; None where T is no more."""
    inside = np.flatnonzero(state.place == INSIDE)
    others = np.flatnonzero(state.place != INSIDE)
    x = np.where(state.place == INSIDE, 0.0, state.x)
    T = np.empty_like(A)
    try:
        T[np.ix_(inside, inside)] = np.linalg.inv(A[np.ix_(inside, inside)])
    except np.linalg.LinAlgError:
        return None
    inverse, beside = T[np.ix_(inside, inside)], A[np.ix_(others, inside)]
    T[np.ix_(inside, others)] = -inverse @ A[np.ix_(inside, others)]
    T[np.ix_(others, inside)] = beside @ inverse
    T[np.ix_(others, others)] = A[np.ix_(others, others)] + beside @ T[np.ix_(inside, others)]
    q = b.copy()
    q[inside] = -inverse @ b[inside]
    q[others] += beside @ q[inside]
    y = T @ x + q
    return state._replace(T=T, x=x, y=y) if np.isfinite(T).all() and np.isfinite(y).all() else None


def by_principal_pivots(problem, start, tolerance, max_iterations, kernel, options, record, says):
    """Run ``kernel(state, most, *options) -> (pivots, code)`` on a problem, and return its Solution.

    options(form, pass): the tuple of the kernel's own arguments. says: sentences by status. record: write the
    tableaux down.
    """
    λ, tolerance, most, solution = begun(problem, start, tolerance, max_iterations)
    if solution:
        return solution
    form, done, seen = scaled(problem), 0, []
    λ = λ if start is not None else problem.origin
    for k in range(_PASSES if problem.has_friction else 1):
        lower, upper = _bounds(form, λ)
        state = begin(form.A, form.b, lower, upper, λ / form.unit)
        given = options(form, k)
        state, pivots, code = _run(kernel, state, form, most - done, given, seen if record else None)
        done += pivots
        previous, λ = λ, refined(problem, answer(state) * form.unit, _places(state))
        if code != SOLVED or problem.residual(λ) <= tolerance or done >= most or (λ == previous).all():
            break
    if code == SOLVED and problem.has_friction and problem.residual(λ) > tolerance:
        code, says = MAX_ITERATIONS, {**says, "max_iterations": _FRICTION}
    proof = _proof(problem, form, state) if code == RAY else None
    word = "infeasible" if proof else STATUSES[code]
    return finish(problem, λ, done, word, tolerance, reason=says.get(word), certificate=proof, record=seen)


_FRICTION = (
    "The bounds of friction, set anew from each λ_n found, did not settle: allow more pivots, or take lemke, "
    "which takes bounds and λ_n as one problem."
)


def _run(kernel, state, form, most, options, seen):
    """Pivot until it is done, (state, pivots, code); with ``seen`` one at a time, each tableau appended."""
    done, fresh = 0, 0
    if seen is not None:
        seen.append(written(state, form, "at first"))
    with np.errstate(all="ignore"):
        while True:
            before = state.place.copy()
            pivots, code = kernel(state, most - done if seen is None else min(1, most - done), *options)
            done += pivots
            if seen is not None and pivots:
                rows = ", ".join(
                    str(i) for i in np.flatnonzero((before == INSIDE) != (state.place == INSIDE))
                )
                seen.append(written(state, form, f"pivot {done}: row {rows or '-'}"))
                if code == MAX_ITERATIONS and done < most:
                    continue
            if code == MAX_ITERATIONS or fresh == 3:
                return state, done, code
            again = rebuilt(state, form.A, form.b)  # what looks done may be rounding
            if again is None or not _still_wrong(again):
                return state if again is None else again, done, code
            if code != SOLVED and fresh:
                return state, done, code
            state, fresh = again, fresh + 1
            state.at[0] = -1


def _still_wrong(state):
    tolerance = 100 * slack(state)
    return any(wrong(state, i, tolerance) for i in range(len(state.y)))


def _bounds(form, λ):
    """The bounds, those of friction being the ones of this λ."""
    if not len(λ):
        return form.lower, form.upper
    most = form.mu * np.maximum(λ[form.normal] / form.unit[form.normal], 0)
    friction = form.normal >= 0
    return np.where(friction, -most, form.lower), np.where(friction, most, form.upper)


def _proof(problem, form, state):
    """What proves that there is no solution, from the direction in which λ ran off; None where it doesn't."""
    d = state.at[0]
    if d < 0:
        return None
    along = np.where(state.place == INSIDE, state.T[:, d], 0.0)
    along[d] = 1.0 if state.place[d] != INSIDE else along[d]
    for y in (along * form.unit, -along * form.unit):
        y = np.where(np.abs(along) > TINY * np.abs(along).max(), y, 0.0)
        if proves_infeasible(problem, y):
            return {"y": y}
    return None


def written(state, form, note):
    """The Tableau of a state, in the problem's own units."""
    inside = state.place == INSIDE
    rows = [f"{'λ' if i else 'w'}_{k}" for k, i in enumerate(inside)]
    columns = [f"{'w' if i else 'λ'}_{k}" for k, i in enumerate(inside)]
    of_row = np.where(inside, form.unit, 1 / form.weight)
    of_column = np.where(inside, 1 / form.weight, form.unit)
    return Tableau(rows, columns, state.T * of_row[:, None] / of_column, state.y * of_row, note)
