"""Which solver for λ a scene's joints need, and why.

Slides S8, S9; lectures/04_embedding.md. Source of the rank: Golub & Van Loan, Matrix Computations (2013),
section 8.1.5 (the law of inertia).
"""

from typing import NamedTuple

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from .multipliers.tree import links_of_tree
from .rows import fill_rows, make_jacobian

FEW = 12  # rows: so many a dense matrix serves as well as any
HUB = 12  # joints on one body: A has a full block for all of their rows
LOOPS = 100  # rows: up to so many their rank is looked at in each evaluation, where joints close loops
SINGULAR = 1e-6  # of a row's length: where a combination of rows is shorter, one is a sum of others


class Choice(NamedTuple):
    """A solver and why; how many rows, and redundant ones at the start; whether joints close loops."""

    solver: str
    why: str
    rows: int
    redundant: int
    loops: bool


def choose_solver(bodies, rows):
    """The ``Choice`` for these rigid rows of ``layout.Bodies``."""
    m = len(rows.kind)
    if m == 0:
        return Choice("cholesky", "no joint is rigid, so there is nothing to solve", 0, 0, False)
    if links_of_tree(rows, len(bodies.moving)) is not None:
        if m <= FEW:
            return Choice("cholesky", f"{m} rows without loops are few", m, 0, False)
        if joints_on_a_body(rows) > HUB:
            return Choice("tree", "no loops, and a body with many joints", m, 0, False)
        return Choice("sparse", "no loops, and few joints on each body", m, 0, False)
    redundant = short_combinations(scaled_rows(bodies, rows), SINGULAR)
    if redundant:
        return Choice("minimum_norm", f"{redundant} of {m} rows are redundant", m, redundant, True)
    if m <= LOOPS:
        return Choice("minimum_norm", "loops, which may come to a singular position", m, 0, True)
    return Choice("sparse", "loops of many rows", m, 0, True)


def short_combinations(J, length):
    """How many singular values of the rows J (sparse, each of length 1) are below ``length``.

    They are counted, not found: by Sylvester's law of inertia as many pivots of J Jᵀ − length² are negative
    as it has eigenvalues below 0. So the cost is that of one sparse factorisation.
    """
    shifted = J @ J.T - length**2 * scipy.sparse.eye_array(J.shape[0])
    factor = scipy.sparse.linalg.splu(
        shifted.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    return int(np.sum(factor.U.diagonal() < 0))


def joints_on_a_body(rows):
    """How many joints the body with the most of them has."""
    _, first = np.unique(rows.joint, return_index=True)
    bodies = rows.bodies[first].ravel()
    return int(np.bincount(bodies[bodies >= 0]).max(initial=0))


def scaled_rows(bodies, rows):
    """J M^(−1/2) at the start, each row divided by its length: (m, M k), sparse; its square is A, scaled."""
    m, d, M = len(rows.kind), bodies.dimension, len(bodies.moving)
    jacobian = make_jacobian(m, len(bodies.rotating), d)
    fill_rows(rows, bodies.state(), jacobian)
    J, k = jacobian.J, jacobian.J.shape[2]
    mass = np.ones((M, k))
    mass[:, :d] = bodies.system.mass[:, None]
    mass[: len(bodies.moments), d:] = bodies.moments
    parts = []
    for side in range(2):
        row = np.flatnonzero(rows.bodies[:, side] >= 0)
        body = rows.bodies[row, side]
        part = J[row, side]
        if d == 3:
            turns = np.flatnonzero(body < len(bodies.moments))
            frame = jacobian.frame[body[turns]].reshape(-1, 3, 3)
            part[turns, 3:] = np.einsum("kc,kcx->kx", part[turns, 3:], frame)
        places = np.repeat(row, k), (body[:, None] * k + np.arange(k)).ravel()
        parts.append(scipy.sparse.coo_array(((part / np.sqrt(mass[body])).ravel(), places), (m, M * k)))
    scaled = (parts[0] + parts[1]).tocsr()
    length = scipy.sparse.linalg.norm(scaled, axis=1)
    return scipy.sparse.diags_array(1 / np.where(length > 0, length, 1)) @ scaled
