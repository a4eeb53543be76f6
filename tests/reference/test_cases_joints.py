"""The exact motions of jointed cases: published numbers, invariants, an answer derived in two ways; and ours.

That engines go to them as dt → 0 is in test_peers_joints.
"""

import numpy as np
import pytest

from reference import simulate
from reference.cases import CASES
from reference.cases.falling import point_accelerations, rod_accelerations
from reference.cases.integrated import Integrated
from reference.cases.swing import Swing
from reference.joints import BallJoint, Distance, Hinge, Slider
from reference.layout import Bodies
from reference.measure import fitted_order
from reference.rotation import over_arrays, rotate
from reference.trajectory import ContactHistory, Trajectory

pytestmark = pytest.mark.xdist_group("joints")  # what one test compiles, the next needs

ALL = [
    ("pendulum", {}),
    ("pendulum", {"angle": 3.0, "dimension": 3, "joint": "ball", "length": 2.0, "mass": 3.0}),
    ("pendulum", {"joint": "distance"}),
    ("double_pendulum", {}),
    ("double_pendulum", {"dimension": 3}),
    ("chain", {"n": 5, "end_mass": 1000.0, "duration": 0.5}),
    ("chain", {"n": 4, "dimension": 3, "joint": "distance"}),
    ("chain", {"n": 4, "dimension": 3, "joint": "ball"}),
    ("hanging_chain", {"n": 12}),
    ("hanging_chain", {"n": 12, "dimension": 3}),
    ("door", {}),
    ("door", {"hinges": 3, "joint": "ball", "tilt": 1.0, "angle": 0.5}),
    ("four_bar", {}),
    ("four_bar", {"dimension": 3}),
    ("slider_crank", {"duration": 2.0}),
    ("slider_crank", {"dimension": 3, "duration": 2.0}),
    ("n_four_bars", {"n": 3}),
    ("n_four_bars", {"dimension": 3, "speed": 2.0}),
    ("bricard", {}),
    ("gimbal_gyroscope", {}),
    ("gimbal_gyroscope", {"precession": 0.0}),
]
IDS = [f"{name}-{'-'.join(map(str, parameters.values()))}" for name, parameters in ALL]


def as_run(case, time):
    """The exact motion as a Trajectory."""
    empty = ContactHistory.empty(len(time), case.scene.dimension)
    return Trajectory(Bodies(case.scene), time, *case.exact(time), contacts=empty)


def to_world(q, v):
    """Vectors (d,) of a body's frame in the world's, for orientations (T,) or (T, 4)."""
    if q.ndim == 2:
        return over_arrays(rotate)(q, v)
    c, s = np.cos(q), np.sin(q)
    return np.stack([c * v[0] - s * v[1], s * v[0] + c * v[1]], axis=-1)


def to_body(q, v):
    if np.ndim(q):
        return over_arrays(rotate)(q * [1, -1, -1, -1], v)
    return to_world(np.array([-q]), v)[0]


def fixed_to(run, scene, i, v, point):
    """Where a point, or a direction, that at the start is v in the world and fixed to body i, is later."""
    if i is None:
        return np.broadcast_to(v, (len(run.time), len(v)))
    body = scene.bodies[i]
    moved = to_world(run.orientation[:, i], to_body(body.orientation, v - body.position if point else v))
    return moved + run.position[:, i] if point else moved


def gaps(run, scene, joint):
    """What the joint should keep at 0, (T, k): written from its description, not from its rows."""
    i, j = joint.ends
    if isinstance(joint, Distance):
        ends = [fixed_to(run, scene, k, p, point=True) for k, p in zip((i, j), joint.points, strict=True)]
        return np.linalg.norm(ends[1] - ends[0], axis=-1, keepdims=True) - joint.length
    place = scene.bodies[j].position if isinstance(joint, Slider) else joint.point
    apart = fixed_to(run, scene, j, place, point=True) - fixed_to(run, scene, i, place, point=True)
    if isinstance(joint, BallJoint) or (isinstance(joint, Hinge) and joint.axis is None):
        return apart
    axes = [fixed_to(run, scene, k, joint.axis, point=False) for k in (i, j)]
    if isinstance(joint, Slider):
        apart = apart - np.sum(apart * axes[0], axis=-1, keepdims=True) * axes[0]
    return np.concatenate([apart, axes[1] - axes[0]], axis=-1)


@pytest.mark.parametrize(("name", "parameters"), ALL, ids=IDS)
def test_exact_motion_starts_as_the_scene_and_keeps_joints_and_energy(name, parameters):
    case = CASES[name](**parameters)
    run = as_run(case, np.linspace(0, case.duration, 41))
    start, bodies = run.state(0), Bodies(case.scene)
    for key in ("position", "orientation", "velocity", "angular_velocity"):
        np.testing.assert_allclose(getattr(start, key), getattr(bodies, key), atol=1e-14, err_msg=key)
    for joint in case.scene.joints:
        # of sizes up to 5 m; Bricard's ring and the linkages close as well as DOP853 keeps their coordinates
        assert np.abs(gaps(run, case.scene, joint)).max() < 1e-11
    energy, kinetic = run.energy(), as_run(case, run.time)
    scale = np.abs(energy).max() + 0.5 * np.max(np.square(kinetic.velocity).sum(axis=-1) @ bodies.mass)
    np.testing.assert_allclose(energy, energy[0], atol=1e-11 * scale)
    assert case.error(run) < 1e-14


@pytest.mark.parametrize(("name", "parameters"), ALL, ids=IDS)
def test_exact_velocities_are_the_rates_of_exact_positions(name, parameters):
    case = CASES[name](**parameters)
    middle, h = np.linspace(0.1, 0.9, 9) * case.duration, 1e-4

    def central(array):  # of order h⁴: 8 (f₁ − f₋₁) − (f₂ − f₋₂) over 12 h
        far, near = array(2 * h) - array(-2 * h), array(h) - array(-h)
        return (8 * near - far) / (12 * h)

    motion = case.exact(middle)
    rate = central(lambda shift: case.exact(middle + shift).position)
    scale = 1 + np.abs(motion.velocity).max()
    np.testing.assert_allclose(motion.velocity, rate, atol=1e-8 * scale)
    rate = central(lambda shift: case.exact(middle + shift).orientation)
    if case.scene.dimension == 2:
        np.testing.assert_allclose(motion.angular_velocity, rate, atol=1e-8 * scale)
    else:  # q̇ = ½ ω q
        ω, q = motion.angular_velocity, motion.orientation
        w, v = q[..., :1], q[..., 1:]
        expected = np.concatenate([-np.sum(ω * v, axis=-1, keepdims=True), w * ω + np.cross(ω, v)], axis=-1)
        np.testing.assert_allclose(expected / 2, rate, atol=1e-7 * scale)


def test_period_of_a_pendulum():
    for angle, ratio in ((np.pi / 2, 1.180341), (np.deg2rad(170), 2.439363)):
        case = CASES["pendulum"](angle=angle, joint="distance", length=2.0)
        assert case.exact.period / (2 * np.pi * np.sqrt(2.0 / 9.81)) == pytest.approx(ratio, abs=1e-6)


@pytest.mark.parametrize(
    ("angle", "speed"),
    [(1.5, 0.0), (-2.9, 0.1), (2.9, -1.0), (1.0, 5.9), (np.pi, -1.0), (7.0, 1.0), (0.0, 2.0)],
)
def test_swing_against_an_integration(angle, speed):
    swing, time = Swing(3.0, angle, speed), np.linspace(0, 5, 101)
    other = Integrated(lambda y: np.array([y[1], -9 * np.sin(y[0])]), (angle, speed))(time)
    found = np.stack(swing(time), axis=-1)
    np.testing.assert_allclose(found, other, atol=1e-9)  # near the top errors of both grow a thousandfold
    np.testing.assert_allclose(swing.acceleration(time), -9 * np.sin(other[:, 0]), atol=1e-8)
    later = swing(time + swing.period)
    turns = 0 if swing.k < 1 else np.sign(speed) * 2 * np.pi
    np.testing.assert_allclose(later[0], found[:, 0] + turns, atol=1e-9)


def test_swing_refuses_what_never_ends():
    with pytest.raises(ValueError, match="must not lead exactly to the top"):
        Swing(3.0, np.pi, 0.0)


def test_integrated_goes_on_and_refuses_what_breaks_down():
    solution = Integrated(lambda y: np.array([y[1], -y[0]]), (1.0, 0.0))
    np.testing.assert_allclose(solution(np.array([0.0])), [[1, 0]])
    for time in (np.linspace(0, 2, 21), np.linspace(0, 5, 51), np.array([3.0, 1.0, 4.0])):
        np.testing.assert_allclose(
            solution(time), np.stack([np.cos(time), -np.sin(time)], axis=-1), atol=1e-11
        )
    with pytest.raises(ArithmeticError, match="can't be computed up to t = 2 s"):
        Integrated(lambda y: y**2, (1.0,))(np.array([2.0]))  # 1/(1 − t)


@pytest.mark.parametrize("joint", ["hinge", "distance"])
def test_a_chain_of_one_is_a_pendulum(joint):
    chain, pendulum = CASES["chain"](n=1, joint=joint), CASES["pendulum"](joint=joint)
    time = np.linspace(0, 2, 21)
    for one, other in zip(chain.exact(time), pendulum.exact(time), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-11)


def test_a_long_chain_with_a_heavy_end_is_known_to_rounding():
    case = CASES["chain"](n=20, end_mass=1000.0)
    looser = Integrated(case.exact.rate, np.zeros(40), tolerance=1e-10)
    tips = [
        np.exp(1j * solution(np.array([0.5, 1.0]))[:, :20]).sum(axis=1)
        for solution in (case.exact.solution, looser)
    ]
    assert np.abs(tips[1] - tips[0]).max() < 1e-8  # m, though in between light links whip


@pytest.mark.parametrize("end", [1.0, 1000.0])
@pytest.mark.parametrize("points", [False, True])
def test_accelerations_of_a_chain_are_lagranges(points, end):
    """In absolute angles: (B cos D + diag I) θ̈ = −(B sin D) θ̇² − g (aᵀ m) cos θ, B = aᵀ diag(m) a."""
    n, link, rng = 6, 0.7, np.random.default_rng(4)
    θ, ω, masses = rng.normal(size=n), rng.normal(size=n), rng.uniform(1, 2, n)
    masses[-1] = end
    moments = masses * link**2 / 12
    a = link * (np.tril(np.ones((n, n)), -1) + (1.0 if points else 0.5) * np.eye(n))
    B, D = a.T @ (masses[:, None] * a), θ[:, None] - θ
    M = B * np.cos(D) + (0 if points else np.diag(moments))
    lagrange = np.linalg.solve(M, -(B * np.sin(D)) @ ω**2 - 9.81 * (a.T @ masses) * np.cos(θ))
    if points:
        found = point_accelerations(θ, ω, masses, link)
    else:
        found = rod_accelerations(θ, ω, masses, moments, link)
    np.testing.assert_allclose(found, lagrange, rtol=1e-9, atol=1e-9)


def test_the_hanging_chain_goes_to_the_catenary():
    n = np.array([10, 20, 40, 80, 160])
    cases = [CASES["hanging_chain"](n=int(k)) for k in n]
    assert cases[0].exact.catenary_sag == pytest.approx(0.50263326, abs=1e-8)
    errors = [abs(case.exact.sag - case.exact.catenary_sag) for case in cases]
    assert fitted_order(1 / n, errors) == pytest.approx(2.0, abs=0.02)


def test_the_hanging_chain_is_in_balance():
    case = CASES["hanging_chain"](n=7)
    # the pull at each joint: H to the side, and the weight of all links between it and the middle; so no
    # link's ends turn it about its centre: (pull above + pull below) lies along the link
    weight, angles = 9.81 / 7, case.exact.angles
    side = weight * 3 / np.tan(angles[-1])
    up = weight * (np.arange(8) - 3.5)
    np.testing.assert_allclose((up[1:] + up[:-1]) / 2, side * np.tan(angles), atol=1e-12)
    assert sum(np.cos(angles)) * 1.5 / 7 == pytest.approx(1.0, abs=1e-12)


def test_hinges_of_the_door_hold_it():
    case = CASES["door"]()
    exact, time, h = case.exact, np.linspace(0.1, 3.9, 20), 1e-3
    places = [exact(time + k * h).position[:, 0] for k in (-2, -1, 0, 1, 2)]
    acceleration = (-places[0] + 16 * places[1] - 30 * places[2] + 16 * places[3] - places[4]) / (12 * h**2)
    np.testing.assert_allclose(exact.force(time), 20 * (acceleration + [0, 0, 9.81]), atol=1e-5)
    along = exact.force(time) @ exact.axis  # it does not move along the axis: that part is the weight's alone
    np.testing.assert_allclose(along, 20 * 9.81 * np.cos(0.2), rtol=1e-12)


def test_the_four_bars_turn_as_long_as_grashof_says():
    with pytest.raises(ValueError, match="lengths must let the crank go round"):
        CASES["four_bar"](lengths=(1.0, 1.0, 1.0, 1.0))
    angle = CASES["four_bar"]().exact.solution(np.linspace(0, 4, 9))[:, 0]
    assert np.ptp(angle) > 2 * np.pi


def test_the_windows_pass_through_a_line():
    case = CASES["n_four_bars"](duration=10.0)
    period = case.exact.swing.period
    level = case.exact(np.linspace(0, period, 2001)).orientation[:, 0]
    assert level.max() - level.min() == pytest.approx(2 * np.pi, abs=1e-9)
    tip = case.exact(np.zeros(1)).velocity[0, -1]
    np.testing.assert_allclose(tip, (1, 0), atol=1e-12)
    low = case.exact(np.array([period / 2])).velocity[0, -1]
    moment = 5 * ((1 + 0.01) / 12 + 0.25) + 4  # ½ I q̇² gains twice the lift of all centres
    assert np.linalg.norm(low) == pytest.approx(np.sqrt(1 + 2 * 9.81 * (5 + 8) / moment), rel=1e-10)


def test_steady_precession_needs_no_integration():
    steady = CASES["gimbal_gyroscope"]()
    rate = float(steady.exact.precession(np.array(1.0)))
    nodding = CASES["gimbal_gyroscope"](precession=rate)
    time = np.linspace(0, 2, 21)
    for one, other in zip(steady.exact(time), nodding.exact(time), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-10)


def test_bricards_angles_close_the_ring():
    case = CASES["bricard"]()
    s, t, _ = case.exact.solution(np.linspace(0, 4, 41)).T
    np.testing.assert_allclose((1 + np.cos(s)) * (1 + np.cos(t)), 1, atol=1e-11)
    assert np.ptp(s) > 1  # it moves far


@pytest.mark.parametrize(
    ("name", "parameters", "message"),
    [
        ("pendulum", {"angle": 4.0}, "angle must lie between 0 and π"),
        ("pendulum", {"joint": "rope"}, "joint must be one of hinge, ball, distance"),
        ("pendulum", {"joint": "ball"}, "joint must be 'hinge' or 'distance' in the plane"),
        ("chain", {"n": 0}, "n must be a whole number of at least 1"),
        ("chain", {"end_mass": -1.0}, "end_mass must be a positive number"),
        ("chain", {"dimension": 4}, "dimension must be 2"),
        ("hanging_chain", {"length": 0.9}, "length must exceed the span"),
        ("door", {"hinges": 1, "joint": "ball"}, "hinges must be a whole number of at least 2"),
        ("door", {"tilt": 2.0}, "tilt must lie in"),
        ("slider_crank", {"rod": 0.4}, "rod must be longer than the crank"),
        ("n_four_bars", {"speed": 0.0}, "speed must be a positive number"),
        ("gimbal_gyroscope", {"spin": 10.0}, "spin must be at least"),
        ("gimbal_gyroscope", {"tilt": 0.0}, "tilt must lie between"),
    ],
)
def test_parameters_are_checked(name, parameters, message):
    with pytest.raises(ValueError, match=message):
        CASES[name](**parameters)


# ---- ours, with what the scene's model chooses: rk4, and a solver

OURS = [  # case, parameters, steps, tolerance: from twice to five times what was measured at these steps
    ("pendulum", {}, 400, 4e-7),
    ("pendulum", {"joint": "distance"}, 400, 4e-6),
    ("double_pendulum", {}, 800, 1e-7),
    ("double_pendulum", {"dimension": 3}, 800, 1e-7),
    ("chain", {"n": 5, "duration": 1.0, "joint": "distance"}, 400, 1e-9),
    ("chain", {"n": 5, "duration": 1.0, "dimension": 3, "joint": "ball"}, 400, 3e-8),
    ("chain", {"n": 20, "duration": 1.0}, 400, 2e-10),
    ("hanging_chain", {}, 400, 1e-13),
    ("door", {}, 400, 2e-8),
    ("door", {"joint": "ball"}, 400, 2e-8),
    ("four_bar", {}, 800, 6e-5),
    ("four_bar", {"dimension": 3}, 800, 6e-5),
    ("slider_crank", {}, 1600, 9e-5),
    ("slider_crank", {"dimension": 3}, 1600, 9e-5),
    ("n_four_bars", {"duration": 2.0}, 400, 1e-6),
    ("gimbal_gyroscope", {}, 800, 4e-4),
    ("gimbal_gyroscope", {"precession": 0.0}, 800, 6e-4),
]


@pytest.mark.parametrize(
    ("name", "parameters", "steps", "tolerance"), OURS, ids=[f"{n}-{p}" for n, p, _, _ in OURS]
)
def test_ours_goes_to_the_exact_motion(name, parameters, steps, tolerance):
    case = CASES[name](**parameters)
    run = simulate(case.scene, case.duration, case.duration / steps, record_every=steps // 40)
    assert case.error(run) < tolerance
    assert run.joint_error().max() < 1e-11  # it is projected to 1e-12 of the mechanism's size after each step


def test_ours_has_order_4_on_the_double_pendulum():
    case, steps = CASES["double_pendulum"](duration=1.0), np.array([50, 100, 200, 400])
    runs = [simulate(case.scene, 1.0, 1.0 / n, record_every=n // 10) for n in steps]
    assert fitted_order(1 / steps, [case.error(run) for run in runs]) == pytest.approx(4.0, abs=0.3)


def test_a_chain_of_100_with_a_heavy_end():
    case = CASES["chain"](n=100, end_mass=1000.0)
    run = simulate(case.scene, 2.0, 2.0 / 400, record_every=40)
    assert case.error(run) < 2e-8  # measured 5e-9 of the length
    assert run.joint_error().max() < 1e-9
    assert np.ptp(run.energy()) < 1e-3 * 1000 * 9.81 * 20  # J, of what the end gains in its fall of 20 m


def test_a_chain_settles_on_its_catenary():
    case = CASES["hanging_chain"](n=8, settle=True, duration=20.0)
    run = simulate(case.scene, 20.0, 1 / 200, record_every=400)
    assert case.error(run) < 1e-6  # what still swings after 20 s of drag
