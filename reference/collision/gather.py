"""A scene's shapes gathered into ``Solids``.

Slides S10; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import plain
from ..shapes import Box, Capsule, Disc, Plane, Point, Polygon, Sphere
from .solids import BALL, BOX, CAPSULE, PLANE, POLYGON, Forms, Solids, place_in_plane, place_in_space


def make_solids(bodies, scene):
    """The ``Solids`` of a scene laid out as ``bodies``; static ones are placed, once."""
    d, parts = scene.dimension, scene.bodies
    number = [i for i, body in enumerate(parts) if not isinstance(body.shape, Point)]
    of_body = {i: a for a, i in enumerate(number)}
    shapes, s = [parts[i].shape for i in number], len(number)
    corners = [_corners(shape, d) for shape in shapes]
    edges = [np.roll(c, -1, axis=0) - c for c in corners]
    normals = [
        _capsule_normals() if isinstance(shape, Capsule) else _normals(e)
        for shape, e in zip(shapes, edges, strict=True)
    ]
    first = np.cumsum([0] + [len(c) for c in corners])
    groups = {
        g: k for k, g in enumerate({parts[i].group: None for i in number if parts[i].group is not None})
    }
    apart, special, law = _pairs(scene, of_body)
    orientation = bodies.orientation[number]
    form = Forms(
        size=np.array([_size(shape, d) for shape in shapes]).reshape(s, 3),
        radius=np.array([_radius(shape, c) for shape, c in zip(shapes, corners, strict=True)]),
        x=bodies.position[number],
        axes=np.zeros((s, d, d)),
        first=first.astype(int),
        corner=np.zeros((first[-1], 2)),
        normal=np.zeros((first[-1], 2)),
        length=np.linalg.norm(np.concatenate(edges), axis=1),
    )
    solids = Solids(
        form,
        number=np.array(number, dtype=int),
        slot=np.array([bodies.slot.get(i, -1) for i in number], dtype=int),
        kind=np.array([_kind(shape, d) for shape in shapes], dtype=int),
        principal=_principal(bodies, number),
        corner_in_body=np.concatenate(corners),
        normal_in_body=np.concatenate(normals),
        friction=np.array([parts[i].friction for i in number]),
        restitution=np.array([parts[i].restitution for i in number]),
        group=np.array([groups.get(parts[i].group, -1) for i in number], dtype=int),
        apart=apart,
        special=special,
        special_law=law,
        reach=np.zeros(s),
        low=np.zeros((s, d)),
        high=np.zeros((s, d)),
    )
    turn = plain(place_in_space if d == 3 else place_in_plane)
    for a in range(s):
        if solids.slot[a] < 0:
            turn(solids, a, orientation[a])
            if isinstance(shapes[a], Plane):
                form.axes[a, 0] = np.array(shapes[a].normal) @ form.axes[a]
    return solids


def _kind(shape, d):
    if isinstance(shape, Plane):
        return PLANE
    if isinstance(shape, (Sphere, Disc)) or (isinstance(shape, Capsule) and shape.half_length == 0):
        return BALL
    if d == 2:
        return POLYGON
    return BOX if isinstance(shape, Box) else CAPSULE


def _size(shape, d):
    if isinstance(shape, Box) and d == 3:
        return shape.half_extents
    return getattr(shape, "radius", 0.0), getattr(shape, "half_length", 0.0), 0.0


def _radius(shape, corners):
    """Of a ball about the centre that holds the shape."""
    if isinstance(shape, Plane):
        return np.inf
    if isinstance(shape, Box):
        return float(np.linalg.norm(shape.half_extents))
    if isinstance(shape, Polygon):
        return float(np.linalg.norm(corners, axis=1).max())
    return shape.radius + getattr(shape, "half_length", 0.0)


def _corners(shape, d):
    """(c, 2), anticlockwise; none for what is no polygon."""
    if d == 3 or _kind(shape, d) != POLYGON:
        return np.zeros((0, 2))
    if isinstance(shape, Polygon):
        return np.array(shape.vertices)
    if isinstance(shape, Box):
        return np.array(shape.half_extents) * [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    return shape.half_length * np.array([(0.0, -1.0), (0.0, -1.0), (0.0, 1.0), (0.0, 1.0)])


def _normals(edges):
    lengths = np.linalg.norm(edges, axis=1, keepdims=True)
    return np.stack([edges[:, 1], -edges[:, 0]], axis=1) / lengths


def _capsule_normals():
    """Of the four sides of a polygon with no width: its ends have no length, but a normal."""
    return np.array([(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)])


def _principal(bodies, number):
    if bodies.dimension == 2:
        return np.zeros((len(number), 0))
    rows = np.tile([1.0, 0, 0, 0], (len(number), 1))
    for a, i in enumerate(number):
        slot = bodies.slot.get(i, -1)
        if slot >= 0:
            rows[a] = bodies.principal[slot]
    return rows


def _pairs(scene, of_body):
    """Which pairs of solids may not touch, and which have a law of their own, as sorted arrays."""
    s = len(of_body)

    def key(i, j):
        return of_body[min(i, j)] * s + of_body[max(i, j)]

    solid = {pair: law for pair, law in scene.pairs.items() if pair[0] in of_body and pair[1] in of_body}
    apart = {key(*pair) for pair, law in solid.items() if not law.collide}
    for joint in scene.joints:
        if joint.b is not None and not joint.collide and joint.a in of_body and joint.b in of_body:
            apart.add(key(joint.a, joint.b))
    laws = sorted(
        (key(*pair), law.friction, law.restitution)
        for pair, law in solid.items()
        if law.friction is not None or law.restitution is not None
    )
    values = np.array([[np.nan if v is None else v for v in law[1:]] for law in laws], dtype=float)
    return (
        np.array(sorted(apart), dtype=int),
        np.array([law[0] for law in laws], dtype=int),
        values.reshape(-1, 2),
    )
