"""From the state to the contacts: place the solids, find pairs, let each pair's routine find its contacts.

``detect`` is one compiled kernel a dimension. It allocates nothing; where its arrays are too small, it says
how much it needs.

**Order.** Pairs by the bodies' numbers, and in a pair by id: the same scene gives the same rows in the same
order. A pair's routine is called with its two solids in an order of their own, by shape, size and place, not
by number. So numbering the bodies differently gives the same contacts, but for the sign of n.

Slides S10; lectures/05_contact.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import bind, inner, lean_apart
from ..rotation import cross, vector
from .boxes import box_ball, box_box, plane_box
from .broad import find_pairs, row_of
from .capsule_box import box_capsule
from .closest import tangent
from .polygons import disc_disc, halfplane_point, halfplane_polygon, pair, polygon_disc, polygon_polygon
from .round import ball_ball, capsule_ball, capsule_capsule, plane_ball, plane_capsule
from .solids import BALL, BOX, PLANE, place

_MOST = 8  # corners of two faces cut to each other


class ContactArrays(NamedTuple):
    """Room for contacts in d dimensions; the first ``count[0]`` rows are the last call's. World frame, SI.

    i is the body with the lower number in the scene, j the other.
    """

    count: np.ndarray  # (1,) int
    bodies: np.ndarray  # (c, 2) int, numbers in the scene: i < j
    slot: np.ndarray  # (c, 2) int, rows in the State; −1: static
    id: np.ndarray  # (c,) int: what of i touches what of j; the same from step to step while that stays so
    point: np.ndarray  # (c, d) half way between the two surfaces
    frame: np.ndarray  # (c, d, d) rows n, t1, t2; n from i to j
    gap: np.ndarray  # (c,) along n; negative: depth
    arm: np.ndarray  # (c, 2, d) r_i, r_j: from the centres of mass to the point
    friction: np.ndarray  # (c,)
    restitution: np.ndarray  # (c,)


class Raw(NamedTuple):
    """Room for one pair's contacts, n and features from the routine's first solid to its second."""

    point: np.ndarray  # (8, d)
    normal: np.ndarray  # (8, d)
    gap: np.ndarray  # (8,)
    feature: np.ndarray  # (8, 2) int
    corner: np.ndarray  # (12, 3) outline of a face: u, v, w
    label: np.ndarray  # (12,) int
    spare: np.ndarray  # (12, 3)
    spare_label: np.ndarray  # (12,) int
    pick: np.ndarray  # (12, 2) int


def make_contacts(capacity, d):
    """Empty ``ContactArrays``."""
    c = capacity
    return ContactArrays(
        count=np.zeros(1, dtype=int),
        bodies=np.zeros((c, 2), dtype=int),
        slot=np.zeros((c, 2), dtype=int),
        id=np.zeros(c, dtype=int),
        point=np.zeros((c, d)),
        frame=np.zeros((c, d, d)),
        gap=np.zeros(c),
        arm=np.zeros((c, 2, d)),
        friction=np.zeros(c),
        restitution=np.zeros(c),
    )


def make_raw(d):
    """Room for one pair's contacts in d dimensions."""
    rows = 12  # a face has 4 corners, and each of 4 cuts adds at most one; with room to spare
    return Raw(
        np.zeros((_MOST, d)),
        np.zeros((_MOST, d)),
        np.zeros(_MOST),
        np.zeros((_MOST, 2), dtype=int),
        np.zeros((rows, 3)),
        np.zeros(rows, dtype=int),
        np.zeros((rows, 3)),
        np.zeros(rows, dtype=int),
        np.zeros((rows, 2), dtype=int),
    )


@lean_apart
def detect(touch, write_frame, solids, grid, pairs, spare, raw, contacts, state, margin, h):
    """(pairs, contacts) that there are. More than there is room for: make room and call again.

    touch(kind, kind, forms, a, b, limit, raw): the number of contacts of a pair, in its order;
    write_frame(frame, row, normal, k).
    """
    place(solids, state, margin, h)
    found = find_pairs(solids, grid, pairs, spare)
    contacts.count[0] = 0
    if found > len(pairs):
        return found, 0
    count = 0
    for p in range(found):
        a, b = pairs[p, 0], pairs[p, 1]
        swapped = not in_order(solids, a, b)
        first, second = (b, a) if swapped else (a, b)
        limit = solids.reach[a] + solids.reach[b]
        m = touch(solids.kind[first], solids.kind[second], solids.form, first, second, limit, raw)
        if m == 0:
            continue
        if count + m <= len(contacts.gap):
            for k in range(m):
                write(write_frame, solids, a, b, swapped, raw, k, contacts, count + k)
            sort_by_id(contacts, count, m)
            contacts.count[0] = count + m
        count += m
    return found, count


@inner
def in_order(solids, a, b):
    """Whether a comes before b, by what they are: kind, then size (larger first), then place, lower first.

    The direction in which places are compared is none in which bodies are usually lined up.
    """
    if solids.kind[a] != solids.kind[b]:
        return solids.kind[a] < solids.kind[b]
    size_a, size_b = solids.form.radius[a], solids.form.radius[b]
    if abs(size_a - size_b) > 1e-9 * size_a:
        return size_a > size_b
    ahead = 0.36 * (solids.form.x[b, 0] - solids.form.x[a, 0]) + 0.82 * (
        solids.form.x[b, 1] - solids.form.x[a, 1]
    )
    if solids.form.x.shape[1] == 3:
        ahead += 0.45 * (solids.form.x[b, 2] - solids.form.x[a, 2])
    return ahead >= 0


@inner
def touch_in_space(kind_a, kind_b, forms, a, b, limit, raw):
    """The contacts of a pair in its order: the routine for its two kinds."""
    if kind_a == PLANE:
        if kind_b == BALL:
            return plane_ball(forms, a, b, limit, raw)
        if kind_b == BOX:
            return plane_box(forms, a, b, limit, raw)
        return plane_capsule(forms, a, b, limit, raw)
    if kind_a == BALL:
        return ball_ball(forms, a, b, limit, raw)
    if kind_a == BOX:
        if kind_b == BOX:
            return box_box(forms, a, b, limit, raw)
        if kind_b == BALL:
            return box_ball(forms, a, b, limit, raw)
        return box_capsule(forms, a, b, limit, raw)
    if kind_b == BALL:
        return capsule_ball(forms, a, b, limit, raw)
    return capsule_capsule(forms, a, b, limit, raw)


@inner
def touch_in_plane(kind_a, kind_b, forms, a, b, limit, raw):
    """The contacts of a pair in its order: the routine for its two kinds."""
    if kind_a == PLANE:
        if kind_b == BALL:
            return halfplane_point(forms, a, pair(forms.x, b), forms.size[b, 0], limit, raw, 0, 0)
        return halfplane_polygon(forms, a, b, limit, raw)
    if kind_a == BALL:
        return disc_disc(forms, a, b, limit, raw)
    if kind_b == BALL:
        return polygon_disc(forms, a, b, limit, raw)
    return polygon_polygon(forms, a, b, limit, raw)


@inner
def frame_in_space(frame, row, normal, k):
    """Rows n, t1 (see ``closest.tangent``), t2 = n × t1."""
    n = vector(normal, k)
    t1 = tangent(n)
    t2 = cross(n, t1)
    frame[row, 0, 0], frame[row, 0, 1], frame[row, 0, 2] = n
    frame[row, 1, 0], frame[row, 1, 1], frame[row, 1, 2] = t1
    frame[row, 2, 0], frame[row, 2, 1], frame[row, 2, 2] = t2


@inner
def frame_in_plane(frame, row, normal, k):
    """Rows n and t1, which is n turned by a quarter anticlockwise."""
    x, y = normal[k, 0], normal[k, 1]
    frame[row, 0, 0], frame[row, 0, 1], frame[row, 1, 0], frame[row, 1, 1] = x, y, -y, x


@inner
def write(write_frame, solids, a, b, swapped, raw, k, contacts, row):
    """Contact k of the pair a < b into its row. Features are numbered within 2¹⁶."""
    feature_a, feature_b = raw.feature[k, 0], raw.feature[k, 1]
    if swapped:
        feature_a, feature_b = feature_b, feature_a
        for i in range(raw.normal.shape[1]):
            raw.normal[k, i] = -raw.normal[k, i]
    contacts.bodies[row, 0], contacts.bodies[row, 1] = solids.number[a], solids.number[b]
    contacts.slot[row, 0], contacts.slot[row, 1] = solids.slot[a], solids.slot[b]
    contacts.id[row] = feature_a << 16 | feature_b
    contacts.gap[row] = raw.gap[k]
    write_frame(contacts.frame, row, raw.normal, k)
    for i in range(raw.point.shape[1]):
        contacts.point[row, i] = raw.point[k, i]
        contacts.arm[row, 0, i] = raw.point[k, i] - solids.form.x[a, i]
        contacts.arm[row, 1, i] = raw.point[k, i] - solids.form.x[b, i]
    friction = solids.friction[a] * solids.friction[b]
    restitution = max(solids.restitution[a], solids.restitution[b])
    if len(solids.special) > 0:
        own = row_of(solids.special, a * len(solids.kind) + b)
        if own >= 0 and not np.isnan(solids.special_law[own, 0]):
            friction = solids.special_law[own, 0]
        if own >= 0 and not np.isnan(solids.special_law[own, 1]):
            restitution = solids.special_law[own, 1]
    contacts.friction[row], contacts.restitution[row] = friction, restitution


@inner
def sort_by_id(contacts, first, m):
    """Sort m rows from ``first`` by id."""
    for row in range(first + 1, first + m):
        k = row
        while k > first and contacts.id[k - 1] > contacts.id[k]:
            swap_rows(contacts, k - 1, k)
            k -= 1


@inner
def swap_rows(contacts, i, j):
    """Exchange two contacts of one pair: what differs within a pair."""
    contacts.id[i], contacts.id[j] = contacts.id[j], contacts.id[i]
    contacts.gap[i], contacts.gap[j] = contacts.gap[j], contacts.gap[i]
    for k in range(contacts.point.shape[1]):
        contacts.point[i, k], contacts.point[j, k] = contacts.point[j, k], contacts.point[i, k]
        for e in range(2):
            contacts.arm[i, e, k], contacts.arm[j, e, k] = contacts.arm[j, e, k], contacts.arm[i, e, k]
        for l in range(contacts.point.shape[1]):
            kept = contacts.frame[i, k, l]
            contacts.frame[i, k, l] = contacts.frame[j, k, l]
            contacts.frame[j, k, l] = kept


def detector(d):
    """``detect`` for d dimensions: detect(solids, grid, pairs, spare, raw, contacts, state, margin, h)."""
    if d == 3:
        return bind(detect, touch_in_space, frame_in_space)
    return bind(detect, touch_in_plane, frame_in_plane)
