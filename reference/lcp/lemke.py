"""Lemke's method: cover what is wrong by one artificial unknown z₀, and follow the path on which z₀ vanishes.

    w = M z + c z₀ + q,   z, w, z₀ ≥ 0,   zᵀw = 0        any z₀ large enough is a start with z = 0

z₀ enters, and the row that was most wrong leaves. From then on each pivot lets that unknown enter whose
partner has just left: so of each pair at most one is ever positive, and at each vertex there is one way
onward. The path ends where z₀ leaves (solved), or at a ray: nothing stops the entering unknown.

**Ties.** Two unknowns that would become 0 at once make the next vertex a degenerate one. To take the first of
them can lead round in a circle. The lexicographic rule acts as if q had been q + (ε, ε², …), so small an ε
that only ties feel it: no vertex comes twice, so the method must end.

**A ray proves something** where M is copositive-plus, as J M⁻¹ Jᵀ is: that there is no solution. The
direction of the ray is a certificate, checked before anything is called infeasible; else it says ``ray``.

Bounds and friction first take the plain form (``standard``). The tableau is n × (n + 2): basic unknowns have
no column, so a pivot costs half of what it costs where the identity is stored.

Slides S13, S14; lectures/06_pivoting_lcp.md. Sources: Lemke, Management Science 11 (1965) 681; Cottle, Pang &
Stone, The Linear Complementarity Problem (2009), sections 4.4 and 4.9.
"""

import numpy as np

from .. import inputs
from .iteration import unsuitable
from .lemke_path import follow_path, straight
from .path_end import answer, proof
from .pivoting import begun, scaled
from .solution import MAX_ITERATIONS, RAY, SOLVED, STATUSES, finish
from .standard import plain, why_no_plain
from .tableau import Tableau

_SAYS = {
    "ray": "Lemke's path ran off along a ray: z₀ can't be brought to 0 from this covering vector. A is not "
    "copositive-plus, so that proves nothing: there may be a solution elsewhere.",
    "infeasible": "Lemke's path ran off along a ray, and its direction y proves that there is no solution: "
    "every right w has yᵀw ≥ 0, but yᵀ(A λ + b) < 0 for all λ within their bounds.",
    "cycle": "The path came back to a vertex where it had been: ties broken by the first index lead round in "
    "a circle. Take ties='lexicographic'.",
}


def lemke(
    problem,
    start=None,
    tolerance=1e-10,
    max_iterations=1000,
    *,
    cover=None,
    ties="lexicographic",
    record=False,
):
    """Solve an LCP by Lemke's method; bounds and friction bounds by way of the plain form.

    cover (n,): the covering vector c, at least 0, and positive where λ⁰'s w is wrong; None: all 1. ties:
    "lexicographic", which can't cycle, or "first", which can. start: only looked at in case it is a solution.
    record: the list of ``Tableau`` that it went through. One iteration is one pivot, the first lets z₀ in.
    Solves it for P-matrices and, if it can be solved at all, for copositive-plus A, such as J M⁻¹ Jᵀ. A is
    made dense. Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    inputs.choice("ties", ties, ("first", "lexicographic"))
    λ, tolerance, most, solution = begun(problem, start, tolerance, max_iterations)
    c = np.ones(problem.n) if cover is None else _checked_cover(cover, problem.n)
    if solution:
        return solution
    if problem.is_plain and isinstance(problem.A, np.ndarray) and cover is None and not record:
        λ, done, code = straight(problem.A, problem.b, most, ties == "lexicographic")
        if code == SOLVED:
            solution = finish(problem, λ, done, code, tolerance, history=[1.0, 0.0] if done else [0.0])
            if solution.solved:
                return solution
    form = scaled(problem)
    reason = why_no_plain(form)
    if reason:
        return unsuitable(problem, λ, tolerance, reason)
    parts = plain(form)
    c = np.where(parts.kind == 1, 1.0, (c * (form.weight / form.weight.max()))[parts.row])
    uncovered = np.flatnonzero((c == 0) & (parts.q < 0))
    if len(uncovered):
        i = parts.row[uncovered[0]]
        raise ValueError(f"cover must be positive where w is wrong at λ⁰, but is 0 in row {i}")
    return _solve(problem, form, parts, c, tolerance, most, ties == "lexicographic", record)


def _checked_cover(cover, n):
    c = inputs.array("cover", cover, (n,))
    if (c < 0).any():
        raise ValueError(f"cover must be at least 0, but holds {c.min():g}")
    return c


def _solve(problem, form, parts, c, tolerance, most, lexicographic, record):
    for every in (1,) if record else (most, 20):  # the second time rid of rounding every so often
        T, basic, nonbasic = path = _first_tableau(parts, c)
        at, saved, done, code, seen = np.array([len(c), 0, 2]), np.full(len(c), -1), 0, MAX_ITERATIONS, []
        path = *path, at
        if not (c.any() and (parts.q < 0).any()):
            code = SOLVED  # nothing to cover: z = 0
        if record:
            seen.append(_written(parts, *path, "at first"))
        while code == MAX_ITERATIONS and done < most:
            with np.errstate(all="ignore"):
                pivots, code = follow_path(*path, min(every, most - done), lexicographic, saved)
            done += pivots
            if record:
                seen.append(_written(parts, *path, f"pivot {done}"))
            elif every < most and code == MAX_ITERATIONS:
                _renew(parts, c, T, basic, nonbasic)
        λ = answer(problem, form, parts, *path[:3])
        proved = proof(problem, form, parts, *path[:3], at[0]) if code == RAY else None
        word = "infeasible" if proved else STATUSES[code]
        ends = {"reason": _SAYS.get(word), "history": [1.0, 0.0] if done else [0.0]}  # the start is λ⁰
        solution = finish(problem, λ, done, word, tolerance, certificate=proved, record=seen, **ends)
        if solution.status not in ("ray", "diverged"):
            break
    return solution


def _first_tableau(parts, c):
    m = len(c)
    T = np.empty((m, m + 2))
    T[:, :m], T[:, m], T[:, m + 1] = parts.M, c, parts.q
    return T, np.arange(m), np.arange(m, 2 * m + 1)


def _renew(parts, c, T, basic, nonbasic):
    """Compute the tableau of these basic unknowns afresh, where that is possible."""
    columns = np.hstack([np.eye(len(c)), -parts.M, -c[:, None]])
    try:
        new = np.linalg.solve(columns[:, basic], np.column_stack([-columns[:, nonbasic], parts.q]))
    except np.linalg.LinAlgError:
        return
    if np.isfinite(new).all():
        T[:] = new


def _written(parts, T, basic, nonbasic, at, note):
    m = len(basic)
    mark = ("", "'", "+", "-")
    names = [f"{letter}_{i}{mark[k]}" for letter in "wz" for i, k in zip(parts.row, parts.kind, strict=True)]
    names += ["z₀"]
    entering = f"; {names[nonbasic[at[0]]]} enters next" if 2 * m in basic or note == "at first" else ""
    return Tableau(
        [names[i] for i in basic],
        [names[i] for i in nonbasic],
        T[:, :-1].copy(),
        T[:, -1].copy(),
        note + entering,
    )
