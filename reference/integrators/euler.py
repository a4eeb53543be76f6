"""Euler's methods: one force a step, order 1. They differ in which velocities move the positions.

Slides S4, S9; lectures/02_equation_of_motion.md. Source: Hairer, Lubich & Wanner, Geometric Numerical
Integration (2006), sections I.1 and VI.3.
"""

from ..bodies import add_gyroscopic_torque, normalise_all, planar, solve_mass, times, velocity_to_rate
from ..compiled import lean, merged
from ..rotation import cross, quaternion, rotate, rotate_back, solve3, store, vector
from .parts import add_scaled, drift


@merged
def explicit_euler(force, system, t, h, state, work):
    """y ← y + h ẏ: all rates from the start of the step. Order 1; a spring's energy grows in every step."""
    rate = work.rate
    force(system, t, state, rate.v, rate.ω)
    add_gyroscopic_torque(system, state, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    velocity_to_rate(state, rate)
    add_scaled(state.y, h, rate.y)
    normalise_all(state)


@merged
def symplectic_euler(force, system, t, h, state, work):
    """Velocity first: u ← u + h M⁻¹ f(x, u), then positions with the new u (S9; what pybullet and Box2D
    do).
    """
    rate = work.rate
    force(system, t, state, rate.v, rate.ω)
    add_gyroscopic_torque(system, state, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    add_scaled(state.u, h, rate.u)
    drift(state, h)


@merged
def symplectic_euler_position_first(force, system, t, h, state, work):
    """Position first: x ← x + h v, then u ← u + h M⁻¹ f(new x, u); the adjoint of the other one (what
    pymunk does).
    """
    rate = work.rate
    drift(state, h)
    force(system, t + h, state, rate.v, rate.ω)
    add_gyroscopic_torque(system, state, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    add_scaled(state.u, h, rate.u)


@merged
def implicit_gyroscopic(force, system, t, h, state, work):
    """Velocity first, with the gyroscopic term at the end of the step, by one step of Newton's method.

    Stable at any h, but it loses energy. Source: Catto, Numerical Methods, GDC 2015; the rigid bodies of
    Bullet do the same: first the gyroscopic term alone, from the old ω, then h I⁻¹ τ.
    """
    rate = work.rate
    force(system, t, state, rate.v, rate.ω)
    solve_mass(system, state.q, rate.v, rate.ω)
    for i in range(0 if planar(state) else len(state.q)):
        q = quaternion(state.q, i)
        s = gyroscopic_newton_step(rotate_back(q, vector(state.ω, i)), vector(system.inertia, i), h)
        store(state.ω, i, rotate(q, s))
    add_scaled(state.u, h, rate.u)
    drift(state, h)


@lean
def gyroscopic_newton_step(s, I, h):
    """The angular velocity after one step towards I (s′ − s) + h s′ × I s′ = 0, all in the body's
    principal frame.
    """
    L = times(I, s)
    g = cross(s, L)
    change = solve3(
        (I[0], h * (L[2] - s[2] * I[1]), h * (s[1] * I[2] - L[1])),
        (h * (s[2] * I[0] - L[2]), I[1], h * (L[0] - s[0] * I[2])),
        (h * (L[1] - s[1] * I[0]), h * (s[0] * I[1] - L[0]), I[2]),
        (h * g[0], h * g[1], h * g[2]),
    )
    return s[0] - change[0], s[1] - change[1], s[2] - change[2]
