"""Error correction: positions and velocities drift off the joints, and are projected back (S13).

Positions: Newton's method on φ = 0, along M⁻¹ Jᵀ, the smallest move in the measure of the kinetic energy.
Velocities: u ← u + M⁻¹ Jᵀ A⁻¹ (speed − J u), after which w is right.

Slides S9, S13; lectures/04_embedding.md. Source: Hairer & Wanner, Solving Ordinary Differential Equations II
(1996), section VII.2.
"""

import numpy as np

from .bodies import planar, times
from .compiled import compiled
from .embedding import add_rows, factorise_rows, fill_mass_rows, row_times, rows_of, solve_rows
from .joints import DISTANCE, LINEAR
from .rotation import (
    exponential,
    multiply,
    quaternion,
    rotate,
    rotate_back,
    store,
    store_quaternion,
    vector,
)
from .rows import fill_rows

MOST_PROJECTIONS = 20
CLOSE = 1e-9  # of the mechanism's size: so near, an iteration that doesn't help ends it


@compiled
def project(system, state):
    """Bring positions and velocities back to where all joints hold. Returns (iterations, the worst |φ| left).

    |φ| is relative to the mechanism's size; motors have none.
    """
    mechanism = system.mechanism
    index, law, J, φ, _ = rows_of(mechanism)
    worst, iterations = np.inf, 0
    for iteration in range(MOST_PROJECTIONS):
        fill_rows(mechanism.rows, state, mechanism.jacobian)
        before, worst = worst, fill_position_side(index, law, φ, mechanism.scale, mechanism.right)
        if iteration > 0 and (worst <= mechanism.tolerance or (worst < CLOSE and not worst < before)):
            break
        fill_mass_rows(index, J, system.mass, system.inertia, mechanism.jacobian.frame, mechanism.B)
        factorise_rows(system, mechanism)
        solve_rows(system, mechanism, mechanism.change)
        mechanism.v[:] = 0
        mechanism.ω[:] = 0
        add_rows(index, mechanism.B, mechanism.change, mechanism.v, mechanism.ω)
        displace(state, mechanism.v, mechanism.ω)
        iterations += 1
    fill_velocity_side(index, law, J, state.v, state.ω, mechanism.right)
    solve_rows(system, mechanism, mechanism.change)
    add_rows(index, mechanism.B, mechanism.change, state.v, state.ω)
    fill_momenta(system.inertia, state)
    return iterations, worst


@compiled
def fill_position_side(index, law, φ, scale, right):
    """right = −φ, 0 for motors, which have no φ. Returns the largest: m over the scale, or rad."""
    worst = 0.0
    for k in range(len(right)):
        right[k] = -φ[k] if law[k, 3] == 0 else 0.0
        long = index[k, 0] == LINEAR or index[k, 0] == DISTANCE
        worst = max(worst, abs(right[k]) / scale if long else abs(right[k]))
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


@compiled
def fill_momenta(inertia, state):
    """L = R I Rᵀ ω, for integrators that carry it from step to step."""
    for i in range(len(state.L)):
        q = quaternion(state.q, i)
        store(state.L, i, rotate(q, times(vector(inertia, i), rotate_back(q, vector(state.ω, i)))))
