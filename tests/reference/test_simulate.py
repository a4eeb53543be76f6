"""Runs as a whole: what a trajectory holds, energy, momenta, status, going on, own forces, model."""

from importlib import import_module

import numpy as np
import pytest

import independent
from reference import Disc, Fixed, Plane, Point, Polygon, Scene, Simulation, Sphere, model, simulate
from reference.integrators import INTEGRATORS


def test_shapes_and_times_of_a_trajectory():
    scene = independent.busy_scene()
    run = simulate(scene, 1, 0.01, record_every=30)
    assert np.allclose(run.time, [0, 0.3, 0.6, 0.9, 1]) and run.time[-1] == 1 and run.status == "ok"
    T, n = 5, 4
    assert run.position.shape == run.velocity.shape == run.angular_velocity.shape == (T, n, 3)
    assert run.orientation.shape == (T, n, 4)
    assert run.energy().shape == run.joint_error().shape == run.penetration().shape == (T,)
    assert run.momentum().shape == run.angular_momentum().shape == (T, 3)
    assert run.residual.shape == run.iterations.shape == (T,) and len(run.contacts) == T
    assert (run.orientation[:, [1, 3]] == (1, 0, 0, 0)).all() and not run.angular_velocity[:, [1, 3]].any()
    assert (run.position[:, 3] == scene.bodies[3].position).all()
    for i, body in enumerate(scene.bodies):
        assert np.allclose(run.orientation[0, i], body.orientation, atol=1e-15)
        assert np.allclose(run.angular_velocity[0, i], body.angular_velocity, atol=1e-15)


def test_a_planar_trajectory():
    run = simulate(independent.planar_scene(), 1, 0.1)
    assert run.position.shape == (11, 4, 2) and run.orientation.shape == run.angular_velocity.shape == (11, 4)
    assert run.angular_momentum().shape == (11,)
    contacts = run.contacts[0]
    assert contacts.bodies.shape == (0, 2) and contacts.frame.shape == (0, 2, 2)
    with pytest.raises(IndexError):
        run.contacts[11]


@pytest.mark.parametrize("make", [independent.busy_scene, independent.planar_scene])
def test_energy_is_kept_where_nothing_dissipates(make):
    E = simulate(make(), 2, 0.002).energy()
    assert np.abs(E - E[0]).max() < 1e-8 * np.abs(E).max()


def test_momenta_of_bodies_that_only_pull_at_each_other():
    for make in (independent.busy_scene, independent.planar_scene):
        whole = make()
        scene = Scene(gravity=np.zeros(whole.dimension))
        for body in whole.bodies:
            if not body.static:
                turn = {}
                if body.inertia is not None:
                    turn = {"orientation": body.orientation, "angular_velocity": body.angular_velocity}
                scene.add(
                    body.shape,
                    mass=body.mass,
                    inertia=body.inertia,
                    position=body.position,
                    velocity=body.velocity,
                    group=1,
                    **turn,
                )
        spring = whole.springs[0]
        scene.spring(0, 1, 5, damping=0.3, point_a=spring.point_a, point_b=spring.point_b)
        scene.gravitate(0.3)
        run = simulate(scene, 2, 0.002, integrator="rk4")
        for quantity in (run.momentum(), run.angular_momentum()):
            assert np.abs(quantity - quantity[0]).max() < 1e-9 * np.abs(quantity).max()


def test_energy_of_a_known_state():
    scene = Scene(gravity=(0, -10))
    a = scene.add(Disc(1), mass=2, position=(0, 3), velocity=(1, 2), angular_velocity=3, group=1)
    b = scene.add(Disc(1), mass=1, position=(4, 0), group=1)
    scene.spring(a, b, 8, length=3)
    scene.gravitate(2)
    run = simulate(scene, 0.1, 0.1)
    assert run.energy()[0] == pytest.approx(5 + 0.5 * 1 * 9 + 60 + 0.5 * 8 * 4 - 2 * 2 / 5)
    assert run.momentum()[0] == pytest.approx([2, 4])
    assert run.angular_momentum()[0] == pytest.approx(-6 + 3)


def test_going_on_from_a_state_is_the_same_as_not_stopping():
    scene = independent.busy_scene()
    whole = simulate(scene, 1, 0.01, integrator="rk4")
    half = simulate(scene, 0.5, 0.01, integrator="rk4")
    rest = simulate(scene, 0.5, 0.01, integrator="rk4", start=half.state())
    assert rest.time[0] == 0 and rest.time[-1] == 0.5 and rest.state().time == 1
    assert np.abs(rest.position[-1] - whole.position[-1]).max() < 1e-13


def test_the_same_scene_gives_the_same_bits():
    runs = [simulate(independent.busy_scene(), 1, 0.01) for _ in range(2)]
    assert all(np.array_equal(runs[0].position, run.position) for run in runs)


def test_overflow_ends_with_a_status_and_the_time():
    scene = Scene(gravity=(0, 0))
    i = scene.add(Point(), position=(1, 0))
    scene.spring(i, None, 1e6, length=0, point_b=(0, 0))
    run = simulate(scene, 10, 0.01, integrator="explicit_euler")
    assert run.status == "diverged" and f"from t = {run.time[-1]:.6g} s" in run.reason
    assert np.isfinite(run.position).all() and 0 < run.time[-1] < 10
    simulation = Simulation(scene, 0.01, integrator="explicit_euler")
    simulation.advance(10)
    assert simulation.status == "diverged" and np.isfinite(simulation.state.position).all()
    assert simulation.time == pytest.approx(run.time[-1])
    with pytest.raises(ValueError, match="can't go on"):
        simulation.step()


def test_bodies_in_one_place_that_gravitate():
    scene = Scene(gravity=(0, 0, 0))
    scene.add(Point())
    scene.add(Point())
    scene.gravitate(1)
    run = simulate(scene, 1, 0.1)
    assert run.status == "diverged" and "t = 0 s" in run.reason and len(run.time) == 1


def test_a_spring_without_direction_pulls_nowhere():
    scene = Scene(gravity=(0, 0, 0))
    a, b = scene.add(Point()), scene.add(Point())
    scene.spring(a, b, 3, length=1)
    assert not simulate(scene, 1, 0.1).position.any()


def test_users_force_and_torque():
    """A force that grows with time, and a torque on a disc: x = t³/6m, θ = t²/2I."""
    scene = Scene(gravity=(0, 0))
    scene.add(Plane((0, 1)))
    scene.add(Point(), mass=2)
    scene.add(Disc(1), mass=3, position=(5, 5))
    scene.pair(0, 2, collide=False)
    seen = []

    def push(t, state):
        seen.append(state)
        force, torque = np.zeros((3, 2)), np.zeros(3)
        force[1, 0], torque[2] = t, 1
        return force, torque

    scene.force(push)
    run = simulate(scene, 2, 0.1)
    assert run.position[-1, 1, 0] == pytest.approx(8 / 6 / 2, rel=1e-12)
    assert run.orientation[-1, 2] == pytest.approx(4 / 2 / 1.5, rel=1e-12)
    assert seen[0].position.shape == (3, 2) and not run.settings["compiled"]


@pytest.mark.parametrize("answer", [np.zeros((1, 3)), (np.zeros((1, 3)), np.zeros(3)), None, ("a", "b")])
def test_users_force_of_the_wrong_shape(answer):
    scene = Scene()
    scene.add(Sphere(1))
    scene.force(lambda t, state: answer)
    with pytest.raises(
        ValueError, match=r"must return a force of shape \(1, 3\) and a torque of shape \(1, 3\)"
    ):
        simulate(scene, 1, 0.1)


def test_users_nan_is_a_status():
    scene = Scene()
    scene.add(Sphere(1))
    scene.force(lambda t, state: (np.full((1, 3), np.nan if t > 0.55 else 0), np.zeros((1, 3))))
    run = simulate(scene, 1, 0.1, integrator="explicit_euler")
    assert run.status == "diverged" and run.time[-1] == pytest.approx(0.6)
    assert "your own force" in run.reason


def test_model_builds_only_what_the_scene_needs():
    scene = Scene(gravity=(0, -1))
    scene.add(Polygon([(0, 0), (1, 0), (0, 1)]))
    scene.add(Point())
    scene.add(Plane((0, 1)))
    scene.pair(0, 2, collide=False)
    needs = model(scene)
    assert (needs.dimension, needs.moving, needs.rotating, needs.static, needs.velocities) == (2, 2, 1, 1, 5)
    assert [term.name for term in needs.terms] == ["M⁻¹", "gravity"] and needs.integrator == "splitting"
    assert "springs" in needs.absent and any("LCP" in name for name in needs.absent)
    scene.spring(0, 1, 3)
    assert model(scene).integrator == "splitting4"
    before = model(scene).operations
    scene.drag(0, 1)
    assert model(scene).integrator == "rk4" and "rk4" in str(model(scene)) and "springs" in str(model(scene))
    assert sum(t.operations for t in model(scene).terms) > before / 5
    assert simulate(scene, 1, 0.1).settings["integrator"] == "rk4"


@pytest.mark.parametrize("integrator", [*INTEGRATORS, None])
@pytest.mark.parametrize("angular", [False, True])
def test_drag_that_would_speed_up_is_refused(integrator, angular, monkeypatch):
    """Up to the longest dt that is named a velocity falls, and just beyond it would grow."""
    scene = Scene(gravity=(0, 0, 0))
    ball = scene.add(Sphere(1), mass=2.5, position=(0, 0, 9), velocity=(1, 2, 3), angular_velocity=(1, 2, 3))
    scene.drag(ball, *((1.0, 3.0) if angular else (5.0, 0.5)))  # rates in 1/s: .4 and 3, or 2 and .5
    if not integrator:  # with contact, though nothing comes near
        scene.add(Plane((0, 0, 1)))
    most = (INTEGRATORS[integrator].most_drag if integrator else 2.0) / (3.0 if angular else 2.0)
    settings = {"integrator": integrator, "substeps": 2}
    run = simulate(scene, 80 * 0.999 * most, 2 * 0.999 * most, **settings)
    speed = np.linalg.norm(run.angular_velocity if angular else run.velocity, axis=-1)[:, ball]
    assert np.all(np.diff(speed) < 0)
    with pytest.raises(ValueError, match=rf"dt must be at most {2 * most:.6g} s for the drag of body {ball}"):
        simulate(scene, 80 * 1.001 * most, 2 * 1.001 * most, **settings)
    monkeypatch.setattr(import_module("reference.simulators.simulate"), "_check_drag", lambda *_: None)
    run = simulate(scene, 80 * 1.001 * most, 2 * 1.001 * most, **settings)
    speed = np.linalg.norm(run.angular_velocity if angular else run.velocity, axis=-1)[:, ball]
    assert np.all(np.diff(speed) > 0)


def test_drag_on_what_joints_hold_is_not_judged_by_one_body():
    """A light bob on a heavy one: alone its drag would speed it up, together it slows them down."""
    scene = Scene(gravity=(0, 0))
    heavy, light = scene.add(Disc(1), mass=10, velocity=(1, 0)), scene.add(Disc(1), mass=0.1, velocity=(1, 0))
    scene.join(Fixed(heavy, light))
    scene.drag(light, 5)  # 50/s of its own mass, .5/s of both
    run = simulate(scene, 4, 0.1)
    assert run.velocity[-1, 1, 0] == pytest.approx(np.exp(-4 * 5 / 10.1), rel=1e-5)


def test_nothing_moves():
    scene = Scene()
    scene.add(Plane((0, 0, 1)))
    run = simulate(scene, 1, 0.5)
    assert run.status == "ok" and run.position.shape == (3, 1, 3) and not run.energy().any()


def test_an_empty_scene():
    run = simulate(Scene(), 1, 0.5)
    assert run.status == "ok" and run.position.shape == (3, 0, 3)
