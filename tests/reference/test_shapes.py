"""Inertia against pymunk, against integrals by SciPy, and against itself put together from parts."""

import numpy as np
import pymunk
import pytest
from scipy.integrate import quad
from scipy.spatial.transform import Rotation

from reference import Box, Capsule, Disc, Plane, Point, Polygon, Sphere
from reference.inertia import checked_inertia, composite_inertia, parallel_axis, principal_axes
from reference.rotation import rotation_matrix

TRIANGLE = [(0, 0), (1, 0), (0.2, 0.7)]


def test_planar_shapes_are_pymunks():
    assert Disc(0.7).inertia(3) == pytest.approx(pymunk.moment_for_circle(3, 0, 0.7), rel=1e-14)
    assert Box((0.5, 0.2)).inertia(3) == pytest.approx(pymunk.moment_for_box(3, (1, 0.4)), rel=1e-14)
    polygon = Polygon(TRIANGLE)
    moment = pymunk.moment_for_poly(3, [tuple(v) for v in polygon.vertices])
    assert polygon.inertia(3) == pytest.approx(moment, rel=1e-13)
    assert (
        np.abs(np.mean(polygon.vertices, axis=0)).max() < 1e-16
    )  # a triangle's centroid is its vertices' mean


def test_polygon_forgets_origin_and_sense():
    moved = Polygon([(x + 3, y - 2) for x, y in TRIANGLE])
    assert moved.inertia(1) == pytest.approx(Polygon(TRIANGLE).inertia(1), rel=1e-13)
    turned = Polygon(TRIANGLE[::-1])
    assert sorted(turned.vertices) == sorted(Polygon(TRIANGLE).vertices)


def profile_of_capsule(r, h, z):
    return np.sqrt(max(0.0, r**2 - max(0.0, abs(z) - h) ** 2))


@pytest.mark.parametrize(("r", "h"), [(0.3, 0.8), (1, 0), (0.5, 0.01)])
def test_capsule_by_integration_of_its_slices(r, h):
    """Discs of radius ρ(z): about z ½ ρ² dm, across ¼ ρ² dm + z² dm; in the plane strips of width 2 ρ."""

    def integral(f):
        return sum(quad(f, a, b, epsabs=1e-13)[0] for a, b in ((-h - r, -h), (-h, h), (h, h + r)))

    ρ = lambda z: profile_of_capsule(r, h, z)
    volume = integral(lambda z: np.pi * ρ(z) ** 2)
    along = integral(lambda z: np.pi * ρ(z) ** 4 / 2) / volume
    across = integral(lambda z: np.pi * ρ(z) ** 2 * (ρ(z) ** 2 / 4 + z**2)) / volume
    assert np.allclose(Capsule(r, h).inertia(2), np.diag([2 * across, 2 * across, 2 * along]), rtol=1e-8)
    area = integral(lambda z: 2 * ρ(z))
    second = integral(lambda z: 2 * ρ(z) * z**2 + 2 * ρ(z) ** 3 / 3) / area
    assert Capsule(r, h).inertia(2, dimension=2) == pytest.approx(2 * second, rel=1e-7)


def test_box_and_sphere():
    assert np.allclose(Box((1, 2, 3)).inertia(12), np.diag([12 * 13 / 3, 12 * 10 / 3, 12 * 5 / 3]))
    assert np.allclose(Sphere(2).inertia(5), 8 * np.eye(3))


def test_a_box_put_together_from_turned_halves():
    whole = Box((1, 2, 3)).inertia(6)
    q = Rotation.from_rotvec((0, 0, np.pi / 2)).as_quat(scalar_first=True)
    half = Box((2, 0.5, 3)).inertia(3)  # lies on its side: turned by q it is half of the whole
    mass, centre, inertia = composite_inertia([3, 3], [(-0.5, 7, 0), (0.5, 7, 0)], [half, half], [q, q])
    assert mass == 6 and np.allclose(centre, (0, 7, 0)) and np.allclose(inertia, whole)


def test_a_hole_is_a_negative_part():
    mass, centre, inertia = composite_inertia(
        [4, -1], [(0, 0), (0.2, 0)], [Box((1, 1)).inertia(4), Box((0.5, 0.5)).inertia(-1)]
    )
    outer, inner = [(-1, -1), (1, -1), (1, 1), (-1, 1)], 0.5
    polygon = pymunk.moment_for_poly(4, outer)
    assert mass == 3 and np.allclose(centre, (-0.2 / 3, 0))
    by_hand = polygon - (2 * inner**2 / 3 + 0.2**2) - 3 * (0.2 / 3) ** 2
    assert inertia == pytest.approx(by_hand)


def test_parallel_axis():
    assert parallel_axis(2.0, 3, (1, 2)) == 17
    assert np.allclose(parallel_axis(np.zeros((3, 3)), 2, (0, 0, 3)), np.diag([18, 18, 0]))


def test_principal_axes_of_a_turned_tensor():
    R = Rotation.from_rotvec((0.3, -1, 0.5)).as_matrix()
    moments, q = principal_axes(R @ np.diag([1, 2, 2.5]) @ R.T)
    assert np.allclose(
        rotation_matrix(q) @ np.diag(moments) @ rotation_matrix(q).T, R @ np.diag([1, 2, 2.5]) @ R.T
    )
    moments, q = principal_axes(np.diag([3.0, 1, 2.5]))
    assert list(moments) == [3, 1, 2.5] and list(q) == [1, 0, 0, 0]


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Sphere(0), "radius must be a finite number greater than 0, but is 0"),
        (lambda: Sphere(float("nan")), "radius must be a finite number"),
        (lambda: Sphere("big"), "radius must be a number, but is 'big'"),
        (lambda: Box((1, 2, 3, 4)), "half_extents must be 2 or 3 lengths"),
        (lambda: Box((1, -2)), "half_extents must be a finite number greater than 0, but is -2"),
        (lambda: Capsule(1, -1), "half_length must be a finite number of at least 0"),
        (lambda: Plane((0, 0, 0)), "normal must be a direction"),
        (lambda: Plane(1), "normal must have 2 or 3 components"),
        (lambda: Polygon([(0, 0), (1, 0)]), "vertices must be at least 3 points"),
        (lambda: Polygon(3), "vertices must be at least 3 points (x, y), but are 3"),
        (lambda: Polygon(None), "vertices must be at least 3 points (x, y), but are None"),
        (lambda: Polygon([(0, 0), (1,), (0, 1)]), "vertices must be an array of numbers of shape (3, 2)"),
        (lambda: Polygon([("0", "0"), ("1", "0"), ("0", "1")]), "vertices must be an array of numbers"),
        (lambda: Sphere(True), "radius must be a number, but is True"),
        (lambda: Polygon([(0, 0), (1, 0), (2, 0)]), "convex polygon"),
        (lambda: Polygon([(0, 0), (2, 0), (1, 0.2), (1, 2)]), "convex polygon"),
        (lambda: Polygon(TRIANGLE * 2), "convex polygon"),
        (lambda: Polygon([(0, 0), (1, float("inf")), (0, 1)]), "vertices must hold finite numbers"),
        (lambda: checked_inertia("inertia", (1, 2, 4)), "triangle inequality"),
        (lambda: checked_inertia("inertia", (0, 1, 1)), "positive principal moments"),
        (lambda: checked_inertia("inertia", [[1, 2, 0], [0, 1, 0], [0, 0, 1]]), "symmetric"),
        (lambda: composite_inertia([1, -1], [(0, 0), (1, 0)], [1, 1]), "sum greater than 0"),
        (lambda: composite_inertia([1, 1], [(0, 0), (1, 0)], [1]), "one entry a part"),
    ],
)
def test_bad_input_says_what_would_be_right(make, words):
    with pytest.raises((ValueError, TypeError)) as raised:
        make()
    assert words in str(raised.value)


def test_flat_bodies_may_touch_the_triangle_inequality():
    assert np.allclose(checked_inertia("inertia", (1, 2, 3)), np.diag([1, 2, 3]))
    assert Point().dimensions == (2, 3)
