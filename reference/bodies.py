"""The state of the bodies as arrays, the mass matrix M, and the equation of motion M u̇ = f.

Only what moves is in the state: bodies that rotate come first, then points; what is static has no velocity. A
rotating body's frame is turned to its principal axes, so that its inertia is three numbers.

M is block diagonal: the mass for v, the world-frame inertia R I Rᵀ for ω. So M⁻¹ is applied body by body,
never formed.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

from typing import NamedTuple

import numpy as np

from .compiled import compiled, lean, merged
from .rotation import (
    add,
    cross,
    normalise,
    quaternion,
    quaternion_rate,
    rotate,
    rotate_back,
    store,
    store_quaternion,
    vector,
)


class State(NamedTuple):
    """What changes: views into one flat vector y = (x, q, u). m bodies move, the first r of them rotate.

    x (m, d) m; q (r, 4), or (r, 1) angles in the plane; u: all velocities, v and ω stacked; v (m, d) m/s; ω
    (r, 3) or (r, 1) rad/s; all in the world frame. A rate of change, and a force, have the same layout.
    L (r, 3), or (0, 3) in the plane: the angular momentum of each body about its centre. ω tells it too;
    integrators that keep it to the last bit carry it from step to step, the others leave it alone.
    """

    y: np.ndarray
    x: np.ndarray
    q: np.ndarray
    u: np.ndarray
    v: np.ndarray
    ω: np.ndarray
    L: np.ndarray


class System(NamedTuple):
    """What does not change. Bodies as in State; points on a body are in its principal frame."""

    mass: np.ndarray  # (m,) kg
    inertia: np.ndarray  # (r, 3) principal moments, or (r, 1), kg m²
    gravity: np.ndarray  # (d,) m/s²
    spring_bodies: np.ndarray  # (s, 2) int; −1: fixed in the world
    spring_points: np.ndarray  # (s, 2, d) m
    spring_law: np.ndarray  # (s, 3): stiffness N/m, damping N s/m, length m
    drag_bodies: np.ndarray  # (k,) int
    drag_law: np.ndarray  # (k, 2): linear N s/m, angular N m s
    gravitation: float  # G, m³/(kg s²)
    fixed_masses: np.ndarray  # (p,) kg, static bodies that attract
    fixed_positions: np.ndarray  # (p, d) m
    velocity_dependent: bool  # whether a force depends on v or ω
    mechanism: object = None  # the joints (``mechanism.Mechanism``), or None, where there are none


@compiled
def make_state(m, r, d):
    """A State of zeros for m bodies in d dimensions, of which r rotate."""
    orientation, spin = (4, 3) if d == 3 else (1, 1)
    i, j, k = m * d, m * d + r * orientation, 2 * m * d + r * orientation
    y = np.zeros(k + r * spin)
    x, q = y[:i].reshape((m, d)), y[i:j].reshape((r, orientation))
    v, ω = y[j:k].reshape((m, d)), y[k:].reshape((r, spin))
    return State(y, x, q, y[j:], v, ω, np.zeros((r if d == 3 else 0, 3)))


@lean
def planar(state):
    """Whether orientations are angles."""
    return state.q.shape[1] == 1


@lean
def times(I, ω):
    """I ω for the principal moments I."""
    return I[0] * ω[0], I[1] * ω[1], I[2] * ω[2]


@lean
def divided(L, I):
    """I⁻¹ L for the principal moments I."""
    return L[0] / I[0], L[1] / I[1], L[2] / I[2]


@merged
def add_gyroscopic_torque(system, state, τ):
    """τ −= ω × I ω, that is τ += L × ω, the inertial part of f_e (S4): I turns with the body."""
    if planar(state):
        return
    for i in range(len(state.q)):
        q, ω = quaternion(state.q, i), vector(state.ω, i)
        L = rotate(q, times(vector(system.inertia, i), rotate_back(q, ω)))
        add(τ, i, cross(L, ω))


@merged
def solve_mass(system, q, f, τ):
    """M⁻¹ (f, τ), in place: a force becomes an acceleration, an impulse a change of velocity."""
    for i in range(len(f)):
        for k in range(f.shape[1]):
            f[i, k] /= system.mass[i]
    for i in range(len(τ)):
        if q.shape[1] == 1:
            τ[i, 0] /= system.inertia[i, 0]
        else:
            frame = quaternion(q, i)
            store(τ, i, rotate(frame, divided(rotate_back(frame, vector(τ, i)), vector(system.inertia, i))))


@merged
def velocity_to_rate(state, rate):
    """ẋ = v and q̇ = E(q) ω (S9); an angle's rate is ω itself."""
    for i in range(len(state.x)):
        for k in range(state.x.shape[1]):
            rate.x[i, k] = state.v[i, k]
    for i in range(len(state.q)):
        if planar(state):
            rate.q[i, 0] = state.ω[i, 0]
        else:
            store_quaternion(rate.q, i, quaternion_rate(quaternion(state.q, i), vector(state.ω, i)))


@merged
def normalise_all(state):
    """Bring each quaternion back to norm 1."""
    if not planar(state):
        for i in range(len(state.q)):
            store_quaternion(state.q, i, normalise(quaternion(state.q, i)))
