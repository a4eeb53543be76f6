"""Error correction: positions and velocities drift off the joints, and are projected back (S13).

Positions: Newton's method on φ = 0, along M⁻¹ Jᵀ, the smallest move in the measure of the kinetic energy.
Velocities: u ← u + M⁻¹ Jᵀ A⁻¹ (speed − J u), after which w is right.

Slides S9, S13; lectures/04_embedding.md. Source: Hairer & Wanner, Solving Ordinary Differential Equations II
(1996), section VII.2.
"""

import numpy as np

from .bodies import planar
from .compiled import compiled
from .embedding import add_rows, fill_mass_rows, row_times, rows_of
from .rotation import exponential, multiply, quaternion, store_quaternion
from .rows import fill_rows

MOST_PROJECTIONS = 20


@compiled
def project(factorise, substitute, system, state):
    """Bring positions and velocities back to where all joints hold. Returns (iterations, the worst |φ| left).

    |φ| is relative to the mechanism's size; motors have none.
    """
    mechanism = system.mechanism
    index, law, J, φ, _ = rows_of(mechanism)
    worst, iterations = np.inf, 0
    for iteration in range(MOST_PROJECTIONS):
        fill_rows(mechanism.rows, state, mechanism.jacobian)
        before, worst = worst, fill_position_side(law, φ, mechanism.right) / mechanism.scale
        if iteration > 0 and (worst <= mechanism.tolerance or not worst < before):
            break
        fill_mass_rows(index, J, system.mass, system.inertia, mechanism.jacobian.frame, mechanism.B)
        factorise(system, mechanism)
        substitute(mechanism, mechanism.right, mechanism.λ)
        mechanism.v[:] = 0
        mechanism.ω[:] = 0
        add_rows(index, mechanism.B, mechanism.λ, mechanism.v, mechanism.ω)
        displace(state, mechanism.v, mechanism.ω)
        iterations += 1
    fill_velocity_side(index, law, J, state.v, state.ω, mechanism.right)
    substitute(mechanism, mechanism.right, mechanism.λ)
    add_rows(index, mechanism.B, mechanism.λ, state.v, state.ω)
    return iterations, worst


@compiled
def fill_position_side(law, φ, right):
    """right = −φ, 0 for motors, which have no φ. Returns the largest."""
    worst = 0.0
    for k in range(len(right)):
        right[k] = -φ[k] if law[k, 3] == 0 else 0.0
        worst = max(worst, abs(right[k]))
    return worst


@compiled
def fill_velocity_side(index, law, J, v, ω, right):
    """right = speed − J u."""
    for k in range(len(right)):
        right[k] = law[k, 3] - row_times(index, J, k, v, ω)


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
