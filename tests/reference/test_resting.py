"""What rests is left out of the solve: nothing moves otherwise, and whatever disturbs it wakes it."""

import numpy as np
import pytest

from contact_scenes import G, at, ground, stack
from reference import Box, Disc, Hinge, Simulation, Sphere, simulate
from reference.contacts import gather, keys, look_up
from reference.simulators.resting import leave_out_rest, put_back

FRAME = 1 / 60
DIMENSIONS = pytest.mark.parametrize("d", [2, 3])


def with_ball(d, scene, height=0.0):
    """A ball beside the scene, that rolls away from it, once it has come down from a height."""
    ball = Disc(0.3) if d == 2 else Sphere(0.3)
    scene.add(ball, position=at(d, -5, 0.3 + height), velocity=at(d, -1, 0), friction=0.5)
    return scene


@DIMENSIONS
def test_a_ball_moves_by_the_same_bits_whether_a_stack_rests_beside_it_or_not(d):
    """It comes down when the stack has been at rest for some steps: then that has no part in anything."""
    alone = simulate(with_ball(d, ground(d), 0.1), 0.5, FRAME)
    beside = simulate(with_ball(d, stack(d, 4), 0.1), 0.5, FRAME)
    for name in ("position", "velocity", "angular_velocity"):
        assert np.array_equal(getattr(alone, name)[:, -1], getattr(beside, name)[:, -1])
    assert np.array_equal(beside.position[:, :-1], np.broadcast_to(beside.position[0, :-1], (31, 5, d)))
    c = beside.contacts[-1]
    carried = [c.impulse[c.bodies[:, 1] == j, 0].sum() / FRAME for j in range(1, 5)]
    np.testing.assert_allclose(carried, G * np.array([4, 3, 2, 1]), rtol=1e-8)


def problem_now(scene, duration):
    """(family, rows, λ to begin with) of the next step, after so many s."""
    sim = Simulation(scene, FRAME)
    sim.advance(duration)
    family = sim._family
    family.fill(duration, FRAME)
    contacts = family.find(FRAME)
    rows = family.rows(contacts, np.maximum(contacts.gap, 0) / FRAME, family.held.in_flight(FRAME))
    pushed = look_up(family.key, family.force, keys(contacts, family.limits.bodies))
    return family, rows, FRAME * gather(rows, pushed, family.held.force)


@DIMENSIONS
def test_solving_it_again_would_change_nothing(d):
    """The whole problem, solved with what rests: all velocities are the same, to the solver's tolerance."""
    family, rows, λ = problem_now(with_ball(d, stack(d, 3)), 0.3)
    moving = leave_out_rest(rows, family.M, family.before, family.free, λ, 1e-12)
    assert moving.still.tolist() == [1, 1, 1, 0] and moving.body.tolist() == [3]
    part, found = moving.λ.copy(), λ.copy()
    after = family.solver(moving.rows, moving.M, moving.free, part)
    whole = family.solver(rows, family.M, family.free, λ)
    moving.λ[:] = part
    np.testing.assert_allclose(put_back(moving, after, found, family.free), whole, atol=1e-11 * G * FRAME)
    np.testing.assert_allclose(found, λ, atol=1e-9 * G * FRAME)


@DIMENSIONS
def test_what_is_hit_wakes(d):
    """A ball rolls against a resting box: momentum goes over, and the box slides."""
    scene = ground(d, friction=1.0)
    box = scene.add(Box((0.2,) * d), position=at(d, 0, 0.2), friction=0.1)
    ball = Disc(0.2) if d == 2 else Sphere(0.2)
    scene.add(ball, mass=3.0, position=at(d, -1.0, 0.2), velocity=at(d, 3, 0), friction=0.0)
    run = simulate(scene, 0.6, FRAME)
    assert np.all(run.velocity[run.time < 0.15, box] == 0)
    assert run.velocity[-1, box, 0] > 1.0 and run.velocity[-1, 2, 0] < 3.0


def test_a_force_that_begins_wakes():
    """A user's force that begins at .3 s and is more than friction bears, by 1 N."""
    scene = ground(2, friction=1.0)
    scene.add(Box((0.5, 0.5)), position=(0, 0.5), friction=0.5)
    scene.force(lambda t, state: (np.array([[0, 0], [0.5 * G + 1.0 if t > 0.3 else 0, 0]]), np.zeros(2)))
    run = simulate(scene, 0.6, 0.05)
    assert np.all(run.velocity[run.time < 0.31, 1] == 0)
    gone = run.time[-1] - run.time[np.flatnonzero(run.velocity[:, 1, 0])[0] - 1]
    assert run.velocity[-1, 1, 0] == pytest.approx(gone * 1.0, rel=1e-9)


def test_what_loses_its_support_falls():
    """A box that rests on another which is pulled away: it wakes with it."""
    scene = ground(2, friction=0.0)
    scene.add(Box((0.5, 0.1)), position=(0, 0.1), friction=0.0)
    scene.add(Box((0.1, 0.1)), position=(0, 0.3), friction=0.0)
    scene.force(lambda t, state: (np.array([[0, 0], [20.0 if t > 0.1 else 0, 0], [0, 0]]), np.zeros(3)))
    run = simulate(scene, 0.8, 0.02)
    assert run.position[4, 2, 1] == 0.3 and run.position[-1, 2, 1] == pytest.approx(0.1, abs=1e-8)


def test_joints_rest_with_the_rest():
    """A lintel hinged to a post beside a rolling ball: at rest by the joint's force, and left out."""
    scene = ground(2, friction=1.0)
    scene.add(Box((0.5, 0.5)), position=(0, 0.5))
    scene.add(Box((0.5, 0.5)), position=(1.5, 0.5))
    scene.join(Hinge(1, 2, point=(0.75, 0.5)))
    family, rows, λ = problem_now(with_ball(2, scene), 0.5)
    moving = leave_out_rest(rows, family.M, family.before, family.free, λ, 1e-12)
    assert moving.still.tolist() == [1, 1, 0] and moving.body.tolist() == [2]
