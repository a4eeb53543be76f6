"""The same J both ways: w = J u takes velocities to the joints, f_c = Jᵀ λ takes forces back (S7).

u and forces on bodies are given as v (M, d) and ω (r, 3) or (r, 1), as in ``State``.

Slide S7; lectures/03_jacobian.md.
"""

import numpy as np

from ..compiled import lean


@lean
def row_times(J, bodies, k, v, ω):
    """Row k of J u, from velocities to the constraint (S7); u given as v (M, d) and ω (r, 3) or (r, 1)."""
    d = v.shape[1]
    w = 0.0
    for side in range(2):
        i = bodies[k, side]
        if i >= 0:
            for c in range(d):
                w += J[k, side, c] * v[i, c]
            if i < len(ω):
                for c in range(ω.shape[1]):
                    w += J[k, side, d + c] * ω[i, c]
    return w


@lean
def add_row(J, bodies, k, λ, f, τ):
    """Add row k's part of Jᵀ λ, from the constraint back to the bodies (S7); λ a number."""
    d = f.shape[1]
    for side in range(2):
        i = bodies[k, side]
        if i >= 0:
            for c in range(d):
                f[i, c] += J[k, side, c] * λ
            if i < len(τ):
                for c in range(τ.shape[1]):
                    τ[i, c] += J[k, side, d + c] * λ


@lean
def add_rows(J, bodies, λ, f, τ):
    """Jᵀ λ added to f (M, d) and τ (r, 3) or (r, 1). With B for J: M⁻¹ Jᵀ λ added to velocities."""
    for k in range(len(λ)):
        add_row(J, bodies, k, λ[k], f, τ)


def dense(J, bodies, M, r):
    """J as a matrix (m, size of u), to be looked at: the columns are those of ``State.u``, v, then ω.

    J (m, 2, k), bodies (m, 2); M moving bodies, the first r of them rotate.
    """
    d, s = (3, 3) if J.shape[2] == 6 else (2, 1)
    matrix = np.zeros((len(J), M * d + r * s))
    for k, (row, ends) in enumerate(zip(J, bodies, strict=True)):
        for part, i in zip(row, ends, strict=True):
            if i >= 0:
                matrix[k, i * d : (i + 1) * d] += part[:d]
            if 0 <= i < r:
                matrix[k, M * d + i * s : M * d + (i + 1) * s] += part[d:]
    return matrix
