"""Which pairs meet: against brute force, in any order of the bodies, of any size; and what arrays hold."""

import json
import os
import subprocess
import sys
import time

import numpy as np
import pytest

from reference import BallJoint, Box, Capsule, Disc, Plane, Point, Polygon, Scene, Sphere
from reference.collision import count_pairs, find_contacts, make_collider
from reference.compiled import COMPILED
from reference.layout import Bodies
from tests.geometry import contacts_of, random_quaternion
from tests.house.tree import ROOT


def crowd(d, count, rng, sizes=(0.3, 0.6), spread=None):
    """Keyword arguments of bodies of all shapes, thrown into a cube, and of a floor and a wall."""
    spread = count ** (1 / d) / 2 if spread is None else spread
    parts = []
    for _ in range(count):
        s = np.exp(rng.uniform(*np.log(sizes)))
        kind = rng.integers(3)
        if d == 3:
            shapes = Sphere(s), Box(tuple(s * rng.uniform(0.3, 1, size=3))), Capsule(0.4 * s, 0.6 * s)
        else:
            corners = s * np.array([(0, 0), (1, 0.1), (0.9, 0.8), (0.2, 1)])
            shapes = Disc(s), Polygon(corners), Capsule(0.4 * s, 0.6 * s)
        parts.append(
            {
                "shape": shapes[kind],
                "position": rng.uniform(-spread, spread, size=d),
                "orientation": random_quaternion(rng) if d == 3 else rng.uniform(-3, 3),
                "velocity": rng.normal(size=d),
                "static": False,
            }
        )
    for i in rng.integers(count, size=count // 10):
        parts[i] |= {"static": True, "velocity": 0}
    for axis in (0, d - 1):
        parts.append({"shape": Plane(np.eye(d)[axis]), "position": -0.8 * spread * np.eye(d)[axis]})
    return parts


def scene_of(parts, d):
    scene = Scene(gravity=np.zeros(d))
    for part in parts:
        scene.add(**part)
    return scene


def overlapping_boxes(collider, scene):
    """All pairs whose bounding boxes overlap and that the scene lets collide, by comparing each with each."""
    low, high = collider.solids.low, collider.solids.high
    meet = np.all((low[:, None] <= high) & (low <= high[:, None]), axis=-1)
    number = collider.solids.number
    met = {(int(number[a]), int(number[b])) for a, b in np.argwhere(np.triu(meet, 1))}
    return met & set(scene.colliding_pairs())


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("sizes", [(0.3, 0.6), (1e-3, 10)])
def test_pairs_are_those_of_brute_force(d, sizes):
    rng = np.random.default_rng(1)
    scene = scene_of(crowd(d, 150, rng, sizes), d)
    for part in range(0, 60, 2):
        scene.pair(part, part + 1, collide=False)
    bodies = Bodies(scene)
    collider = make_collider(bodies, scene)
    state = bodies.state()
    find_contacts(collider, state, 0.02)
    found, _ = collider.detect(*collider.arrays, collider.contacts, state, 0.02, 0.0)
    solids, pairs = collider.solids, collider.arrays[2]
    ours = [(int(solids.number[a]), int(solids.number[b])) for a, b in pairs[:found]]
    assert ours == sorted(ours)
    assert len(set(ours)) == len(ours)
    planes = {150, 151}
    expected = overlapping_boxes(collider, scene)
    assert {p for p in ours if not planes & set(p)} == {p for p in expected if not planes & set(p)}
    assert set(ours) <= expected
    touching = {tuple(map(int, p)) for p in collider.contacts.bodies[: collider.count]}
    assert touching <= set(ours)
    assert any(planes & set(p) for p in touching)


def comparable(found, number_of):
    """Contacts as rows that don't depend on numbers: n from the body with the lower *original* number."""
    i, j = number_of[found["bodies"]].T
    turn = np.where(i < j, 1.0, -1.0)[:, None]
    rows = np.hstack(
        [
            np.minimum(i, j)[:, None],
            np.maximum(i, j)[:, None],
            found["point"],
            turn * found["frame"][:, 0],
            found["gap"][:, None],
        ]
    )
    return rows[np.lexsort(rows.round(9).T[::-1])]


@pytest.mark.parametrize("d", [2, 3])
def test_contacts_do_not_depend_on_the_order_of_the_bodies(d):
    rng = np.random.default_rng(2)
    parts = crowd(d, 120, rng)
    for k in range(6):  # aligned boxes, where everything ties
        parts.append({"shape": Box((0.5,) * d), "position": [20.0 + k % 2] + [0.0] * (d - 2) + [k // 2]})
    first, _ = contacts_of(scene_of(parts, d), 0.05)
    assert len(first["gap"]) > 150
    for _ in range(2):
        order = rng.permutation(len(parts))
        found, _ = contacts_of(scene_of([parts[k] for k in order], d), 0.05)
        assert (found["bodies"][:, 0] < found["bodies"][:, 1]).all()
        ours, theirs = comparable(found, order), comparable(first, np.arange(len(parts)))
        np.testing.assert_allclose(ours, theirs, atol=1e-12)
        key = np.lexsort((found["id"], found["bodies"][:, 1], found["bodies"][:, 0]))
        np.testing.assert_array_equal(key, np.arange(len(key)))


def test_filters_are_the_scenes_own():
    scene = Scene()
    a = scene.add(Sphere(1), group="g")
    b = scene.add(Sphere(1), group="g")
    c = scene.add(Sphere(1), static=True)
    d = scene.add(Box((1, 1, 1)), static=True)
    e = scene.add(Point())
    f = scene.add(Capsule(1, 0))
    scene.add(Plane((0, 0, 1)))
    scene.pair(b, c, collide=False)
    scene.join(BallJoint(a, f, point=(0, 0, 0)))
    scene.join(BallJoint(b, f, point=(0, 0, 0), collide=True))
    found, _ = contacts_of(scene)
    assert {tuple(map(int, p)) for p in found["bodies"]} == set(scene.colliding_pairs())
    assert count_pairs(scene) == len(set(scene.colliding_pairs()))
    assert e not in found["bodies"] and d in found["bodies"]


@pytest.mark.parametrize(
    "ruling", [lambda s: s.pair(0, 1, collide=False), lambda s: s.join(BallJoint(0, 1, point=(0, 0, 0)))]
)
def test_nothing_is_built_where_nothing_can_touch(ruling):
    scene = Scene()
    scene.add(Sphere(1))
    scene.add(Sphere(1))
    assert count_pairs(scene) == 1
    ruling(scene)
    scene.add(Point())
    assert count_pairs(scene) == 0 == len(list(scene.colliding_pairs()))
    assert make_collider(Bodies(scene), scene) is None
    assert count_pairs(Scene()) == 0


def test_friction_and_restitution_of_a_pair():
    scene = Scene()
    for friction, restitution in ((0.5, 0.1), (0.4, 0.3), (0.7, 0.2)):
        scene.add(Sphere(1), friction=friction, restitution=restitution)
    scene.pair(0, 2, friction=0.9)
    scene.pair(2, 1, restitution=0.0)
    found, _ = contacts_of(scene)
    np.testing.assert_array_equal(found["bodies"], [(0, 1), (0, 2), (1, 2)])
    np.testing.assert_allclose(found["friction"], [0.2, 0.9, 0.28])
    np.testing.assert_allclose(found["restitution"], [0.3, 0.2, 0.0])


def test_a_body_whose_principal_axes_are_turned_keeps_its_shape():
    rng = np.random.default_rng(3)
    q = random_quaternion(rng)
    tensor = np.array([[0.5, 0.1, 0.02], [0.1, 0.6, 0.05], [0.02, 0.05, 0.7]])
    found = []
    for inertia in (None, tensor):
        scene = Scene()
        scene.add(Plane((0, 0, 1)))
        scene.add(Box((0.3, 0.4, 0.5)), position=(0, 0, 0.2), orientation=q, inertia=inertia)
        found.append(contacts_of(scene, 0.1)[0])
    np.testing.assert_allclose(found[0]["point"], found[1]["point"], atol=1e-12)


def test_solids_follow_the_state_and_arrays_grow():
    scene = Scene(gravity=(0, 0))
    for _ in range(60):
        scene.add(Disc(1))
    bodies = Bodies(scene)
    collider = make_collider(bodies, scene)
    assert find_contacts(collider, bodies.state(), 0) == 60 * 59 // 2  # all in one place
    apart = np.stack([2.5 * np.arange(60.0), np.zeros(60)], axis=1)
    state = bodies.state(position=apart)
    assert find_contacts(collider, state, 0) == 0 == collider.count
    assert find_contacts(collider, state, 0.500001) == 59
    state.v[0] = 10, 0
    assert find_contacts(collider, state, 0.0, h=0.06) == 1  # it may come .6 m within .06 s
    state.x[5] = np.nan
    assert find_contacts(collider, state, 0.500001) == 57


RUNS = """
import json, sys
import numpy as np
from reference.compiled import COMPILED
from tests.geometry import contacts_of
from tests.reference.test_collision_pairs import crowd, scene_of
results = {"compiled": COMPILED}
for d in (2, 3):
    found, _ = contacts_of(scene_of(crowd(d, 60, np.random.default_rng(6)), d), 0.05)
    results[str(d)] = [np.asarray(a).ravel().tolist() for a in found.values()]
json.dump(results, sys.stdout)
"""


@pytest.mark.skipif(not COMPILED, reason="needs Numba")
def test_compiled_and_plain_give_the_same():
    answers = []
    for switch in "10":
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "REFERENCE_COMPILED": switch}
        done = subprocess.run(
            [sys.executable, "-c", RUNS], env=environment, capture_output=True, text=True, check=True
        )
        answers.append(json.loads(done.stdout))
    assert answers[0].pop("compiled") and not answers[1].pop("compiled")
    for d in "23":
        assert len(answers[0][d][0]) > 40
        for ours, theirs in zip(answers[0][d], answers[1][d], strict=True):
            np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12)


def test_time_grows_as_the_number_of_bodies_does():
    """Ten times as many spheres in a cubic lattice take about ten times as long, not a hundred times."""
    times = []
    for n in (800, 8000):
        side = round(n ** (1 / 3))
        scene = Scene()
        for k in range(n):
            scene.add(Sphere(0.5), position=(k % side, k // side % side, k // side**2))
        bodies = Bodies(scene)
        collider, state = make_collider(bodies, scene), bodies.state()
        find_contacts(collider, state, 0.01)
        seconds = []
        for _ in range(5):
            start = time.process_time()
            find_contacts(collider, state, 0.01)
            seconds.append(time.process_time() - start)
        times.append(np.median(seconds))
    if COMPILED:
        assert times[1] < 25 * times[0]
