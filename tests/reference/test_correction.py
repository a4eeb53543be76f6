"""Projection: by hand, by invariants, and against dense algebra."""

from dataclasses import replace

import numpy as np
import pytest

import jointed
from reference import Distance, Point, Scene, Simulation, simulate
from reference.equation import equation
from reference.layout import Bodies


def projected(scene, state):
    """The state that a simulation starts from."""
    simulation = Simulation(scene, 0.01, start=state)
    return simulation.state


def test_a_rod_that_is_too_long_is_shared_out_by_mass():
    scene = Scene(gravity=(0, 0))
    a, b = scene.add(Point(), mass=1), scene.add(Point(), mass=3, position=(2, 0), velocity=(4, 1))
    scene.join(Distance(a, b, length=1.2))
    run = simulate(scene, 0.1, 0.1)
    assert run.position[0] == pytest.approx(np.array([[0.6, 0], [1.8, 0]]), abs=1e-12)
    assert run.velocity[0] == pytest.approx(np.array([[3, 0], [3, 1]]), abs=1e-12)


def disturbed(scene, seed, size=0.03):
    state = simulate(scene, 0.1, 0.1).state()
    rng = np.random.default_rng(seed)
    for part in (state.position, state.velocity):
        part += size * rng.normal(size=part.shape)
    state.angular_velocity[:] += size * rng.normal(size=state.angular_velocity.shape)
    return state


def test_a_free_mechanism_keeps_its_centre_of_mass_and_momenta():
    scene = jointed.star(5)
    start = disturbed(scene, 3)
    end = projected(scene, start)
    mass = np.array([body.mass for body in scene.bodies])
    assert np.abs(mass @ (end.position - start.position)).max() < 1e-12
    assert np.abs(mass @ (end.velocity - start.velocity)).max() < 1e-12
    again = replace(end, velocity=start.velocity, angular_velocity=start.angular_velocity)
    momenta = []
    for state in (again, projected(scene, again)):
        x, p = state.position, mass[:, None] * state.velocity
        spin = np.array([body.inertia for body in scene.bodies]) @ state.angular_velocity
        momenta.append((x[:, 0] * p[:, 1] - x[:, 1] * p[:, 0]).sum() + spin)
    assert momenta[0] == pytest.approx(momenta[1], abs=1e-11)


@pytest.mark.parametrize("make", [jointed.star, jointed.hinged_chain])
def test_all_gaps_are_closed(make):
    scene = make(5)
    end = projected(scene, disturbed(scene, 4))
    made = equation(scene, end, step=0.01)
    assert np.abs(made.φ).max() < 1e-11
    u = flat_velocity(scene, end)
    assert np.abs(made.J @ u).max() < 1e-9


def flat_velocity(scene, state):
    bodies = Bodies(scene)
    return np.concatenate(
        [state.velocity[bodies.moving].ravel(), state.angular_velocity[bodies.rotating].ravel()]
    )


def test_velocities_change_as_little_as_the_kinetic_energy_can_measure():
    scene = jointed.hinged_chain(4)
    closed = projected(scene, disturbed(scene, 5))
    rng = np.random.default_rng(6)
    start = replace(
        closed,
        velocity=rng.normal(size=closed.velocity.shape),
        angular_velocity=rng.normal(size=closed.angular_velocity.shape),
    )
    made = equation(scene, closed, step=0.01)
    M, J = made.M, made.J
    before, after = flat_velocity(scene, start), flat_velocity(scene, projected(scene, start))
    λ = np.linalg.lstsq(J @ np.linalg.solve(M, J.T), J @ before, rcond=None)[0]
    assert after == pytest.approx(before - np.linalg.solve(M, J.T @ λ), abs=1e-9)
    assert after @ M @ after <= before @ M @ before
