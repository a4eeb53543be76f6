"""Contacts of boxes in space: with planes, balls, capsules, and each other.

Two boxes are apart if one of 15 axes separates them: a normal of either's faces, or a cross product of two
edges (Gottschalk, Lin & Manocha 1996). The axis on which they are farthest apart, or overlap least, is n,
and the separation is the gap along it. Where n is a face's normal, the other box's face is cut to that face
(``clipping``); where it is a cross product, the two edges touch in one point; and where neither face nor
edges meet, although the boxes are apart, their closest points make the contact.

Near ties are decided by what changes least: a face rather than edges nearly parallel to it, the first box's
face rather than the second's.

Slides S10; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import inner
from ..rotation import cross, vector
from .clipping import box_edge, face_contact, facing
from .closest import (
    TIE,
    along,
    body_axis,
    clip,
    closest_on_segments,
    dot,
    minus,
    norm,
    put,
    put_balls,
    scaled,
    sign,
)
from .round import plane_point

_PARALLEL = 1e-4  # sine below which two edges are parallel, and their cross product no axis
# A cross product whose cosine with the best face's normal exceeds the one must gain the other, relative.
_LEANING, _LEAN_TIE = 0.99, 1e-4


@inner
def reach(forms, a, n):
    """How far the box a extends from its centre along n."""
    e = forms.size
    return (
        e[a, 0] * abs(dot(body_axis(forms, a, 0), n))
        + e[a, 1] * abs(dot(body_axis(forms, a, 1), n))
        + e[a, 2] * abs(dot(body_axis(forms, a, 2), n))
    )


@inner
def corner(forms, a, signs):
    """The corner of box a with these signs of its three coordinates, world frame."""
    p = vector(forms.x, a)
    for k in range(3):
        p = along(p, (1 if signs >> k & 1 else -1) * forms.size[a, k], body_axis(forms, a, k))
    return p


@inner
def within(forms, a, p):
    """The point of box a nearest to p, world frame."""
    x = vector(forms.x, a)
    d, q = minus(p, x), x
    for k in range(3):
        e = body_axis(forms, a, k)
        q = along(q, clip(dot(d, e), -forms.size[a, k], forms.size[a, k]), e)
    return q


@inner
def middle_of_edge(forms, a, k, edge):
    """The middle of one of the four edges of box a along its axis k; edge: two bits, the sides it is on."""
    k1, k2 = (k + 1) % 3, (k + 2) % 3
    p = along(vector(forms.x, a), (1 if edge & 1 else -1) * forms.size[a, k1], body_axis(forms, a, k1))
    return along(p, (1 if edge & 2 else -1) * forms.size[a, k2], body_axis(forms, a, k2))


@inner
def edge_towards(forms, a, k, n, d):
    """Of the four edges of box a along axis k, the one farthest along n; towards d where n can't tell."""
    edge = 0
    for bit in range(2):
        e = body_axis(forms, a, (k + 1 + bit) % 3)
        lean = dot(e, n)
        if (lean if abs(lean) > 1e-9 else dot(e, d)) > 0:
            edge += 1 << bit
    return edge


@inner
def plane_box(forms, a, b, limit, raw):
    """The corners of the face that looks most towards the plane, if near: 0 to 4 contacts."""
    n = body_axis(forms, a, 0)
    k = facing(forms, b, n)
    below = dot(body_axis(forms, b, k), n) < 0
    m = 0
    for signs in range(8):
        if (signs >> k & 1) == below:
            m = plane_point(forms, a, corner(forms, b, signs), 0.0, limit, raw, m, signs)
    return m


@inner
def box_ball(forms, a, b, limit, raw):
    """0 or 1 contacts. A centre inside the box is pushed out through the nearest face."""
    c, x, r = vector(forms.x, b), vector(forms.x, a), forms.size[b, 0]
    d, deepest, face = minus(c, x), -np.inf, 0
    for k in range(3):
        out = abs(dot(d, body_axis(forms, a, k))) - forms.size[a, k]
        if out > deepest:
            deepest, face = out, k
    if deepest > 1e-9 * r:
        return put_balls(raw, 0, limit, within(forms, a, c), 0.0, c, r, body_axis(forms, a, face), 0, 0)
    n = body_axis(forms, a, face)
    n = scaled(sign(dot(d, n)), n)
    put(raw, 0, along(c, -0.5 * (deepest + r), n), n, deepest - r, 0, 0)
    return 1


@inner
def box_box(forms, a, b, limit, raw):
    """0 to 4 contacts."""
    d = minus(vector(forms.x, b), vector(forms.x, a))
    size = min(forms.radius[a], forms.radius[b])
    gap, face, n = best_face(forms, a, b, d, size, limit)
    if gap > limit:
        return 0
    gap_edges, pair, n_edges = best_edges(forms, a, b, d, size, limit)
    if gap_edges > limit:
        return 0
    tie = _LEAN_TIE if abs(dot(n, n_edges)) > _LEANING else 1e-9
    by_face = gap_edges <= gap + tie * size
    if by_face:
        m, lowest = face_contact(forms, a, b, face, n, limit, raw)
        if lowest <= gap + TIE * size or (m > 0 and gap <= 0):
            return m
    else:
        k, l = pair // 3, pair % 3
        edge_a = edge_towards(forms, a, k, n_edges, d)
        edge_b = edge_towards(forms, b, l, scaled(-1.0, n_edges), scaled(-1.0, d))
        p, q = edge_points(forms, a, k, edge_a, b, l, edge_b)
        if gap_edges <= 0 or norm(minus(q, p)) <= gap_edges + TIE * size:
            middle = along(p, 0.5, minus(q, p))
            put(raw, 0, middle, n_edges, gap_edges, box_edge(k, edge_a), box_edge(l, edge_b))
            return 1
    if max(gap, gap_edges) > 0:
        return closest_boxes(forms, a, b, limit, raw, n)
    return deepest_corner(forms, a, b, face, n, gap, raw)


@inner
def best_face(forms, a, b, d, size, limit):
    """(separation, face, n from a to b): the best normal of a face, 0–2 of a, 3–5 of b.

    Stops at the first that separates by more than the limit.
    """
    best, face, normal = -np.inf, 0, (1.0, 0.0, 0.0)
    for f in range(6):
        n = body_axis(forms, a, f) if f < 3 else body_axis(forms, b, f - 3)
        t = dot(d, n)
        if f < 3:
            gap = abs(t) - forms.size[a, f] - reach(forms, b, n)
        else:
            gap = abs(t) - forms.size[b, f - 3] - reach(forms, a, n)
        if gap > best + (TIE if f >= 3 > face else 1e-9) * size or f == 0:
            best, face, normal = gap, f, scaled(sign(t), n)
        if gap > limit:
            return gap, f, scaled(sign(t), n)
    return best, face, normal


@inner
def best_edges(forms, a, b, d, size, limit):
    """(separation, 3 k + l, n from a to b): the best cross product of an axis k of a and an axis l of b."""
    best, pair, normal = -np.inf, 0, (1.0, 0.0, 0.0)
    for k in range(3):
        for l in range(3):
            n = cross(body_axis(forms, a, k), body_axis(forms, b, l))
            length = norm(n)
            if length < _PARALLEL:
                continue
            n = scaled(1 / length, n)
            t = dot(d, n)
            gap = abs(t) - reach(forms, a, n) - reach(forms, b, n)
            if gap > best + 1e-9 * size:
                best, pair, normal = gap, 3 * k + l, scaled(sign(t), n)
            if gap > limit:
                return gap, pair, normal
    return best, pair, normal


@inner
def edge_points(forms, a, k, edge_a, b, l, edge_b):
    """The closest points of an edge of box a along its axis k and one of box b along its axis l."""
    p, q = middle_of_edge(forms, a, k, edge_a), middle_of_edge(forms, b, l, edge_b)
    e = scaled(forms.size[a, k], body_axis(forms, a, k))
    g = scaled(forms.size[b, l], body_axis(forms, b, l))
    s, t = closest_on_segments(p, e, q, g)
    return along(p, s, e), along(q, t, g)


@inner
def closest_boxes(forms, a, b, limit, raw, default):
    """One contact at the closest points of two boxes that are apart, by trying all corners and edges."""
    best, p, q, feature_a, feature_b = np.inf, default, default, 0, 0
    for v in range(16):
        on_a = v < 8
        s = corner(forms, a, v) if on_a else within(forms, a, corner(forms, b, v - 8))
        t = within(forms, b, s) if on_a else corner(forms, b, v - 8)
        distance = norm(minus(t, s))
        if distance < best:
            best, p, q = distance, s, t
            feature_a, feature_b = (v, 26) if on_a else (26, v - 8)
    for edges in range(144):
        k, l = edges // 48, edges // 4 % 3
        edge_a, edge_b = edges // 12 % 4, edges % 4
        s, t = edge_points(forms, a, k, edge_a, b, l, edge_b)
        distance = norm(minus(t, s))
        if distance < best * (1 - 1e-9):
            best, p, q = distance, s, t
            feature_a, feature_b = box_edge(k, edge_a), box_edge(l, edge_b)
    return put_balls(raw, 0, limit, p, 0.0, q, 0.0, default, feature_a, feature_b)


@inner
def deepest_corner(forms, a, b, face, n, gap, raw):
    """One contact at the corner that is farthest beyond a face: for overlaps where no faces meet."""
    other, outward = (b, scaled(-1.0, n)) if face < 3 else (a, n)
    signs = 0
    for k in range(3):
        if dot(body_axis(forms, other, k), outward) > 0:
            signs += 1 << k
    half_way = 0.5 * gap if face < 3 else -0.5 * gap
    point = along(corner(forms, other, signs), -half_way, n)
    put(raw, 0, point, n, gap, 20 + face if face < 3 else signs, signs if face < 3 else 17 + face)
    return 1
