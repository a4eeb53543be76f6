"""Integrators against SciPy's DOP853 on equations written apart: order, symmetry, conservation."""

from dataclasses import replace

import numpy as np
import pytest

import independent
from reference import Box, Disc, Point, Scene, Simulation, Sphere, simulate
from reference.integrators import INTEGRATORS
from reference.rotation import rotation_angle

STEPS = {1: (400, 800), 2: (100, 200), 4: (25, 50), 6: (15, 30)}  # a second in so many steps, by order


@pytest.fixture(scope="module")
def solved():
    scenes = {"space": independent.busy_scene(), "plane": independent.planar_scene()}
    return {name: (scene, independent.solve(scene, 1.0)) for name, scene in scenes.items()}


@pytest.mark.parametrize("where", ["space", "plane"])
@pytest.mark.parametrize("name", INTEGRATORS)
def test_order_is_what_is_claimed(name, where, solved):
    scene, exact = solved[where]
    steps = STEPS[INTEGRATORS[name].order]
    errors = [
        independent.worst_error(scene, simulate(scene, 1, 1 / n, integrator=name), exact) for n in steps
    ]
    order = np.log(errors[0] / errors[1]) / np.log(steps[1] / steps[0])
    assert abs(order - INTEGRATORS[name].order) < 0.35, errors


@pytest.mark.parametrize(
    ("name", "order"),
    [("rk4", 4), ("splitting", 2), ("splitting4", 3), ("splitting6", 3), ("implicit_midpoint", 2)],
)
def test_damping_and_drag_agree_with_scipy(name, order):
    scene = independent.busy_scene()
    scene.spring(0, 1, 2, damping=1.5, length=1, point_a=(0, 0.4, 1))
    scene.drag(0, 0.4, 0.3)
    scene.drag(1, 0.2)
    exact = independent.solve(scene, 1.0)
    errors = [
        independent.worst_error(scene, simulate(scene, 1, 1 / n, integrator=name), exact) for n in (50, 100)
    ]
    assert abs(np.log2(errors[0] / errors[1]) - order) < 0.35, errors
    assert errors[1] < 1e-2


def there_and_back(scene, name, dt):
    """How far (m, rad) from the start a run of 1 s ends that is turned round by reversing all velocities."""
    out = simulate(scene, 1, dt, integrator=name).state()
    turned = replace(out, velocity=-out.velocity, angular_velocity=-out.angular_velocity)
    back = simulate(scene, 1, dt, integrator=name, start=turned)
    first = simulate(scene, dt, dt, integrator=name)
    spinning = [i for i, body in enumerate(scene.bodies) if body.inertia is not None]
    turn = rotation_angle(back.orientation[-1, spinning], first.orientation[0, spinning])
    return max(np.abs(back.position[-1] - first.position[0]).max(), turn.max())


@pytest.mark.parametrize("name", INTEGRATORS)
def test_reversed_in_time_returns_as_well_as_claimed(name):
    method, scene = INTEGRATORS[name], independent.busy_scene()
    if method.symmetric:
        assert there_and_back(scene, name, 0.02) < 1e-11
    else:  # not symmetric: the way back is wrong too, to the method's own order at least
        steps = STEPS[method.order]
        ratio = there_and_back(scene, name, 1 / steps[0]) / there_and_back(scene, name, 1 / steps[1])
        assert there_and_back(scene, name, 1 / steps[0]) > 1e-9
        assert np.log2(ratio) > method.order - 0.35


def top(ω, moments=(1, 2, 3)):
    scene = Scene(gravity=(0, 0, 0))
    scene.add(Sphere(1), inertia=moments, angular_velocity=ω)
    return scene


@pytest.mark.parametrize("name", INTEGRATORS)
def test_free_body_keeps_what_is_claimed(name):
    run = simulate(top((0.1, 3, 0.1)), 20, 0.1, integrator=name)
    L, E = run.angular_momentum(), run.energy()
    kept = {
        "momentum": np.abs(L - L[0]).max() / np.linalg.norm(L[0]),
        "energy": np.abs(E - E[0]).max() / E[0],
    }
    for quantity, drift in kept.items():
        assert (drift < 1e-12) == (quantity in INTEGRATORS[name].conserves), kept
    assert np.abs(np.linalg.norm(run.orientation, axis=-1) - 1).max() < 1e-15 * 10


def test_momentum_is_kept_over_a_million_steps():
    run = simulate(top((0.1, 3, 0.1)), 1000, 1e-3, integrator="splitting", record_every=1000)
    L = run.angular_momentum()
    assert np.abs(L - L[0]).max() < 1e-12 * np.linalg.norm(L[0])


@pytest.mark.parametrize("name", ["rk4", "splitting4", "splitting6"])
def test_attitude_of_the_free_top_after_20_s(name):
    scene = top((0.1, 3, 0.1))
    ((_, attitude, _),) = independent.solve(scene, 20)
    run = simulate(scene, 20, 1e-3, integrator=name, record_every=20000)
    assert rotation_angle(run.orientation[-1, 0], attitude.as_quat(scalar_first=True)) < 1e-9


@pytest.mark.parametrize("h", [0.01, 0.1, 1.0])
def test_implicit_gyroscopic_is_stable_and_loses_energy(h):
    E = simulate(top((1, 10, 1)), 100 * h, h, integrator="implicit_gyroscopic").energy()
    assert np.isfinite(E).all() and E.max() <= E[0] * 1.01 and E[-1] < E[0]
    explicit = simulate(top((1, 10, 1)), 100 * 0.1, 0.1, integrator="symplectic_euler")
    assert explicit.status == "diverged" or explicit.energy()[-1] > 10 * E[0]


def test_implicit_gyroscopic_leaves_a_sphere_alone():
    run = simulate(top((1, 10, 1), (2, 2, 2)), 1, 0.1, integrator="implicit_gyroscopic")
    assert np.abs(run.angular_velocity - (1, 10, 1)).max() < 1e-14


@pytest.mark.parametrize("name", INTEGRATORS)
def test_constant_force_is_exact_where_the_order_is_two_or_more(name):
    scene = Scene(gravity=(0, -9.81))
    scene.add(Disc(1), position=(0, 1), velocity=(2, 3), angular_velocity=4)
    run = simulate(scene, 2, 0.1, integrator=name)
    t = run.time
    x = np.stack([2 * t, 1 + 3 * t - 9.81 * t**2 / 2], axis=-1)
    error = np.abs(run.position[:, 0] - x).max()
    assert (error < 1e-12) == (INTEGRATORS[name].order > 1)
    assert np.abs(run.orientation[:, 0] - 4 * t).max() < 1e-12


@pytest.mark.parametrize(
    ("name", "ratio"), [("symplectic_euler", 1.010721), ("symplectic_euler_position_first", 1.010721)]
)
def test_frequency_of_the_oscillator(name, ratio):
    """At ω Δt = .5; 2 asin(¼)/.5 (Hairer, Lubich & Wanner, exercise I.4)."""
    scene = Scene(gravity=(0, 0))
    i = scene.add(Point(), position=(1, 0))
    scene.spring(i, None, 1, length=0, point_b=(0, 0))
    x = simulate(scene, 500, 0.5, integrator=name).position[:, 0, 0]
    lag = np.arccos((x[2:] + x[:-2])[np.abs(x[1:-1]) > 0.5] / (2 * x[1:-1][np.abs(x[1:-1]) > 0.5]))
    assert abs(lag.mean() / 0.5 - ratio) < 1e-6


def test_symplectic_keeps_the_spring_and_explicit_does_not():
    scene = Scene(gravity=(0, 0))
    i = scene.add(Point(), position=(1, 0))
    scene.spring(i, None, 1, length=0, point_b=(0, 0))
    energy = {name: simulate(scene, 1000, 0.1, integrator=name).energy() for name in INTEGRATORS}
    # ((1 + h²)^½)^(2 n) for explicit Euler: each step multiplies the energy by 1 + h²
    assert energy["explicit_euler"][100] / energy["explicit_euler"][0] == pytest.approx(1.01**100)
    for name in ("symplectic_euler", "symplectic_euler_position_first", "splitting"):
        assert np.abs(energy[name] / energy[name][0] - 1).max() < 0.06


def test_midpoint_says_when_it_has_not_converged():
    scene = top((10, 300, 10))
    good = simulate(scene, 1, 0.001, integrator="implicit_midpoint")
    assert good.reason == "" and good.residual.max() <= 1e-14 and 0 < good.iterations.max() <= 5
    poor = simulate(scene, 1, 0.01, integrator="implicit_midpoint", iterations=1)
    assert poor.status == "ok" and "1 iterations" in poor.reason and poor.residual.max() > 1e-14


def test_steps_one_by_one_and_all_at_once_are_the_same():
    scene = independent.busy_scene()
    scene.force(lambda t, state: (np.full((4, 3), t), np.zeros((4, 3))))
    at_once = Simulation(scene, 0.01, integrator="splitting4")
    at_once.advance(0.5)
    by_step = Simulation(scene, 0.01, integrator="splitting4")
    for _ in range(50):
        by_step.step()
    assert np.array_equal(at_once.state.position, by_step.state.position)
    assert at_once.time == by_step.time == pytest.approx(0.5)


def test_substeps_are_steps():
    scene = independent.busy_scene()
    coarse = simulate(scene, 0.5, 0.1, substeps=10, integrator="rk4")
    fine = simulate(scene, 0.5, 0.01, record_every=10, integrator="rk4")
    assert np.abs(coarse.position - fine.position).max() < 1e-14 and len(coarse.time) == len(fine.time) == 6


def test_box_tumbles_as_scipy_says():
    scene = Scene()
    scene.add(Box((0.1, 0.2, 0.3)), mass=3, velocity=(1, 2, 3), angular_velocity=(3, -2, 1))
    assert independent.worst_error(scene, simulate(scene, 2, 0.005), independent.solve(scene, 2)) < 1e-8
