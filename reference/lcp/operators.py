"""What a kernel that goes row by row needs of A, for each form that A can have.

One text of a method serves every form of A. The method takes four functions before its data, and
``for_form(method, form)`` fixes them (by ``bind``, so that the compiled loop has no call left in it):

    x = follow(A, λ)                               what A λ is computed from, besides A
    row(A, i, λ, x)                                row i of A λ
    rows(A, i, λ_old, x_old, λ, x)                 row i of A λ for two λ, of before and of now
    change(A, i, Δ, x)                             λ_i has changed by Δ: let x follow

For a matrix, dense or sparse, x is λ itself. For the factored operator x is
u = M⁻¹ Jᵀ λ, the bodies' velocities: to renew a row is then to push two bodies, as engines do, and A is never
formed (S7, S8).

Slides S8, S16; lectures/07_iterative_lcp.md.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
import scipy.sparse

from ..compiled import bind, compiled
from ..factored import Factored, add_row, add_rows, row_times


class Sparse(NamedTuple):
    """A sparse A: row i has the numbers value[start[i]:start[i + 1]] in these columns.

    The indices are unsigned: a signed one might be negative and count from the end, and to look whether it is
    takes longer than the sum itself (measured: 2 to 3 times the whole sweep).
    """

    start: np.ndarray
    column: np.ndarray
    value: np.ndarray


class Factors(NamedTuple):
    """The factored operator as arrays: see ``reference.factored``."""

    bodies: np.ndarray
    J: np.ndarray
    B: np.ndarray
    softness: np.ndarray
    velocities: np.ndarray  # (count, k): its shape is what is needed


def arrays(A):
    """A as the kernels take it: Factors, or a Sparse; a dense A is one that leaves out nothing."""
    if isinstance(A, Factored):
        return Factors(A.bodies, A.J, A.B, A.softness, np.zeros((A.count, A.J.shape[2])))
    if scipy.sparse.issparse(A):
        return Sparse(A.indptr.astype(np.uint32), A.indices.astype(np.uint32), A.data)
    n = np.uint32(len(A))
    return Sparse(np.arange(n + 1, dtype=np.uint32) * n, np.tile(np.arange(n, dtype=np.uint32), n), A.ravel())


@compiled
def follow_matrix(A, λ):
    """x is λ itself."""
    return λ


@compiled
def change_matrix(A, i, Δ, x):
    """x is λ itself, and has changed already."""


@compiled(reorder=True)
def row_matrix(A, i, λ, x):
    """Row i of A λ."""
    now = 0.0
    for k in range(A.start[i], A.start[i + 1]):
        now += A.value[k] * λ[A.column[k]]
    return now


@compiled
def rows_matrix(A, i, λ_old, x_old, λ, x):
    """Row i of A λ for two λ; A is read once."""
    old, now = 0.0, 0.0
    for k in range(A.start[i], A.start[i + 1]):
        j, a = A.column[k], A.value[k]
        old += a * λ_old[j]
        now += a * λ[j]
    return old, now


@compiled
def follow_factored(A, λ):
    """x is u = M⁻¹ Jᵀ λ."""
    u = np.zeros_like(A.velocities)
    add_rows(A.bodies, A.B, λ, u)
    return u


@compiled
def row_factored(A, i, λ, x):
    """Row i of A λ = J u + softness λ."""
    return row_times(A.bodies, A.J, i, x) + A.softness[i] * λ[i]


@compiled
def rows_factored(A, i, λ_old, x_old, λ, x):
    """Row i of A λ for two λ; J is read once."""
    old, now = A.softness[i] * λ_old[i], A.softness[i] * λ[i]
    for side in range(A.bodies.shape[1]):
        body = A.bodies[i, side]
        if body >= 0:
            for c in range(A.J.shape[2]):
                old += A.J[i, side, c] * x_old[body, c]
                now += A.J[i, side, c] * x[body, c]
    return old, now


@compiled
def change_factored(A, i, Δ, x):
    """Push the bodies of row i: u += M⁻¹ J_iᵀ Δ."""
    add_row(A.bodies, A.B, i, Δ, x)


_FORMS = {
    Sparse: (follow_matrix, row_matrix, rows_matrix, change_matrix),
    Factors: (follow_factored, row_factored, rows_factored, change_factored),
}


@cache
def for_form(method, form, *more):
    """The kernel that a method is for one form of A, ``Sparse`` or ``Factors``; more: functions that the
    method takes after the four.
    """
    return bind(method, *_FORMS[form], *more)


@compiled
def product(follow, row, A, λ, out):
    """Fill out (n,) with A λ, whatever the form of A."""
    x = follow(A, λ)
    for i in range(len(λ)):
        out[i] = row(A, i, λ, x)
