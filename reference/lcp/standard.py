"""Every LCP with bounds is a plain one, w = M z + q, z ≥ 0, w ≥ 0, zᵀw = 0, with more rows.

    λ ≥ l only            z = λ − l
    λ ≤ u only            z = u − λ, w = −w_i
    l ≤ λ ≤ u             z = λ − l, and a second pair: s = u − λ against w⁻, where w_i = w⁺ − w⁻
    |λ_t| ≤ μ λ_n         the same with l = −μ λ_n, u = μ λ_n, which move with λ_n (S17)
    λ free, w_i = 0       solved for λ_i, and put into the other rows
    l = u                 λ_i is no unknown

If A is positive semidefinite so is M, unless there is friction. Free rows that can't be solved for (a joint
that says what another says) are split, λ_i = z − z', which asks w_i ≥ 0 and −w_i ≥ 0.

Slides S10–S13; lectures/06_pivoting_lcp.md. Sources: Cottle, Pang & Stone, The Linear Complementarity Problem
(2009), section 1.5; Stewart & Trinkle, Int. J. Numer. Meth. Engng 39 (1996) 2673, for friction.
"""

from typing import NamedTuple

import numpy as np

from .pivoting import INSIDE, LOWER, UPPER
from .tableau import exchange

_TINY, _NOISE = 1e-11, 1e-13  # what is taken for 0: a pivot; a q, beside the numbers that it is the sum of


class Plain(NamedTuple):
    """The plain problem M (m, m), q (m,), and how its z tells λ: ``lam(z)``, ``place(z is basic)``."""

    M: np.ndarray
    q: np.ndarray
    row: np.ndarray  # (m,) the row of the problem that each belongs to
    kind: np.ndarray  # (m,) 0: z of that row; 1: its second pair; 2, 3: the two halves of a split row
    start: np.ndarray  # (n,) λ where z = 0
    change: np.ndarray | None  # (n, m) of λ with z; None: λ is z
    sign: np.ndarray  # (n,) −1 where w is turned round
    solved: tuple  # (rows, columns): free rows of the problem solved for the λ of these columns

    def lam(self, z):
        """λ (n,) of z (m,), in the scaled units."""
        return z if self.change is None else self.start + self.change @ z

    def place(self, basic):
        """Where each row is (n,), from which z are basic (m,)."""
        if self.change is None:
            return np.where(basic, INSIDE, LOWER)
        place = np.full(len(self.start), LOWER)
        place[self.solved[0]] = place[self.solved[1]] = INSIDE
        place[self.row[basic & (self.kind != 1)]] = INSIDE
        place[self.row[self.kind >= 2]] = INSIDE
        place[self.row[basic & (self.kind == 1)]] = UPPER
        turned = (self.sign < 0) & (place == LOWER)
        place[turned] = UPPER
        return place

    def multipliers(self, y):
        """(n,): y (m,) of the plain rows as one number for each row of the problem."""
        result = np.zeros(len(self.start))
        np.add.at(result, self.row, np.where(self.kind == 3, -1, self.kind != 1) * y)
        return self.sign * result


def why_no_plain(form):
    """Why a Scaled problem can't be made plain; "" where it can."""
    normals = form.normal[form.normal >= 0]
    if len(normals) and (form.lower[normals] < 0).any():
        return (
            "Friction bounds are ±μ λ_n, and λ_n may be negative here: this method needs rows of λ_n with a "
            "lower bound of at least 0."
        )
    return ""


def plain(form):
    """The Plain form of a Scaled problem; a problem without bounds but 0 … ∞ is its own."""
    n, friction = len(form.b), form.normal >= 0
    if not friction.any() and (form.lower == 0).all() and np.isinf(form.upper).all():
        zero, one = np.zeros(n), np.ones(n)
        none = np.zeros(0, dtype=int)
        return Plain(form.A, form.b, np.arange(n), np.zeros(n, dtype=int), zero, None, one, (none, none))
    low, high, normal = form.lower, form.upper, np.where(friction, form.normal, 0)
    turned = ~friction & np.isinf(low) & np.isfinite(high)
    sign = np.where(turned, -1.0, 1.0)
    start = np.where(turned, high, np.where(np.isfinite(low), low, 0.0))
    C, t = np.diag(sign), np.flatnonzero(friction)
    start[t] = -form.mu[t] * start[normal[t]]
    C[t, normal[t]] = -form.mu[t]
    free = np.flatnonzero(~friction & np.isinf(low) & np.isinf(high))
    fixed = np.where(friction, form.mu == 0, low == high)
    double = np.flatnonzero(~fixed & (friction | (np.isfinite(low) & np.isfinite(high))))
    room = np.where(friction, 2 * form.mu * start[normal], high - low)[double]
    second = np.zeros((len(double), n))
    second[np.arange(len(double)), double] = -1
    moving = np.flatnonzero(friction[double])
    second[moving, normal[double[moving]]] += 2 * form.mu[double[moving]]
    T = np.zeros((n + len(double), n + len(double) + 1))
    T[:n, :n] = sign[:, None] * form.A * sign
    np.add.at(T[:n, :n].T, normal[t], -form.mu[t, None] * (sign[:, None] * form.A[:, t]).T)
    T[double, n + np.arange(len(double))] = 1
    q = form.A @ start + form.b
    q[np.abs(q) <= _NOISE * (np.abs(form.A) @ np.abs(start) + np.abs(form.b))] = 0
    T[n:, :n], T[:n, -1], T[n:, -1] = second, sign * q, room
    change = np.hstack([C, np.zeros((n, len(double)))])
    row, kind = np.concatenate([np.arange(n), double]), np.repeat([0, 1], [n, len(double)])
    kept = np.flatnonzero(~np.concatenate([fixed, np.zeros(len(double), dtype=bool)]))
    if len(kept) < len(row):  # columns of λ that can't change leave, and so do their rows
        T, row, kind, change = T[np.ix_(kept, [*kept, -1])], row[kept], kind[kept], change[:, kept]
    parts = Plain(T[:, :-1], T[:, -1], row, kind, start, change, sign, (free[:0], free[:0]))
    return _without_free(parts, T, free) if len(free) else parts


def _without_free(parts, T, free):
    """Solve the free rows for their λ; those that can't be are split in two."""
    rows = list(np.flatnonzero(np.isin(parts.row, free) & (parts.kind == 0)))
    columns, solved = list(rows), []
    while rows:
        size = np.abs(T[np.ix_(rows, columns)])
        size[np.equal.outer(rows, columns)] *= 8  # rather on the diagonal: that keeps M semidefinite
        k, l = np.unravel_index(size.argmax(), size.shape)
        if not abs(T[rows[k], columns[l]]) > _TINY:
            break
        exchange(T, rows[k], columns[l])
        solved.append((rows.pop(k), columns.pop(l)))
    T[np.abs(T[:, -1]) <= _NOISE * np.abs(parts.q).max(initial=1), -1] = 0
    used_rows, used_columns = np.array(solved, dtype=int).reshape(-1, 2).T
    m = len(T)
    keep_rows, keep_columns = (np.setdiff1d(np.arange(m), used) for used in (used_rows, used_columns))
    start = parts.start + parts.change[:, used_columns] @ T[used_rows, -1]
    T[rows, :] = np.where(np.abs(T[rows, :]) > _TINY, T[rows, :], 0)
    T[:, columns] = np.where(np.abs(T[:, columns]) > _TINY, T[:, columns], 0)
    split_rows, split_columns = np.array(rows, dtype=int), np.array(columns, dtype=int)
    keep_rows = np.concatenate([np.setdiff1d(keep_rows, split_rows), split_rows])
    keep_columns = np.concatenate([np.setdiff1d(keep_columns, split_columns), split_columns])
    change = (
        parts.change[:, keep_columns] + parts.change[:, used_columns] @ T[np.ix_(used_rows, keep_columns)]
    )
    M, q, k = T[np.ix_(keep_rows, keep_columns)], T[keep_rows, -1], len(rows)
    last = slice(len(M) - k, len(M))
    M = np.hstack([M, -M[:, last]])
    M, q = np.vstack([M, -M[last]]), np.concatenate([q, -q[last]])
    change = np.hstack([change, -change[:, last]]) if k else change
    row = np.concatenate([parts.row[keep_rows], parts.row[split_rows]])
    kind = np.concatenate([parts.kind[keep_rows], np.full(k, 3)])
    kind[last] = 2
    solved = parts.row[used_rows], parts.row[used_columns]
    return Plain(M, q, row, kind, start, change, parts.sign, solved)
