"""Contacts in space, against SciPy's least squares, directions tried one by one, pybullet, and by hand."""

import itertools

import numpy as np
import pytest

from reference import Box, Capsule, Plane, Scene, Sphere
from tests.geometry import (
    assert_smallest_gap_is_the_distance,
    contacts_of,
    directions,
    overlap_along,
    pair_contacts,
    random_quaternion,
    shrunk,
)

SHAPES = {
    "sphere": Sphere(0.4),
    "box": Box((0.5, 0.3, 0.7)),
    "thin box": Box((1.0, 0.8, 1e-3)),
    "capsule": Capsule(0.3, 0.6),
}
PAIRS = list(itertools.combinations_with_replacement(SHAPES, 2))
UPRIGHT = (1.0, 0, 0, 0)


def turned(axis, angle):
    return (np.cos(angle / 2), *(np.sin(angle / 2) * np.array(axis, dtype=float) / np.linalg.norm(axis)))


def random_pair(rng, names, spread, scale=1.0):
    return [
        (shrunk(SHAPES[name], scale), scale * rng.uniform(-spread, spread, size=3), random_quaternion(rng))
        for name in names
    ]


@pytest.mark.parametrize("names", PAIRS, ids=" - ".join)
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_the_smallest_gap_of_a_separated_pair_is_the_distance(names, scale):
    rng = np.random.default_rng(1)
    assert_smallest_gap_is_the_distance(lambda: random_pair(rng, names, 1.2, scale), scale, 12)


@pytest.mark.parametrize("names", PAIRS, ids=" - ".join)
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_depth_is_the_least_overlap_of_all_directions(names, scale):
    rng, seen = np.random.default_rng(2), 0
    n = directions(rng, 3000, 3)
    while seen < 12:
        pair = random_pair(rng, names, 0.45, scale)
        if overlap_along(*pair, n).min() < 0.01 * scale:
            continue
        seen += 1
        found = pair_contacts(*pair, margin=0.0)
        assert len(found["gap"]) >= 1
        normals = found["frame"][:, 0]
        if names != ("capsule", "capsule"):
            assert np.ptp(normals, axis=0).max() < 1e-12
        claimed = overlap_along(*pair, normals).min()
        assert claimed <= overlap_along(*pair, n).min() + 2e-4 * scale
        assert -found["gap"].min() <= claimed + 1e-9 * scale


# --- manifolds, by hand -------------------------------------------------------------------------------------


def sorted_points(found):
    return np.array(sorted(found["point"].tolist()))


def test_box_on_plane_touches_at_four_corners():
    found = pair_contacts((Plane((0, 0, 2)), (0, 0, 0), None), (Box((1, 2, 3)), (5, 5, 2.999), UPRIGHT), 0.01)
    expected = [(4, 3, -5e-4), (4, 7, -5e-4), (6, 3, -5e-4), (6, 7, -5e-4)]
    np.testing.assert_allclose(sorted_points(found), expected, atol=1e-12)
    np.testing.assert_allclose(found["gap"], -1e-3, atol=1e-12)
    np.testing.assert_allclose(
        found["frame"], np.tile([(0, 0, 1), (1, 0, 0), (0, 1, 0)], (4, 1, 1)), atol=1e-15
    )
    np.testing.assert_allclose(found["arm"][:, 1], found["point"] - (5, 5, 2.999), atol=1e-12)
    assert (found["slot"] == (-1, 0)).all()
    assert len(set(found["id"])) == 4


def test_capsule_on_plane_touches_at_two_points():
    lying = (Capsule(0.2, 1.0), (0, 0, 0.2), turned((0, 1, 0), np.pi / 2))
    found = pair_contacts((Plane((0, 0, 1)), (0, 0, 0), None), lying, 1e-6)
    np.testing.assert_allclose(sorted_points(found), [(-1, 0, 0), (1, 0, 0)], atol=1e-12)


def test_boxes_stacked_askew_share_an_octagon_of_which_four_corners_are_kept():
    half = (Box((1, 1, 1)), (0, 0, 2.0), turned((0, 0, 1), np.pi / 4))
    found = pair_contacts((Box((1, 1, 1)), (0, 0, 0), UPRIGHT), half, 1e-6)
    assert len(found["gap"]) == 4
    p = found["point"]
    np.testing.assert_allclose(p[:, 2], 1, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(p[:, :2], axis=1), np.hypot(1, np.sqrt(2) - 1), atol=1e-12)
    angles = np.sort(np.arctan2(p[:, 1], p[:, 0]))
    gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi))
    assert gaps.max() < np.pi * 0.8  # they surround the middle widely


def test_overlapping_faces_are_cut_to_each_other():
    upper = (Box((1, 1, 1)), (1.5, 0.5, 2.0), UPRIGHT)
    found = pair_contacts((Box((1, 1, 1)), (0, 0, 0), UPRIGHT), upper, 1e-6)
    expected = [(0.5, -0.5, 1), (0.5, 1, 1), (1, -0.5, 1), (1, 1, 1)]
    np.testing.assert_allclose(sorted_points(found), expected, atol=1e-12)


def test_crossed_edges_touch_in_one_point():
    lower = (Box((2, 0.5, 0.5)), (0, 0, 0), turned((1, 0, 0), np.pi / 4))
    r = np.sqrt(0.5)
    upper = (Box((0.5, 2, 0.5)), (0.3, 0.2, 2 * r - 0.01), turned((0, 1, 0), np.pi / 4))
    found = pair_contacts(lower, upper, 1e-3)
    assert len(found["gap"]) == 1
    np.testing.assert_allclose(found["point"], [(0.3, 0, r - 0.005)], atol=1e-9)
    np.testing.assert_allclose(found["frame"][0, 0], (0, 0, 1), atol=1e-9)
    assert found["gap"][0] == pytest.approx(-0.01)


def test_parallel_capsules_touch_at_the_ends_of_what_they_share():
    lying = turned((0, 1, 0), np.pi / 2)
    lower, upper = (Capsule(0.2, 1.0), (0, 0, 0), lying), (Capsule(0.3, 1.0), (0.5, 0, 0.5), lying)
    found = pair_contacts(lower, upper, 1e-6)
    np.testing.assert_allclose(sorted_points(found), [(-0.5, 0, 0.2), (1, 0, 0.2)], atol=1e-12)


def test_capsule_lying_on_a_box_that_is_shorter():
    lying = (Capsule(0.2, 1.0), (0.5, 0, 0.7), turned((0, 1, 0), np.pi / 2))
    found = pair_contacts((Box((1, 1, 0.5)), (0, 0, 0), UPRIGHT), lying, 1e-6)
    np.testing.assert_allclose(sorted_points(found), [(-0.5, 0, 0.5), (1, 0, 0.5)], atol=2e-5)


@pytest.mark.parametrize(
    "pair, depth",
    [
        (((Sphere(0.5), (0, 0, 0), UPRIGHT), (Sphere(0.3), (0, 0, 0), UPRIGHT)), 0.8),
        (((Box((1, 2, 3)), (0, 0, 0), UPRIGHT), (Sphere(0.5), (0.25, 0, 0), UPRIGHT)), 1.25),
        (((Box((1, 1, 1)), (0, 0, 0), UPRIGHT), (Box((1, 1, 1)), (0, 0, 0), UPRIGHT)), 2),
        (((Capsule(0.2, 1), (0, 0, 0), UPRIGHT), (Capsule(0.3, 1), (0, 0, 0), UPRIGHT)), 0.5),
        (((Capsule(0.2, 1), (0, 0, 0), UPRIGHT), (Sphere(0.3), (0, 0, 0.5), UPRIGHT)), 0.5),
        (((Box((1, 1, 1)), (0, 0, 0), UPRIGHT), (Capsule(0.25, 0.5), (0, 0, 0), UPRIGHT)), 1.25),
        (((Plane((0, 0, 1)), (0, 0, 0), None), (Box((1, 1, 1)), (0, 0, -50), UPRIGHT)), 51),
    ],
)
def test_coinciding_centres_and_deep_overlaps_are_parted_along_the_shortest_way(pair, depth):
    found = pair_contacts(*pair, margin=0.0)
    assert -found["gap"].min() == pytest.approx(depth, rel=1e-6)
    for values in found.values():
        assert np.isfinite(values).all()
    np.testing.assert_allclose(np.linalg.det(found["frame"]), 1, atol=1e-12)


def test_a_thin_plate_lies_on_a_big_floor():
    """Aspect 1:1000, and a floor a million times as large as the plate is thick."""
    floor = (Box((1e3, 1e3, 1e3)), (0, 0, -1e3), UPRIGHT)
    plate = (Box((1, 1, 1e-3)), (300, -200, 1e-3), turned((0, 0, 1), 0.3))
    found = pair_contacts(floor, plate, 1e-9)
    assert len(found["gap"]) == 4
    assert np.ptp(found["point"], axis=0)[:2].min() > 1


# --- ids, ties and frames -----------------------------------------------------------------------------------


def towers(jolt, rng):
    """Three aligned boxes, then one askew, then a capsule and a plate on a plane; each moved by ``jolt``."""
    scene = Scene()
    scene.add(Plane((0, 0, 1)))
    for k in range(5):
        askew = 0.5 if k > 2 else 0.0
        q = np.array(turned((0, 0, 1), askew)) + jolt * rng.normal(size=4)
        position = np.array([0, 0, 0.5 + k]) + jolt * rng.normal(size=3)
        scene.add(Box((0.5, 0.5, 0.5)), position=position, orientation=q / np.linalg.norm(q))
    q = np.array(turned((1, 0, 0), np.pi / 2)) + jolt * rng.normal(size=4)
    scene.add(Capsule(0.2, 0.4), position=(0, 0, 5.2), orientation=q / np.linalg.norm(q))
    return scene


def test_resting_manifolds_do_not_flicker():
    rng = np.random.default_rng(3)
    first, _ = contacts_of(towers(0, rng), margin=1e-4)
    assert len(first["id"]) == 4 * 5 + 2
    for _ in range(10):
        found, _ = contacts_of(towers(1e-9, rng), margin=1e-4)
        np.testing.assert_array_equal(found["bodies"], first["bodies"])
        np.testing.assert_array_equal(found["id"], first["id"])
        np.testing.assert_allclose(found["point"], first["point"], atol=1e-7)
        np.testing.assert_allclose(found["frame"], first["frame"], atol=1e-7)


def frame_along(n):
    return pair_contacts((Sphere(1), -n, UPRIGHT), (Sphere(1), n, UPRIGHT), 1)["frame"][0]


def test_tangents_turn_slowly_and_do_not_depend_on_the_sign_of_n():
    n = directions(np.random.default_rng(4), 60, 3)
    n = np.concatenate([n, np.eye(3), -np.eye(3)])
    for direction in n:
        frames = [frame_along(s * direction) for s in (1, -1)]
        np.testing.assert_allclose(frames[0] @ frames[0].T, np.eye(3), atol=1e-12)
        assert np.linalg.det(frames[0]) == pytest.approx(1)
        np.testing.assert_allclose(frames[1], frames[0] * [[-1], [1], [-1]], atol=1e-9)
        turned_a_little = frame_along(direction + 1e-6 * n[0])
        assert np.abs(turned_a_little - frames[0]).max() < 1e-4
    for axis, t1 in ((2, 0), (1, 0), (0, 1)):
        np.testing.assert_allclose(frame_along(np.eye(3)[axis])[1], np.eye(3)[t1], atol=1e-15)


# --- against pybullet ---------------------------------------------------------------------------------------


def test_gaps_agree_with_pybullet():
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    rng = np.random.default_rng(5)
    worst = 0.0
    try:
        for names in PAIRS:
            if "thin box" in names:
                continue
            for _ in range(6):
                pair = random_pair(rng, names, 1.0)
                bodies = [in_bullet(pybullet, *body) for body in pair]
                theirs = pybullet.getClosestPoints(*bodies, distance=5)
                d = min(point[8] for point in theirs)
                found = pair_contacts(*pair, margin=5)
                worst = max(worst, abs(found["gap"].min() - d)) if d > 0 else worst
                assert (found["gap"].min() > 0) == (d > 0) or abs(d) < 1e-3
    finally:
        pybullet.disconnect(client)
    assert worst < 2e-3  # GJK in single precision with margins


def in_bullet(pybullet, shape, position, orientation):
    kinds = {Sphere: pybullet.GEOM_SPHERE, Box: pybullet.GEOM_BOX, Capsule: pybullet.GEOM_CAPSULE}
    sizes = {
        Sphere: lambda: {"radius": shape.radius},
        Box: lambda: {"halfExtents": shape.half_extents},
        Capsule: lambda: {"radius": shape.radius, "height": 2 * shape.half_length},
    }
    form = pybullet.createCollisionShape(kinds[type(shape)], **sizes[type(shape)]())
    w, x, y, z = orientation
    return pybullet.createMultiBody(1, form, -1, list(position), [x, y, z, w])
