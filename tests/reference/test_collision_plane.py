"""Contacts in the plane, against SciPy's least squares, directions tried one by one, pymunk, and by hand."""

import itertools

import numpy as np
import pytest

from reference import Box, Capsule, Disc, Plane, Polygon, Scene
from tests.geometry import (
    assert_smallest_gap_is_the_distance,
    contacts_of,
    directions,
    overlap_along,
    pair_contacts,
    shrunk,
)

SHAPES = {
    "disc": Disc(0.4),
    "box": Box((0.5, 0.3)),
    "thin box": Box((1.0, 1e-3)),
    "capsule": Capsule(0.3, 0.6),
}
PAIRS = list(itertools.combinations_with_replacement(SHAPES, 2))


def random_pair(rng, names, spread, scale=1.0):
    return [
        (
            shrunk(SHAPES[name], scale),
            scale * rng.uniform(-spread, spread, size=2),
            rng.uniform(-np.pi, np.pi),
        )
        for name in names
    ]


@pytest.mark.parametrize("names", PAIRS, ids=" - ".join)
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_the_smallest_gap_of_a_separated_pair_is_the_distance(names, scale):
    rng = np.random.default_rng(1)
    assert_smallest_gap_is_the_distance(lambda: random_pair(rng, names, 1.5, scale), scale, 15)


@pytest.mark.parametrize("names", PAIRS, ids=" - ".join)
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_depth_is_the_least_overlap_of_all_directions(names, scale):
    rng, seen = np.random.default_rng(2), 0
    n = directions(rng, 2000, 2)
    while seen < 15:
        pair = random_pair(rng, names, 0.45, scale)
        if overlap_along(*pair, n).min() < 0.01 * scale:
            continue
        seen += 1
        found = pair_contacts(*pair, margin=0.0)
        assert len(found["gap"]) >= 1
        claimed = overlap_along(*pair, found["frame"][:, 0]).min()
        assert claimed <= overlap_along(*pair, n).min() + 1e-6 * scale
        assert -found["gap"].min() <= claimed + 1e-9 * scale


def regular(corners, radius, angle):
    φ = angle + 2 * np.pi * np.arange(corners) / corners
    return np.stack([radius * np.cos(φ), radius * np.sin(φ)], axis=1)


def test_polygons_agree_with_pymunk():
    """The same depth and n; where n differs, the way out is no longer than theirs."""
    pymunk = pytest.importorskip("pymunk")
    rng, seen, same = np.random.default_rng(3), 0, 0
    space = pymunk.Space()
    while seen < 120:
        pair, theirs = zip(*(random_body(pymunk, space, rng) for _ in range(2)), strict=True)
        try:
            points = theirs[0].shapes_collide(theirs[1])
        except AssertionError:  # pymunk's way to say that they don't touch
            assert len(pair_contacts(*pair, margin=0.0)["gap"]) == 0
            continue
        depth = -min(p.distance for p in points.points)
        if depth < 1e-3:
            continue
        seen += 1
        found = pair_contacts(*pair, margin=0.0)
        if found["frame"][0, 0] @ points.normal > 0.9999:
            same += 1
            assert -found["gap"].min() == pytest.approx(depth, abs=1e-6)
            assert len(found["gap"]) == len(points.points)
        else:
            assert -found["gap"].min() <= depth + 1e-6
    assert same > 0.9 * seen


def random_body(pymunk, space, rng):
    """((shape, position, angle), pymunk's shape)."""
    position, angle, kind = rng.uniform(-0.8, 0.8, size=2), rng.uniform(-np.pi, np.pi), rng.integers(3)
    body = pymunk.Body(1, 1)
    if kind == 0:
        shape, other = Disc(0.5), pymunk.Circle(body, 0.5)
    elif kind == 1:
        shape, other = Box((0.7, 0.2)), pymunk.Poly.create_box(body, (1.4, 0.4))
    else:
        shape = Polygon(regular(rng.integers(3, 8), rng.uniform(0.3, 0.8), 0.1))
        other = pymunk.Poly(body, shape.vertices)
    body.position, body.angle = tuple(position), angle
    space.add(body, other)
    space.reindex_shapes_for_body(body)
    return (shape, position, angle), other


# --- manifolds, by hand -------------------------------------------------------------------------------------


def sorted_points(found):
    return np.array(sorted(found["point"].tolist()))


def test_box_on_a_tilted_plane():
    θ = 0.3
    n = np.array([-np.sin(θ), np.cos(θ)])
    t = np.array([np.cos(θ), np.sin(θ)])
    found = pair_contacts((Plane(n), (0, 0), None), (Box((2, 0.5)), 0.499 * n, θ), 1e-6)
    np.testing.assert_allclose(found["gap"], -1e-3, atol=1e-12)
    np.testing.assert_allclose(sorted_points(found), [-2 * t - 5e-4 * n, 2 * t - 5e-4 * n], atol=1e-12)
    np.testing.assert_allclose(found["frame"], [[n, -t]] * 2, atol=1e-12)


def test_the_same_by_an_orientation_of_the_plane():
    found = pair_contacts((Plane((0, 1)), (0, 0), 0.3), (Disc(1), (0, 0), 0.0), 0.0)
    np.testing.assert_allclose(found["frame"][0, 0], (-np.sin(0.3), np.cos(0.3)), atol=1e-12)
    assert found["gap"][0] == pytest.approx(-1)


def test_shifted_boxes_are_cut_to_each_other():
    found = pair_contacts((Box((1, 1)), (0, 0), 0.0), (Box((1, 1)), (0.5, 2), 0.0), 1e-6)
    np.testing.assert_allclose(sorted_points(found), [(-0.5, 1), (1, 1)], atol=1e-12)


def test_corner_to_corner():
    found = pair_contacts((Box((1, 1)), (0, 0), 0.0), (Box((1, 1)), (2.3, 2.4), 0.0), 1.0)
    assert found["gap"] == pytest.approx([0.5])
    np.testing.assert_allclose(found["frame"][0, 0], (0.6, 0.8), atol=1e-12)
    np.testing.assert_allclose(found["point"][0], (1.15, 1.2), atol=1e-12)


def test_capsules_side_by_side_and_end_to_end():
    beside = pair_contacts((Capsule(0.2, 1), (0, 0), 0.0), (Capsule(0.3, 1), (0.5, 0.5), 0.0), 1e-6)
    np.testing.assert_allclose(sorted_points(beside), [(0.2, -0.5), (0.2, 1)], atol=1e-12)
    ends = pair_contacts((Capsule(0.2, 1), (0, 0), 0.0), (Capsule(0.3, 1), (0, 2.6), 0.0), 0.2)
    assert ends["gap"] == pytest.approx([0.1])
    np.testing.assert_allclose(ends["frame"][0, 0], (0, 1), atol=1e-12)


@pytest.mark.parametrize(
    "pair, depth",
    [
        (((Disc(0.5), (0, 0), 0.0), (Disc(0.3), (0, 0), 0.0)), 0.8),
        (((Box((1, 2)), (0, 0), 0.0), (Disc(0.5), (0.25, 0), 0.0)), 1.25),
        (((Box((1, 1)), (0, 0), 0.0), (Box((1, 1)), (0, 0), 0.0)), 2),
        (((Capsule(0.2, 1), (0, 0), 0.0), (Capsule(0.3, 1), (0, 0), 0.0)), 0.5),
        (((Capsule(0.2, 1), (0, 0), 0.0), (Disc(0.3), (0, 0.5), 0.0)), 0.5),
        (((Box((1, 1)), (0, 0), 0.0), (Capsule(0.25, 0.5), (0, 0), 0.0)), 1.25),
        (((Plane((0, 1)), (0, 0), None), (Box((1, 1)), (0, -50), 0.0)), 51),
    ],
)
def test_coinciding_centres_and_deep_overlaps_are_parted_along_the_shortest_way(pair, depth):
    found = pair_contacts(*pair, margin=0.0)
    assert -found["gap"].min() == pytest.approx(depth, rel=1e-6)
    for values in found.values():
        assert np.isfinite(values).all()


def pyramid(base, jolt, rng):
    scene = Scene(gravity=(0, -9.81))
    scene.add(Plane((0, 1)))
    for row in range(base):
        for k in range(base - row):
            position = np.array([k - (base - row) / 2 + 0.05 * k, row + 0.5]) + jolt * rng.normal(size=2)
            scene.add(Box((0.5, 0.5)), position=position, orientation=jolt * rng.normal())
    return scene


def test_a_resting_pyramid_keeps_its_contacts():
    rng = np.random.default_rng(4)
    first, _ = contacts_of(pyramid(6, 0, rng), margin=1e-4)
    assert len(first["id"]) == 2 * (6 + 2 * 15)
    for _ in range(5):
        found, _ = contacts_of(pyramid(6, 1e-9, rng), margin=1e-4)
        np.testing.assert_array_equal(found["bodies"], first["bodies"])
        np.testing.assert_array_equal(found["id"], first["id"])
        np.testing.assert_allclose(found["point"], first["point"], atol=1e-7)


def test_an_aligned_stack_keeps_its_contacts():
    rng, seen = np.random.default_rng(5), []
    for jolt in (0, 1e-9, 1e-9, 1e-9):
        scene = Scene(gravity=(0, -9.81))
        for k in range(5):
            place = np.array([0, k]) + jolt * rng.normal(size=2)
            scene.add(Box((0.5, 0.5)), position=place, orientation=jolt * rng.normal())
        found, _ = contacts_of(scene, margin=1e-4)
        seen.append(found["id"].tolist())
    assert len(seen[0]) == 8
    assert seen.count(seen[0]) == 4
