"""Error correction: positions and velocities drift off the joints, and are projected back (S13).

Positions: Newton's method on φ = 0, along M⁻¹ Jᵀ, the smallest move in the measure of the kinetic energy.
Velocities: u ← u + M⁻¹ Jᵀ A⁻¹ (speed − J u), after which w is right.

Slides S9, S13; lectures/04_embedding.md. Source: Hairer & Wanner, Solving Ordinary Differential Equations II
(1996), section VII.2.
"""

import numpy as np

from .bodies import planar
from .compiled import compiled
from .equation import fill_mass_rows
from .rotation import exponential, multiply, quaternion, store_quaternion
from .rows import add_rows, fill_rows, row_times

MOST_PROJECTIONS = 20


@compiled
def project(factorise, substitute, system, state):
    """Bring positions and velocities back to where all joints hold. Returns (iterations, the worst |φ| left).

    |φ| is relative to the mechanism's size; motors have none.
    """
    mechanism = system.mechanism
    rows, jacobian = mechanism.rigid, mechanism.jacobian
    worst, iterations = np.inf, 0
    for iteration in range(MOST_PROJECTIONS):
        fill_rows(rows, state, jacobian)
        before, worst = worst, 0.0
        for k in range(len(rows.kind)):
            mechanism.right[k] = 0.0 if rows.speed[k] != 0 else -jacobian.φ[k]
            worst = max(worst, abs(mechanism.right[k]) / mechanism.scale)
        if iteration > 0 and (worst <= mechanism.tolerance or not worst < before):
            break
        fill_mass_rows(system, rows, jacobian, mechanism.B)
        factorise(system, mechanism)
        substitute(mechanism, mechanism.right, mechanism.λ)
        mechanism.v[:] = 0
        mechanism.ω[:] = 0
        add_rows(mechanism.B, rows.bodies, mechanism.λ, mechanism.v, mechanism.ω)
        displace(state, mechanism.v, mechanism.ω)
        iterations += 1
    project_velocities(substitute, mechanism, state)
    return iterations, worst


@compiled
def project_velocities(substitute, mechanism, state):
    """u + M⁻¹ Jᵀ λ with A λ = speed − J u, A as factorised before."""
    rows, jacobian = mechanism.rigid, mechanism.jacobian
    for k in range(len(rows.kind)):
        mechanism.right[k] = rows.speed[k] - row_times(jacobian.J, rows.bodies, k, state.v, state.ω)
    substitute(mechanism, mechanism.right, mechanism.λ)
    add_rows(mechanism.B, rows.bodies, mechanism.λ, state.v, state.ω)


@compiled
def displace(state, x, φ):
    """Move the bodies by x (M, d) m and turn them by the rotation vectors φ (r, 3), or the angles (r, 1)."""
    for i in range(len(x)):
        for k in range(x.shape[1]):
            state.x[i, k] += x[i, k]
    for i in range(len(φ)):
        if planar(state):
            state.q[i, 0] += φ[i, 0]
        else:
            turn = exponential((φ[i, 0], φ[i, 1], φ[i, 2]))
            store_quaternion(state.q, i, multiply(turn, quaternion(state.q, i)))
