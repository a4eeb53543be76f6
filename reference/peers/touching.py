"""What touches in an engine: the pair's law from what each body has, and contacts gathered step by step.

The course's law of a pair is the product of frictions and the larger restitution, or what ``scene.pair``
says. Both engines multiply what the two bodies have, friction and restitution alike. So each body gets a
factor, and where no factors have the pair's law as their product the adapter needs another way, or refuses.

Slides S10, S12, S18; lectures/05_contact.md.
"""

import math

import numpy as np

from ..collision.find import frame_in_plane, frame_in_space
from ..compiled import compiled
from ..declared import Pair
from ..shapes import Point
from ..trajectory import ContactHistory


def solid_numbers(scene):
    """The numbers of the bodies that can touch something, or () where nothing in the scene can."""
    if next(iter(scene.colliding_pairs()), None) is None:
        return ()
    return tuple(i for i, body in enumerate(scene.bodies) if not isinstance(body.shape, Point))


def apart_pairs(scene):
    """The pairs (i, j), i < j, of solid bodies that pass through each other, both static ones left out."""
    meet, solid = set(scene.colliding_pairs()), solid_numbers(scene)
    both_static = {i for i in solid if scene.bodies[i].static}
    for a, i in enumerate(solid):
        for j in solid[a + 1 :]:
            if (i, j) not in meet and not (i in both_static and j in both_static):
                yield i, j


def friction_of(scene, i, j):
    """μ between two bodies: the pair's own, or the product."""
    own = scene.pairs.get((min(i, j), max(i, j)), Pair()).friction
    return scene.bodies[i].friction * scene.bodies[j].friction if own is None else own


def restitution_of(scene, i, j):
    """e between two bodies: the pair's own, or the larger."""
    own = scene.pairs.get((min(i, j), max(i, j)), Pair()).restitution
    return max(scene.bodies[i].restitution, scene.bodies[j].restitution) if own is None else own


def factors(scene, own, law):
    """A factor for each body (n,), and the pairs whose law is not the product of their factors.

    own (n,): what the bodies have; law(scene, i, j): what the pair should have. One value for all pairs is
    shared out evenly; else each body keeps its own.
    """
    if len(set(own)) == 1 and own[0] in (0.0, 1.0) and not scene.pairs:
        return list(own), []
    laws = {pair: law(scene, *pair) for pair in scene.colliding_pairs()}
    values = set(laws.values())
    if len(values) == 1:
        return [math.sqrt(values.pop())] * len(own), []
    off = [
        (i, j) for (i, j), value in laws.items() if not math.isclose(own[i] * own[j], value, abs_tol=1e-15)
    ]
    return list(own), off


class Touching:
    """Contacts as an engine reports them, and closed to one list a record. d dimensions.

    Engines forget from step to step which contact is which. So a record has the contacts of the last step in
    which its pair touched, and what a pair's contacts did before goes to the nearest of them.
    """

    def __init__(self, d):
        self.d, self.rows, self.step, self.closed, self.on = d, [], 0, [], False

    def add(self, i, j, point, normal, depth, impulse):
        """A contact of this step. normal: from i to j; impulse (d,): on j, world frame, N s."""
        if i > j:
            i, j, normal, impulse = j, i, [-a for a in normal], [-a for a in impulse]
        self.rows.append((i, j, self.step, *point, *normal, depth, *impulse))

    def next_step(self):
        """What is added from now on belongs to another step."""
        self.step += 1

    def close(self):
        """End a record."""
        d = self.d
        rows = np.array(self.rows, dtype=float).reshape(-1, 4 + 3 * d)
        kept, impulse = [], []
        pairs, group = np.unique(rows[:, :2], axis=0, return_inverse=True)
        for k in range(len(pairs)):
            mine = rows[group.ravel() == k]
            last = mine[mine[:, 2] == mine[-1, 2]]
            gap = mine[:, None, 3 : 3 + d] - last[None, :, 3 : 3 + d]
            nearest = np.argmin(np.square(gap).sum(axis=-1), axis=1)
            total = np.zeros((len(last), d))
            np.add.at(total, nearest, mine[:, 4 + 2 * d :])
            counts = np.any(total != 0, axis=1) | (last[:, 3 + 2 * d] >= 0)
            kept.append(last[counts])
            impulse.append(total[counts])
        last = np.concatenate([rows[:0], *kept])
        frame = frames(last[:, 3 + d : 3 + 2 * d])
        world = np.concatenate([np.zeros((0, d)), *impulse])
        self.closed.append(
            (
                last[:, :2].astype(int),
                last[:, 3 : 3 + d],
                frame,
                last[:, 3 + 2 * d],
                np.einsum("mij,mj->mi", frame, world),
            )
        )
        self.rows = []

    def history(self, records):
        """The ``ContactHistory``: nothing at the first record, then the closed lists."""
        lists, self.closed = self.closed[: records - 1], []
        if not lists:
            return ContactHistory.empty(records, self.d)
        offsets = np.cumsum([0, 0, *(len(one[0]) for one in lists)])
        return ContactHistory(offsets, *(np.concatenate(arrays) for arrays in zip(*lists, strict=True)))


def frames(normals):
    """Rows n, t1, t2 for normals (m, d): as this course's own contacts have them."""
    m, d = normals.shape
    made = np.zeros((m, d, d))
    (_fill_in_plane if d == 2 else _fill_in_space)(made, normals)
    return made


@compiled
def _fill_in_plane(frame, normals):
    for k in range(len(normals)):
        frame_in_plane(frame, k, normals, k)


@compiled
def _fill_in_space(frame, normals):
    for k in range(len(normals)):
        frame_in_space(frame, k, normals, k)


def outward(body):
    """The normal (d,) of a Plane in the world."""
    n = np.array(body.shape.normal)
    if len(n) == 2:
        c, s = math.cos(body.orientation), math.sin(body.orientation)
        return np.array([c * n[0] - s * n[1], s * n[0] + c * n[1]])
    w, v = body.orientation[0], body.orientation[1:]
    return n + 2 * np.cross(v, np.cross(v, n) + w * n)
