"""Two scenes with every force of the course, and their solution by SciPy, from equations written apart."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from reference import Box, Disc, Point, Polygon, Scene, Sphere


def quaternion(rotation_vector):
    """The quaternion (w, x, y, z) of a rotation vector, by SciPy."""
    return Rotation.from_rotvec(rotation_vector).as_quat(scalar_first=True)


def busy_scene():
    """In space: two bodies, one with a full tensor, a point, a static mass; every force but damping."""
    scene = Scene(gravity=(0.3, -0.2, -1))
    a = scene.add(
        Box((0.3, 0.4, 0.5)),
        mass=2,
        inertia=[[0.5, 0.1, 0.02], [0.1, 0.6, 0.05], [0.02, 0.05, 0.7]],
        position=(0, 0, 1),
        orientation=quaternion((0.3, -0.2, 0.5)),
        velocity=(0.1, 0.2, 0.3),
        angular_velocity=(1, 2, -1.5),
        group="all",
    )
    b = scene.add(Point(), mass=0.7, position=(1.5, 0, 1), velocity=(0, 1, 0))
    c = scene.add(
        Sphere(0.2),
        mass=1.5,
        inertia=(0.1, 0.2, 0.25),
        position=(0, 2, 0),
        angular_velocity=(2, 0.3, 0.1),
        group="all",
    )
    sun = scene.add(Point(), mass=5, static=True, position=(0, 0, -3))
    scene.spring(a, b, 6, length=1.2, point_a=(0.3, 0.2, 1.4))
    scene.spring(a, c, 4, point_a=(0, -0.3, 1), point_b=(0.1, 1.9, 0.1))
    scene.spring(c, None, 3, length=0.5, point_b=(0, 3, 1))
    scene.spring(b, sun, 0.5)
    scene.gravitate(0.2)
    return scene


def planar_scene():
    """In the plane: a polygon, a disc, a point and what is fixed; springs off the centres, gravitation."""
    scene = Scene(gravity=(0.1, -2))
    a = scene.add(
        Polygon([(0, 0), (1, 0), (0, 0.7)]),
        mass=2,
        position=(0, 1),
        orientation=0.4,
        angular_velocity=1,
        group=1,
    )
    b = scene.add(Disc(0.3), mass=0.7, position=(1.5, 1), velocity=(0, 1), group=1)
    c = scene.add(Point(), mass=1.1, position=(0.5, 2.5), velocity=(-0.5, 0))
    wall = scene.add(Box((1, 1)), static=True, position=(-3, 0), orientation=0.2, group=1)
    scene.spring(a, b, 6, length=1.2, point_a=(0.3, 1.2), point_b=(1.5, 1.2))
    scene.spring(a, wall, 4, point_a=(-0.2, 1.1), point_b=(-2.2, 0.5))
    scene.spring(b, c, 3)
    scene.gravitate(0.3)
    return scene


def newton_euler(scene, t, y):
    """ẏ of all moving bodies, y = position, quaternion, velocity, body-frame spin: 13 numbers each.

    Written apart from the reference: attitudes by SciPy, Euler's equations in the body frame, planar bodies
    as bodies in space that turn about z.
    """

    def pad(r):
        return np.append(r, 0.0) if scene.dimension == 2 else np.asarray(r)

    n = len(scene.bodies)
    moving = [i for i, body in enumerate(scene.bodies) if not body.static]
    state = {i: y[13 * k : 13 * k + 13] for k, i in enumerate(moving)}
    R0 = [initial_attitude(scene, i) for i in range(n)]
    R = {i: Rotation.from_quat(state[i][3:7], scalar_first=True) if i in state else R0[i] for i in range(n)}
    x = {i: state[i][:3] if i in state else pad(scene.bodies[i].position) for i in range(n)}
    v = {i: state[i][7:10] if i in state else np.zeros(3) for i in range(n)}
    ω = {i: R[i].apply(state[i][10:]) if i in state else np.zeros(3) for i in range(n)}
    f = {i: scene.bodies[i].mass * pad(scene.gravity) for i in range(n)}
    τ = {i: np.zeros(3) for i in range(n)}
    for spring in scene.springs:
        ends = []
        for i, point in ((spring.a, spring.point_a), (spring.b, spring.point_b)):
            if i is None:
                ends.append((None, None, pad(point), np.zeros(3)))
                continue
            arm = R[i].apply(R0[i].inv().apply(pad(point) - pad(scene.bodies[i].position)))
            ends.append((i, arm, x[i] + arm, v[i] + np.cross(ω[i], arm)))
        (a, arm_a, p_a, v_a), (b, arm_b, p_b, v_b) = ends
        length = np.linalg.norm(p_b - p_a)
        n_ab = (p_b - p_a) / length
        pull = (spring.stiffness * (length - spring.length) + spring.damping * (v_b - v_a) @ n_ab) * n_ab
        for i, arm, force in ((a, arm_a, pull), (b, arm_b, -pull)):
            if i is not None:
                f[i], τ[i] = f[i] + force, τ[i] + np.cross(arm, force)
    for i, (linear, angular) in scene.drags.items():
        f[i], τ[i] = f[i] - linear * v[i], τ[i] - angular * ω[i]
    for i in range(n):
        for j in range(n):
            if i != j and scene.gravitation:
                r = x[j] - x[i]
                f[i] = (
                    f[i]
                    + scene.gravitation * scene.bodies[i].mass * scene.bodies[j].mass * r / (r @ r) ** 1.5
                )
    rates = []
    for i in moving:
        body, spin = scene.bodies[i], state[i][10:]
        q = Rotation.from_quat(state[i][3:7], scalar_first=True).as_quat(scalar_first=True)
        rate = 0.5 * np.array([-spin @ q[1:], *(q[0] * spin + np.cross(q[1:], spin))])
        acceleration = np.zeros(3)
        if body.inertia is not None:
            I = body.inertia if scene.dimension == 3 else body.inertia * np.eye(3)
            acceleration = np.linalg.solve(I, R[i].inv().apply(τ[i]) - np.cross(spin, I @ spin))
        rates.append(np.concatenate([v[i], rate, f[i] / body.mass, acceleration]))
    return np.concatenate(rates)


def initial_attitude(scene, i):
    """The Rotation of body i at the start."""
    orientation = scene.bodies[i].orientation
    if scene.dimension == 2:
        return Rotation.from_rotvec((0, 0, orientation))
    return Rotation.from_quat(orientation, scalar_first=True)


def solve(scene, duration):
    """Position, attitude (Rotation), velocity of each moving body after the duration, by SciPy's DOP853."""
    y0 = []
    for i, body in enumerate(scene.bodies):
        if not body.static:
            attitude, planar = initial_attitude(scene, i), scene.dimension == 2
            spin = (0, 0, body.angular_velocity) if planar else body.angular_velocity
            x, v = (np.append(r, 0.0) if planar else r for r in (body.position, body.velocity))
            q = attitude.as_quat(scalar_first=True)
            y0.append(np.concatenate([x, q, v, attitude.inv().apply(spin)]))
    y = solve_ivp(
        lambda t, y: newton_euler(scene, t, y),
        (0, duration),
        np.concatenate(y0),
        "DOP853",
        rtol=1e-13,
        atol=1e-13,
    ).y[:, -1]
    return [(b[:3], Rotation.from_quat(b[3:7], scalar_first=True), b[7:10]) for b in y.reshape(-1, 13)]


def worst_error(scene, run, exact):
    """The largest error of the last record: positions m, velocities m/s, attitudes rad."""
    moving = [i for i, body in enumerate(scene.bodies) if not body.static]
    worst = 0.0
    for i, (x, attitude, v) in zip(moving, exact, strict=True):
        d = scene.dimension
        worst = max(
            worst, np.abs(run.position[-1, i] - x[:d]).max(), np.abs(run.velocity[-1, i] - v[:d]).max()
        )
        if scene.bodies[i].inertia is not None:
            q = run.orientation[-1, i]
            ours = Rotation.from_rotvec((0, 0, q)) if d == 2 else Rotation.from_quat(q, scalar_first=True)
            worst = max(worst, (ours.inv() * attitude).magnitude())
    return worst
