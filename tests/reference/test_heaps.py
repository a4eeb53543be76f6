"""Heaps: the solver to its tolerance however many contacts there are, and in whatever order bodies come."""

import time

import numpy as np
import pytest

from contact_scenes import at, ground
from reference import Box, Capsule, Disc, Plane, Sphere, simulate
from reference.cases import CASES
from reference.cases.heaps import silo

FRAME = 1 / 60


def settling(d, order, n=12, seed=3):
    """n bodies of three shapes in a narrow box, as they begin to fall on each other; added in an order."""
    random, scene = np.random.default_rng(seed), ground(d)
    for side in (-1, 1):
        scene.add(Plane(at(d, -side, 0)), position=at(d, 1.2 * side, 0))
        if d == 3:
            scene.add(Plane((0, -side, 0)), position=(0, 1.2 * side, 0))
    walls = len(scene.bodies)
    places = []
    for k in range(n):
        across = 0.0 if d == 2 else 0.6 * (k // 3 % 2) - 0.3
        place = at(d, 0.75 * (k % 3 - 1), 0.3 + 0.6 * (k // (3 if d == 2 else 6)), across)
        places.append((place, random.normal(size=d) * 0.4, random.normal(size=() if d == 2 else 3)))
    shapes = (Disc(0.3), Box((0.3, 0.3))) if d == 2 else (Sphere(0.3), Box((0.3,) * 3))
    for k in order:
        shape, (place, velocity, spin) = (*shapes, Capsule(0.2, 0.1))[k % 3], places[k]
        scene.add(shape, mass=1 + 0.3 * k, position=place, velocity=velocity, angular_velocity=spin)
    return scene, walls


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("seed", range(3))
def test_bodies_added_in_another_order_make_the_same_contacts_and_velocities(d, seed):
    """Twelve bodies of three shapes, some of which slide, stick and part: the same contacts after a step, up
    to the sign of n, and converged velocities within 100 × tolerance of the scale of w, the speeds.
    """
    order = np.random.default_rng(seed).permutation(12)
    (one, walls), (other, _) = settling(d, range(12)), settling(d, order)
    runs = [simulate(scene, FRAME, FRAME) for scene in (one, other)]
    number = np.arange(walls + 12)
    number[walls:] = walls + order  # body walls + k of the other scene is this one of the first
    found = []
    for run, name in zip(runs, (np.arange(walls + 12), number), strict=True):
        c = run.contacts[1]
        pairs = np.sort(name[c.bodies], axis=1)
        keys = np.column_stack([pairs, np.round(c.point, 9) + 0.0])
        found.append(keys[np.lexsort(keys.T[::-1])])
    assert len(found[0]) > 12
    np.testing.assert_allclose(found[0], found[1], atol=2e-9)
    scale = max(1.0, np.abs(runs[0].velocity).max())
    for name in ("velocity", "angular_velocity"):
        a, b = getattr(runs[0], name)[1], getattr(runs[1], name)[1]
        np.testing.assert_allclose(a[number], b, atol=100 * 1e-12 * scale / 0.2)  # ω: over .2 m


def depths(run):
    """By how much any two balls, or a ball and a plane of the box, are in each other: (T,)."""
    declared, x = run.bodies.declared, run.position
    balls = [i for i, body in enumerate(declared) if not body.static]
    r = np.array([declared[i].shape.radius for i in balls])
    between = np.linalg.norm(x[:, balls, None] - x[:, None, balls], axis=-1) - r[:, None] - r
    between[:, range(len(r)), range(len(r))] = np.inf
    gaps = [between.min(axis=(1, 2))]
    for body in declared:
        if body.static:
            gaps.append(((x[:, balls] - body.position) @ body.shape.normal - r).min(axis=1))
    return np.maximum(-np.min(gaps, axis=0), 0.0)


@pytest.mark.parametrize(
    "n, d, seed, worst, unsolved",
    [
        (40, 2, 0, 1e-8, 0.05),
        (40, 2, 1, 1e-8, 0.05),
        pytest.param(100, 2, 0, 1e-4, 0.5, marks=pytest.mark.slow),
        pytest.param(30, 3, 0, 0.05, 0.4, marks=pytest.mark.slow),  # spheres: nothing brakes what rolls
    ],
)
def test_a_heap_comes_to_rest(n, d, seed, worst, unsolved):
    """The box bears the weight, nothing moves any more, and no energy came in on the way, whatever share of
    the steps was left short of the solver's tolerance: that is told.
    """
    case = CASES["heap"](n=n, dimension=d, seed=seed, duration=2.5)
    run = simulate(case.scene, case.duration, FRAME)
    assert run.status == "ok" and case.error(run) < worst
    energy = run.energy()
    assert np.max(energy - np.minimum.accumulate(energy)) < 1e-6 * energy[0]
    assert run.residual.max() < 0.05
    np.testing.assert_allclose(run.penetration(), depths(run), atol=1e-12)
    short = np.count_nonzero(run.residual > 1e-12)
    assert short <= unsolved * (len(run.time) - 1) and (short > 0) == ("some steps stopped" in run.reason)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_a_tolerance_is_kept(tolerance):
    """A coarse one saves time, but nothing gains energy or sinks in, and the box bears the weight."""
    case = CASES["heap"](n=40, dimension=2, duration=1.5)
    run = simulate(case.scene, case.duration, FRAME, tolerance=tolerance)
    assert run.status == "ok" and np.max(run.residual) <= tolerance
    energy = run.energy()
    assert np.max(energy - np.minimum.accumulate(energy)) < 1e-3 * tolerance * energy[0]
    assert run.penetration().max() < 1e-8 * 0.1 and case.error(run) < tolerance


def test_what_is_recorded_is_lifted_apart_also_where_room_for_contacts_runs_out(monkeypatch):
    """A solver that is right to 1 % leaves overlaps; each record is free of them, from the first step on."""
    monkeypatch.setattr("reference.collision.collider._ROOM", 1)
    case = CASES["heap"](n=40, dimension=2, duration=0.6)
    run = simulate(case.scene, case.duration, FRAME, tolerance=1e-2)
    np.testing.assert_allclose(run.penetration(), depths(run), atol=1e-12)
    assert run.penetration().max() < 1e-8 * 0.1


def test_a_pyramid_of_thousands_of_contacts_is_no_heap():
    """It is solved to the end, at once: nothing moves, and nothing need be said."""
    case = CASES["pyramid"](base=30, duration=0.2)
    run = simulate(case.scene, case.duration, FRAME)
    assert len(run.contacts[1].depth) > 2000 and run.reason == ""
    assert run.residual.max() <= 1e-12 and np.all(run.position == run.position[0])


def measured(case):
    """(error, rise of energy, largest residual) of a whole run, which must be "ok"; printed with its cost."""
    start = time.process_time()
    run = simulate(case.scene, case.duration, FRAME)
    cost, energy = (time.process_time() - start) / case.duration, run.energy()
    rise, error = np.max(energy - np.minimum.accumulate(energy)) / energy[0], case.error(run)
    print(f"{cost:.0f} s a second, error {error:.1g}, rise {rise:.1g}, residual {run.residual.max():.1g}")
    assert run.status == "ok"
    return error, rise, run.residual.max()


@pytest.mark.study
def test_666_spheres_come_to_rest():
    """All but: what rolls in the cup that others make, at a few mm/s after 4 s, is braked by nothing."""
    error, rise, residual = measured(CASES["heap"]())
    assert error < 0.02 and rise < 1e-6 and residual < 0.05


@pytest.mark.study
def test_2000_discs_run_out_of_a_silo_at_hagens_rate():
    """Mass is kept (none is lost or gets through a wall), and the rate is right to the law's own 25 %."""
    error, rise, residual = measured(silo())
    assert error < 0.25 and rise < 1e-6 and residual < 0.05
