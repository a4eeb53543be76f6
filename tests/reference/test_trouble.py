"""Bad input and hard circumstances: for each a stated behaviour, and never nan (issue 6's last point).

deep overlap at the start    lifted apart at once; the energy that this adds is told in ``reason``
what has no room             as far apart as it goes; ``penetration`` tells what is left; no gain in speed
mass ratio of 1e8            rests, to 1e-8
Δt = .1 s                    rests, falls and bounces as with small steps; energy doesn't rise
speeds that tunnel           what rebounds is found within the step, at any speed; what doesn't, too
"""

import numpy as np
import pytest

from contact_scenes import G, at, ground, rise, stack
from reference import Box, Disc, Plane, Scene, Simulation, Sphere, simulate

FRAME = 1 / 60
DIMENSIONS = pytest.mark.parametrize("d", [2, 3])


def finite(run):
    arrays = run.position, run.velocity, run.orientation, run.angular_velocity
    return all(np.isfinite(a).all() for a in arrays)


def ball(d, r=0.5):
    return Disc(r) if d == 2 else Sphere(r)


@DIMENSIONS
def test_balls_in_one_place_are_parted(d):
    """Five balls, all but in one place: none overlaps another after the first step, and it is told."""
    scene, random = ground(d), np.random.default_rng(0)
    for _ in range(5):
        scene.add(ball(d), position=np.array(at(d, 0, 0.5)) + 1e-3 * random.normal(size=d))
    run = simulate(scene, 1.0, FRAME, record_every=1)
    assert run.status == "ok" and finite(run) and "lifting overlaps apart has added" in run.reason
    assert run.penetration()[1:].max() < 1e-6
    x = run.position[-1]
    assert min(np.linalg.norm(x[i] - x[j]) for i in range(1, 6) for j in range(1, i)) > 1 - 1e-6
    assert run.position[-1, 1:, -1].min() > 0.5 - 1e-6
    assert rise(run.energy()[1:]) < 1e-6 * run.energy()[1]  # after that first step nothing is gained any more


@DIMENSIONS
def test_a_box_sunk_to_its_middle_is_lifted_without_being_thrown(d):
    scene = ground(d)
    scene.add(Box((0.5,) * d), position=at(d, 0, 0.0))
    run = simulate(scene, 0.5, FRAME)
    assert run.position[-1, 1, -1] == pytest.approx(0.5, abs=1e-8)
    assert np.abs(run.velocity).max() < G * FRAME


@DIMENSIONS
def test_what_has_no_room_stays_finite_and_says_how_deep(d):
    """A ball of 1 m between two walls .8 m apart: .1 m in each, at rest, and the run says so."""
    scene = Scene(gravity=(0,) * d)
    for side in (-1, 1):
        scene.add(Plane(at(d, -side, 0)), position=at(d, 0.4 * side, 0))
    scene.add(ball(d), position=at(d, 0.05, 0))
    run = simulate(scene, 0.5, FRAME)
    assert finite(run) and np.abs(run.velocity).max() < 1e-6
    assert run.penetration()[-1] == pytest.approx(0.1, abs=0.06)
    assert run.status != "ok" or run.residual.max() < 1e-6 or "residual" in run.reason
    blind = simulate(scene, FRAME, FRAME, record_contacts=False)
    with pytest.raises(ValueError, match="run with record_contacts=True"):
        blind.penetration()


@DIMENSIONS
@pytest.mark.parametrize("top", [1e8, 1e-8])
@pytest.mark.parametrize("dt", [0.1, FRAME])
def test_a_mass_ratio_of_1e8_rests(d, top, dt):
    run = simulate(stack(d, 3, top), 1.0, dt)
    assert run.status == "ok" and finite(run)
    assert np.abs(run.position - run.position[0]).max() < 1e-8
    c = run.contacts[-1]
    weight = c.impulse[c.bodies[:, 0] == 0, 0].sum() / dt
    assert weight == pytest.approx(G * (2 + top), rel=1e-8)


@DIMENSIONS
@pytest.mark.parametrize("restitution", [0.0, 0.7])
def test_steps_of_a_tenth_of_a_second(d, restitution):
    """A tower that falls over, and a ball that bounces: energy only falls, and all ends above the ground."""
    scene = ground(d)
    for k in range(3):
        scene.add(Box((0.3,) * d), position=at(d, 0.25 * k, 0.3 + 0.6 * k), restitution=restitution)
    scene.add(ball(d, 0.2), position=at(d, 0, 4), restitution=restitution)
    run = simulate(scene, 3.0, 0.1)
    assert run.status == "ok" and finite(run)
    assert rise(run.energy()) < 1e-6 * run.energy()[0]
    assert run.position[:, 1:, -1].min() > 0.2 - 1e-6


@DIMENSIONS
@pytest.mark.parametrize("speed", [50.0, 5e3, 5e5])
@pytest.mark.parametrize("restitution", [0.0, 1.0])
def test_bullets_meet_a_thin_wall(d, speed, restitution):
    """2 mm of wall, a ball of 2 cm; in a step of .1 s it would be 50 km beyond."""
    scene = Scene(gravity=(0,) * d)
    scene.add(Box((0.001,) + (1.0,) * (d - 1)), static=True)
    scene.add(ball(d, 0.01), position=at(d, -1, 0), velocity=at(d, speed, 0), restitution=restitution)
    run = simulate(scene, 0.1, 0.1)
    assert finite(run) and run.position[-1, 1, 0] < 0
    assert run.velocity[-1, 1, 0] == pytest.approx(-restitution * speed, abs=1e-6 * speed)


@DIMENSIONS
def test_two_bullets_meet_each_other(d):
    """Head on, e = 1 and equal masses: they exchange their speeds, though each step takes them 100 radii."""
    scene = Scene(gravity=(0,) * d)
    for side in (-1, 1):
        velocity = at(d, -side * 600.0, 0)
        scene.add(ball(d, 0.1), position=at(d, side * 5.0, 0), velocity=velocity, restitution=1.0)
    run = simulate(scene, FRAME, FRAME)
    np.testing.assert_allclose(run.velocity[-1, :, 0], [-600, 600], rtol=1e-9)


@DIMENSIONS
def test_warm_starts_when_contacts_change_their_names(d):
    """A box slides off a step: its corners' contacts come, go and get other ids. Warm start is only a start:
    with and without it every record is the same, to the solver's tolerance.
    """
    scene = ground(d)
    step = Box((1.0, 0.25) if d == 2 else (1.0, 1.0, 0.25))
    scene.add(step, static=True, position=at(d, 0, 0.25), friction=0.3)
    scene.add(Box((0.3,) * d), position=at(d, 0.5, 0.8), velocity=at(d, 3.0, 0), friction=0.3)
    runs = [simulate(scene, 0.4, FRAME, warm_start=warm) for warm in (True, False)]
    ids = [sorted(map(tuple, c.bodies)) for c in (runs[0].contacts[k] for k in range(1, 25))]
    assert len(set(map(str, ids))) > 2  # contacts did come and go
    np.testing.assert_allclose(runs[0].velocity, runs[1].velocity, atol=1e-8)
    np.testing.assert_allclose(runs[0].position, runs[1].position, atol=1e-8)


@DIMENSIONS
def test_a_warm_start_from_nonsense_is_only_a_start(d):
    """Forces of the step before that belong to another scene altogether: the velocities are the same."""
    states = []
    for wrong in (0.0, 1e6):
        sim = Simulation(stack(d, 4), FRAME)
        sim.advance(3 * FRAME)
        sim._family.force = sim._family.force + wrong
        sim._family.still = False
        sim.step()
        states.append(sim.state)
    np.testing.assert_allclose(states[0].velocity, states[1].velocity, atol=1e-10)
    np.testing.assert_allclose(states[0].position, states[1].position, atol=1e-10)
