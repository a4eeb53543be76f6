"""Landings without rebound, each at its own time; and the loop of ordinary steps against single steps."""

import numpy as np
import pytest

from contact_scenes import G, at, ground, pyramid, rise
from reference import Box, Disc, Plane, Scene, Simulation, Sphere, simulate
from reference.cases import CASES
from reference.simulators import impact_time
from reference.simulators.velocity_lcp import VelocityLCP

FRAME = 1 / 60


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 240])
def test_a_ball_lands_and_slides(d, dt):
    """By hand: at the landing friction gives μ v_z, from then on it takes μ g: exact whatever Δt is."""
    μ, height, speed = 0.1, 0.7, 5.0
    scene = ground(d, friction=1.0)
    scene.add(
        Disc(0.1) if d == 2 else Sphere(0.1),
        position=at(d, 0, 0.1 + height),
        velocity=at(d, speed, 0),
        friction=μ,
    )
    run = simulate(scene, 0.5, dt, record_every=15)
    landing, impact = np.sqrt(2 * height / G), np.sqrt(2 * height * G)
    left, slides = speed - μ * impact, 0.5 - landing
    assert run.velocity[-1, 1, 0] == pytest.approx(left - μ * G * slides, rel=1e-8)
    way = speed * landing + left * slides - 0.5 * μ * G * slides**2
    assert run.position[-1, 1, 0] == pytest.approx(way, rel=1e-7)
    assert run.position[-1, 1, -1] == pytest.approx(0.1, abs=1e-9)


@pytest.mark.parametrize("half_width", [0.15, 0.25, 0.4])
def test_a_block_lands_on_its_other_corner(half_width):
    """Housner 1963: 1 − (3/2) sin²α of ω is left. In a step of 1e-5 s nothing else changes it by 1e-4."""
    α, ω = np.arctan2(half_width, 1.0), -0.5
    scene = ground(2, friction=1.0)
    velocity = ω * np.array([-1.0, half_width])  # turns about the left corner: the right one comes down
    scene.add(Box((half_width, 1.0)), position=(0, 1), velocity=velocity, angular_velocity=ω, friction=1.0)
    run = simulate(scene, 1e-5, 1e-5)
    assert run.angular_velocity[-1, 1] / ω == pytest.approx(1 - 1.5 * np.sin(α) ** 2, rel=1e-4)


def test_rocking_converges():
    """About its corners it turns to second order; what is left comes of the landings. Energy only falls."""
    errors = []
    for rate in (60, 120, 240):
        case = CASES["rocking_block"]()
        run = simulate(case.scene, 1.0, 1 / rate, record_contacts=False)
        errors.append(case.error(run))
        assert rise(run.energy()) < 1e-6 * G
    assert errors[0] < 1e-3  # rad; pymunk .0048
    assert errors[1] < 0.6 * errors[0] and errors[2] < 0.5 * errors[0]


def test_what_rocks_to_rest_does_not_step_from_landing_to_landing(monkeypatch):
    """Landings come ever faster (Zeno): those that the forces of a step explain are not looked for."""
    most = {}
    hop = impact_time.hop

    def counted(sim, contacts, h, left, early):
        most[sim.now + left] = most.get(sim.now + left, 0) + 1
        return hop(sim, contacts, h, left, early)

    monkeypatch.setattr("reference.simulators.velocity_lcp.hop", counted)
    case = CASES["rocking_block"]()
    sim = Simulation(case.scene, FRAME, record_contacts=False)
    sim.advance(10.0)
    assert np.all(sim.state.velocity == 0) and max(most.values()) <= 4


def bounced(height, e, t):
    """How high a ball is over the ground at time t, let go at a height: by hand, bounce after bounce."""
    fallen = np.sqrt(2 * height / G)
    if t < fallen:
        return height - 0.5 * G * t**2
    speed, t = e * G * fallen, t - fallen
    while t > 2 * speed / G:
        speed, t = e * speed, t - 2 * speed / G
    return speed * t - 0.5 * G * t**2


def test_of_many_balls_each_bounces_by_itself():
    """Three hundred at once, some ten impacts a step: no crowd, since none is struck twice in a step."""
    heights, e = np.linspace(0.5, 1.5, 300), 0.8
    scene = Scene(gravity=(0, -G))
    scene.add(Plane((0, 1)), restitution=e)
    for k, height in enumerate(heights):
        scene.add(Disc(0.1), position=(0.3 * k, 0.1 + height), restitution=e)
    run = simulate(scene, 1.5, FRAME, record_every=90, record_contacts=False)
    expected = [0.1 + bounced(height, e, 1.5) for height in heights]
    np.testing.assert_allclose(run.position[-1, 1:, 1], expected, atol=1e-9)


def test_a_crowd_that_bounces_comes_to_rest(monkeypatch):
    """Thirty discs with e = .5 (inelastic collapse): a bounded number of impacts a step, and energy falls."""
    case, hops = CASES["heap"](n=30, dimension=2, duration=2.0), {}
    for body in case.scene.bodies:
        object.__setattr__(body, "restitution", 0.5)
    hop = impact_time.hop

    def counted(sim, contacts, h, left, early):
        step = round((sim.now + left) / FRAME)
        hops[step] = hops.get(step, 0) + 1
        return hop(sim, contacts, h, left, early)

    monkeypatch.setattr("reference.simulators.velocity_lcp.hop", counted)
    run = simulate(case.scene, case.duration, FRAME)
    assert run.status == "ok" and np.abs(run.velocity[-1]).max() == 0
    assert rise(run.energy()) < 1e-12 * run.energy()[0] and run.penetration().max() < 1e-8 * 0.1
    assert 20 < max(hops.values()) <= 100  # thirty discs once each, fifty times more, and twenty in shares
    assert "impacts in a crowd were taken together" in run.reason


@pytest.mark.parametrize("digits", [1, 2, 3])
def test_galperins_billiard(digits):
    """A heavy ball drives a light one to a wall: they collide π × 10^digits times, thousands within a step.

    In the plane of √m u each pair of collisions is a turn by 2 arctan 10^−digits (Galperin 2003): after an
    even number the speeds are those of the first turned so far.
    """
    ratio = 10.0**digits
    scene = Scene(gravity=(0, 0))
    scene.add(Plane((1, 0)), restitution=1)
    scene.add(Disc(0.1), mass=1, position=(1, 0), restitution=1)
    scene.add(Disc(0.1), mass=ratio**2, position=(2, 0), velocity=(-1, 0), restitution=1)
    run = simulate(scene, 4.0, FRAME, record_every=240, record_contacts=False)
    turn = 2 * np.arctan(1 / ratio)
    count = int(np.pi * ratio)
    heavy, light = np.cos(np.pi - (count + 1) // 2 * turn), ratio * np.sin(np.pi - (count + 1) // 2 * turn)
    assert run.velocity[-1, 2, 0] == pytest.approx(heavy, abs=1e-9)
    assert abs(run.velocity[-1, 1, 0]) == pytest.approx(abs(light), abs=1e-6 * ratio)
    assert run.reason == ""


@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 500])
def test_energy_never_rises_in_a_fall(dt):
    """A row of boxes thrown over; landings at their times don't add energy."""
    scene = ground(2)
    for i in range(4):
        scene.add(
            Box((0.1, 0.5)),
            position=(0.5 * i, 0.5),
            angular_velocity=-2.0 if i == 0 else 0.0,
            velocity=(1.0, 0.1) if i == 0 else 0,
        )
    run = simulate(scene, 1.0, dt, record_contacts=False)
    assert run.status == "ok" and rise(run.energy()) < 1e-6 * run.energy()[0]


def test_recorded_impulses_are_what_changes_the_momentum():
    """In each record, whatever happened in it, and also where one stands for several steps."""
    for every in (1, 6):
        run = simulate(falling_heap(), 0.6, FRAME, record_every=every)
        for k in range(1, len(run.time)):
            contacts, change = run.contacts[k], np.diff(run.velocity[k - 1 : k + 1], axis=0)[0]
            pushes = np.einsum("mi,mij->mj", contacts.impulse, contacts.frame)
            total = np.zeros_like(change)
            np.add.at(total, contacts.bodies[:, 0], -pushes)
            np.add.at(total, contacts.bodies[:, 1], pushes)
            given = change - scene_gravity(run) * (run.time[k] - run.time[k - 1])
            # what is lifted apart by 1e-9 m pays for it with its speed, not by a contact: some 1e-8 m/s
            np.testing.assert_allclose(total[2:], given[2:], atol=1e-7)


def scene_gravity(run):
    return run.bodies.gravity


def falling_heap():
    """Discs of 1 kg that fall into a corner."""
    scene = Scene(gravity=(0, -G))
    scene.add(Plane((0, 1)))
    scene.add(Plane((0.6, 0.8)), position=(-1, 0))
    for i in range(6):
        scene.add(Disc(0.2), mass=1.0, position=(0.1 * i - 0.2, 0.5 + 0.45 * i))
    return scene


@pytest.mark.parametrize("d", [2, 3])
def test_the_loop_of_ordinary_steps_is_the_step(d, monkeypatch):
    """The same scene with the loop and without: one after the other ``step`` gives the same motion."""

    def run():
        if d == 2:
            scene = pyramid(3)
            scene.add(Disc(0.4), mass=5, position=(-1.5, 1.5), velocity=(6, 0))
        else:
            scene = ground(3)
            scene.add(
                Box((0.3, 0.4, 0.6)), position=(0, 0, 1.2), orientation=(np.cos(0.2), 0, np.sin(0.2), 0)
            )
        return simulate(scene, 0.5, 1 / 120, record_every=60, record_contacts=False)

    loop = run()
    monkeypatch.setattr(VelocityLCP, "coasts", False)
    steps = run()
    np.testing.assert_allclose(loop.position, steps.position, atol=1e-7)
    np.testing.assert_allclose(loop.velocity, steps.velocity, atol=1e-6)
