"""The operator A = J M⁻¹ Jᵀ, kept as its factors: never formed, unless somebody asks to see it.

A row of J concerns few bodies, so J is kept as (m, s, k): row i acts on the bodies ``bodies[i]``, s of them
(two for joints and contacts; −1 stands for the world, which doesn't move), with k numbers for each (6 in
space, 3 in the plane). B = J M⁻¹ has the same shape. A λ goes through the bodies' velocities (S7, S8):

    u = M⁻¹ Jᵀ λ = Bᵀ λ        from the constraints to the bodies
    A λ = J u + softness λ     and back

That costs a few numbers a row, however many rows a body has; A itself has a block for each pair of rows that
share a body. A general J (m, N) is the same with k = 1: each of its columns is a body of one velocity.

Slides S7, S8; lectures/04_embedding.md.
"""

import numpy as np
import scipy.sparse

from . import inputs
from .compiled import compiled


class Factored:
    """A = J M⁻¹ Jᵀ + diag(softness), over rows that concern s bodies each.

    bodies (m, s) whole numbers: which bodies row i concerns, −1 for the world. J, B (m, s, k): rows of J
    and of J M⁻¹ in the same places (what they hold for the world is never read). count: how many bodies
    there are. softness (m,) at least 0: added to the diagonal, for rows that give way; None: rigid. mass
    (count, k, k): M of each body, with B M = J, for methods that work on the velocities; None: not told.
    All arrays are copied. Raises ValueError or TypeError, which name the argument.
    """

    def __init__(self, bodies, J, B, count, softness=None, mass=None):
        self.count = inputs.whole("count", count)
        self.bodies = _checked_bodies(bodies, self.count)
        m, s = self.bodies.shape
        shape = np.shape(J)
        if len(shape) != 3 or shape[:2] != (m, s):
            raise ValueError(
                f"J must have shape (m, s, k) with (m, s) = {(m, s)}, as bodies, but has {shape}"
            )
        self.J = inputs.array("J", J, shape)
        self.B = inputs.array("B", B, shape)
        self.J[self.bodies < 0] = self.B[self.bodies < 0] = 0
        self.softness = inputs.array("softness", np.zeros(m) if softness is None else softness, (m,))
        if m and self.softness.min() < 0:
            raise ValueError(f"softness must be at least 0, but holds {self.softness.min():g}")
        self.mass = None if mass is None else self._checked_mass(mass)
        self.shape = (m, m)

    def _checked_mass(self, mass):
        k = self.J.shape[2]
        mass = inputs.array("mass", mass, (self.count, k, k))
        if self.J.size:
            again = np.einsum("msk,mskl->msl", self.B, mass[self.bodies])
            if np.abs(again - self.J).max() > 1e-8 * np.abs(self.J).max():
                raise ValueError("mass must be the M of B = J M⁻¹, but B M is not J")
        return mass

    @classmethod
    def from_matrices(cls, J, mass_inverse, softness=None):
        """From J (m, N), dense or sparse, and M⁻¹: (N, N), dense or sparse, symmetric; or its diagonal (N,).

        Raises ValueError or TypeError, which name the argument.
        """
        J = _checked_matrix("J", J)
        N = J.shape[1]
        if np.ndim(mass_inverse) == 1:
            mass_inverse = scipy.sparse.diags_array(inputs.array("mass_inverse", mass_inverse, (N,)))
        inverse = _checked_matrix("mass_inverse", mass_inverse)
        if inverse.shape != (N, N):
            raise ValueError(
                f"mass_inverse must have shape {(N, N)}, as J has {N} columns, not {inverse.shape}"
            )
        if N and abs(inverse - inverse.T).max() > 1e-12 * abs(inverse).max():
            raise ValueError("mass_inverse must be symmetric, but differs from its transpose")
        B = scipy.sparse.csr_array(J @ inverse)
        pattern = scipy.sparse.csr_array(abs(J) + abs(B))  # where either of the two has a number
        pattern.eliminate_zeros()
        row = np.repeat(np.arange(J.shape[0]), np.diff(pattern.indptr))
        slot, column = np.arange(len(row)) - pattern.indptr[row], pattern.indices
        bodies = np.full((J.shape[0], int(slot.max(initial=-1)) + 1), -1)
        bodies[row, slot] = column
        packed = np.zeros((2, *bodies.shape, 1))
        for whole, part in zip((J, B), packed, strict=True):
            part[row, slot, 0] = np.asarray(whole[row, column]).ravel() if len(row) else 0
        return cls(bodies, *packed, N, softness)

    def __matmul__(self, λ):
        """A λ (m,), by way of the bodies' velocities. Raises ValueError where λ is not of shape (m,)."""
        λ = np.asarray(λ, dtype=float)
        if λ.shape != self.shape[:1]:
            raise ValueError(f"A @ λ needs λ of shape {self.shape[:1]}, but it has {λ.shape}")
        result = np.empty(len(λ))
        multiply(self.bodies, self.J, self.softness, λ, self.velocities(λ), result)
        return result

    def velocities(self, λ):
        """u = M⁻¹ Jᵀ λ (count, k): what the constraint impulses λ (m,) do to the bodies' velocities."""
        u = np.zeros((self.count, self.J.shape[2]))
        add_rows(self.bodies, self.B, np.asarray(λ, dtype=float), u)
        return u

    def sizes(self, λ):
        """(m,): the sum of the sizes of all that is added up in A λ; its rounding is about ε times that."""
        J, B, λ = np.abs(self.J), np.abs(self.B), np.abs(np.asarray(λ, dtype=float))
        u, result = np.zeros((self.count, J.shape[2])), np.empty(len(λ))
        add_rows(self.bodies, B, λ, u)
        multiply(self.bodies, J, self.softness, λ, u, result)
        return result

    def diagonal(self):
        """A_ii (m,)."""
        result = self.softness.copy()
        for side in range(self.bodies.shape[1]):
            for other in range(self.bodies.shape[1]):  # a row may name the same body twice
                same = self.bodies[:, side] == self.bodies[:, other]
                result += np.where(same, np.sum(self.J[:, side] * self.B[:, other], axis=1), 0)
        return result

    def row_peaks(self, rows):
        """max_j |A_ij| for some rows i (whole numbers): an array like ``rows``."""
        part = scipy.sparse.csr_array(self._unpacked(self.J)[rows] @ self._unpacked(self.B).T)
        part += scipy.sparse.csr_array(
            (self.softness[rows], (np.arange(len(rows)), rows)), shape=(len(rows), self.shape[0])
        )
        return abs(part).max(axis=1).toarray().ravel() if len(rows) else np.zeros(0)

    def tosparse(self):
        """A formed, as a SciPy ``csr_array`` (m, m)."""
        whole = self._unpacked(self.J) @ self._unpacked(self.B).T + scipy.sparse.diags_array(self.softness)
        return scipy.sparse.csr_array(whole)

    def toarray(self):
        """A formed, as a dense array (m, m)."""
        return self.tosparse().toarray()

    def _unpacked(self, rows):
        """J or B as a sparse matrix (m, count · k)."""
        m, _, k = rows.shape
        column = self.bodies[:, :, None] * k + np.arange(k)
        row = np.broadcast_to(np.arange(m)[:, None, None], column.shape)
        there = np.broadcast_to(self.bodies[:, :, None] >= 0, column.shape)
        return scipy.sparse.csr_array(
            (rows[there], (row[there], column[there])), shape=(m, self.count * k)
        )  # what a row says twice of a body is summed


@compiled
def row_times(bodies, J, i, u):
    """Row i of J u, from the bodies to the constraint (S7); u (count, k)."""
    w = 0.0
    for side in range(bodies.shape[1]):
        body = bodies[i, side]
        if body >= 0:
            for c in range(J.shape[2]):
                w += J[i, side, c] * u[body, c]
    return w


@compiled
def add_row(bodies, B, i, λ, u):
    """Add row i's part of Bᵀ λ to the velocities u (count, k); λ a number."""
    for side in range(bodies.shape[1]):
        body = bodies[i, side]
        if body >= 0:
            for c in range(B.shape[2]):
                u[body, c] += B[i, side, c] * λ


@compiled
def add_rows(bodies, B, λ, u):
    """Add Bᵀ λ to u: all rows."""
    for i in range(len(λ)):
        add_row(bodies, B, i, λ[i], u)


@compiled
def multiply(bodies, J, softness, λ, u, out):
    """Fill out (m,) with A λ = J u + softness λ, where u (count, k) = Bᵀ λ."""
    for i in range(len(λ)):
        out[i] = row_times(bodies, J, i, u) + softness[i] * λ[i]


def _checked_bodies(bodies, count):
    result = np.array(bodies)
    if result.size == 0 and result.ndim < 2:
        result = np.zeros((0, 2), dtype=int)
    if result.ndim != 2 or (result.size and result.dtype.kind not in "iu"):
        raise TypeError(
            f"bodies must be an array (m, 2) of whole numbers, but is of shape {result.shape}, {result.dtype}"
        )
    if result.size and not (-1 <= result.min() and result.max() < count):
        raise ValueError(
            f"bodies must be numbers of bodies, 0 to {count - 1}, or −1 for the world, but go from "
            f"{result.min()} to {result.max()}"
        )
    return result.astype(np.int64)


def _checked_matrix(name, matrix):
    """A csr_array of finite numbers."""
    if not scipy.sparse.issparse(matrix):
        if np.ndim(matrix) != 2:
            raise ValueError(
                f"{name} must be a matrix, dense or sparse, but has {np.ndim(matrix)} dimensions"
            )
        matrix = inputs.array(name, matrix, np.shape(matrix))
    result = scipy.sparse.csr_array(matrix, dtype=float)
    if not np.isfinite(result.data).all():
        raise ValueError(f"{name} must hold finite numbers only")
    return result
