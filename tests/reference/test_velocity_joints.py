"""Joints among contacts: limits, motors of limited force, mechanisms that touch; against mechanics by
hand.
"""

import numpy as np
import pytest

from contact_scenes import G, at, ground
from reference import Box, Distance, Fixed, Hinge, Point, Scene, Slider, Unsupported, model, simulate


def flywheel(motor, gravity=0.0):
    """A disc-like box on a hinge through its centre, driven by a motor: I = 2 kg m²."""
    scene = Scene(gravity=(0, -gravity))
    scene.add(Box((0.5, 0.5)), inertia=2.0)
    scene.join(Hinge(0, point=(0, 0), motor=motor))
    return scene


def test_a_motor_pushes_with_its_force_until_it_has_its_speed():
    """ω = 3 t up to 2 rad/s: then it turns evenly."""
    run = simulate(flywheel((2.0, 6.0)), 1, 1 / 60)
    assert run.settings["simulator"] == "velocity_lcp"
    np.testing.assert_allclose(run.angular_velocity[:, 0], np.minimum(3 * run.time, 2.0), atol=1e-9)
    assert np.abs(run.position).max() < 1e-9


def test_a_motor_too_weak_holds_nothing():
    """A motor of 1 N m at speed 0 under a torque of 4.905 N m: the rest of it turns the body."""
    scene = Scene(gravity=(0, -G))
    scene.add(Box((0.5, 0.5)), inertia=0.1, position=(0.5, 0))
    scene.join(Hinge(0, point=(0, 0), motor=(0.0, 1.0)))
    run = simulate(scene, 1 / 100, 1 / 1000)
    rate = (0.5 * G - 1) / (0.1 + 0.25)
    assert run.angular_velocity[-1, 0] == pytest.approx(-rate / 100, rel=1e-3)


@pytest.mark.parametrize("d", [2, 3])
def test_a_pendulum_stops_at_its_limit(d):
    """It swings until the hinge's limit, stays there without rebound, and the limit bears its torque."""
    scene = Scene(gravity=at(d, 0, -G))
    scene.add(Box((0.5, 0.1) if d == 2 else (0.5, 0.1, 0.1)), position=at(d, 0.5, 0))
    axis = {} if d == 2 else {"axis": (0, -1, 0)}
    scene.join(Hinge(0, point=at(d, 0, 0), limits=(-0.7, 0.2), **axis))
    run = simulate(scene, 2, 1 / 100)
    angle = np.arctan2(run.position[:, 0, -1], run.position[:, 0, 0])
    assert angle.min() > -0.7 - 1e-8
    assert np.all(np.abs(angle[run.time > 1.2] + 0.7) < 1e-8)
    assert np.all(run.velocity[run.time > 1.2] == 0)
    assert run.joint_error().max() < 1e-7
    assert np.all(np.diff(run.energy()) < 1e-6 * G)


def test_a_slider_falls_to_its_limit():
    scene = Scene(gravity=(0, -G))
    scene.add(Box((0.1, 0.1)), mass=2)
    scene.join(Slider(0, axis=(0, 1), limits=(-0.5, 1)))
    run = simulate(scene, 1, 1 / 60)
    before = run.time < np.sqrt(1 / G) - 1 / 60
    np.testing.assert_allclose(run.position[before, 0, 1], -0.5 * G * run.time[before] ** 2, atol=1e-12)
    assert run.position[-1, 0, 1] == pytest.approx(-0.5, abs=1e-8) and np.all(run.velocity[-1] == 0)


@pytest.mark.parametrize("d", [2, 3])
def test_a_cart_of_joined_bodies_stands_and_carries_its_load(d):
    """Two boxes welded to a plank on the ground, a load on the plank: nothing moves, the ground bears all."""
    scene = ground(d)
    size = lambda x, z: (x, z) if d == 2 else (x, 0.3, z)
    plank = scene.add(Box(size(1, 0.1)), mass=3, position=at(d, 0, 0.5))
    for x in (-0.8, 0.8):
        foot = scene.add(Box(size(0.1, 0.2)), mass=1, position=at(d, x, 0.2))
        scene.join(Fixed(plank, foot))
    scene.add(Box(size(0.2, 0.2)), mass=5, position=at(d, 0.3, 0.8))
    run = simulate(scene, 1, 1 / 60, record_every=30)
    assert np.abs(run.position - run.position[0]).max() < 1e-8
    contacts = run.contacts[-1]
    bears = contacts.impulse[contacts.bodies[:, 0] == 0, 0].sum() / 0.5
    assert bears == pytest.approx(10 * G, rel=1e-7)


def test_a_rod_swings_against_a_wall():
    """A hinged rod meets a wall that stops it; the joint holds, energy only falls."""
    scene = Scene(gravity=(0, -G))
    scene.add(Box((0.2, 1)), static=True, position=(-0.25, -1))
    scene.add(Box((0.5, 0.05)), position=(0.5, 0))
    scene.join(Hinge(1, point=(0, 0)))
    run = simulate(scene, 2, 1 / 200)
    assert run.status == "ok" and run.joint_error().max() < 1e-7
    assert np.all(np.diff(run.energy()) < 1e-6 * G)
    assert np.abs(run.velocity[-1]).max() < 1e-9


def test_a_rope_of_limited_length():
    """A Distance with an upper limit is a rope: the ball falls freely until it is taut, and then hangs."""
    scene = Scene(gravity=(0, -G))
    scene.add(Point(), position=(0, -0.5))
    scene.join(Distance(0, point_b=(0, 0), limits=(0, 1)))
    run = simulate(scene, 1, 1 / 100)
    assert run.position[-1, 0, 1] == pytest.approx(-1, abs=1e-8)


def test_what_cannot_be_joined_is_said():
    def triangle():
        scene = Scene(gravity=(0, -G))
        for x in (0, 1, 3):
            scene.add(Point(), position=(x, 0.1 * x))
        for a, b, length in ((0, 1, 1), (1, 2, 1), (0, 2, 3)):
            scene.join(Distance(a, b, length=length))
        scene.join(Distance(0, point_b=(0, 5), limits=(0, 9)))
        return scene

    with pytest.raises(ValueError, match="joints must be able to hold at the same time"):
        simulate(triangle(), 0.1, 0.1)
    scene = flywheel((1.0, 1.0))
    scene.join(Hinge(0, point=(0, 0), stiffness=1.0))
    with pytest.raises(Unsupported, match=r"spring or damper.*scene\.spring"):
        model(scene)
    text = str(model(flywheel((1.0, 1.0))))
    assert "velocity_lcp" in text and "3 rows of the joints" in text
