"""The engines against formulas written out here, against our integrators of the same scheme, and on paper.

Where an engine has no wheel (pybullet needs Linux x86-64 and Python up to 3.11), the tests that step it are
skipped with that reason, and its recordings are what our integrators are held against.
"""

import math
import sys

import numpy as np
import pytest

from reference import Box, Disc, Point, Scene, Sphere, Unsupported, simulate
from reference.cases import CASES
from reference.peers import ENGINES, simulate_in
from reference.peers.recorded import ARRAYS, FOLDER, RECORDINGS, load, record
from reference.rotation import rotation_matrix, skew

PYTHON = ".".join(map(str, sys.version_info[:2]))
SAME_SCHEME = {
    ("pymunk", None): "symplectic_euler_position_first",
    ("pybullet", "multibody"): "symplectic_euler",
    ("pybullet", "rigid"): "implicit_gyroscopic",
}


def needs(engine):
    return pytest.mark.skipif(
        not ENGINES[engine].available,
        reason=f"{engine} is not installed for Python {PYTHON}; its recordings serve",
    )


def assert_same(run, other, tolerance):
    """All motion within the tolerance, absolutely (SI units); quaternions up to their sign."""
    np.testing.assert_allclose(run.time, other.time, atol=1e-12)
    for name in ("position", "velocity", "angular_velocity"):
        np.testing.assert_allclose(getattr(run, name), getattr(other, name), atol=tolerance, err_msg=name)
    p, q = run.orientation, other.orientation
    if p.ndim == 3:
        q = q * np.sign(np.sum(p * q, axis=-1, keepdims=True))
    np.testing.assert_allclose(p, q, atol=tolerance, err_msg="orientation")


# ---- what each engine does in a step, by hand


@needs("pymunk")
def test_pymunk_moves_first_and_then_changes_speed():
    scene, h = Scene(gravity=(0.0, -10.0)), 0.1
    i = scene.add(Disc(1.0), mass=2.0, inertia=0.7, position=(1, 2), velocity=(3, 4), angular_velocity=5)
    scene.force(lambda t, state: ([[6.0, 0.0]], [7.0]))
    with ENGINES["pymunk"].load(scene, h) as peer:
        peer.advance(h)
        state = peer.state
    np.testing.assert_allclose(state.position[i], (1.3, 2.4), atol=1e-15)
    np.testing.assert_allclose(state.velocity[i], (3.3, 3.0), atol=1e-15)
    assert state.orientation[i] == 0.5
    assert state.angular_velocity[i] == 6.0


@needs("pymunk")
@pytest.mark.parametrize(("stiffness", "damping"), [(5, 0), (5, 1), (0, 1), (500, 30)])
def test_pymunk_spring_is_an_impulse_and_its_damper_an_exponential(stiffness, damping):
    scene, h, x, v, length = Scene(gravity=(0, 0)), 0.01, 1.0, 0.3, 0.4
    scene.add(Point(), mass=2.0, position=(x, 0), velocity=(v, 0))
    scene.spring(0, None, stiffness, damping=damping, length=length, point_b=(0, 0))
    run = simulate_in(scene, "pymunk", 0.05, h)
    for k in range(1, 6):
        x += h * v
        v = (v - h * stiffness * (x - length) / 2.0) * math.exp(-damping * h / 2.0)
        np.testing.assert_allclose((run.position[k, 0, 0], run.velocity[k, 0, 0]), (x, v), atol=1e-14)


@needs("pymunk")
def test_pymunk_damper_between_two_bodies():
    scene, h = Scene(gravity=(0, 0)), 0.01
    scene.add(Point(), mass=2.0, position=(0, 0), velocity=(-0.5, 0))
    scene.add(Point(), mass=3.0, position=(1, 0), velocity=(0.7, 0))
    scene.spring(0, 1, 500.0, damping=30.0, length=0.9)
    run = simulate_in(scene, "pymunk", 0.05, h)
    gap, rate, inverse = 1.0, 1.2, 1 / 2.0 + 1 / 3.0  # inverse of the reduced mass
    for k in range(1, 6):
        gap += h * rate
        rate = (rate - h * 500.0 * (gap - 0.9) * inverse) * math.exp(-30.0 * h * inverse)
        found = np.diff(run.position[k, :, 0])[0], np.diff(run.velocity[k, :, 0])[0]
        np.testing.assert_allclose(found, (gap, rate), atol=1e-14)


def bullet_spin(kind, R, ω, τ, I, h):
    """ω after a step of pybullet, in the world; body-frame formulas of the adapter's docstring."""
    s, I = R.T @ ω, np.diag(I)
    if kind == "multibody":
        return R @ (s + h * np.linalg.solve(I, R.T @ τ - np.cross(s, I @ s)))
    slope = I + h * (skew(s) @ I - skew(I @ s))
    return R @ (s - np.linalg.solve(slope, h * np.cross(s, I @ s)) + h * np.linalg.solve(I, R.T @ τ))


@needs("pybullet")
@pytest.mark.parametrize("kind", ["multibody", "rigid"])
@pytest.mark.parametrize("torque", [(0, 0, 0), (1.0, -2.0, 0.5)])
@pytest.mark.parametrize("spin", [(0.1, 1, 0.2), (3, -1, 2), (1e-4, 2e-4, 0), (0, 0, 0), (300, 5, 7)])
def test_pybullet_step_by_hand(kind, torque, spin):
    h, q, force = (
        (0.01 if max(spin) < 100 else 0.001),
        np.array([0.9, 0.1, 0.2, -0.3]),
        np.array([1.0, 2, -3]),
    )
    q /= np.linalg.norm(q)
    scene, x, v, ω = (
        Scene(gravity=(1, 2, 3)),
        np.array([5.0, 6, 7]),
        np.array([200.0, -3, 1]),
        np.array(spin, float),
    )
    scene.add(
        Sphere(0.5), mass=2.0, inertia=(1, 2, 3), position=x, velocity=v, orientation=q, angular_velocity=ω
    )
    scene.force(lambda t, state: (force[None], np.array([torque], dtype=float)))
    run = simulate_in(scene, "pybullet", 3 * h, h, body=kind)
    for k in range(1, 4):
        ω = bullet_spin(kind, rotation_matrix(q), ω, np.array(torque), (1, 2, 3), h)
        v = v + h * (scene.gravity + force / 2.0)
        x = x + h * v
        half = h * np.linalg.norm(ω) / 2
        turn = np.append(math.cos(half), np.sinc(half / np.pi) * h / 2 * ω)
        q = np.array(
            [
                turn[0] * q[0] - turn[1:] @ q[1:],
                *(turn[0] * q[1:] + q[0] * turn[1:] + np.cross(turn[1:], q[1:])),
            ]
        )
        np.testing.assert_allclose(run.position[k, 0], x, atol=1e-13)
        np.testing.assert_allclose(run.velocity[k, 0], v, atol=1e-13)
        np.testing.assert_allclose(run.angular_velocity[k, 0], ω, rtol=1e-13, atol=1e-13)
        np.testing.assert_allclose(run.orientation[k, 0], q, atol=1e-14)


@needs("pybullet")
def test_pybullet_substeps_are_steps():
    case = CASES["tumbling_box"]()
    fine = simulate_in(case.scene, "pybullet", case.duration, case.duration / 800, record_every=8)
    coarse = simulate_in(case.scene, "pybullet", case.duration, case.duration / 100, substeps=8)
    assert_same(fine, coarse, 1e-12)
    case = CASES["spring"]()  # with forces of ours each substep is a call
    fine = simulate_in(case.scene, "pybullet", case.duration, case.duration / 800, record_every=8)
    coarse = simulate_in(case.scene, "pybullet", case.duration, case.duration / 100, substeps=8)
    assert_same(fine, coarse, 1e-12)


@needs("pybullet")
def test_pybullet_refuses_a_turn_that_it_would_cut_off():
    scene = Scene(gravity=(0, 0, 0))
    scene.add(Sphere(1.0), angular_velocity=(0, 0, 10))
    with pytest.raises(Unsupported, match=r"dt must be at most 0\.07854"):
        simulate_in(scene, "pybullet", 1.0, 0.1)
    simulate_in(scene, "pybullet", 1.0, 0.1, substeps=2)


# ---- the same scheme of ours


@pytest.mark.parametrize(
    ("engine", "kind", "name"),
    [
        pytest.param(engine, kind, name, marks=needs(engine))
        for engine, kind, names in (
            ("pymunk", None, ("free_fall", "planar_flight", "spring", "two_body_orbit", "projectile_drag")),
            ("pybullet", "multibody",
             ("free_fall", "tumbling_box", "spring", "two_body_orbit", "projectile_drag", "heavy_top")),
            ("pybullet", "rigid", ("free_fall", "tumbling_box", "spring", "two_body_orbit", "heavy_top")),
        )
        for name in names
    ],
)  # fmt: skip
def test_engine_equals_our_integrator_of_its_scheme(engine, kind, name):
    flat = engine == "pymunk" and name not in ("planar_flight",)
    case = CASES[name](**({"dimension": 2} if flat else {}))
    dt = case.duration / 1000
    theirs = simulate_in(
        case.scene, engine, case.duration, dt, record_every=50, **({"body": kind} if kind else {})
    )
    ours = simulate(case.scene, case.duration, dt, integrator=SAME_SCHEME[engine, kind], record_every=50)
    assert theirs.status == ours.status == "ok"
    # The issue asks for 1e-9; a thousand steps of rounding were measured to stay below 1e-10.
    assert_same(theirs, ours, 1e-9)


@needs("pymunk")
def test_pymunk_forces_of_ours_equal_its_own_spring():
    case = CASES["spring"](dimension=2)
    runs = [simulate_in(case.scene, "pymunk", 1.0, 1e-3, springs=how) for how in ("engine", "force")]
    assert_same(*runs, 1e-12)


@needs("pymunk")
def test_springs_on_turning_bodies_in_the_plane():
    scene = Scene(gravity=(0, -9.81))
    a = scene.add(Box((0.5, 0.2)), mass=2.0, angular_velocity=1.0, orientation=0.3, group=1)
    b = scene.add(Disc(0.3), mass=1.0, position=(2, 1), velocity=(0, 1), group=1)
    wall = scene.add(Point(), static=True, position=(0, 3))
    scene.spring(a, b, 30.0, length=1.5, point_a=(0.4, 0.1), point_b=(1.9, 1.2))
    scene.spring(a, wall, 40.0, length=2.0, point_a=(-0.4, 0.1))
    ours = simulate(scene, 1.0, 1e-3, integrator=SAME_SCHEME["pymunk", None])
    for how in ("engine", "force"):
        assert_same(simulate_in(scene, "pymunk", 1.0, 1e-3, springs=how), ours, 1e-9)


@needs("pybullet")
@pytest.mark.parametrize("kind", ["multibody", "rigid"])
def test_springs_drag_and_tilted_inertia_in_space(kind):
    """Everything at once."""
    scene = Scene(gravity=(0, 0, -9.81))
    tilted = np.array([[2.0, 0.3, 0.1], [0.3, 1.5, -0.2], [0.1, -0.2, 1.2]])
    a = scene.add(Sphere(0.5), mass=2.0, inertia=tilted, angular_velocity=(1, 2, 0.5), group=1)
    b = scene.add(Box((0.3, 0.2, 0.1)), mass=1.0, position=(2, 1, 0), orientation=(0.8, 0, 0.6, 0), group=1)
    sun = scene.add(Point(), static=True, mass=50.0, position=(0, 0, 4))
    scene.spring(a, b, 30.0, damping=0.5, length=1.5, point_a=(0.2, 0.1, 0.3), point_b=(1.9, 1.1, 0))
    scene.spring(a, sun, 40.0)
    scene.drag(b, 0.3, 0.02)
    scene.gravitate(0.1)
    theirs = simulate_in(scene, "pybullet", 1.0, 1e-3, body=kind)
    ours = simulate(scene, 1.0, 1e-3, integrator=SAME_SCHEME["pybullet", kind])
    assert_same(theirs, ours, 1e-9)
    np.testing.assert_array_equal(theirs.position[:, sun], np.broadcast_to((0, 0, 4), (1001, 3)))


@needs("pymunk")
def test_pymunk_damping_is_drag_to_first_order():
    case = CASES["projectile_drag"](dimension=2)
    errors = [
        case.error(simulate_in(case.scene, "pymunk", case.duration, case.duration / n, drag="engine"))
        for n in (200, 400)
    ]
    assert 1.8 < errors[0] / errors[1] < 2.2
    case.scene.add(Point(), mass=5.0)
    with pytest.raises(Unsupported, match="one for all bodies"):
        simulate_in(case.scene, "pymunk", 1.0, 0.1, drag="engine")


@pytest.mark.parametrize("engine", [pytest.param(name, marks=needs(name)) for name in ENGINES])
def test_users_force_sees_what_it_should(engine):
    d = ENGINES[engine].dimension
    scene, seen = Scene(gravity=[0.0] * d), []
    scene.add(Point(), velocity=[1.0] * d)
    scene.add(Sphere(1.0) if d == 3 else Disc(1.0), mass=2.0)

    def push(t, state):
        seen.append((t, state))
        return np.ones((2, d)), np.zeros((2, 3) if d == 3 else 2)

    scene.force(push)
    simulate_in(scene, engine, 0.3, 0.1)
    start = (
        0.1 if engine == "pymunk" else 0.0
    )  # position first sees the end of the step, velocity first its start
    np.testing.assert_allclose([t for t, _ in seen], start + np.array([0.0, 0.1, 0.2]), atol=1e-15)
    state = seen[0][1]
    assert state.position.shape == (2, d)
    np.testing.assert_allclose(state.position[0], start)
    assert state.orientation.shape == ((2, 4) if d == 3 else (2,))
    scene.force(lambda t, state: (np.ones(d), 0.0))
    with pytest.raises(ValueError, match=r"must return a force of shape \(2"):
        simulate_in(scene, engine, 0.3, 0.1)


# ---- the same Trajectory, and the promise


@pytest.mark.parametrize("engine", [pytest.param(name, marks=needs(name)) for name in ENGINES])
def test_trajectory_is_the_same_class_with_settings(engine):
    d = ENGINES[engine].dimension
    case = CASES["spring"](dimension=d)
    theirs, ours = (
        simulate_in(case.scene, engine, 0.5, 0.01, iterations=7, record_every=4),
        simulate(case.scene, 0.5, 0.01, record_every=4),
    )
    assert type(theirs) is type(ours)
    for name in (*ARRAYS, "residual", "iterations"):
        assert getattr(theirs, name).shape == getattr(ours, name).shape, name
    for method in ("energy", "momentum", "angular_momentum", "joint_error", "penetration"):
        assert getattr(theirs, method)().shape == getattr(ours, method)().shape, method
    assert theirs.settings["engine"] == engine
    assert theirs.settings["version"] == ENGINES[engine].version
    assert theirs.settings["iterations"] == 7
    assert len(theirs.contacts[0].depth) == 0
    blind = simulate_in(case.scene, engine, 0.01, 0.01, record_contacts=False)
    with pytest.raises(ValueError, match="run with record_contacts=True"):
        blind.penetration()


@pytest.mark.parametrize("engine", [pytest.param(name, marks=needs(name)) for name in ENGINES])
def test_advance_and_run_agree(engine):
    d = ENGINES[engine].dimension
    case = CASES["spring"](dimension=d)
    run = simulate_in(case.scene, engine, 1.0, 0.01)
    with ENGINES[engine].load(case.scene, 0.01) as peer:
        peer.advance(0.4)
        peer.advance(0.6)
        assert peer.time == pytest.approx(1.0)
        np.testing.assert_array_equal(peer.state.position, run.position[-1])


@needs("pybullet")
def test_every_client_is_disconnected():
    import pybullet

    def connected():
        return [c for c in range(20) if pybullet.isConnected(c)]

    before, scene = connected(), CASES["spring"]().scene
    simulate_in(scene, "pybullet", 0.1, 0.01)
    assert connected() == before
    scene.force(lambda t, state: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulate_in(scene, "pybullet", 0.1, 0.01)
    assert connected() == before
    peer = ENGINES["pybullet"].load(CASES["spring"]().scene, 0.01)
    assert connected() != before
    peer.close()
    peer.close()
    del peer
    assert connected() == before
    ENGINES["pybullet"].load(CASES["spring"]().scene, 0.01)  # dropped at once
    assert connected() == before


@pytest.mark.parametrize("engine", [pytest.param(name, marks=needs(name)) for name in ENGINES])
def test_a_run_that_overflows_says_when(engine):
    d = ENGINES[engine].dimension
    case = CASES["spring"](dimension=d, stiffness=1e5)
    run = simulate_in(case.scene, engine, 40.0, 0.1)
    assert run.status == "diverged"
    assert f"{run.time[-1]:.6g} s" in run.reason
    assert np.isfinite(run.position).all()
    assert case.error(run) == np.inf


def test_what_an_engine_can_not_express():
    flat, space = CASES["planar_flight"](), CASES["tumbling_box"]()
    with pytest.raises(Unsupported, match="pymunk has no third dimension"):
        simulate_in(space.scene, "pymunk", 1.0, 0.1)
    with pytest.raises(Unsupported, match="pybullet has no planar bodies"):
        simulate_in(flat.scene, "pybullet", 1.0, 0.1)


@pytest.mark.parametrize(
    ("engine", "settings", "words"),
    [
        ("bullet", {}, "engine must be one of pymunk, pybullet, but is 'bullet'"),
        ("pymunk", {"solver": "pgs"}, "'solver' is no setting of pymunk, which has substeps"),
        ("pymunk", {"springs": "soft"}, "springs must be one of engine, force"),
        ("pymunk", {"iterations": 0}, "iterations must be a whole number of at least 1"),
        ("pybullet", {"body": "soft"}, "body must be one of multibody, rigid"),
    ],
)
def test_bad_settings_are_told(engine, settings, words):
    case = CASES["free_fall"](dimension=2 if engine == "pymunk" else 3)
    with pytest.raises(ValueError, match=words):
        simulate_in(case.scene, engine, 1.0, 0.1, **settings)


@needs("pymunk")
@pytest.mark.parametrize(
    ("duration", "dt", "word"), [(1.0, 0.3, "whole number"), (1.0, 0.0, "dt"), (-1.0, 0.1, "duration")]
)
def test_bad_times_are_told(duration, dt, word):
    with pytest.raises(ValueError, match=word):
        simulate_in(CASES["free_fall"](dimension=2).scene, "pymunk", duration, dt)


@pytest.mark.parametrize("engine", list(ENGINES))
def test_missing_engine_is_told(engine, monkeypatch):
    monkeypatch.setattr("reference.peers.engine.importlib.util.find_spec", lambda name: None)
    assert not ENGINES[engine].available
    assert ENGINES[engine].version is None
    case = CASES["free_fall"](dimension=ENGINES[engine].dimension)
    with pytest.raises(
        Unsupported, match=f"(?s){engine} is not installed.*pip install {engine}==.*recordings"
    ):
        simulate_in(case.scene, engine, 1.0, 0.1)


# ---- recordings


FREE = [name for name, (_, case, *_) in RECORDINGS.items() if not CASES[case]().scene.joints]


@pytest.mark.parametrize("name", FREE)  # those with joints: test_peers_joints
def test_our_integrator_equals_the_recording(name):
    data, run = load(name)
    assert data["version"] and data["platform"] and data["settings"]["engine"] == data["engine"]
    case = CASES[data["case"]](**data["parameters"])
    integrator = SAME_SCHEME[data["engine"], data["settings"].get("body")]
    ours = simulate(
        case.scene, case.duration, data["dt"], integrator=integrator, record_every=data["record_every"]
    )
    assert_same(run, ours, 1e-9)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=needs(RECORDINGS[name][0])) for name in RECORDINGS]
)
def test_recording_again_gives_the_same(name):
    data, run = load(name)
    again = record(name)
    assert again["version"] == data["version"], (
        "a new version of the engine: record anew, and look at what changed"
    )
    for key in ARRAYS:
        # Another processor may round differently in each of some hundred steps.
        np.testing.assert_allclose(getattr(run, key), again[key], atol=1e-11, err_msg=key)


def test_there_are_no_other_recordings_and_unknown_ones_are_told():
    assert {path.stem for path in FOLDER.glob("*.json")} == set(RECORDINGS)
    with pytest.raises(KeyError, match="recording must be one of pybullet_free_fall"):
        load("pybullet_door")
