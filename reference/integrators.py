"""Smooth motion: from the force to the velocities, from the velocities to positions and orientations.

Each integrator is one kernel, ``step(force, system, t, h, state, work)``: it moves ``state`` from t to t + h.
``force(system, t, state, f, τ)`` fills in the external force. ``INTEGRATORS`` says of each what order it has, whether
it is symmetric (a step back undoes a step), and what it conserves.

A force of free flight and a free rotation can each be solved well; the *splitting* integrators alternate them:
half a drift, a kick by the force, half a drift.

Slides S4, S9; lectures/02_equation_of_motion.md. Sources: Hairer, Lubich & Wanner, Geometric Numerical Integration
(2006), sections I.1, II.4–5, V.3, VII.5; others at each function.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .bodies import (
    State, add_gyroscopic_torque, divided, make_state, normalise_all, planar, solve_mass, times, velocity_to_rate,
)
from .compiled import bind, compiled
from .rotation import (
    cayley, cross, exponential, multiply, normalise, quaternion, rotate, rotate_back, store, store_quaternion, vector,
)


class Work(NamedTuple):
    """Room to compute in, shaped like the state; ``solve``: of an implicit step, [iterations done, residual]."""

    rate: State
    start: State
    total: State
    solve: np.ndarray
    max_iterations: int
    tolerance: float


@compiled
def make_work(m, r, d, max_iterations, tolerance):
    """Work for m bodies in d dimensions, of which r rotate."""
    return Work(make_state(m, r, d), make_state(m, r, d), make_state(m, r, d), np.zeros(2), max_iterations, tolerance)


@compiled
def add_scaled(y, h, rate):
    """y += h · rate, for flat arrays."""
    for k in range(len(y)):
        y[k] += h * rate[k]


@compiled
def copy(y, to):
    """Copy a flat array."""
    for k in range(len(y)):
        to[k] = y[k]


@compiled
def drift(state, h):
    """Move on for the time h at constant velocities: x += h v, and each q turns by h ω, its norm kept exactly."""
    for i in range(len(state.x)):
        for k in range(state.x.shape[1]):
            state.x[i, k] += h * state.v[i, k]
    for i in range(len(state.q)):
        if planar(state):
            state.q[i, 0] += h * state.ω[i, 0]
        else:
            turned = exponential((h * state.ω[i, 0], h * state.ω[i, 1], h * state.ω[i, 2]))
            store_quaternion(state.q, i, multiply(turned, quaternion(state.q, i)))


@compiled
def explicit_euler(force, system, t, h, state, work):
    """y ← y + h ẏ: all rates from the start of the step. Order 1; a spring's energy grows in every step."""
    rate = work.rate
    force(system, t, state, rate.v, rate.ω)
    add_gyroscopic_torque(system, state, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    velocity_to_rate(state, rate)
    add_scaled(state.y, h, rate.y)
    normalise_all(state)


@compiled
def symplectic_euler(force, system, t, h, state, work):
    """Velocity first: u ← u + h M⁻¹ f(x, u), then positions with the new u (S9; what pybullet and Box2D do)."""
    rate = work.rate
    force(system, t, state, rate.v, rate.ω)
    add_gyroscopic_torque(system, state, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    add_scaled(state.u, h, rate.u)
    drift(state, h)


@compiled
def symplectic_euler_position_first(force, system, t, h, state, work):
    """Position first: x ← x + h v, then u ← u + h M⁻¹ f(new x, u); the adjoint of the other one (what pymunk does)."""
    rate = work.rate
    drift(state, h)
    force(system, t + h, state, rate.v, rate.ω)
    add_gyroscopic_torque(system, state, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    add_scaled(state.u, h, rate.u)


@compiled
def implicit_gyroscopic(force, system, t, h, state, work):
    """``symplectic_euler`` with the gyroscopic term taken at the end of the step, by one step of Newton's method.

    Stable at any h, but it loses energy. Source: Catto, Numerical Methods, GDC 2015; Bullet's rigid bodies do the same.
    """
    rate = work.rate
    force(system, t, state, rate.v, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    add_scaled(state.u, h, rate.u)
    if not planar(state):
        for i in range(len(state.q)):
            s, q = vector(state.ω, i), quaternion(state.q, i)
            s = gyroscopic_newton_step(rotate_back(q, s), vector(system.inertia, i), h)
            store(state.ω, i, rotate(q, s))
    drift(state, h)


@compiled
def gyroscopic_newton_step(s, I, h):
    """The angular velocity after one step towards I (s′ − s) + h s′ × I s′ = 0, all in the body's principal frame."""
    L = times(I, s)
    g = cross(s, L)
    change = solve3(
        (I[0], h * (L[2] - s[2] * I[1]), h * (s[1] * I[2] - L[1])),
        (h * (s[2] * I[0] - L[2]), I[1], h * (L[0] - s[0] * I[2])),
        (h * (L[1] - s[1] * I[0]), h * (s[0] * I[1] - L[0]), I[2]),
        (h * g[0], h * g[1], h * g[2]),
    )
    return s[0] - change[0], s[1] - change[1], s[2] - change[2]


@compiled
def solve3(a, b, c, r):
    """x of the three equations a·x = r₀, b·x = r₁, c·x = r₂, by Cramer's rule."""
    bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
    determinant = a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]
    return (
        (r[0] * bc[0] + r[1] * ca[0] + r[2] * ab[0]) / determinant,
        (r[0] * bc[1] + r[1] * ca[1] + r[2] * ab[1]) / determinant,
        (r[0] * bc[2] + r[1] * ca[2] + r[2] * ab[2]) / determinant,
    )


RK4_WHEN = np.array([0, 1 / 2, 1 / 2, 1])  # in steps
RK4_WEIGHT = np.array([1 / 6, 1 / 3, 1 / 3, 1 / 6])


@compiled
def rk4(force, system, t, h, state, work):
    """The classical Runge–Kutta method of order 4: a weighted mean of four rates. Source: Kutta (1901)."""
    rate, start, total = work.rate, work.start, work.total
    copy(state.y, start.y)
    copy(state.y, total.y)
    for stage in range(4):
        if stage > 0:
            copy(start.y, state.y)
            add_scaled(state.y, RK4_WHEN[stage] * h, rate.y)
        force(system, t + RK4_WHEN[stage] * h, state, rate.v, rate.ω)
        add_gyroscopic_torque(system, state, rate.ω)
        solve_mass(system, state.q, rate.v, rate.ω)
        velocity_to_rate(state, rate)
        add_scaled(total.y, RK4_WEIGHT[stage] * h, rate.y)
    copy(total.y, state.y)
    normalise_all(state)


@compiled
def splitting(force, system, t, h, state, work):
    """Half a drift, a kick, half a drift (Strang). Order 2, symmetric, symplectic; |L| of a free body kept to rounding.

    The drift turns a free body about its principal axes in turn, each turn solved exactly. Sources: McLachlan, Phys.
    Rev. Lett. 71 (1993) 3043; Reich, Physica D 76 (1994) 375; Hairer, Lubich & Wanner VII.5.3.
    """
    drift_by_axes(system, h / 2, state)
    force(system, t + h / 2, state, work.rate.v, work.rate.ω)
    if system.velocity_dependent:  # the force at the middle of the kick
        move_half_kicked(system, h, state, work)
        force(system, t + h / 2, work.start, work.rate.v, work.rate.ω)
    kick(system, h, state, work.rate)
    drift_by_axes(system, h / 2, state)


@compiled
def implicit_midpoint(force, system, t, h, state, work):
    """As ``splitting``, with a drift that keeps both the energy and the angular momentum of a free body (order 2).

    Source: Simo & Wong, Int. J. Numer. Meth. Engng 31 (1991) 19; the update of q is Cayley's.
    """
    drift_by_midpoint(system, h / 2, state, work)
    force(system, t + h / 2, state, work.rate.v, work.rate.ω)
    if system.velocity_dependent:
        move_half_kicked(system, h, state, work)
        force(system, t + h / 2, work.start, work.rate.v, work.rate.ω)
    kick(system, h, state, work.rate)
    drift_by_midpoint(system, h / 2, state, work)


@compiled
def kick(system, h, state, forces):
    """u += h M⁻¹ f and L += h τ, at fixed positions; the gyroscopic term belongs to the drift. Overwrites the forces."""
    for i in range(len(state.L)):
        add_scaled(state.L[i], h, forces.ω[i])
    solve_mass(system, state.q, forces.v, forces.ω)
    add_scaled(state.u, h, forces.u)


@compiled
def move_half_kicked(system, h, state, work):
    """The state after half a kick, in ``work.start``."""
    copy(state.y, work.start.y)
    kick(system, h / 2, work.start, work.rate)


@compiled
def drift_by_axes(system, h, state):
    """Move freely for the time h; rotate about the principal axes 1, 2, 3, 2, 1 in turn, as if each were the only one."""
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


@compiled
def drift_all_but_rotation(state, h):
    """x += h v; an angle in the plane turns by h ω."""
    for i in range(len(state.x)):
        for k in range(state.x.shape[1]):
            state.x[i, k] += h * state.v[i, k]
    for i in range(len(state.q) if planar(state) else 0):
        state.q[i, 0] += h * state.ω[i, 0]


@compiled
def turn_body(q, L, φ):
    """Turn a body by φ, in its own frame: its attitude q, and the momentum L as seen from it, which turns back."""
    turned = exponential(φ)
    return multiply(q, turned), rotate_back(turned, L)


@compiled
def finish_free_rotation(state, i, q, I):
    """The new attitude, and its ω = R I⁻¹ Rᵀ L: in the world the angular momentum L is what it was, to the last bit."""
    store_quaternion(state.q, i, q)
    store(state.ω, i, rotate(q, divided(rotate_back(q, vector(state.L, i)), I)))


@compiled
def drift_by_midpoint(system, h, state, work):
    """Move freely for the time h; rotate with the angular velocity of the middle, L_m = L + ½ h L_m × I⁻¹ L_m.

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


@compiled
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
        change = solve3((1.0, -a * L[2], -a * L[1]), (-b * L[2], 1.0, -b * L[0]), (-c * L[1], -c * L[0], 1.0), r)
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


@compiled
def compose4(step, system, t, h, state, work):
    """Five steps of a symmetric method of order 2, one of them backwards: order 4. Source: Suzuki, Phys. Lett. A 146
    (1990) 319. With forces that depend on velocity the kick is not symmetric, and the order stays 2."""
    for k in range(len(COMPOSITION4)):
        share = COMPOSITION4[k] * h
        step(system, t, share, state, work)
        t += share


@compiled
def compose6(step, system, t, h, state, work):
    """Nine steps of a symmetric method of order 2: order 6. Source: Kahan & Li, Math. Comp. 66 (1997) 1089; the
    coefficients also in Hairer, Lubich & Wanner (V.3.11). With forces that depend on velocity the order stays 2."""
    for k in range(len(COMPOSITION6)):
        share = COMPOSITION6[k] * h
        step(system, t, share, state, work)
        t += share


@dataclass(frozen=True)
class Integrator:
    """What is claimed of an integrator; the tests measure it.

    order: of the error in h, for smooth forces; symmetric: a step of −h undoes a step, where no force depends on
    velocity; conserves: of a free rigid body, to rounding: "momentum", "energy", or nothing; evaluations: of the force
    in a step; base: the step that a composition repeats.
    """

    step: object
    order: int
    symmetric: bool = False
    conserves: tuple = ()
    evaluations: int = 1
    base: object = None

    def bind(self, force):
        """The step with its force fixed: ``step(system, t, h, state, work)``."""
        return bind(self.step, bind(self.base, force) if self.base else force)


INTEGRATORS = {
    "explicit_euler": Integrator(explicit_euler, order=1),
    "symplectic_euler": Integrator(symplectic_euler, order=1),
    "symplectic_euler_position_first": Integrator(symplectic_euler_position_first, order=1),
    "implicit_gyroscopic": Integrator(implicit_gyroscopic, order=1),
    "rk4": Integrator(rk4, order=4, evaluations=4),
    "splitting": Integrator(splitting, order=2, symmetric=True, conserves=("momentum",)),
    "splitting4": Integrator(compose4, order=4, symmetric=True, conserves=("momentum",), evaluations=5, base=splitting),
    "splitting6": Integrator(compose6, order=6, symmetric=True, conserves=("momentum",), evaluations=9, base=splitting),
    "implicit_midpoint": Integrator(implicit_midpoint, order=2, symmetric=True, conserves=("momentum", "energy")),
}
