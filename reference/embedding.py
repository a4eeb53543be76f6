"""Embedding: the equation of motion multiplied by J M⁻¹ and allied with the joints' conditions (S8).

    M u̇ = f_e + Jᵀ λ,   J u̇ + J̇ u = 0      ⇒      A λ + b = 0,   A = J M⁻¹ Jᵀ,   b = J M⁻¹ f_e + J̇ u

b is what the rate of w would be without the joints. These are the loops that run in each stage of a step,
row by row; they never form M. ``equation`` puts the same into matrices, to be looked at.

Slides S7–S9; lectures/04_embedding.md.
"""

from .bodies import add_gyroscopic_torque
from .compiled import lean, merged
from .multipliers import MINIMUM_NORM, factorise, substitute
from .rows import add_row, add_rows, fill_rows, row_times


@merged
def constrained_force(force, system, t, state, f, τ):
    """f_e + f_c: the external force, and the constraint force Jᵀ λ that keeps the joints' accelerations (S8).

    force(system, t, state, f, τ) fills in the external one. f (M, d) in N, τ (r, 3) or (r, 1) in N m.
    """
    mechanism = system.mechanism
    rows, jacobian, B = mechanism.rows, mechanism.jacobian, mechanism.B
    force(system, t, state, f, τ)
    fill_rows(rows, state, jacobian)
    J, bodies = jacobian.J, rows.bodies
    if len(jacobian.φ) > len(mechanism.λ):
        add_joint_springs(rows.stiffness, rows.damping, jacobian.φ, J, bodies, len(mechanism.λ), state, f, τ)
    fill_mass_rows(bodies, J, system.mass, system.inertia, jacobian.frame, B)
    copy_rows(τ, mechanism.ω)
    add_gyroscopic_torque(system, state, mechanism.ω)
    fill_acceleration_side(B, bodies, jacobian.rate, f, mechanism.ω, mechanism.right)
    factorise_rows(system, mechanism)
    solve_rows(system, mechanism, mechanism.λ)
    add_rows(J, bodies, mechanism.λ, f, τ)


@merged
def factorise_rows(system, mechanism):
    """A made ready by the mechanism's solver; ``watch`` keeps the smallest pivot, and the ranks seen."""
    m, J = len(mechanism.λ), mechanism.jacobian.J
    factor, watch = mechanism.factor, mechanism.watch
    pivot = factorise(
        mechanism.solver, m, factor, J, mechanism.B, system.mass, system.inertia, mechanism.jacobian.frame
    )
    if pivot < watch[0]:
        watch[0] = pivot
    if mechanism.solver == MINIMUM_NORM:
        rank = factor.pattern[m, 0]
        watch[1], watch[2] = min(watch[1], rank), max(watch[2], rank)


@merged
def solve_rows(system, mechanism, λ):
    """λ of A λ = right."""
    J, right = mechanism.jacobian.J, mechanism.right
    substitute(mechanism.solver, len(λ), mechanism.factor, J, system.mass, right, λ)


@lean
def copy_rows(a, to):
    """Copy a two-dimensional array."""
    for i in range(len(a)):
        for c in range(a.shape[1]):
            to[i, c] = a[i, c]


@merged
def fill_acceleration_side(B, bodies, rate, f, τ, right):
    """right = −b = −(J M⁻¹ f_e + J̇ u); τ with the gyroscopic torque."""
    for k in range(len(right)):
        right[k] = -row_times(B, bodies, k, f, τ) - rate[k]


@merged
def add_joint_springs(stiffness, damping, φ, J, bodies, first, state, f, τ):
    """Add Jᵀ λ of the soft rows, from ``first`` on, whose λ = −stiffness φ − damping w is known."""
    for k in range(first, len(φ)):
        w = row_times(J, bodies, k, state.v, state.ω)
        add_row(J, bodies, k, -stiffness[k] * φ[k] - damping[k] * w, f, τ)


@merged
def fill_mass_rows(bodies, J, mass, inertia, frame, B):
    """B = J M⁻¹, row by row."""
    d = 2 if B.shape[2] == 3 else 3
    for k in range(len(B)):
        for side in range(2):
            i = bodies[k, side]
            if i < 0:
                continue
            for c in range(d):
                B[k, side, c] = J[k, side, c] / mass[i]
            if i >= len(inertia):
                continue
            if d == 2:
                B[k, side, 2] = J[k, side, 2] / inertia[i, 0]
            else:
                divide_by_inertia(inertia, frame, i, J, B, k, side)


@lean
def divide_by_inertia(inertia, frame, i, J, B, k, side):
    """The turning part of B's row: R I⁻¹ Rᵀ times that of J, with R the frame of body i."""
    n0, n1, n2 = J[k, side, 3], J[k, side, 4], J[k, side, 5]
    s0 = (frame[i, 0] * n0 + frame[i, 3] * n1 + frame[i, 6] * n2) / inertia[i, 0]
    s1 = (frame[i, 1] * n0 + frame[i, 4] * n1 + frame[i, 7] * n2) / inertia[i, 1]
    s2 = (frame[i, 2] * n0 + frame[i, 5] * n1 + frame[i, 8] * n2) / inertia[i, 2]
    for c in range(3):
        B[k, side, 3 + c] = frame[i, 3 * c] * s0 + frame[i, 3 * c + 1] * s1 + frame[i, 3 * c + 2] * s2
