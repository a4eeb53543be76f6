"""Gauss–Seidel over contacts: each in turn is solved exactly, with what the others do now.

As Gauss–Seidel, but a block (n, t1, t2) at a time: the friction cone is taken whole, so friction is the
same in all directions, and the contact by itself is solved by ``one_contact``, which can't fail for a
positive block. So a lone contact takes one sweep. For the convex law each block lowers the energy, and the
sweeps converge wherever a solution exists; for Coulomb's law that is what one sees, though nobody has
proved it.

Slides S14, S16, S17; lectures/08_newton_lcp.md. Source: Jourdan, Alart & Jean, CMAME 155 (1998) 31; Daviet,
Bertails-Descoubes & Boissieux, ACM TOG 30 (2011) 139, for an exact local solver.
"""

import numpy as np

from ..compiled import compiled
from ..factored import Factored
from .iteration import BLOWN_UP, iterate
from .merit import cone_gap, larger
from .one_contact import solve_contact
from .solution import DIVERGED, MAX_ITERATIONS, SOLVED
from .symmetry import why_no_cone


@compiled
def cone_sweeps(follow, row, rows, change, A, terms, λ, scale, tolerance, history, block):
    """Sweep over the blocks until the residual is at most the tolerance; returns (sweeps, code).

    The arguments are those of ``gauss_seidel.sweeps``; block (m, 3, 3): A's diagonal blocks. history[k] is
    the residual before sweep k.
    """
    x, size, w, q = follow(A, λ), terms.size, 0 * block[0, 0], 0 * block[0, 0]
    λ_old, x_old = λ.copy(), x.copy()
    for k in range(len(history) - 1):
        λ_old[:], worst = λ, 0.0
        x_old[:] = x
        for c in range(len(terms.mu)):
            for a in range(size):
                i = c * size + a
                before, now = rows(A, i, λ_old, x_old, λ, x)
                w[a], q[a] = before + terms.b[i], now + terms.b[i]
                for e in range(size):
                    q[a] -= block[c, a, e] * λ[c * size + e]
            for r in cone_gap(terms, λ_old, c, w[0], w[1], w[2]):
                worst = larger(worst, abs(r))
            new = solve_contact(block[c], q[0], q[1], q[2], terms.mu[c], terms.coulomb)
            put(change, A, λ, x, c * size, new[0])
            put(change, A, λ, x, c * size + 1, new[1])
            if size == 3:
                put(change, A, λ, x, c * size + 2, new[2])
        history[k] = worst / scale
        if not tolerance < history[k] <= BLOWN_UP * max(1.0, history[0]):
            λ[:] = λ_old
            return k, SOLVED if history[k] <= tolerance else DIVERGED
    return len(history) - 1, MAX_ITERATIONS


@compiled
def put(change, A, λ, x, i, value):
    """λ_i ← value, and x follows."""
    Δ = value - λ[i]
    λ[i] = value
    change(A, i, Δ, x)


def diagonal_blocks(problem):
    """A's blocks on the diagonal (m, 3, 3); in the plane the third row and column are those of 1."""
    A, size, m = problem.A, problem.size, len(problem.mu)
    rows = np.arange(problem.n).reshape(m, size)
    result = np.zeros((m, 3, 3))
    result[:, 2, 2] = 1
    for a in range(size):
        for e in range(size):
            result[:, a, e] = _entries(A, rows[:, a], rows[:, e]) if m else 0
    return result


def _entries(A, i, j):
    """A_ij for pairs of rows and columns."""
    if not isinstance(A, Factored):
        return np.asarray(A[i, j]).ravel()
    found = np.where(i == j, A.softness[i], 0.0)
    for side in range(A.bodies.shape[1]):
        for other in range(A.bodies.shape[1]):
            same = (A.bodies[i, side] == A.bodies[j, other]) & (A.bodies[i, side] >= 0)
            found += np.where(same, np.sum(A.J[i, side] * A.B[j, other], axis=1), 0)
    return found


def cone_gauss_seidel(problem, start=None, tolerance=1e-10, max_iterations=1000):
    """Solve a ConeProblem by Gauss–Seidel over contacts: either law, A dense, sparse or factored.

    start (n,): λ to begin with; None: 0. One iteration is a sweep over all contacts. Needs a symmetric A with
    positive A_ii, else the problem is ``unsuitable``. Slow where heavy rests on light, as all splitting.
    Returns a ``Solution``. Raises ValueError or TypeError for bad arguments.
    """
    return iterate(
        cone_sweeps, problem, start, tolerance, max_iterations,
        options=(diagonal_blocks,), why_not=why_no_cone,
    )  # fmt: skip
