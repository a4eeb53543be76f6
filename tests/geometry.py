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
