"""Contacts of a box and a capsule in space: the box against the capsule's segment, less its radius.

The axes that can separate them are the three normals of the box's faces and the three cross products of its
axes and the segment. Lying on a face makes two contacts, at the ends of the stretch that lies on it.

Slides S10; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import inner
from ..rotation import cross, vector
from .boxes import edge_towards, middle_of_edge, reach, within
from .clipping import box_edge
from .closest import (
    SLOP,
    TIE,
    along,
    body_axis,
    closest_on_segments,
    dot,
    minus,
    norm,
    put,
    put_balls,
    scaled,
    sign,
)

_PARALLEL = 1e-4  # sine below which the segment is parallel to an edge, and their cross product no axis


@inner
def box_capsule(forms, a, b, limit, raw):
    """0 to 2 contacts. Features of the capsule: 1 and 2 an end, 0 its side."""
    d = minus(vector(forms.x, b), vector(forms.x, a))
    g = scaled(forms.size[b, 1], body_axis(forms, b, 2))
    r, size = forms.size[b, 0], min(forms.radius[a], forms.radius[b])
    gap, k, n = best_face_for_segment(forms, a, d, g)
    gap_edge, l, n_edge = best_edge_for_segment(forms, a, d, g)
    if max(gap, gap_edge) - r > limit:
        return 0
    if gap_edge <= gap + TIE * size:
        m, lowest = segment_on_face(forms, a, b, k, n, d, g, limit, raw)
        if lowest <= gap + TIE * size or (m > 0 and gap <= 0):
            return m
    elif gap_edge <= 0:
        edge = edge_towards(forms, a, l, n_edge, d)
        p, q = segment_at_edge(forms, a, l, edge, b, g)
        return put_through(raw, 0, p, q, n_edge, gap_edge, r, box_edge(l, edge), 0)
    if max(gap, gap_edge) > 0:
        return closest_to_segment(forms, a, b, g, limit, raw, n)
    end = -1.0 if dot(g, n) > 0 else 1.0
    q = along(vector(forms.x, b), end, g)
    return put_through(raw, 0, along(q, -gap, n), q, n, gap, r, 20 + k, 1 + (end > 0))


@inner
def put_through(raw, k, p, q, n, gap, r, feature_a, feature_b):
    """One contact of the box's p and the segment's q, whose distance along n is ``gap``; returns k + 1."""
    middle = along(p, 0.5, minus(q, p))
    put(raw, k, along(middle, -0.5 * r, n), n, gap - r, feature_a, feature_b)
    return k + 1


@inner
def best_face_for_segment(forms, a, d, g):
    """(separation, axis k, n): the face of box a from which the segment d ± g is farthest away."""
    best, face, normal = -np.inf, 0, (1.0, 0.0, 0.0)
    for k in range(3):
        n = body_axis(forms, a, k)
        t = dot(d, n)
        gap = abs(t) - abs(dot(g, n)) - forms.size[a, k]
        if gap > best + 1e-9 * forms.radius[a]:
            best, face, normal = gap, k, scaled(sign(t), n)
    return best, face, normal


@inner
def best_edge_for_segment(forms, a, d, g):
    """(separation, axis k, n): the same for the cross products of the segment and the box's axes."""
    best, edge, normal = -np.inf, 0, (1.0, 0.0, 0.0)
    for k in range(3):
        n = cross(body_axis(forms, a, k), g)
        length = norm(n)
        if length < _PARALLEL * norm(g):
            continue
        n = scaled(1 / length, n)
        t = dot(d, n)
        gap = abs(t) - reach(forms, a, n)
        if gap > best + 1e-9 * forms.radius[a]:
            best, edge, normal = gap, k, scaled(sign(t), n)
    return best, edge, normal


@inner
def segment_on_face(forms, a, b, k, n, d, g, limit, raw):
    """(m, lowest): 0 to 2 contacts where the segment is over a face; lowest: its least height, or inf."""
    low, high, low_side, high_side = -1.0, 1.0, -1, -1
    for side in range(2):
        across = (k + 1 + side) % 3
        e = body_axis(forms, a, across)
        c, slope, extent = dot(d, e), dot(g, e), forms.size[a, across] * (1 + SLOP)
        if abs(slope) <= 1e-12 * extent:
            if abs(c) > extent:
                return 0, np.inf
            continue
        enter, leave = (-extent * sign(slope) - c) / slope, (extent * sign(slope) - c) / slope
        if enter > low:
            low, low_side = enter, across
        if leave < high:
            high, high_side = leave, across
    if low > high:
        return 0, np.inf
    x, r, extent = vector(forms.x, b), forms.size[b, 0], forms.size[a, k]
    w_low, w_high = dot(along(d, low, g), n) - extent, dot(along(d, high, g), n) - extent
    single = (high - low) * norm(g) < 1e-3 * r  # the nearer one will do
    m = 0
    if w_low - r <= limit and not (single and w_high < w_low):
        q = along(x, low, g)
        feature_a, feature_b = 20 + k if low_side < 0 else 8 + low_side, 1 if low_side < 0 else 0
        m = put_through(raw, m, along(q, -w_low, n), q, n, w_low, r, feature_a, feature_b)
    if w_high - r <= limit and not (single and w_high >= w_low):
        q = along(x, high, g)
        feature_a, feature_b = 20 + k if high_side < 0 else 11 + high_side, 2 if high_side < 0 else 0
        m = put_through(raw, m, along(q, -w_high, n), q, n, w_high, r, feature_a, feature_b)
    return m, min(w_low, w_high)


@inner
def segment_at_edge(forms, a, l, edge, b, g):
    """The closest points of an edge of box a along its axis l and the segment of b."""
    p, e = middle_of_edge(forms, a, l, edge), scaled(forms.size[a, l], body_axis(forms, a, l))
    s, t = closest_on_segments(p, e, vector(forms.x, b), g)
    return along(p, s, e), along(vector(forms.x, b), t, g)


@inner
def closest_to_segment(forms, a, b, g, limit, raw, default):
    """One contact at the closest points of the box and the segment, which are apart: tries ends and edges."""
    best, p, q, feature_a, feature_b = np.inf, default, default, 0, 0
    for end in range(2):
        t = along(vector(forms.x, b), 2.0 * end - 1, g)
        s = within(forms, a, t)
        distance = norm(minus(t, s))
        if distance < best:
            best, p, q, feature_a, feature_b = distance, s, t, 26, 1 + end
    for edges in range(12):
        s, t = segment_at_edge(forms, a, edges // 4, edges % 4, b, g)
        distance = norm(minus(t, s))
        if distance < best * (1 - 1e-9):
            best, p, q, feature_a, feature_b = distance, s, t, box_edge(edges // 4, edges % 4), 0
    return put_balls(raw, 0, limit, p, 0.0, q, forms.size[b, 0], default, feature_a, feature_b)
