"""Rows of J against finite differences of φ, against the motions that joints allow, and against engines."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

import independent_joints as apart
from independent_joints import PARTNERS, PLANE, SPACE
from reference import BallJoint, Box, Distance, Fixed, Hinge, Point, Polygon, Scene, Slider, compiled
from reference.correction import displace
from reference.joints.row import frame
from reference.layout import Bodies
from reference.mechanism import rigid_rows, soft_rows
from reference.rows import add_rows, dense, fill_rows, make_jacobian, row_times
from reference.rows.frames import fill_frames

ROOT = Path(__file__).resolve().parents[2]
EVERY = [(kind, d) for d, kinds in ((3, SPACE), (2, PLANE)) for kind in kinds]
every_kind = pytest.mark.parametrize(("name", "d"), EVERY, ids=[f"{kind}-{d}D" for kind, d in EVERY])
every_partner = pytest.mark.parametrize("partners", PARTNERS)


def kind_of(name, d):
    return (SPACE if d == 3 else PLANE)[name]


def filled(bodies, rows, state):
    out = make_jacobian(len(rows.kind), len(bodies.rotating), bodies.dimension)
    fill_rows(rows, state, out)
    return out, dense(out.J, rows.bodies, len(bodies.moving), len(bodies.rotating))


def moving(scene, *numbers):
    return [i for i in numbers if i is not None and not scene.bodies[i].static]


def still(d):
    return lambda t: apart.slide(np.zeros(d))


# --- J and J̇u are the derivatives of φ ----------------------------------------------------------------------


def steady_motions(bodies, numbers, rng, off):
    """Constant velocities of these bodies, from the start, or from anywhere else."""
    d = bodies.dimension
    return {
        k: apart.steady(
            bodies.declared[k].position,
            rng.normal(size=d),
            rng.normal(size=3) if d == 3 else rng.normal(),
            apart.random_displacement(rng, d) if off else None,
        )
        for k in numbers
    }


def φ_and_derivatives(kind, bodies, motions, i, j):
    """By finite differences of φ as written apart."""
    D_i, D_j = (motions.get(k, still(bodies.dimension)) for k in (i, j))
    p = bodies.declared[j].position
    return apart.derivatives(lambda t: kind.φ(D_i(t), D_j(t), p), 5e-3)


@every_kind
@every_partner
@pytest.mark.parametrize("where", ["at the start", "off the joint"])
def test_w_and_its_rate_are_the_derivatives_of_φ(name, d, partners, where):
    rng, kind = np.random.default_rng(3), kind_of(name, d)
    for _ in range(3):
        scene, i, j = apart.joined(kind, partners, rng, d)
        bodies = Bodies(scene)
        motions = steady_motions(bodies, moving(scene, i, j), rng, off=where == "off the joint")
        φ, w, rate = φ_and_derivatives(kind, bodies, motions, i, j)
        state, _ = apart.state_of(bodies, motions)
        out, J = filled(bodies, rigid_rows(bodies), state)
        assert_allclose(out.φ, φ, rtol=0, atol=1e-13)
        assert_allclose(J @ state.u, w, rtol=0, atol=2e-7)
        assert_allclose(out.rate, rate, rtol=0, atol=2e-6)
        if where == "at the start":
            assert_allclose(out.φ, 0, rtol=0, atol=1e-14)


@every_kind
def test_the_rate_is_that_of_J_at_constant_u(name, d):
    """(J(h) u − J(−h) u) / 2h, off the joint; for the row of the coordinate as well."""
    rng, h = np.random.default_rng(14), 1e-5
    law = {"stiffness": 1} if kind_of(name, d).driven else {}
    for _ in range(3):
        bodies, state = anywhere(name, d, "two bodies", rng, **law)
        for rows in (rigid_rows(bodies), soft_rows(bodies)):
            w = []
            for t in (-h, h):
                moved = bodies.state()
                moved.y[:] = state.y
                displace(moved, t * state.v, t * state.ω)
                w.append(filled(bodies, rows, moved)[1] @ state.u)
            rate = filled(bodies, rows, state)[0].rate
            assert_allclose((w[1] - w[0]) / (2 * h), rate, rtol=0, atol=1e-6)


@pytest.mark.parametrize("d", [3, 2])
@pytest.mark.parametrize("which", ["a bead on a rod", "a ring on a bead"])
def test_points_follow_and_carry(d, which):
    """A Point as j slides along a body; a Point as i carries a body, with directions that never turn."""
    rng, kinds = np.random.default_rng(13), SPACE if d == 3 else PLANE
    name = "Slider" if "rod" in which else "BallJoint" if d == 3 else "Hinge"
    bead, body = (1, 0) if name == "Slider" else (0, 1)
    scene = Scene(gravity=np.zeros(d))
    for k in range(2):
        solid = Box((0.3, 0.4, 0.5)) if d == 3 else Polygon([(0, 0), (1, 0), (0, 1)])
        position = apart.POINT[:d] if k == bead else rng.normal(size=d)
        inertia = None if k == bead else apart.TENSOR if d == 3 else 0.3
        scene.add(Point() if k == bead else solid, mass=1, inertia=inertia, position=position)
    scene.join(kinds[name].declare(0, 1))
    bodies = Bodies(scene)
    for _ in range(3):
        motions = steady_motions(bodies, (body,), rng, off=True)
        v, away = rng.normal(size=(2, d))
        motions[bead] = lambda t, v=v, away=away: apart.slide(away + v * t)
        φ, w, rate = φ_and_derivatives(kinds[name], bodies, motions, 0, 1)
        state, _ = apart.state_of(bodies, motions)
        out, J = filled(bodies, rigid_rows(bodies), state)
        m = d - 1 if name == "Slider" else d  # no rows for an orientation
        assert len(J) == m
        assert_allclose(out.φ, φ[:m], rtol=0, atol=1e-13)
        assert_allclose(J @ state.u, w[:m], rtol=0, atol=2e-7)
        assert_allclose(out.rate, rate[:m], rtol=0, atol=2e-6)


# --- what a joint allows, and what it does not --------------------------------------------------------------


def allowed_motion(name, d, partners, rng, **law):
    """A scene whose bodies move as the joint lets them: (bodies, state, u̇, c, ċ), c its coordinates."""
    kind = kind_of(name, d)
    scene, i, j = apart.joined(kind, partners, rng, d, **law)
    p = scene.bodies[j].position
    c, rate = 0.7 * rng.normal(size=kind.freedom), rng.normal(size=kind.freedom)

    def relative(t):
        return kind.allowed(c + rate * t, p)

    if partners == "static j":
        motions = {i: lambda t: apart.inverse(relative(t))}
    elif partners == "two bodies":
        spin = rng.normal(size=3) if d == 3 else rng.normal()
        start = apart.random_displacement(rng, d)
        at = apart.steady(scene.bodies[i].position, rng.normal(size=d), spin, start)
        motions = {i: at, j: lambda t: apart.after(at(t), relative(t))}
    else:
        motions = {j: relative}
    bodies = Bodies(scene)
    return bodies, *apart.state_of(bodies, motions), c, rate


@every_kind
@every_partner
def test_allowed_motions_have_no_w_and_keep_having_none(name, d, partners):
    rng = np.random.default_rng(4)
    for _ in range(3):
        bodies, state, u̇, *_ = allowed_motion(name, d, partners, rng)
        out, J = filled(bodies, rigid_rows(bodies), state)
        assert_allclose(out.φ, 0, rtol=0, atol=1e-12)
        assert_allclose(J @ state.u, 0, rtol=0, atol=1e-7)
        assert_allclose(J @ u̇ + out.rate, 0, rtol=0, atol=1e-5)  # w stays 0: J u̇ + J̇ u = 0


@every_kind
@every_partner
def test_no_row_too_many_and_none_too_few(name, d, partners):
    kind, rng = kind_of(name, d), np.random.default_rng(5)
    bodies, state, *_ = allowed_motion(name, d, partners, rng)
    _, J = filled(bodies, rigid_rows(bodies), state)
    freedom = min(kind.freedom, 5 if d == 3 else 2)  # a rod's turn about itself moves nothing
    wanted = (6 if d == 3 else 3) - freedom
    assert len(J) == wanted == np.linalg.matrix_rank(J)
    free = scipy.linalg.null_space(J)  # all velocities that the joint allows
    assert free.shape[1] == J.shape[1] - wanted


@pytest.mark.parametrize("name", ["Hinge", "Slider"])
@pytest.mark.parametrize("d", [3, 2])
@every_partner
def test_the_free_row_measures_the_coordinate(name, d, partners):
    rng = np.random.default_rng(6)
    for _ in range(3):
        bodies, state, u̇, c, rate = allowed_motion(name, d, partners, rng, stiffness=1)
        out, J = filled(bodies, soft_rows(bodies), state)
        assert_allclose(out.φ, c, rtol=0, atol=1e-12)
        assert_allclose(J @ state.u, rate, rtol=0, atol=1e-7)
        assert_allclose(J @ u̇ + out.rate, 0, rtol=0, atol=1e-5)  # the rate is constant


# --- both ways, work, action and reaction (S7) --------------------------------------------------------------


def anywhere(name, d, partners, rng, **law):
    """A joined scene with its bodies anywhere, at any velocities."""
    scene, *_ = apart.joined(kind_of(name, d), partners, rng, d, **law)
    bodies = Bodies(scene)
    state = bodies.state()
    state.x[:] += rng.normal(size=state.x.shape)
    state.q[:] += rng.normal(size=state.q.shape)
    if d == 3:
        state.q[:] /= np.linalg.norm(state.q, axis=1, keepdims=True)
    state.u[:] = rng.normal(size=state.u.shape)
    return bodies, state


def back(bodies, rows, out, λ):
    """f_c = Jᵀ λ as (f, τ)."""
    d, r = bodies.dimension, len(bodies.rotating)
    f, τ = np.zeros((len(bodies.moving), d)), np.zeros((r, 3 if d == 3 else 1))
    add_rows(out.J, rows.bodies, λ, f, τ)
    return f, τ


@every_kind
@every_partner
def test_the_constraint_s_power_is_the_same_on_both_sides(name, d, partners):
    rng = np.random.default_rng(7)
    bodies, state = anywhere(name, d, partners, rng)
    rows = rigid_rows(bodies)
    out, J = filled(bodies, rows, state)
    λ = rng.normal(size=len(J))
    w = np.array([row_times(out.J, rows.bodies, k, state.v, state.ω) for k in range(len(J))])
    f, τ = back(bodies, rows, out, λ)
    assert_allclose(w, J @ state.u, rtol=1e-13)
    assert_allclose(np.concatenate([f.ravel(), τ.ravel()]), J.T @ λ, rtol=1e-13, atol=1e-15)
    assert_allclose(λ @ w, np.sum(f * state.v) + np.sum(τ * state.ω), rtol=1e-12)


@every_kind
def test_each_row_acts_on_both_bodies_oppositely_also_off_the_joint(name, d):
    rng = np.random.default_rng(8)
    laws = [{}, {"stiffness": 1}] if kind_of(name, d).driven else [{}]
    for law in laws:
        bodies, state = anywhere(name, d, "two bodies", rng, **law)
        for rows in (rigid_rows(bodies), soft_rows(bodies)):
            out, _ = filled(bodies, rows, state)
            f, τ = back(bodies, rows, out, rng.normal(size=len(rows.kind)))
            arms = state.x[:, :, None] * f[:, None, :]
            about_origin = arms[:, 0, 1] - arms[:, 1, 0]
            if d == 3:
                about_origin = np.cross(state.x, f)
            assert_allclose(f.sum(axis=0), 0, atol=1e-14)
            assert_allclose(about_origin.sum(axis=0) + τ.sum(axis=0), 0, atol=1e-13)


@every_kind
@every_partner
def test_a_joint_does_no_work_on_what_it_allows(name, d, partners):
    rng = np.random.default_rng(9)
    bodies, state, *_ = allowed_motion(name, d, partners, rng)
    rows = rigid_rows(bodies)
    out, J = filled(bodies, rows, state)
    λ = rng.normal(size=len(J))
    f, τ = back(bodies, rows, out, λ)
    power = np.sum(f * state.v) + np.sum(τ * state.ω)
    assert abs(power) < 1e-6
    assert (
        abs(np.sum(np.abs(f * state.v))) > 1e-3 or kind_of(name, d).freedom == 0
    )  # each side alone does some


# --- frames -------------------------------------------------------------------------------------------------


@every_kind
def test_λ_is_in_the_joint_s_own_frame_and_u_in_the_world_s(name, d):
    """Carry everything over into a turned world: φ, w and J̇ u stay, forces on bodies turn with it."""
    rng = np.random.default_rng(10)
    bodies, state = anywhere(name, d, "two bodies", rng)
    rows = rigid_rows(bodies)
    out, J = filled(bodies, rows, state)
    λ = rng.normal(size=len(J))
    f, τ = back(bodies, rows, out, λ)

    R, t = apart.random_displacement(rng, d)
    moved = bodies.state()
    moved.x[:], moved.v[:] = state.x @ R.T + t, state.v @ R.T
    if d == 3:
        turned = Rotation.from_matrix(R) * Rotation.from_quat(state.q, scalar_first=True)
        moved.q[:], moved.ω[:] = turned.as_quat(scalar_first=True), state.ω @ R.T
    else:
        moved.q[:], moved.ω[:] = state.q + np.arctan2(R[1, 0], R[0, 0]), state.ω
    again, J_again = filled(bodies, rows, moved)
    f_again, τ_again = back(bodies, rows, again, λ)
    assert_allclose(again.φ, out.φ, rtol=0, atol=1e-13)
    assert_allclose(J_again @ moved.u, J @ state.u, rtol=0, atol=1e-12)
    assert_allclose(again.rate, out.rate, rtol=0, atol=1e-12)
    assert_allclose(f_again, f @ R.T, rtol=0, atol=1e-13)
    assert_allclose(τ_again, τ @ R.T if d == 3 else τ, rtol=0, atol=1e-12)


def test_a_hinge_s_w_are_the_components_along_e1_e2_e3():
    """By hand (S5, S6): the hinge at the world's origin about z, in the joint's frame e1 e2 e3."""
    scene = Scene()
    body = scene.add(Box((1, 1, 1)), position=(1, 2, 3), velocity=(0.5, -1, 2), angular_velocity=(3, 5, 7))
    scene.join(Hinge(body, None, point=(0, 0, 0), axis=(0, 0, 1)))
    bodies = Bodies(scene)
    e = frame(np.array([0.0, 0, 1]))
    at_the_point = np.array([0.5, -1, 2]) + np.cross((3, 5, 7), (-1, -2, -3))
    _, J = filled(bodies, rigid_rows(bodies), bodies.state())
    assert_allclose(J @ bodies.state().u, [*(e @ at_the_point), *(e[:2] @ (3, 5, 7))], rtol=1e-14)
    assert np.allclose(e @ e.T, np.eye(3)) and np.linalg.det(e) > 0 and np.allclose(e[2], (0, 0, 1))


# --- what J̇ u is for: known constraint forces ---------------------------------------------------------------


def accelerations(bodies, state, f_e):
    """(λ, u̇) of M u̇ = f_e + Jᵀ λ and J u̇ + J̇ u = 0, with points only: M is diagonal."""
    out, J = filled(bodies, rigid_rows(bodies), state)
    M = np.repeat(bodies.system.mass, bodies.dimension)
    λ = np.linalg.solve(J / M @ J.T, -out.rate - J @ (f_e / M))
    return λ, (f_e + J.T @ λ) / M


@pytest.mark.parametrize("d", [2, 3])
def test_the_rod_of_a_pendulum_carries_weight_and_centripetal_force(d):
    m, g, length, θ, ω = 2.0, 9.81, 1.5, 0.7, 1.3
    down, side = -np.eye(d)[-1], np.eye(d)[0]
    scene = Scene(gravity=g * down)
    scene.add(
        Point(),
        mass=m,
        position=length * (np.cos(θ) * down + np.sin(θ) * side),
        velocity=length * ω * (np.cos(θ) * side - np.sin(θ) * down),
    )
    scene.join(Distance(0, None, point_b=np.zeros(d)))
    bodies = Bodies(scene)
    λ, _ = accelerations(bodies, bodies.state(), m * g * down)
    assert_allclose(λ, [-m * (g * np.cos(θ) + length * ω**2)], rtol=1e-12)  # it pulls: λ < 0


def test_a_bead_on_a_turning_rod_feels_coriolis():
    """x = r e(ωt): r̈ = ω² r along the rod, and the rod pushes with 2 m ω ṙ across."""
    m, r, ṙ, ω = 0.3, 1.2, 0.8, 2.5
    scene = Scene(gravity=(0, 0))
    outline = [(-2, -0.1), (2, -0.1), (2, 0.1), (-2, 0.1)]
    rod = scene.add(Polygon(outline), mass=1e9, inertia=1e9, angular_velocity=ω)
    bead = scene.add(Point(), mass=m, position=(r, 0), velocity=(ṙ, ω * r))
    scene.join(Slider(rod, bead, axis=(1, 0)))
    bodies = Bodies(scene)
    out, J = filled(bodies, rigid_rows(bodies), bodies.state())
    assert len(J) == 1 and bead == 1 and abs(J @ bodies.state().u)[0] < 1e-14
    on_bead = J[0, 2:4]  # (0, ∓1): across the rod
    λ = -out.rate[0] * m  # the rod does not give way
    assert_allclose(λ * on_bead, [0, 2 * m * ω * ṙ], rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("d", [2, 3])
def test_where_a_distance_s_points_meet_there_is_no_direction_and_no_nan(d):
    scene = Scene(gravity=np.zeros(d))
    scene.add(Point(), position=np.ones(d), velocity=np.ones(d))
    scene.join(Distance(0, None, point_b=np.zeros(d), stiffness=5))
    bodies = Bodies(scene)
    state = bodies.state()
    state.x[:] = 0
    out, J = filled(bodies, soft_rows(bodies), state)
    assert_allclose(out.φ, -np.sqrt(d), rtol=1e-15)
    assert not J.any() and not out.rate.any()


# --- against an engine --------------------------------------------------------------------------------------


def chain_in_pybullet(rng):
    """Links behind one another by joints of every kind that pybullet's trees have; what it says of them.

    Returns types, and per link: start and present (position, quaternion), the joint's point and axis in the
    world at the start, velocities, joint position and rate.
    """
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    names = "REVOLUTE", "PRISMATIC", "SPHERICAL", "FIXED", "REVOLUTE"
    n = len(names)
    axes = rng.normal(size=(n, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    q = rng.normal(size=(2, n + 1, 4))
    q = (q / np.linalg.norm(q, axis=-1, keepdims=True)).tolist()
    tree = pybullet.createMultiBody(
        0,
        -1,
        -1,
        [0.1, 0.2, 0.3],
        q[0][n],
        linkMasses=[1] * n,
        linkCollisionShapeIndices=[-1] * n,
        linkVisualShapeIndices=[-1] * n,
        linkPositions=rng.normal(size=(n, 3)).tolist(),
        linkOrientations=q[0][:n],
        linkInertialFramePositions=rng.normal(size=(n, 3)).tolist(),
        linkInertialFrameOrientations=q[1][:n],
        linkParentIndices=list(range(n)),
        linkJointTypes=[getattr(pybullet, f"JOINT_{name}") for name in names],
        linkJointAxis=axes.tolist(),
        physicsClientId=client,
    )

    def links():
        return [
            pybullet.getLinkState(
                tree, k, computeLinkVelocity=1, computeForwardKinematics=1, physicsClientId=client
            )
            for k in range(n)
        ]

    start = links()
    coordinates = rng.normal(size=(n, 2))
    for k, name in enumerate(names):
        if name == "SPHERICAL":
            pybullet.resetJointStateMultiDof(
                tree, k, q[1][n], rng.normal(size=3).tolist(), physicsClientId=client
            )
        else:
            pybullet.resetJointState(tree, k, *coordinates[k].tolist(), physicsClientId=client)
    now = links()
    pybullet.disconnect(client)
    return names, axes, coordinates, start, now


def test_pybullet_s_links_have_no_w():
    names, axes, coordinates, start, now = chain_in_pybullet(np.random.default_rng(11))
    scene = Scene()
    for link in start:
        scene.add(
            Box((0.3, 0.4, 0.5)),
            inertia=apart.TENSOR,
            position=link[0],
            orientation=np.roll(link[1], 1),
            group="tree",
        )
    made = {
        "REVOLUTE": lambda ends, p, axis: Hinge(*ends, point=p, axis=axis, stiffness=1),
        "PRISMATIC": lambda ends, p, axis: Slider(*ends, axis=axis, stiffness=1),
        "SPHERICAL": lambda ends, p, axis: BallJoint(*ends, point=p),
        "FIXED": lambda ends, p, axis: Fixed(*ends),
    }
    for k, (name, link) in enumerate(zip(names, start, strict=True)):
        axis = Rotation.from_quat(link[5]).apply(axes[k])
        scene.join(made[name]((k - 1, k) if k else (0, None), np.array(link[4]), axis))
    bodies = Bodies(scene)
    state = bodies.state(
        *(np.array([link[part] for link in now]) for part in (0,)),
        np.roll([link[1] for link in now], 1, axis=1),
        *(np.array([link[part] for link in now]) for part in (6, 7)),
    )
    out, J = filled(bodies, rigid_rows(bodies), state)
    assert len(J) == 5 + 5 + 3 + 6 + 5
    assert_allclose(out.φ, 0, atol=1e-6)
    assert_allclose(J @ state.u, 0, atol=1e-6)
    driven = [k for k, name in enumerate(names) if name in ("REVOLUTE", "PRISMATIC")]
    free, J_free = filled(bodies, soft_rows(bodies), state)
    assert_allclose(free.φ, coordinates[driven, 0], atol=1e-6)
    assert_allclose(J_free @ state.u, coordinates[driven, 1], atol=1e-6)


# --- the compiled form --------------------------------------------------------------------------------------

ALL_ROWS = """
import json, sys
from test_rows import all_rows
json.dump(all_rows(), sys.stdout)
"""


def all_rows():
    """Numbers of all kinds of rows, by name."""
    results = {"compiled": compiled.COMPILED}
    for name, d in EVERY:
        law = {"stiffness": 1} if kind_of(name, d).driven else {}
        for partners in PARTNERS:
            bodies, state = anywhere(name, d, partners, np.random.default_rng(12), **law)
            for make in (rigid_rows, soft_rows):
                out, J = filled(bodies, make(bodies), state)
                numbers = np.concatenate([out.φ, out.rate, J.ravel(), J @ state.u])
                results[f"{name} {d} {partners} {make.__name__}"] = numbers.tolist()
    return results


@pytest.mark.skipif(not compiled.COMPILED, reason="without Numba, everything is plain")
def test_rows_are_the_same_compiled_and_plain():
    path = os.pathsep.join(str(ROOT / folder) for folder in ("", "tests", "tests/reference"))
    environment = {**os.environ, "PYTHONPATH": path, "REFERENCE_COMPILED": "0"}
    command = [sys.executable, "-c", ALL_ROWS]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    ours, plain = all_rows(), json.loads(done.stdout)
    assert ours.pop("compiled") and not plain.pop("compiled")
    assert ours.keys() == plain.keys() and len(ours) == len(EVERY) * len(PARTNERS) * 2
    for name, numbers in ours.items():
        scale = max(map(abs, numbers), default=0)
        assert_allclose(numbers, plain[name], rtol=0, atol=1e-12 * scale, err_msg=name)


@pytest.mark.slow
@pytest.mark.skipif(not compiled.COMPILED, reason="without Numba, everything is slow")
def test_rows_cost_no_more_than_their_arithmetic():
    """A hundred hinges beside a hundred cosines and sines: 6 times its cost; 400 with arrays counted."""
    scene = Scene(gravity=(0, 0))
    for k in range(100):
        scene.add(Polygon([(-1, -1), (1, -1), (0, 1)]), position=(k, 0), group="chain")
        scene.join(Hinge(k, k - 1 if k else None, point=(k - 0.5, 0)))
    bodies = Bodies(scene)
    rows, state = rigid_rows(bodies), bodies.state()
    out = make_jacobian(len(rows.kind), 100, 2)
    cost = {}
    for many in (many_rows, many_frames, many_rows, many_frames):
        many(rows, state, out, 1)
        start = time.process_time()
        many(rows, state, out, 5000)
        cost[many] = min(cost.get(many, np.inf), time.process_time() - start)
    assert cost[many_rows] < 40 * cost[many_frames]


@compiled.compiled
def many_rows(rows, state, out, times):
    """fill_rows, over and over."""
    for _ in range(times):
        fill_rows(rows, state, out)


@compiled.compiled
def many_frames(rows, state, out, times):
    """Only each body's cosine and sine."""
    for _ in range(times):
        fill_frames(state, out.frame)
