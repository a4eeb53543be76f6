"""Splitting: free motion and the force by turns. Half a drift, a kick, half a drift.

A force alone, positions held, changes only velocities: the *kick*. Motion without a force, the *drift*, is a
straight line for the centre of mass; for the rotation of a body there are two drifts here, one by turns about
the principal axes, one by the implicit midpoint rule. Both keep the angular momentum L of a free body to the
last bit. Such a step has order 2 and is symmetric; compositions of it have order 4 and 6.

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Hairer, Lubich & Wanner, Geometric Numerical
Integration (2006), sections II.4, II.5, V.3 and VII.5; others at each function.
"""

import numpy as np

from ..bodies import divided, planar, solve_mass
from ..compiled import lean, merged
from ..rotation import (
    cayley,
    exponential,
    multiply,
    normalise,
    quaternion,
    rotate,
    rotate_back,
    solve3,
    store,
    store_quaternion,
    vector,
)
from .parts import add_scaled, copy


@merged
def splitting(force, system, t, h, state, work):
    """Half a drift, a kick, half a drift (Strang). Order 2, symmetric, symplectic; keeps L of a free body.

    The drift turns a free body about its principal axes by turns, each of them solved exactly. Sources:
    McLachlan, Phys. Rev. Lett. 71 (1993) 3043; Reich, Physica D 76 (1994) 375.
    """
    drift_by_axes(system, h / 2, state)
    force(system, t + h / 2, state, work.rate.v, work.rate.ω)
    if system.velocity_dependent:  # the force at the middle of the kick
        move_half_kicked(system, h, state, work)
        force(system, t + h / 2, work.start, work.rate.v, work.rate.ω)
    kick(system, h, state, work.rate)
    drift_by_axes(system, h / 2, state)


@merged
def implicit_midpoint(force, system, t, h, state, work):
    """As ``splitting``, with a drift that keeps both the energy and the angular momentum of a free body.

    Source: Simo & Wong, Int. J. Numer. Meth. Engng 31 (1991) 19; the update of q is Cayley's.
    """
    drift_by_midpoint(system, h / 2, state, work)
    force(system, t + h / 2, state, work.rate.v, work.rate.ω)
    if system.velocity_dependent:
        move_half_kicked(system, h, state, work)
        force(system, t + h / 2, work.start, work.rate.v, work.rate.ω)
    kick(system, h, state, work.rate)
    drift_by_midpoint(system, h / 2, state, work)


@lean
def kick(system, h, state, forces):
    """u += h M⁻¹ f and L += h τ, at fixed positions (no gyroscopic term). Overwrites the forces."""
    for i in range(len(state.L)):
        add_scaled(state.L[i], h, forces.ω[i])
    solve_mass(system, state.q, forces.v, forces.ω)
    add_scaled(state.u, h, forces.u)


@lean
def move_half_kicked(system, h, state, work):
    """The state after half a kick, in ``work.start``."""
    copy(state.y, work.start.y)
    kick(system, h / 2, work.start, work.rate)


@lean
def drift_by_axes(system, h, state):
    """Free motion for the time h: rotations about the principal axes 1, 2, 3, 2, 1, one after the other."""
    drift_all_but_rotation(state, h)
    for i in range(0 if planar(state) else len(state.q)):
        I = vector(system.inertia, i)
        q = quaternion(state.q, i)
        L = rotate_back(q, vector(state.L, i))
        q, L = turn_body(q, L, (h / 2 * L[0] / I[0], 0.0, 0.0))
        q, L = turn_body(q, L, (0.0, h / 2 * L[1] / I[1], 0.0))
        q, L = turn_body(q, L, (0.0, 0.0, h * L[2] / I[2]))
        q, L = turn_body(q, L, (0.0, h / 2 * L[1] / I[1], 0.0))
        q, L = turn_body(q, L, (h / 2 * L[0] / I[0], 0.0, 0.0))
        finish_free_rotation(state, i, normalise(q), I)


@lean
def drift_by_midpoint(system, h, state, work):
    """Free motion for the time h, with the angular velocity of the middle: L_m = L + ½ h L_m × I⁻¹ L_m.

    The momentum is kept whatever L_m is, the energy where the equation is solved.
    """
    drift_all_but_rotation(state, h)
    for i in range(0 if planar(state) else len(state.q)):
        I = vector(system.inertia, i)
        q = quaternion(state.q, i)
        L = rotate_back(q, vector(state.L, i))
        middle, iterations, residual = solve_midpoint(L, I, h, work.max_iterations, work.tolerance)
        work.solve[0] = max(work.solve[0], iterations)
        work.solve[1] = max(work.solve[1], residual)
        ω = divided(middle, I)
        q = multiply(q, cayley((h * ω[0], h * ω[1], h * ω[2])))
        finish_free_rotation(state, i, normalise(q), I)


@lean
def drift_all_but_rotation(state, h):
    """x += h v; an angle in the plane turns by h ω."""
    for i in range(len(state.x)):
        for k in range(state.x.shape[1]):
            state.x[i, k] += h * state.v[i, k]
    for i in range(len(state.q) if planar(state) else 0):
        state.q[i, 0] += h * state.ω[i, 0]


@lean
def turn_body(q, L, φ):
    """Turn a body by φ, in its own frame; the momentum L, as seen from it, turns back. Returns (q, L)."""
    turned = exponential(φ)
    return multiply(q, turned), rotate_back(turned, L)


@lean
def finish_free_rotation(state, i, q, I):
    """The new attitude, and its ω = R I⁻¹ Rᵀ L: in the world, L is what it was, to the last bit."""
    store_quaternion(state.q, i, q)
    store(state.ω, i, rotate(q, divided(rotate_back(q, vector(state.L, i)), I)))


@lean
def solve_midpoint(L0, I, h, max_iterations, tolerance):
    """L = L0 + ½ h L × I⁻¹ L by Newton's method: L (3,), iterations, and the residual relative to |L0|."""
    a = h / 2 * (1 / I[2] - 1 / I[1])
    b = h / 2 * (1 / I[0] - 1 / I[2])
    c = h / 2 * (1 / I[1] - 1 / I[0])
    L, size = L0, abs(L0[0]) + abs(L0[1]) + abs(L0[2])
    iterations, residual = 0, 0.0
    while size > 0:
        r = (
            L[0] - L0[0] - a * L[1] * L[2],
            L[1] - L0[1] - b * L[2] * L[0],
            L[2] - L0[2] - c * L[0] * L[1],
        )
        residual = (abs(r[0]) + abs(r[1]) + abs(r[2])) / size
        if residual <= tolerance or iterations == max_iterations:
            break
        change = solve3(
            (1.0, -a * L[2], -a * L[1]), (-b * L[2], 1.0, -b * L[0]), (-c * L[1], -c * L[0], 1.0), r
        )
        L = (L[0] - change[0], L[1] - change[1], L[2] - change[2])
        iterations += 1
    return L, iterations, residual


SUZUKI = 1 / (4 - 4 ** (1 / 3))
COMPOSITION4 = np.array([SUZUKI, SUZUKI, 1 - 4 * SUZUKI, SUZUKI, SUZUKI])
COMPOSITION6 = np.array([
    0.39216144400731413928, 0.33259913678935943860, -0.70624617255763935981, 0.08221359629355080023,
    0.79854399093482996340,
    0.08221359629355080023, -0.70624617255763935981, 0.33259913678935943860, 0.39216144400731413928,
])  # fmt: skip


@merged
def compose4(step, system, t, h, state, work):
    """Five steps of a symmetric method of order 2, the third of them backwards: order 4.

    With forces that depend on velocity the kick is not symmetric, and the order is 3. Source: Suzuki,
    Phys. Lett. A 146 (1990) 319.
    """
    for k in range(len(COMPOSITION4)):
        share = COMPOSITION4[k] * h
        step(system, t, share, state, work)
        t += share


@merged
def compose6(step, system, t, h, state, work):
    """Nine steps of a symmetric method of order 2, the third and seventh of them backwards: order 6.

    With forces that depend on velocity the order stays 2. Source: Kahan & Li, Math. Comp. 66 (1997) 1089; the
    coefficients are also in Hairer, Lubich & Wanner (V.3.11).
    """
    for k in range(len(COMPOSITION6)):
        share = COMPOSITION6[k] * h
        step(system, t, share, state, work)
        t += share
