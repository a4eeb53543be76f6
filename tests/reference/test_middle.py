"""Contacts, joints and forces at the middle of the step: of second order, and no energy from contact."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from contact_scenes import G, at, ground
from reference import Box, Capsule, Disc, Hinge, Plane, Scene, Sphere, simulate

RATES = 60, 120, 240


def orders(errors):
    """Of the convergence between errors at half the step each."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


def test_a_box_that_falls_over_its_corner():
    """It sticks there, so it is a pendulum upside down: I_c φ̈ = m g d sin φ, by SciPy."""
    a, b, φ0, end = 0.1, 0.5, 0.3, 0.5
    d, lean = np.hypot(a, b), np.arctan2(a, b)
    inertia = (a * a + b * b) / 3 + d * d  # about the corner, of 1 kg

    def fall(t, y):
        return [y[1], G * d * np.sin(y[0]) / inertia]

    φ, ω = solve_ivp(fall, (0, end), [φ0, 0.0], rtol=1e-11, atol=1e-12).y[:, -1]
    off = []
    for rate in RATES:
        scene = ground(2, friction=1.0)
        place = d * np.array([np.sin(φ0), np.cos(φ0)])
        scene.add(Box((a, b)), position=place, orientation=-lean - φ0, friction=20.0)
        run = simulate(scene, end, 1 / rate)
        want = d * np.array([np.sin(φ), np.cos(φ)])
        off.append(max(np.abs(run.position[-1, 1] - want).max(), abs(run.angular_velocity[-1, 1] + ω)))
        assert run.penetration().max() <= 1e-8  # the measure by which things are lifted apart
    assert off[0] < 1e-2 and (orders(off) > 1.7).all()


def test_a_box_that_tumbles_over_its_corner_in_space():
    """A heavy rigid body about a fixed point: L̇ = r × m g in the world, by SciPy."""
    size, end, mass = np.array([0.3, 0.5, 0.8]), 0.1, 2.0
    start = Rotation.align_vectors([[0, 0, 1]], [[0.5, 0.6, 0.62]])[0]
    corner = -size * np.sign(start.as_matrix()[2])  # the lowest, as the body sees it
    square = size**2
    about = mass / 3 * np.diag(square.sum() - square) + mass * (
        corner @ corner * np.eye(3) - np.outer(corner, corner)
    )
    ω0 = np.array([1.0, -2.0, 1.5])

    def tumble(t, y):
        turned, (v, s) = Rotation.from_quat(y[:4]), (y[:3], y[3])
        ω = turned.apply(np.linalg.solve(about, turned.inv().apply(y[4:])))
        turning = 0.5 * np.append(s * ω + np.cross(ω, v), -ω @ v)  # ½ (0, ω) ∘ q
        return np.concatenate([turning, np.cross(turned.apply(-corner), [0, 0, -mass * G])])

    L0 = start.apply(about @ start.inv().apply(ω0))
    last = solve_ivp(tumble, (0, end), np.append(start.as_quat(), L0), rtol=1e-11, atol=1e-12).y[:, -1]
    turned = Rotation.from_quat(last[:4] / np.linalg.norm(last[:4]))
    where, ω = turned.apply(-corner), turned.apply(np.linalg.solve(about, turned.inv().apply(last[4:])))
    off = []
    for rate in RATES:
        scene = ground(3, friction=1.0)
        place = start.apply(-corner)
        scene.add(
            Box(tuple(size)), mass=mass, position=place, orientation=start.as_quat(scalar_first=True),
            velocity=np.cross(ω0, place), angular_velocity=ω0, friction=20.0,
        )  # fmt: skip
        run = simulate(scene, end, 1 / rate)
        found = np.concatenate([run.position[-1, 1] - where, run.angular_velocity[-1, 1] - ω])
        off.append(np.abs(found).max())
    assert off[0] < 2e-3 and (orders(off) > 1.7).all()


def test_a_pendulum_on_a_joint_among_contacts():
    """Let go from the level: I φ̈ = −m g d cos φ, by SciPy; it comes up again nearly to the level."""
    radius, end = 0.2, 1.0
    inertia = 1 + 0.5 * radius**2

    def swing(t, y):
        return [y[1], -G * np.cos(y[0]) / inertia]

    φ = solve_ivp(swing, (0, end), [0.0, 0.0], rtol=1e-11, atol=1e-12).y[0, -1]
    off = []
    for rate in RATES:
        scene = Scene((0, -G))
        scene.add(Plane((0, 1)), position=(0, -50))
        scene.join(Hinge(scene.add(Disc(radius), position=(1, 0)), None, point=(0, 0)))
        run = simulate(scene, end, 1 / rate)
        assert run.settings["simulator"] == "velocity_lcp"
        off.append(np.abs(run.position[-1, 1] - [np.cos(φ), np.sin(φ)]).max())
        rise = run.energy() - np.minimum.accumulate(run.energy())
        assert rise.max() <= 1e-12 * G
    assert off[0] < 0.03 and (orders(off) > 1.7).all()


def test_a_spring_among_contacts_keeps_its_energy():
    """Two discs on a spring, and a plane far away: for 10 s as leapfrog does it, within (ω h)²/4 or so."""
    for rate in 60, 240:
        scene = Scene((0, 0))
        scene.add(Plane((0, 1)), position=(0, -100))
        a, b = scene.add(Disc(0.1), position=(0, 0)), scene.add(Disc(0.1), position=(1.2, 0))
        scene.spring(a, b, 100.0, length=1.0)
        energy = simulate(scene, 10.0, 1 / rate).energy()
        assert np.abs(energy / energy[0] - 1).max() <= 200 / rate**2 / 4 * 1.2  # ω² = 2 k/m


@pytest.mark.parametrize("rate", [30, 60])
@pytest.mark.parametrize("shape", [Box((0.02, 0.02, 0.5)), Capsule(0.15, 0.3), Box((0.4, 0.3, 0.05))])
def test_no_energy_from_what_tumbles(shape, rate):
    """Moments of inertia far from equal: turning in contact, and out of an overlap, gives no energy."""
    for seed in range(6):
        random, scene = np.random.default_rng(seed), ground(3, friction=0.6)
        scene.add(
            shape, position=(0, 0, 0.9), orientation=Rotation.random(random_state=seed).as_quat(),
            velocity=(2, 1, -1), angular_velocity=random.uniform(-8, 8, 3),
        )  # fmt: skip
        run = simulate(scene, 1.5, 1 / rate)
        energy = run.energy()
        assert run.status == "ok" and run.penetration().max() <= 1e-8
        assert np.max(energy - np.minimum.accumulate(energy)) <= 1e-10 * energy[0]


@pytest.mark.parametrize("rate", [30, 240])
def test_what_slides_without_friction_or_rolls_is_exact(rate):
    """½ a t² with a = g sin α, and g sin α / (1 + I/m r²) for what rolls: the contact does no work."""
    α, end = 0.5, 1.0
    pull = G * np.sin(α)
    for shape, μ, a in (
        (Box((0.3, 0.2, 0.1)), 0.0, pull),
        (Sphere(0.2), 2.0, pull / 1.4),
        (Disc(0.2), 2.0, pull / 1.5),
    ):
        d = 2 if isinstance(shape, Disc) else 3
        scene = Scene(at(d, pull, -G * np.cos(α)))
        scene.add(Plane(at(d, 0, 1)), friction=1.0)
        scene.add(shape, position=at(d, 0, 0.1 if d == 3 and μ == 0 else 0.2), friction=μ)
        run = simulate(scene, end, 1 / rate)
        assert abs(run.position[-1, 1, 0] - 0.5 * a * end**2) <= 1e-10
