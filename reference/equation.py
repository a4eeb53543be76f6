"""Embedding: the equation of motion multiplied by J M⁻¹ and allied with the joints' conditions (S8).

    M u̇ = f_e + Jᵀ λ,   J u̇ + J̇ u = 0      ⇒      A λ + b = 0,   A = J M⁻¹ Jᵀ,   b = J M⁻¹ f_e + J̇ u

b is what the rate of w would be without the joints. In a time-stepping method the same stands for impulses:
A is multiplied by Δt, and b is the w at the end of a step without joints.

The kernels work row by row and never form M; ``equation`` below puts the same into matrices, to be looked at.

Slides S7–S9; lectures/04_embedding.md.
"""

from .bodies import add_gyroscopic_torque, solve_mass
from .compiled import compiled
from .rotation import dot
from .rows import add_row, add_rows, fill_rows, row_times


@compiled
def constrained_force(force, factorise, substitute, system, t, state, f, τ):
    """f_e + f_c: the external force, and the constraint force Jᵀ λ that keeps the joints' accelerations (S8).

    force(system, t, state, f, τ) fills in the external one; factorise and substitute solve A λ = right (see
    ``multipliers``). f (M, d) in N, τ (r, 3) or (r, 1) in N m.
    """
    mechanism = system.mechanism
    rows, jacobian = mechanism.rigid, mechanism.jacobian
    force(system, t, state, f, τ)
    add_joint_springs(mechanism, state, f, τ)
    mechanism.v[:], mechanism.ω[:] = f, τ
    add_gyroscopic_torque(system, state, mechanism.ω)
    solve_mass(system, state.q, mechanism.v, mechanism.ω)  # u̇ without joints
    fill_rows(rows, state, jacobian)
    fill_mass_rows(system, rows, jacobian, mechanism.B)
    for k in range(len(mechanism.λ)):
        b = row_times(jacobian.J, rows.bodies, k, mechanism.v, mechanism.ω) + jacobian.rate[k]
        mechanism.right[k] = -b
    factorise(system, mechanism)
    substitute(mechanism, mechanism.right, mechanism.λ)
    add_rows(jacobian.J, rows.bodies, mechanism.λ, f, τ)


@compiled
def add_joint_springs(mechanism, state, f, τ):
    """Add Jᵀ λ of the soft rows, whose λ = −stiffness φ − damping w is known."""
    rows, out = mechanism.soft, mechanism.soft_jacobian
    if len(rows.kind) == 0:
        return
    fill_rows(rows, state, out)
    for k in range(len(rows.kind)):
        w = row_times(out.J, rows.bodies, k, state.v, state.ω)
        add_row(out.J, rows.bodies, k, -rows.stiffness[k] * out.φ[k] - rows.damping[k] * w, f, τ)


@compiled
def fill_mass_rows(system, rows, jacobian, B):
    """B = J M⁻¹, row by row."""
    d = 2 if B.shape[2] == 3 else 3
    for k in range(len(B)):
        for side in range(2):
            i = rows.bodies[k, side]
            if i < 0:
                continue
            for c in range(d):
                B[k, side, c] = jacobian.J[k, side, c] / system.mass[i]
            if i >= len(system.inertia):
                continue
            if d == 2:
                B[k, side, 2] = jacobian.J[k, side, 2] / system.inertia[i, 0]
            else:
                divide_by_inertia(system.inertia, jacobian.frame, i, jacobian.J, B, k, side)


@compiled
def divide_by_inertia(inertia, frame, i, J, B, k, side):
    """The turning part of B's row: R I⁻¹ Rᵀ times that of J, with R the frame of body i."""
    n = J[k, side, 3], J[k, side, 4], J[k, side, 5]
    R0 = frame[i, 0], frame[i, 3], frame[i, 6]  # the principal axes in the world
    R1 = frame[i, 1], frame[i, 4], frame[i, 7]
    R2 = frame[i, 2], frame[i, 5], frame[i, 8]
    s0, s1, s2 = dot(R0, n) / inertia[i, 0], dot(R1, n) / inertia[i, 1], dot(R2, n) / inertia[i, 2]
    for c in range(3):
        B[k, side, 3 + c] = frame[i, 3 * c] * s0 + frame[i, 3 * c + 1] * s1 + frame[i, 3 * c + 2] * s2
