"""Error correction: positions and velocities drift off the joints, and are projected back (S13).

Positions: Newton's method on φ = 0, along M⁻¹ Jᵀ, the smallest move in the measure of the kinetic energy.
Velocities: u ← u + M⁻¹ Jᵀ A⁻¹ (speed − J u), after which w is right.

Slides S9, S13; lectures/04_embedding.md. Source: Hairer & Wanner, Solving Ordinary Differential Equations II
(1996), section VII.2.
"""

import numpy as np

from ..bodies import planar, times
from ..compiled import merged
from ..embedding import factorise_rows, fill_mass_rows, solve_rows
from ..joints import DISTANCE, LINEAR
from ..rotation import (
    exponential,
    multiply,
    quaternion,
    rotate,
    rotate_back,
    store,
    store_quaternion,
    vector,
)
from ..rows import add_rows, fill_rows, row_times

MOST_PROJECTIONS = 20
CLOSE = 1e-9  # of the mechanism's size: so near, an iteration that doesn't help ends it


@merged
def project(system, state):
    """Bring positions and velocities back to where all joints hold. Returns (iterations, the worst |φ| left).

    |φ| is in m over the mechanism's size, or in rad; motors have none.
    """
    mechanism = system.mechanism
    jacobian, bodies, speed = mechanism.jacobian, mechanism.rows.bodies, mechanism.rows.speed
    B, v, ω, right, change = mechanism.B, mechanism.v, mechanism.ω, mechanism.right, mechanism.change
    worst, iterations = np.inf, 0
    for iteration in range(MOST_PROJECTIONS):
        fill_rows(mechanism.rows, state, jacobian)
        before, worst = (
            worst,
            fill_position_side(mechanism.rows.kind, speed, jacobian.φ, mechanism.scale, right),
        )
        if iteration > 0 and (worst <= mechanism.tolerance or (worst < CLOSE and not worst < before)):
            break
        fill_mass_rows(bodies, jacobian.J, system.mass, system.inertia, jacobian.frame, B)
        factorise_rows(system, mechanism)
        solve_rows(system, mechanism, change)
        v[:] = 0
        ω[:] = 0
        add_rows(B, bodies, change, v, ω)
        displace(state, v, ω)
        iterations += 1
    fill_velocity_side(jacobian.J, bodies, speed, state.v, state.ω, right)
    solve_rows(system, mechanism, change)
    add_rows(B, bodies, change, state.v, state.ω)
    fill_momenta(system.inertia, state)
    return iterations, worst


@merged
def fill_position_side(kind, speed, φ, scale, right):
    """right = −φ, 0 for motors, which have no φ. Returns the largest: m over the scale, or rad."""
    worst = 0.0
    for k in range(len(right)):
        right[k] = -φ[k] if speed[k] == 0 else 0.0
        long = kind[k] == LINEAR or kind[k] == DISTANCE
        worst = max(worst, abs(right[k]) / scale if long else abs(right[k]))
    return worst


@merged
def fill_velocity_side(J, bodies, speed, v, ω, right):
    """right = speed − J u."""
    for k in range(len(right)):
        right[k] = speed[k] - row_times(J, bodies, k, v, ω)


@merged
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


@merged
def fill_momenta(inertia, state):
    """L = R I Rᵀ ω, for integrators that carry it from step to step."""
    for i in range(len(state.L)):
        q = quaternion(state.q, i)
        store(state.L, i, rotate(q, times(vector(inertia, i), rotate_back(q, vector(state.ω, i)))))
