"""The external forces f_e: gravity, springs and dampers, drag, gravitation; and their potential energy.

Each force is one kernel that adds to f (m, d) in N and τ (r, 3) or (r, 1) in N m, about the centres of mass,
world frame. A force that the scene does not have is a loop over nothing. The gyroscopic term, the inertial
part of f_e, is in ``bodies``, since it needs only M.

Slide S4; lectures/02_equation_of_motion.md.
"""

import numpy as np

from .bodies import planar
from .compiled import lean, merged
from .rotation import add, cross, over_arrays, quaternion, rotate, rotate_in_plane, vector


@merged
def external_force(system, t, state, f, τ):
    """f_e of S4, without the gyroscopic term: fills f and τ. ``t`` is for forces that depend on time."""
    τ[:] = 0
    add_gravity(system, f)
    add_springs(system, state, f, τ)
    add_drag(system, state, f, τ)
    if system.gravitation > 0:
        add_gravitation(system, state, f)


@merged
def add_gravity(system, f):
    """f = m g; the first force, so it sets f."""
    for i in range(len(f)):
        for k in range(f.shape[1]):
            f[i, k] = system.mass[i] * system.gravity[k]


@lean
def attachment(state, i, points, s, end):
    """Arm, position and velocity, three components each, of an end of spring s, on body i (−1: the world)."""
    d = state.x.shape[1]
    p = (points[s, end, 0], points[s, end, 1], points[s, end, 2] if d == 3 else 0.0)
    if i < 0:
        return (0.0, 0.0, 0.0), p, (0.0, 0.0, 0.0)
    x = (state.x[i, 0], state.x[i, 1], state.x[i, 2] if d == 3 else 0.0)
    v = (state.v[i, 0], state.v[i, 1], state.v[i, 2] if d == 3 else 0.0)
    if i >= len(state.q):  # a point mass
        return (0.0, 0.0, 0.0), x, v
    if planar(state):
        c, s = np.cos(state.q[i, 0]), np.sin(state.q[i, 0])
        arm, spin = (c * p[0] - s * p[1], s * p[0] + c * p[1], 0.0), (0.0, 0.0, state.ω[i, 0])
    else:
        arm, spin = rotate(quaternion(state.q, i), p), vector(state.ω, i)
    turning = cross(spin, arm)
    position = (x[0] + arm[0], x[1] + arm[1], x[2] + arm[2])
    return arm, position, (v[0] + turning[0], v[1] + turning[1], v[2] + turning[2])


@lean
def apply_at(f, τ, i, arm, force):
    """Add a force that acts on body i at the end of ``arm``: the force to f, its moment arm × force to τ."""
    if i < 0:
        return
    if f.shape[1] == 3:
        add(f, i, force)
    else:
        f[i, 0] += force[0]
        f[i, 1] += force[1]
    if i < len(τ):
        moment = cross(arm, force)
        if τ.shape[1] == 3:
            add(τ, i, moment)
        else:
            τ[i, 0] += moment[2]


@merged
def add_springs(system, state, f, τ):
    """k (|Δ| − length) + c d|Δ|/dt along the spring, on both ends; 0 where they coincide: no direction."""
    for s in range(len(system.spring_law)):
        a, b = system.spring_bodies[s, 0], system.spring_bodies[s, 1]
        arm_a, p_a, v_a = attachment(state, a, system.spring_points, s, 0)
        arm_b, p_b, v_b = attachment(state, b, system.spring_points, s, 1)
        Δ = (p_b[0] - p_a[0], p_b[1] - p_a[1], p_b[2] - p_a[2])
        distance = np.sqrt(Δ[0] ** 2 + Δ[1] ** 2 + Δ[2] ** 2)
        if distance == 0:
            continue
        n = (Δ[0] / distance, Δ[1] / distance, Δ[2] / distance)
        stretching = (v_b[0] - v_a[0]) * n[0] + (v_b[1] - v_a[1]) * n[1] + (v_b[2] - v_a[2]) * n[2]
        stiffness, damping, length = vector(system.spring_law, s)
        tension = stiffness * (distance - length) + damping * stretching
        apply_at(f, τ, a, arm_a, (tension * n[0], tension * n[1], tension * n[2]))
        apply_at(f, τ, b, arm_b, (-tension * n[0], -tension * n[1], -tension * n[2]))


@merged
def add_drag(system, state, f, τ):
    """−linear·v and −angular·ω."""
    for row in range(len(system.drag_bodies)):
        i = system.drag_bodies[row]
        linear, angular = system.drag_law[row, 0], system.drag_law[row, 1]
        for k in range(f.shape[1]):
            f[i, k] -= linear * state.v[i, k]
        if i < len(τ):
            for k in range(τ.shape[1]):
                τ[i, k] -= angular * state.ω[i, k]


@merged
def add_gravitation(system, state, f):
    """G m_i m_j / r² along the line between them: among all that move, and towards the static masses."""
    G, d = system.gravitation, f.shape[1]
    for i in range(len(f)):
        for j in range(i):
            scale = G * system.mass[i] * system.mass[j] * inverse_cube(state.x, i, state.x, j)
            for k in range(d):
                pull = scale * (state.x[j, k] - state.x[i, k])
                f[i, k] += pull
                f[j, k] -= pull
        for j in range(len(system.fixed_masses)):
            strength = G * system.mass[i] * system.fixed_masses[j]
            scale = strength * inverse_cube(state.x, i, system.fixed_positions, j)
            for k in range(d):
                f[i, k] += scale * (system.fixed_positions[j, k] - state.x[i, k])


@lean
def inverse_cube(a, i, b, j):
    """1 / |b_j − a_i|³ for rows of positions."""
    squared = 0.0
    for k in range(a.shape[1]):
        squared += (b[j, k] - a[i, k]) ** 2
    return 1 / (squared * np.sqrt(squared))


def with_user_forces(bodies, user_forces, public_state):
    """The external force plus the user's own: a plain Python function, called like ``external_force``.

    public_state(t, state): what the user's f(t, state) is given. Raises ValueError where f returns the wrong
    shapes.
    """
    n, d = len(bodies.mass), bodies.dimension
    shapes = (n, d), ((n, 3) if d == 3 else (n,))

    def force(system, t, state, f, τ):
        external_force(system, t, state, f, τ)
        seen = public_state(t, state)
        for user_force in user_forces:
            answer = user_force(t, seen)
            try:
                added = [np.asarray(part, dtype=float) for part in answer]
            except (TypeError, ValueError):
                added = []
            if [part.shape for part in added] != list(shapes):
                raise ValueError(
                    f"f(t, state) must return a force of shape {shapes[0]} and a torque of shape "
                    f"{shapes[1]}, but {getattr(user_force, '__name__', user_force)} returned {answer!r}"
                )
            f += added[0][bodies.moving]
            τ += added[1][bodies.rotating].reshape(τ.shape)

    return force


def potential_energy(bodies, position, orientation):
    """Of gravity, springs and gravitation, J: (T,). position (T, n, d), orientation (T, n, 4) or (T, n).

    Drag, dampers and the user's own forces have none.
    """
    energy = -(position @ bodies.gravity) @ bodies.mass
    for ends, (stiffness, _, length) in zip(bodies.spring_ends, bodies.system.spring_law, strict=True):
        a, b = (_world_point(position, orientation, *end) for end in ends)
        energy = energy + 0.5 * stiffness * (np.linalg.norm(b - a, axis=-1) - length) ** 2
    m = bodies.source_mass
    for i in range(len(m)) if bodies.gravitation else ():
        for j in range(i):
            if m[i] * m[j] > 0 and (bodies.mass[i] > 0 or bodies.mass[j] > 0):
                distance = np.linalg.norm(position[:, i] - position[:, j], axis=-1)
                energy = energy - bodies.gravitation * m[i] * m[j] / distance
    return energy


def _world_point(position, orientation, i, arm):
    """Where (T, d) the point ``arm`` (d,), in body i's frame, is; i None: ``arm`` itself, in the world."""
    if i is None:
        return arm
    turn = over_arrays(rotate) if len(arm) == 3 else rotate_in_plane
    return position[:, i] + turn(orientation[:, i], arm)
