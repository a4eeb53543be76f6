"""Gauss–Seidel over contacts in the space of the velocities: each in turn is solved exactly, and u follows.

As ``cone_gauss_seidel``, but on rows and masses, so that bounded rows (joints) and contacts mix, and a row
may give way: w = J u + c + γ λ. A change of λ by δ moves the bodies by M⁻¹ Jᵀ δ, at once: that is all that a
contact hears of the others. ``cone_newton`` takes it where its own passes go round.

Slides S14, S16, S17; lectures/08_newton_lcp.md. Source: Jourdan, Alart & Jean, CMAME 155 (1998) 31.
"""

import numpy as np

from ..compiled import compiled, compiled_apart, inner
from ..factored import add_row, row_times
from .augmented import dot
from .one_contact import principal, solve_in_axes


@compiled_apart
def fill_moves(rows, M, moves):
    """How λ = 1 in each row moves its two bodies: M⁻¹ Jᵀ, (m, 2, k)."""
    for r in range(len(rows.c)):
        for side in range(2):
            i = rows.bodies[r, side]
            if i >= 0:
                divide_by_mass(M[i], rows.J[r, side], moves[r, side])


@inner
def divide_by_mass(M, a, out):
    """M⁻¹ a for one body: in space masses first, then the inertia (3, 3); else a diagonal M."""
    if len(a) != 6:
        for c in range(len(a)):
            out[c] = a[c] / M[c, c]
        return
    for c in range(3):
        out[c] = a[c] / M[0, 0]
    I, x, y, z = M[3:, 3:], a[3], a[4], a[5]
    p, q, s = (  # the cofactors of the first row
        I[1, 1] * I[2, 2] - I[1, 2] ** 2,
        I[0, 2] * I[1, 2] - I[0, 1] * I[2, 2],
        I[0, 1] * I[1, 2] - I[0, 2] * I[1, 1],
    )
    yz = I[0, 1] * I[0, 2] - I[0, 0] * I[1, 2]
    determinant = I[0, 0] * p + I[0, 1] * q + I[0, 2] * s
    out[3] = (p * x + q * y + s * z) / determinant
    out[4] = (q * x + (I[0, 0] * I[2, 2] - I[0, 2] ** 2) * y + yz * z) / determinant
    out[5] = (s * x + yz * y + (I[0, 0] * I[1, 1] - I[0, 1] ** 2) * z) / determinant


@compiled
def velocity(rows, r, u):
    """w_r = J u + c."""
    return rows.c[r] + row_times(rows.bodies, rows.J, r, u)


@compiled(door=False)
def velocities(rows, u):
    """w = J u + c of all rows (m,)."""
    w = np.empty(len(rows.c))
    for r in range(len(w)):
        w[r] = velocity(rows, r, u)
    return w


@compiled_apart
def block_sizes(rows, moves, free, size):
    """A's largest diagonal entry of each block; returns the worst |w| of the free velocities, and the largest
    sum of its terms' sizes, m/s.
    """
    scale, worst = 0.0, 0.0
    for q in range(len(size)):
        size[q] = 0.0
        for r in range(rows.block[q], rows.block[q + 1]):
            diagonal, terms = 0.0, abs(rows.c[r])
            for side in range(2):
                i = rows.bodies[r, side]
                if i >= 0:
                    diagonal += dot(rows.J[r, side], moves[r, side])
                    for a in range(free.shape[1]):
                        terms += abs(rows.J[r, side, a] * free[i, a])
            size[q] = max(size[q], diagonal)
            scale, worst = max(scale, abs(velocity(rows, r, free))), max(worst, terms)
    return scale, worst


@compiled_apart
def sweep_contacts(rows, moves, softness, coulomb, λ, u, tolerance, most):
    """Up to so many sweeps, λ and u in place: until none changes a w by more than the tolerance, m/s.

    softness (B,): γ of each block's first row; u must be u_free + M⁻¹ Jᵀ λ. Returns (sweeps, worst change).
    """
    own, q, new, worst = own_blocks(rows, moves, softness), np.zeros(3), np.zeros(3), np.inf
    axes = np.empty((len(own), 4))
    for block in range(len(own)):
        A = own[block]
        axes[block, 0], axes[block, 1], axes[block, 2], axes[block, 3] = principal(A[1, 1], A[1, 2], A[2, 2])
    for sweeps in range(most):
        worst = 0.0
        for block in range(len(rows.μ)):
            first, size, A = rows.block[block], rows.block[block + 1] - rows.block[block], own[block]
            for a in range(size):
                q[a] = velocity(rows, first + a, u)
                for e in range(size):
                    q[a] -= A[a, e] * λ[first + e]
            q[0] += softness[block] * λ[first]
            if rows.μ[block] < 0:
                new[0] = min(max(-q[0] / A[0, 0], rows.lower[first]), rows.upper[first])
            else:
                third, x = q[2] if size == 3 else 0.0, axes[block]
                new[0], new[1], new[2] = solve_in_axes(
                    A, (x[0], x[1], x[2], x[3]), q[0], q[1], third, rows.μ[block], coulomb
                )
            for a in range(size):
                change = new[a] - λ[first + a]
                worst = max(worst, abs(change) * A[a, a])
                add_row(rows.bodies, moves, first + a, change, u)
                λ[first + a] = new[a]
        if worst <= tolerance:
            return sweeps + 1, worst
    return most, worst


@compiled
def own_blocks(rows, moves, softness):
    """(B, 3, 3): A's blocks on the diagonal; a row that is not there has 1."""
    own = np.zeros((len(rows.μ), 3, 3))
    for q in range(len(own)):
        first, size = rows.block[q], rows.block[q + 1] - rows.block[q]
        for a in range(3):
            own[q, a, a] = 0.0 if a < size else 1.0
        for a in range(size):
            for e in range(size):
                for side in range(2):
                    if rows.bodies[first, side] >= 0:
                        own[q, a, e] += dot(rows.J[first + a, side], moves[first + e, side])
        own[q, 0, 0] += softness[q]
    return own
