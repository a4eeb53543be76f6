"""Joints in the engines: against formulas and loops written out here, and against exact motions.

What is called a scheme here is in minimal coordinates, in NumPy, and shares no code with the reference.
Tolerances of whole motions are CASES.md's, measured there and repeated here.
"""

import math

import numpy as np
import pytest

from reference import (
    BallJoint,
    Box,
    Disc,
    Distance,
    Fixed,
    Hinge,
    Point,
    Scene,
    Slider,
    Sphere,
    Universal,
    Unsupported,
)
from reference.cases import CASES
from reference.measure import period
from reference.peers import ENGINES, simulate_in
from reference.peers.recorded import load
from reference.peers.trees import trees
from tests.reference.test_peers import assert_same, needs

H = 0.01  # s, a step taken by hand


def turning_disc(**joint):
    """A disc on a hinge through its centre, I = .7 kg m², turning by 5 rad/s."""
    scene = Scene(gravity=(0, 0))
    scene.add(Disc(1.0), mass=2.0, inertia=0.7, orientation=0.3, angular_velocity=5.0)
    scene.join(Hinge(0, None, point=(0, 0), **joint))
    return scene


def sliding_box(joint, dimension=2, **motion):
    """2 kg on a slider along the first axis."""
    scene = Scene(gravity=np.zeros(dimension))
    along = np.eye(dimension)[0]
    scene.add(Box((0.5,) * dimension), mass=2.0, velocity=0.3 * along, **motion)
    scene.join(Slider(0, None, axis=along, **joint))
    return scene


# ---- pymunk's joints, step by step


@needs("pymunk")
def test_pymunk_hinge_spring_is_an_impulse_and_its_damper_an_exponential():
    run = simulate_in(turning_disc(stiffness=40.0, damping=3.0), "pymunk", 0.05, H)
    q, ω = 0.0, 5.0
    for k in range(1, 6):
        q += H * ω
        ω = (ω - H * 40.0 * q / 0.7) * math.exp(-3.0 * H / 0.7)
        assert run.orientation[k, 0] - 0.3 == pytest.approx(q, abs=1e-14)
        assert run.angular_velocity[k, 0] == pytest.approx(ω, abs=1e-13)


@needs("pymunk")
def test_pymunk_slider_spring():
    run = simulate_in(sliding_box({"stiffness": 50.0, "damping": 4.0}), "pymunk", 0.05, H)
    x, v = 0.0, 0.3
    for k in range(1, 6):
        x += H * v
        v = (v - H * 50.0 * x / 2.0) * math.exp(-4.0 * H / 2.0)
        # the spring is anchored 1 km away: 1e-13 m of rounding
        np.testing.assert_allclose((run.position[k, 0, 0], run.velocity[k, 0, 0]), (x, v), atol=1e-12)


@needs("pymunk")
def test_pymunk_distance_with_a_spring_is_the_scenes_own_spring():
    runs = []
    for joint in (True, False):
        scene = Scene(gravity=(0, -9.81))
        scene.add(Point(), mass=2.0, position=(1, 0))
        if joint:
            scene.join(Distance(0, None, point_b=(0, 0), length=0.8, stiffness=50.0, damping=2.0))
        else:
            scene.spring(0, None, 50.0, damping=2.0, length=0.8, point_b=(0, 0))
        runs.append(simulate_in(scene, "pymunk", 1.0, H))
    assert_same(*runs, 1e-14)


@needs("pymunk")
@pytest.mark.parametrize("most", [3.5, math.inf])
def test_pymunk_motor_turns_the_right_way_and_is_bounded(most):
    run = simulate_in(turning_disc(motor=(-2.0, most)), "pymunk", 1.0, H)
    ω = np.maximum(-2.0, 5.0 - most / 0.7 * run.time) if most < math.inf else -2.0 + 0 * run.time
    np.testing.assert_allclose(run.angular_velocity[1:, 0], ω[1:], atol=1e-12)


@needs("pymunk")
def test_pymunk_limits_hold():
    # A step may end past a limit by what it moves; the speed that takes it back stays with the body.
    run = simulate_in(turning_disc(limits=(-0.1, 0.2)), "pymunk", 1.0, H, error_bias=0.0)
    assert run.orientation.max() - 0.3 < 0.2 + 5 * H
    assert run.orientation[-1, 0] - 0.3 == pytest.approx(0.2, abs=1e-5)
    run = simulate_in(sliding_box({"limits": (-0.1, 0.05)}), "pymunk", 2.0, H, error_bias=0.0)
    assert 0.05 <= run.position[:, 0, 0].max() < 0.05 + 0.3 * H
    assert -0.1 - 0.3 * H < run.position[:, 0, 0].min() < -0.1 + 1e-9
    scene = Scene(gravity=(0, -9.81))
    scene.add(Point(), position=(0, -1))
    scene.join(Distance(0, None, point_b=(0, 0), limits=(0.5, 1.2)))  # a rope
    run = simulate_in(scene, "pymunk", 2.0, H, error_bias=0.0)
    np.testing.assert_allclose(
        run.position[:20, 0, 1], -1 - 9.81 * H**2 * np.arange(20) * np.arange(-1, 19) / 2
    )
    assert run.position[-1, 0, 1] == pytest.approx(-1.2, abs=2e-3)  # under tension it hangs by g H² lower


@needs("pymunk")
def test_pymunk_fixed_bodies_are_one_body():
    scene = Scene(gravity=(0, 0))
    parts = [scene.add(Disc(0.1), mass=m, position=(x, 0), inertia=0.02) for m, x in ((1.0, 0.0), (3.0, 1.0))]
    scene.join(Fixed(*parts))
    scene.force(lambda t, state: (np.array([[0.0, 2.0], [0.0, 0.0]]), np.zeros(2)))  # on the lighter one
    run = simulate_in(scene, "pymunk", 0.5, 0.001, error_bias=0.0, iterations=50)
    # about their centre: I = 2 · .02 + (1 · 3/4) · 1²; the force stays (0, 2) N, its arm −.75 cos φ
    φ, ω, h = 0.0, 0.0, 0.001
    for _ in range(500):
        φ += h * ω
        ω -= h * 2.0 * 0.75 * math.cos(φ) / 0.79
    np.testing.assert_allclose(run.orientation[-1], φ, atol=1e-3)
    np.testing.assert_allclose(run.position[-1] @ [0, 1] @ [0.25, 0.75], 0.5 * 0.5 * 0.5**2, rtol=3e-3)


@needs("pymunk")
def test_pymunk_period_and_tip():
    case = CASES["pendulum"](duration=4.0)
    run = simulate_in(case.scene, "pymunk", 4.0, 1e-3, error_bias=0.0)
    assert period(run.time, run.position[:, 0, 0]) == pytest.approx(case.exact.period, rel=1e-5)
    case = CASES["double_pendulum"]()
    assert case.error(simulate_in(case.scene, "pymunk", 2.0, 1e-3, error_bias=0.0)) < 1e-2


def extrapolated(case, engine, dt, **settings):
    """The worst distance from the exact positions, m, extrapolated to dt = 0 by Richardson at order 1."""
    steps = [round(case.duration / dt), 2 * round(case.duration / dt)]
    coarse, fine = (
        simulate_in(case.scene, engine, case.duration, case.duration / n, record_every=n // 20, **settings)
        for n in steps
    )
    exact = case.exact(coarse.time).position
    return np.abs(2 * fine.position - coarse.position - exact).max()


@needs("pymunk")
@pytest.mark.parametrize(
    ("name", "parameters", "tolerance"),
    [  # what is left is of order dt²; measured: at most a quarter of each tolerance
        ("pendulum", {"joint": "distance", "duration": 1.0}, 4e-5),
        ("double_pendulum", {"duration": 1.0}, 5e-5),
        ("chain", {"n": 4, "duration": 1.0, "joint": "distance"}, 1e-4),
        ("four_bar", {"duration": 1.0}, 3e-4),
        ("slider_crank", {"duration": 1.0}, 2e-3),
    ],
)
def test_pymunk_goes_to_the_exact_motion(name, parameters, tolerance):
    case = CASES[name](**parameters)
    assert extrapolated(case, "pymunk", 1e-3, error_bias=0.0, iterations=30) < tolerance


# ---- pybullet's trees, in minimal coordinates


def falling_rods(n, steps, h):
    """Semi-implicit Euler of n rods of 1 m and 1 kg let go level, in absolute angles: (θ, ω) at each step."""
    a = np.tril(np.ones((n, n)), -1) + np.eye(n) / 2
    B, inertia = a.T @ a, (1 + 0.01) / 12
    θ, ω, history = np.zeros(n), np.zeros(n), []
    for _ in range(steps):
        D = θ[:, None] - θ
        pull = -(B * np.sin(D)) @ ω**2 - 9.81 * a.sum(axis=0) * np.cos(θ)
        ω = ω + h * np.linalg.solve(B * np.cos(D) + inertia * np.eye(n), pull)
        θ = θ + h * ω
        history.append((θ, ω))
    return a, np.array(history)


@pytest.mark.parametrize("name", ["pybullet_double_pendulum", "pybullet_chain"])
def test_a_recorded_tree_equals_ten_lines(name):
    data, run = load(name)
    n = len(run.bodies.mass)
    a, history = falling_rods(n, data["steps"], data["dt"])
    θ, ω = history[data["record_every"] - 1 :: data["record_every"]].transpose(1, 0, 2)
    np.testing.assert_allclose(run.position[1:, :, 0], np.cos(θ) @ a.T, atol=1e-9)
    np.testing.assert_allclose(run.position[1:, :, 2], np.sin(θ) @ a.T, atol=1e-9)
    np.testing.assert_allclose(run.velocity[1:, :, 2], (np.cos(θ) * ω) @ a.T, atol=1e-9)
    np.testing.assert_allclose(run.angular_velocity[1:, :, 1], -ω, atol=1e-9)
    np.testing.assert_allclose(run.orientation[1:, :, 2], -np.sin(θ / 2), atol=1e-9)


@needs("pybullet")
def test_a_tree_of_slider_and_hinge_equals_ten_lines():
    cart, pole, half, g, h = 2.0, 1.0, 0.5, 9.81, 1e-3
    scene = Scene(gravity=(0, 0, -g))
    scene.add(Box((0.2, 0.1, 0.1)), mass=cart, velocity=(0.7, 0, 0), position=(0, 0, 1), group=1)
    scene.add(
        Box((half, 0.05, 0.05)),
        mass=pole,
        position=(half, 0, 1),
        velocity=(0.7, 0, half * 2.0),
        angular_velocity=(0, -2.0, 0),
        group=1,
    )
    scene.join(Slider(0, None, axis=(1, 0, 0), stiffness=30.0, damping=1.0))
    scene.join(Hinge(1, 0, point=(0, 0, 1), axis=(0, 3, 0), motor=(0.0, 0.0)))  # pole to cart: the other way
    run = simulate_in(scene, "pybullet", 0.5, h)
    I = pole * (half**2 + 0.05**2) / 3 + pole * half**2
    x, θ, v, ω = 0.0, 0.0, 0.7, 2.0  # θ turns x towards z
    for _ in range(500):
        c, s = math.cos(θ), math.sin(θ)
        M = [[cart + pole, -pole * half * s], [-pole * half * s, I]]
        f = [pole * half * c * ω**2 - 30.0 * x - 1.0 * v, -pole * g * half * c]
        v, ω = np.array([v, ω]) + h * np.linalg.solve(M, f)
        x, θ = x + h * v, θ + h * ω
    np.testing.assert_allclose(run.position[-1, 0], (x, 0, 1), atol=1e-9)
    np.testing.assert_allclose(
        run.position[-1, 1], (x + half * math.cos(θ), 0, 1 + half * math.sin(θ)), atol=1e-9
    )
    np.testing.assert_allclose(run.angular_velocity[-1, 1], (0, -ω, 0), atol=1e-9)
    np.testing.assert_allclose(run.velocity[-1, 0], (v, 0, 0), atol=1e-9)


@needs("pybullet")
def test_a_tree_with_a_fixed_link_is_one_body():
    h, runs = 1e-3, []
    scene = Scene()
    scene.add(Box((0.5, 0.05, 0.05)), mass=1.0, position=(0.5, 0, 0))
    scene.add(Sphere(0.1), mass=3.0, position=(1.1, 0, 0))
    scene.join(Hinge(0, None, point=(0, 0, 0), axis=(0, -1, 0)))
    scene.join(Fixed(1, 0))
    run = simulate_in(scene, "pybullet", 0.5, h)
    I = (0.25 + 0.0025) / 3 + 0.25 + 3 * (0.4 * 0.01 + 1.1**2)
    θ, ω = 0.0, 0.0
    for _ in range(500):
        ω -= h * 9.81 * (0.5 + 3.3) * math.cos(θ) / I
        θ += h * ω
        runs.append(θ)
    np.testing.assert_allclose(run.position[1:, 1, 2], 1.1 * np.sin(runs), atol=1e-9)


@needs("pybullet")
def test_hinges_do_not_mind_the_order_of_their_bodies():
    runs = []
    for swapped in (False, True):
        scene = Scene()
        for x in (0.5, 1.5):
            scene.add(Box((0.5, 0.05, 0.05)), mass=1.0, position=(x, 0, 0), group=1)
        scene.join(Hinge(0, None, point=(0, 0, 0), axis=(0, 1, 0)))
        pair = (
            (1, 0) if swapped else (0, 1)
        )  # the angle of j seen from i changes its sign: motor and limits too
        sign = -1.0 if swapped else 1.0
        limits = tuple(sorted((-0.2 * sign, 0.4 * sign)))
        motor = (sign * 3.0, 5.0)
        scene.join(Hinge(*pair, point=(1, 0, 0), axis=(0, 1, 0), motor=motor, limits=limits))
        runs.append(simulate_in(scene, "pybullet", 0.5, 1e-3))
    assert_same(*runs, 1e-10)


@needs("pybullet")
def test_pybullet_period_and_tip():
    case = CASES["pendulum"](dimension=3, duration=4.0)
    run = simulate_in(case.scene, "pybullet", 4.0, 1e-3)
    assert period(run.time, run.position[:, 0, 0]) == pytest.approx(case.exact.period, rel=1e-5)
    case = CASES["double_pendulum"](dimension=3)
    assert case.error(simulate_in(case.scene, "pybullet", 2.0, 1e-3)) < 1e-2


@needs("pybullet")
@pytest.mark.parametrize(
    ("name", "parameters", "body", "tolerance"),
    [  # as for pymunk
        ("chain", {"n": 3, "duration": 1.0, "dimension": 3, "joint": "ball"}, "multibody", 6e-5),
        ("chain", {"n": 3, "duration": 1.0, "dimension": 3, "joint": "ball"}, "rigid", 4e-4),
        ("double_pendulum", {"duration": 1.0, "dimension": 3}, "rigid", 4e-4),
        ("door", {"duration": 1.0}, "multibody", 1e-6),
        ("door", {"duration": 1.0, "joint": "ball"}, "rigid", 2e-5),
        ("gimbal_gyroscope", {"duration": 1.0, "precession": 0.0}, "multibody", 2e-5),
        ("n_four_bars", {"n": 2, "duration": 1.0, "dimension": 3}, "multibody", 1e-5),
        ("four_bar", {"duration": 0.5, "dimension": 3}, "multibody", 2e-4),
        ("slider_crank", {"duration": 0.5, "dimension": 3}, "multibody", 2e-3),
        ("bricard", {"duration": 1.0}, "rigid", 1e-3),
    ],
)
def test_pybullet_goes_to_the_exact_motion(name, parameters, body, tolerance):
    case = CASES[name](**parameters)
    found = extrapolated(case, "pybullet", 1e-3, body=body, iterations=200, residual=0.0)
    assert found < tolerance


@needs("pybullet")
def test_a_tumbling_body_on_a_ball_is_the_same_in_both_forms():
    scene = Scene()
    spin, arm = np.array([2.0, -1.0, 3.0]), np.array([0.3, 0.2, -0.4])
    scene.add(
        Box((0.1, 0.2, 0.3)),
        mass=2.0,
        position=arm,
        velocity=np.cross(spin, arm),
        angular_velocity=spin,
        orientation=np.array([0.8, 0.4, -0.2, 0.4]),
    )
    scene.join(BallJoint(0, None, point=(0, 0, 0)))
    ends = []
    for body in ("multibody", "rigid"):
        fine, coarse = (
            simulate_in(scene, "pybullet", 0.5, h, record_every=int(0.5 / h), body=body) for h in (5e-4, 1e-3)
        )
        ends.append(2 * fine.position[-1] - coarse.position[-1])
    np.testing.assert_allclose(*ends, atol=1e-4)


def test_trees_of_a_scene():
    scene = Scene()
    for k in range(6):
        scene.add(Sphere(0.1), position=(k, 0, 0), static=k == 0)
    joints = [
        BallJoint(2, 1, point=(1.5, 0, 0)),
        BallJoint(1, 0, point=(0.5, 0, 0)),
        BallJoint(3, 2, point=(2.5, 0, 0)),
        BallJoint(3, 1, point=(2, 0, 0)),
        BallJoint(5, 4, point=(4.5, 0, 0)),
    ]
    for joint in joints:
        scene.join(joint)
    found, left = trees(scene)
    shape = [(base, [(b.body, b.parent) for b in branches]) for base, branches in found]
    assert shape == [(None, [(1, None), (2, 1), (3, 1)]), (4, [(5, 4)])]  # 3 hangs on 1, which is nearer
    assert [joint.ends for joint in left] == [(3, 2)]


# ---- what they can't


def on(dimension, joint, **body):
    scene = Scene(gravity=np.zeros(dimension))
    size = np.eye(dimension)[0]
    scene.add(Box((0.5,) * dimension), **body)
    scene.add(Box((0.5,) * dimension), position=3 * size)
    scene.pair(0, 1, collide=False)
    scene.join(joint)
    return scene


@needs("pymunk")
@pytest.mark.parametrize(
    "joint", [Slider(0, 1, axis=(1, 0), motor=(1.0, 2.0)), Distance(0, 1, motor=(1.0, 2.0))]
)
def test_pymunk_pushes_nothing_along_a_line(joint):
    with pytest.raises(
        Unsupported, match=f"no motor that pushes along a line, as this {type(joint).__name__}"
    ):
        simulate_in(on(2, joint), "pymunk", 0.1, 0.01)


AXIS, POINT = (0, 0, 1), (1.5, 0, 0)


@needs("pybullet")
@pytest.mark.parametrize(
    ("joint", "body", "lacks"),
    [
        (Universal(0, 1, point=POINT, axis_a=AXIS, axis_b=(1, 0, 0)), "multibody", "no Universal"),
        (Universal(0, 1, point=POINT, axis_a=AXIS, axis_b=(1, 0, 0)), "rigid", "no Universal"),
        (Distance(0, 1), "multibody", "no Distance"),
        (Distance(0, 1), "rigid", "no Distance"),
        (Slider(0, 1, axis=AXIS), "rigid", "no Slider between rigid bodies"),
        (Hinge(0, 1, point=POINT, axis=AXIS, stiffness=3.0), "rigid", "no springs, motors or limits"),
        (Hinge(0, 1, point=POINT, axis=AXIS, motor=(1, 2)), "rigid", "no springs, motors or limits"),
        (Hinge(0, 1, point=POINT, axis=AXIS, limits=(-1, 2)), "rigid", "no springs, motors or limits"),
    ],
)
def test_pybullet_lacks(joint, body, lacks):
    with pytest.raises(Unsupported, match=lacks):
        simulate_in(on(3, joint), "pybullet", 0.1, 0.01, body=body)


@needs("pybullet")
def test_pybullets_trees_have_limits():
    case = CASES["chain"](n=33, dimension=3, joint="ball", duration=0.01)
    with pytest.raises(Unsupported, match="has 33 and 132"):
        simulate_in(case.scene, "pybullet", 0.01, 0.01)
    with pytest.raises(Unsupported, match="this one has 128 and 128"):
        simulate_in(CASES["chain"](n=128, dimension=3).scene, "pybullet", 0.01, 0.01)
    loose = on(3, Hinge(0, 1, point=POINT, axis=AXIS), velocity=(0, 1, 0))
    with pytest.raises(Unsupported, match=r"body 1 should start .* off that"):
        simulate_in(loose, "pybullet", 0.1, 0.01)
    fast = on(3, BallJoint(0, 1, point=POINT), angular_velocity=(100.0, 0, 0))
    with pytest.raises(Unsupported, match="body 0 starts with 1"):
        simulate_in(fast, "pybullet", 0.1, 0.01)


def test_numbers_between_two_are_checked():
    case = CASES["pendulum"]()
    with pytest.raises(ValueError, match=r"error_bias must be a number from 0 to 1, but is 1\.5"):
        ENGINES["pymunk"].load(case.scene, 0.01, error_bias=1.5)
    with pytest.raises(TypeError, match="error_bias must be a number, but is 'all'"):
        ENGINES["pymunk"].load(case.scene, 0.01, error_bias="all")
    with pytest.raises(ValueError, match="error_bias: a number from 0 to 1"):
        ENGINES["pymunk"].load(case.scene, 0.01, bias=0.5)
