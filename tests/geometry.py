"""What shapes look like to those who check collisions: a core swept by parameters −1 … 1, and a radius.

Nothing here uses the reference's geometry: distances come from SciPy's bounded least squares, overlaps from
directions tried one by one.
"""

import numpy as np
from scipy.optimize import lsq_linear
from scipy.spatial.transform import Rotation

from reference import Box, Capsule, Disc, Scene, Sphere
from reference.collision import find_contacts, make_collider
from reference.layout import Bodies


def random_quaternion(rng):
    q = rng.normal(size=4)
    return q / np.linalg.norm(q)


def contacts_of(scene, margin=0.0, h=0.0):
    """All contacts of a scene at its start, as a dictionary of arrays, and the collider."""
    bodies = Bodies(scene)
    collider = make_collider(bodies, scene)
    count = find_contacts(collider, bodies.state(), margin, h)
    found = {name: a[:count].copy() for name, a in collider.contacts._asdict().items() if name != "count"}
    return found, collider


def pair_contacts(first, second, margin, friction=0.5):
    """The contacts of two bodies, each (shape, position, orientation), without gravity."""
    scene = Scene(gravity=np.zeros(len(first[1])))
    for shape, position, orientation in (first, second):
        scene.add(shape, position=position, orientation=orientation, friction=friction)
    return contacts_of(scene, margin)[0]


def core(shape, position, orientation):
    """(centre, columns, radius): the shape is centre + columns s, |s_k| ≤ 1, thickened by the radius."""
    d = len(position)
    if d == 3:
        w, x, y, z = orientation
        R = Rotation.from_quat([x, y, z, w]).as_matrix()
    else:
        R = np.array(
            [[np.cos(orientation), -np.sin(orientation)], [np.sin(orientation), np.cos(orientation)]]
        )
    if isinstance(shape, Box):
        return np.array(position), R * shape.half_extents, 0.0
    if isinstance(shape, Capsule):
        return np.array(position), R[:, -1:] * shape.half_length, shape.radius
    assert isinstance(shape, (Sphere, Disc))
    return np.array(position), np.zeros((d, 0)), shape.radius


def distance(first, second):
    """Between two bodies that are apart: the least |p − q| over both cores, less the radii."""
    (x, A, r), (y, B, s) = core(*first), core(*second)
    columns = np.hstack([A, -B])
    if columns.shape[1] == 0:
        return np.linalg.norm(y - x) - r - s
    best = lsq_linear(columns, y - x, bounds=(-1, 1), tol=1e-14, method="bvls")
    return np.linalg.norm(columns @ best.x - (y - x)) - r - s


def overlap_along(first, second, n):
    """How far the shadows of two bodies on the directions n (k, d) overlap: by so much they must part."""
    (x, A, r), (y, B, s) = core(*first), core(*second)
    return np.abs(n @ A).sum(axis=1) + np.abs(n @ B).sum(axis=1) + r + s - n @ (y - x)


def gap_along(first, second, n):
    """The gap of the two bodies along a single direction n."""
    return -overlap_along(first, second, n[None])[0]


def directions(rng, count, d):
    n = rng.normal(size=(count, d))
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def shrunk(shape, s):
    """The shape s times as large."""
    if isinstance(shape, (Sphere, Disc)):
        return type(shape)(s * shape.radius)
    if isinstance(shape, Box):
        return Box(tuple(s * e for e in shape.half_extents))
    return Capsule(s * shape.radius, s * shape.half_length)


def assert_smallest_gap_is_the_distance(make_pair, scale, count):
    """For so many separated pairs: the gap is the distance, and the margin decides who is found."""
    seen = 0
    while seen < count:
        pair = make_pair()
        d = distance(*pair)
        if not 0.01 * scale < d < scale:
            continue
        seen += 1
        found = pair_contacts(*pair, margin=2 * scale)
        k = found["gap"].argmin()
        np.testing.assert_allclose(found["gap"][k], d, rtol=0, atol=2e-6 * scale)
        np.testing.assert_allclose(gap_along(*pair, found["frame"][k, 0]), d, rtol=0, atol=2e-6 * scale)
        assert len(pair_contacts(*pair, margin=d * 1.001)["gap"]) >= 1
        assert len(pair_contacts(*pair, margin=d * 0.999)["gap"]) == 0
