"""A scene made ready for finding contacts: ``make_collider`` once, ``find_contacts`` in each step.

Slides S10; lectures/05_contact.md.
"""

from collections import Counter

import numpy as np

from ..shapes import Point
from .broad import make_grid
from .find import detector, make_contacts, make_raw
from .gather import make_solids

_ROOM = 4  # pairs and contacts a solid, to begin with


def count_pairs(scene):
    """How many pairs of bodies could ever touch, counted without looking at each: as many as
    ``scene.colliding_pairs()`` yields.
    """
    solid = {i: body for i, body in enumerate(scene.bodies) if not isinstance(body.shape, Point)}
    static = {i for i, body in solid.items() if body.static}
    pairs = _choose_two(len(solid)) - _choose_two(len(static))
    members = Counter(body.group for body in solid.values() if body.group is not None)
    resting = Counter(solid[i].group for i in static if solid[i].group is not None)
    pairs -= sum(_choose_two(n) - _choose_two(resting[group]) for group, n in members.items())
    ruled_out = {pair for pair, law in scene.pairs.items() if not law.collide}
    for joint in scene.joints:
        if joint.b is not None and not joint.collide:
            ruled_out.add((min(joint.a, joint.b), max(joint.a, joint.b)))
    for i, j in ruled_out:
        if i in solid and j in solid and not (i in static and j in static):
            pairs -= solid[i].group is None or solid[i].group != solid[j].group
    return pairs


def _choose_two(n):
    return n * (n - 1) // 2


class Collider:
    """What ``find_contacts`` works with; made by ``make_collider``.

    solids: ``Solids``; contacts: ``ContactArrays``, whose first ``count`` rows count; spare: two more;
    detect: the compiled kernel, called as detect(*arrays, contacts, state, margin, h) (see ``find.detect``);
    arrays: the tuple (solids, grid, pairs, spare, raw). ``make_room`` replaces all these by larger ones.
    """

    def __init__(self, bodies, scene):
        self.dimension = scene.dimension
        self.solids = make_solids(bodies, scene)
        s = len(self.solids.kind)
        self.detect = detector(self.dimension)
        self._grid, self._raw = make_grid(s, self.dimension), make_raw(self.dimension)
        self.arrays, self.contacts, self.spare = (), None, []
        self.make_room(_ROOM * s, _ROOM * s)

    @property
    def count(self):
        """How many contacts there are."""
        return int(self.contacts.count[0])

    def make_room(self, pairs, contacts):
        """Room for at least so many pairs and contacts, by doubling. What was found is lost."""
        pairs = _doubled(len(self.arrays[2]) if self.arrays else 1, pairs)
        self.arrays = (
            self.solids,
            self._grid,
            *(np.zeros((pairs, 2), dtype=int) for _ in range(2)),
            self._raw,
        )
        size = _doubled(len(self.contacts.gap) if self.contacts else 1, contacts)
        self.contacts, *self.spare = (make_contacts(size, self.dimension) for _ in range(3))


def _doubled(size, needed):
    while size < needed:
        size *= 2
    return size


def make_collider(bodies, scene):
    """A ``Collider`` for a scene laid out as ``bodies``; None where nothing can ever touch."""
    return Collider(bodies, scene) if count_pairs(scene) > 0 else None


def find_contacts(collider, state, margin, h=0.0):
    """Find all contacts of a ``State`` with gaps of up to ``margin``, m; returns how many there are.

    They stand in the first rows of ``collider.contacts``. h, s: count also what could meet within this time:
    a pair's margin grows by h times a bound on the speed of each of the two (that of the centre, and |ω|
    times the radius). What is not finite has no contacts: whoever moves the bodies looks for that.
    """
    margin, h = float(margin), float(h)
    while True:
        pairs, contacts = collider.detect(*collider.arrays, collider.contacts, state, margin, h)
        if pairs <= len(collider.arrays[2]) and contacts <= len(collider.contacts.gap):
            return contacts
        collider.make_room(pairs, contacts)
