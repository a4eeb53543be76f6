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
from ..compiled import compiled, compiled_apart
from .iteration import unsuitable
from .path_end import answer, proof
from .pivoting import begun, scaled
from .solution import CYCLE, MAX_ITERATIONS, RAY, SOLVED, STATUSES, finish
from .standard import plain, why_no_plain
from .tableau import Tableau, exchange

_TINY, _TIE = 1e-11, 1e-12
_SAYS = {
    "ray": "Lemke's path ran off along a ray: z₀ can't be brought to 0 from this covering vector. A is not "
    "copositive-plus, so that proves nothing: there may be a solution elsewhere.",
    "infeasible": "Lemke's path ran off along a ray, and its direction y proves that there is no solution: "
    "every right w has yᵀw ≥ 0, but yᵀ(A λ + b) < 0 for all λ within their bounds.",
    "cycle": "The path came back to a vertex where it had been: ties broken by the first index lead round in "
    "a circle. Take ties='lexicographic'.",
}


@compiled_apart
def follow_path(T, basic, nonbasic, at, most, lexicographic, saved):
    """Pivot along the path until z₀ leaves; returns (pivots, code).

    T (m, m + 2): columns of the nonbasic unknowns, then constants. basic (m,), nonbasic (m + 1,): i is w_i,
    m + i is z_i, 2m is z₀. at (3,): the entering column, then as in ``principal.came_back``. saved (m,).
    """
    m = len(basic)
    for k in range(most):
        s = at[0]
        r = first_row(T, s, lexicographic) if nonbasic[s] == 2 * m else -1
        if r < 0:
            r = leaving_row(T, basic, nonbasic, s, lexicographic)
        if r < 0:
            return k, RAY
        exchange(T, r, s)
        left = basic[r]
        basic[r], nonbasic[s] = nonbasic[s], left
        if left == 2 * m:
            return k + 1, SOLVED
        partner = left + m if left < m else left - m
        for j in range(m + 1):
            if nonbasic[j] == partner:
                at[0] = j
        same = True
        for i in range(m):
            same = same and saved[i] == basic[i]
        if same:
            return k + 1, CYCLE
        at[1] += 1
        if at[1] >= at[2]:
            at[1], at[2] = 0, 2 * at[2]
            saved[:] = basic
    return most, MAX_ITERATIONS


@compiled
def first_row(T, s, lexicographic):
    """The row that leaves when z₀ enters, in column s: the last to become right as z₀ grows."""
    row, least = -1, 0.0
    for i in range(len(T)):
        if T[i, s] > 0:
            ratio = T[i, -1] / T[i, s]
            if ratio < least or (ratio == least < 0 and lexicographic):
                row, least = i, ratio
    return row


@compiled_apart
def leaving_row(T, basic, nonbasic, s, lexicographic):
    """The row whose unknown is the first to become 0 as that of column s grows from 0; −1 if none is.

    A tie goes to z₀; then to the lexicographically least row, or to the first.
    """
    m = len(basic)
    largest, top = 0.0, 0.0
    for i in range(m):
        largest, top = max(largest, abs(T[i, s])), max(top, abs(T[i, m + 1]))
    tiny, least = _TINY * largest, np.inf
    for i in range(m):
        if T[i, s] < -tiny:
            least = min(least, max(T[i, m + 1], 0.0) / -T[i, s])
    row = -1
    for i in range(m):
        q = max(T[i, m + 1], 0.0)
        if T[i, s] < -tiny and q + T[i, s] * least <= _TIE * q + 1e-15 * top:
            if basic[i] == 2 * m:
                return i
            if row < 0 or (lexicographic and before(T, basic, nonbasic, s, i, row)):
                row = i
    return row


@compiled_apart
def before(T, basic, nonbasic, s, i, r):
    """Whether row i comes before row r in the lexicographic order of their ratios.

    With q + (ε, ε², …) in place of q, a row's value gets ε^k times its number in column k of the inverse of
    the basis: 1 where w_k is its own unknown, − the tableau's number where w_k is nonbasic.
    """
    m = len(basic)
    column = np.full(m, -1)
    for j in range(m + 1):
        if nonbasic[j] < m:
            column[nonbasic[j]] = j
    for k in range(m):
        of_i, of_r = 1.0 if basic[i] == k else 0.0, 1.0 if basic[r] == k else 0.0
        if column[k] >= 0:
            of_i, of_r = -T[i, column[k]], -T[r, column[k]]
        of_i, of_r = of_i / -T[i, s], of_r / -T[r, s]
        if abs(of_i - of_r) > _TIE * max(abs(of_i), abs(of_r)):
            return of_i < of_r
    return False


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
    c = np.ones(problem.n) if cover is None else inputs.array("cover", cover, (problem.n,))
    if (c < 0).any():
        raise ValueError(f"cover must be at least 0, but holds {c.min():g}")
    if solution:
        return solution
    form = scaled(problem)
    reason = why_no_plain(form)
    if reason:
        return unsuitable(problem, λ, tolerance, reason)
    parts = plain(form)
    c = np.where(parts.kind == 1, 1.0, (c * (form.weight / form.weight.max()))[parts.row])
    bare = np.flatnonzero((c == 0) & (parts.q < 0))
    if len(bare):
        i = parts.row[bare[0]]
        raise ValueError(f"cover must be positive where w is wrong at λ⁰, but is 0 in row {i}")
    return _solve(problem, form, parts, c, tolerance, most, ties == "lexicographic", record)


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
