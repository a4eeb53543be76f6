"""Which solver for λ a scene's joints need, and why.

Slides S8, S9; lectures/04_embedding.md. Source of the rank: Golub & Van Loan, Matrix Computations (2013),
section 5.4.1.
"""

from typing import NamedTuple

import numpy as np

from .multipliers.tree import links_of_tree
from .rows import fill_rows, make_jacobian

FEW = 12  # rows: so many a dense matrix serves as well as any
HUB = 12  # joints on one body: A has a full block for all of their rows
DENSE = 500  # rows: up to so many the singular values are worth their cost
SINGULAR = 1e-6  # a singular value over the largest, below which a row is a sum of others
NEARLY = 1e-4  # and below which it may become one


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
    if m <= DENSE:
        values = np.linalg.svd(scaled_rows(bodies, rows), compute_uv=False)
        values = np.concatenate([values, np.zeros(m - len(values))]) / values[0]
        redundant = int(np.sum(values < SINGULAR))
        if redundant:
            return Choice("minimum_norm", f"{redundant} of {m} rows are redundant", m, redundant, True)
        if values[-1] < NEARLY:
            return Choice("minimum_norm", "loops near a singular position", m, 0, True)
    if m <= FEW:
        return Choice("cholesky", f"loops, but only {m} rows, none of them redundant", m, 0, True)
    return Choice("sparse", "loops of many rows", m, 0, True)


def joints_on_a_body(rows):
    """How many joints the body with the most of them has."""
    _, first = np.unique(rows.joint, return_index=True)
    bodies = rows.bodies[first].ravel()
    return int(np.bincount(bodies[bodies >= 0]).max(initial=0))


def scaled_rows(bodies, rows):
    """J M^(−1/2) at the start, each row divided by its length: (m, velocities); its square is A, scaled."""
    m, d = len(rows.kind), bodies.dimension
    jacobian = make_jacobian(m, len(bodies.rotating), d)
    fill_rows(rows, bodies.state(), jacobian)
    M, k = len(bodies.moving), jacobian.J.shape[2]
    J = np.zeros((m, M, k))
    for side in range(2):
        there = rows.bodies[:, side] >= 0
        np.add.at(J, (np.flatnonzero(there), rows.bodies[there, side]), jacobian.J[there, side])
    J[..., :d] /= np.sqrt(bodies.system.mass)[:, None]
    for i, moments in enumerate(bodies.moments):
        frame = jacobian.frame[i].reshape(3, 3) if d == 3 else np.eye(1)
        J[:, i, d:] = J[:, i, d:] @ frame / np.sqrt(moments)
    J = J.reshape(m, M * k)
    return J / np.linalg.norm(J, axis=1, keepdims=True)
