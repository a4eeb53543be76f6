"""A problem w = A λ + b as rows J and masses M of bodies, with A = J M⁻¹ Jᵀ: where ``cone_newton`` works.

Where A is a ``Factored`` of at most two bodies a row, that is what it is made of, if it knows M or M is
diagonal. Any other A is one body, of as many velocities as A has rank and with M = 1: A = G Gᵀ, J = G.

Slides S7, S8, S14; lectures/08_newton_lcp.md.
"""

import numpy as np

from ..factored import Factored
from .augmented import ContactRows
from .direct import formed
from .problem import ConeProblem

_RANK = 1e-13  # of the largest eigenvalue: below that it is rounding


def velocity_form(problem):
    """(ContactRows, M (n, k, k), softness (B,)) of a ConeProblem or an LCP with bounds; None where A is not
    semidefinite. Softness stays apart where only the first row of each block has any.
    """
    m, parts, softness = problem.n, None, np.zeros(problem.n)
    size = problem.size if isinstance(problem, ConeProblem) else 1
    two = isinstance(problem.A, Factored) and problem.A.bodies.shape[1] <= 2
    if two and not problem.A.softness.reshape(-1, size)[:, 1:].any():
        parts, softness = _as_it_is(problem.A), problem.A.softness
    if parts is None:
        parts, softness = one_body(problem.A), np.zeros(m)
    if parts is None:
        return None
    bodies, J, M = parts
    if isinstance(problem, ConeProblem):
        block, μ = np.arange(0, m + 1, problem.size), problem.mu.copy()
        lower, upper = np.zeros(m), np.full(m, np.inf)
    else:
        block, μ, lower, upper = np.arange(m + 1), np.full(m, -1.0), problem.lower, problem.upper
    return ContactRows(bodies, J, problem.b, block, μ, lower, upper), M, softness[::size].copy()


def _as_it_is(A):
    """(bodies (m, 2), J (m, 2, k), M) of a factored A, or None where M can't be told."""
    M = A.mass if A.mass is not None else _diagonal_masses(A)
    if M is None:
        return None
    m, s, k = A.J.shape
    bodies, J = np.full((m, 2), -1), np.zeros((m, 2, k))
    bodies[:, :s], J[:, :s] = A.bodies, A.J
    return bodies, J, M


def _diagonal_masses(A):
    """M (count, k, k) where B = J M⁻¹ with a diagonal M; None where it is not diagonal."""
    inverse = np.zeros((A.count, A.J.shape[2]))
    there = (A.bodies[:, :, None] >= 0) & (A.J != 0)
    body, entry = np.broadcast_to(A.bodies[:, :, None], A.J.shape), np.indices(A.J.shape)[2]
    inverse[body[there], entry[there]] = (A.B / np.where(A.J != 0, A.J, 1))[there]
    if np.abs(A.B - A.J * inverse[A.bodies]).max(initial=0) > 1e-12 * np.abs(A.B).max(initial=0):
        return None
    inverse[inverse == 0] = 1  # what no row moves
    if inverse.min(initial=1) <= 0:
        return None
    return np.eye(inverse.shape[1]) / inverse[:, None, :]


def one_body(A):
    """(bodies, J, M) with J Jᵀ = A and M = 1; None where A has a negative eigenvalue."""
    A = formed(A)
    A = A if isinstance(A, np.ndarray) else A.toarray()
    d = 1 / np.sqrt(A.diagonal())
    value, vector = np.linalg.eigh(
        0.5 * (A + A.T) * d * d[:, None]
    )  # scaled: units must not decide on the rank
    if value.min() < -1e-11 * value.max():
        return None
    keep = value > _RANK * value.max()
    G = vector[:, keep] * np.sqrt(value[keep]) / d[:, None]
    m, k = G.shape
    bodies, J = np.full((m, 2), -1), np.zeros((m, 2, k))
    bodies[:, 0], J[:, 0] = 0, G
    return bodies, J, np.eye(k)[None]
