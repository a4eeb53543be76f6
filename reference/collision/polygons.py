"""Contacts in the plane: convex polygons, thick ones too, discs and half-planes.

A box is a polygon of four corners; a capsule is one as well, with no width, thickened by its radius. (So it
has four sides, two of no length, whose normals point along it.) Two polygons are apart if a normal of a side
separates them. The one along which they are farthest apart, or overlap least, is n. The other polygon's side
that looks most towards it is cut to it, which leaves two points or one; where that misses, though the
polygons are apart, the closest points are corners.

Near ties are decided for the first polygon's side, so that resting contact doesn't flicker.
Features: 2 k a corner, 2 k + 1 the side from corner k to the next.

Slides S10; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import inner
from .closest import SLOP, TIE, clip


@inner
def pair(a, i):
    """Row i of an array (n, 2) as components."""
    return a[i, 0], a[i, 1]


@inner
def put_planar(raw, k, x, y, n, gap, feature_a, feature_b):
    """Write contact k; like ``closest.put``, in the plane."""
    raw.point[k, 0], raw.point[k, 1] = x, y
    raw.normal[k, 0], raw.normal[k, 1] = n
    raw.gap[k] = gap
    raw.feature[k, 0] = feature_a
    raw.feature[k, 1] = feature_b


@inner
def put_discs(raw, k, limit, p, r_p, q, r_q, default, feature_a, feature_b):
    """The contact of discs about p (of a) and q (of b), if within the limit; returns k, or k + 1."""
    dx, dy = q[0] - p[0], q[1] - p[1]
    distance = np.sqrt(dx * dx + dy * dy)
    gap = distance - r_p - r_q
    if not gap <= limit:
        return k
    n = default
    if distance > 1e-14 * (r_p + r_q):
        n = (dx / distance, dy / distance)
    s = r_p + 0.5 * gap
    put_planar(raw, k, p[0] + s * n[0], p[1] + s * n[1], n, gap, feature_a, feature_b)
    return k + 1


@inner
def disc_disc(forms, a, b, limit, raw):
    """0 or 1 contacts; n is upwards where the centres coincide."""
    r_a, r_b = forms.size[a, 0], forms.size[b, 0]
    return put_discs(raw, 0, limit, pair(forms.x, a), r_a, pair(forms.x, b), r_b, (0.0, 1.0), 0, 0)


@inner
def halfplane_point(forms, a, p, r, limit, raw, m, feature):
    """A disc of radius r about p against the plane a, if near; returns m, or m + 1."""
    n, x = (forms.axes[a, 0, 0], forms.axes[a, 0, 1]), pair(forms.x, a)
    gap = (p[0] - x[0]) * n[0] + (p[1] - x[1]) * n[1] - r
    if not gap <= limit:
        return m
    s = -r - 0.5 * gap
    put_planar(raw, m, p[0] + s * n[0], p[1] + s * n[1], n, gap, 0, feature)
    return m + 1


@inner
def halfplane_polygon(forms, a, b, limit, raw):
    """The ends of the side that looks most towards the plane, if near: 0 to 2 contacts."""
    n, first, last = (forms.axes[a, 0, 0], forms.axes[a, 0, 1]), forms.first[b], forms.first[b + 1]
    side = facing_side(forms, first, last, n)
    m = halfplane_point(
        forms, a, pair(forms.corner, side), forms.size[b, 0], limit, raw, 0, 2 * (side - first)
    )
    following = side + 1 if side + 1 < last else first
    return halfplane_point(
        forms, a, pair(forms.corner, following), forms.size[b, 0], limit, raw, m, 2 * (following - first)
    )


@inner
def facing_side(forms, first, last, n):
    """The side of a polygon whose normal is most nearly opposite to n; of equals the first.

    A side of no length, the end of a capsule, is none here: both of its ends would be one point.
    """
    best, lean = -1, np.inf
    for k in range(first, last):
        value = forms.normal[k, 0] * n[0] + forms.normal[k, 1] * n[1]
        if forms.length[k] > 0 and value < lean - TIE:
            best, lean = k, value
    return best


@inner
def polygon_disc(forms, a, b, limit, raw):
    """0 or 1 contacts. A centre inside the polygon is pushed out through the nearest side."""
    c, first, last = pair(forms.x, b), forms.first[a], forms.first[a + 1]
    r_a, r_b = forms.size[a, 0], forms.size[b, 0]
    best, side = -np.inf, first
    for k in range(first, last):
        p, n = pair(forms.corner, k), pair(forms.normal, k)
        gap = (c[0] - p[0]) * n[0] + (c[1] - p[1]) * n[1]
        if gap > best + 1e-12 * forms.radius[a]:
            best, side = gap, k
    if best - r_a - r_b > limit:
        return 0
    p, n, length = pair(forms.corner, side), pair(forms.normal, side), forms.length[side]
    u = -(c[0] - p[0]) * n[1] + (c[1] - p[1]) * n[0]  # along the side
    if best > 1e-9 * (r_a + r_b) or u < 0 or u > length:
        u = clip(u, 0.0, length)
        q = (p[0] - u * n[1], p[1] + u * n[0])
        return put_discs(raw, 0, limit, q, r_a, c, r_b, n, 0, 0)
    s = -r_b - 0.5 * (best - r_a - r_b)
    put_planar(raw, 0, c[0] + s * n[0], c[1] + s * n[1], n, best - r_a - r_b, 0, 0)
    return 1


@inner
def polygon_polygon(forms, a, b, limit, raw):
    """0 to 2 contacts."""
    thick, size = forms.size[a, 0] + forms.size[b, 0], min(forms.radius[a], forms.radius[b])
    gap, side = best_side(forms, a, b, size)
    if gap - thick > limit:
        return 0
    gap_b, side_b = best_side(forms, b, a, size)
    if gap_b - thick > limit:
        return 0
    swapped = gap_b > gap + TIE * size
    if swapped:
        gap, side = gap_b, side_b
    r, o, turn = (b, a, -1.0) if swapped else (a, b, 1.0)
    m, lowest = side_contact(forms, r, o, side, limit, SLOP * size, raw)
    if lowest > gap + TIE * size and not (m > 0 and gap <= 0):
        if gap > 0:
            return closest_corners(forms, a, b, limit, raw, turn)
        m = deepest_point(forms, r, o, side, gap, raw)
    if swapped:
        for k in range(m):
            raw.normal[k, 0], raw.normal[k, 1] = -raw.normal[k, 0], -raw.normal[k, 1]
            raw.feature[k, 0], raw.feature[k, 1] = raw.feature[k, 1], raw.feature[k, 0]
    return m


@inner
def best_side(forms, a, b, size):
    """(separation, side): the side of polygon a from which polygon b is farthest away."""
    best, side = -np.inf, forms.first[a]
    for k in range(forms.first[a], forms.first[a + 1]):
        p, n = pair(forms.corner, k), pair(forms.normal, k)
        gap = np.inf
        for c in range(forms.first[b], forms.first[b + 1]):
            gap = min(gap, (forms.corner[c, 0] - p[0]) * n[0] + (forms.corner[c, 1] - p[1]) * n[1])
        if gap > best + 1e-9 * size:
            best, side = gap, k
    return best, side


@inner
def side_contact(forms, r, o, side, limit, slop, raw):
    """(m, lowest): polygon o against a side of r: its facing side, cut to that; n and features from r to o.

    m: 0 to 2; lowest: the least height above the side, inf if what faces it is not over it.
    """
    first, first_o = forms.first[r], forms.first[o]
    p, n, length = pair(forms.corner, side), pair(forms.normal, side), forms.length[side]
    facing = facing_side(forms, first_o, forms.first[o + 1], n)
    following = facing + 1 if facing + 1 < forms.first[o + 1] else first_o
    next_side = side + 1 if side + 1 < forms.first[r + 1] else first
    c, d = pair(forms.corner, facing), pair(forms.corner, following)
    u_c, u_d = -(c[0] - p[0]) * n[1] + (c[1] - p[1]) * n[0], -(d[0] - p[0]) * n[1] + (d[1] - p[1]) * n[0]
    w_c, w_d = (c[0] - p[0]) * n[0] + (c[1] - p[1]) * n[1], (d[0] - p[0]) * n[0] + (d[1] - p[1]) * n[1]
    if max(u_c, u_d) < -slop or min(u_c, u_d) > length + slop:
        return 0, np.inf
    r_r, r_o, lowest, m = forms.size[r, 0], forms.size[o, 0], np.inf, 0
    placed = np.inf
    for end in range(2):
        u, w = (u_c, w_c) if end == 0 else (u_d, w_d)
        u_end = clip(u, 0.0, length)
        feature_r = 2 * (side - first) + 1
        feature_o = 2 * ((facing if end == 0 else following) - first_o)
        if abs(u - u_end) > slop and u_c != u_d:
            w += (u_end - u) * (w_d - w_c) / (u_d - u_c)
            feature_r = 2 * ((side if u_end == 0 else next_side) - first)
            feature_o = 2 * (facing - first_o) + 1
        lowest = min(lowest, w)
        if abs(u_end - placed) <= slop and abs(u_c - u_d) > slop:
            continue  # cut to one point: the side of r has no length
        if w - r_r - r_o <= limit:
            s = r_r + 0.5 * (w - r_r - r_o)
            x, y = p[0] - u_end * n[1] + s * n[0], p[1] + u_end * n[0] + s * n[1]
            put_planar(raw, m, x, y, n, w - r_r - r_o, feature_r, feature_o)
            placed, m = u_end, m + 1
    return m, lowest


@inner
def closest_corners(forms, a, b, limit, raw, turn):
    """One contact at the closest points of two polygons that are apart: each corner against each side."""
    best, p, q, feature_a, feature_b = np.inf, (0.0, 0.0), (0.0, 0.0), 0, 0
    for swapped in range(2):
        r, o = (b, a) if swapped else (a, b)
        for k in range(forms.first[r], forms.first[r + 1]):
            s, n, length = pair(forms.corner, k), pair(forms.normal, k), forms.length[k]
            for c in range(forms.first[o], forms.first[o + 1]):
                t = pair(forms.corner, c)
                u = clip(-(t[0] - s[0]) * n[1] + (t[1] - s[1]) * n[0], 0.0, length)
                x, y = s[0] - u * n[1], s[1] + u * n[0]
                distance = (t[0] - x) ** 2 + (t[1] - y) ** 2
                if distance < best * (1 - 1e-9):
                    best = distance
                    corner, other = 2 * (c - forms.first[o]), 2 * (k - forms.first[r]) + (u > 0)
                    p, q = (t, (x, y)) if swapped else ((x, y), t)
                    feature_a, feature_b = (corner, other) if swapped else (other, corner)
    r_a, r_b = forms.size[a, 0], forms.size[b, 0]
    return put_discs(raw, 0, limit, p, r_a, q, r_b, (0.0, turn), feature_a, feature_b)


@inner
def deepest_point(forms, r, o, side, gap, raw):
    """One contact at the corner of o that is farthest beyond a side of r: where sides don't meet."""
    p, n, deepest = pair(forms.corner, side), pair(forms.normal, side), forms.first[o]
    for c in range(forms.first[o], forms.first[o + 1]):
        w = (forms.corner[c, 0] - p[0]) * n[0] + (forms.corner[c, 1] - p[1]) * n[1]
        w_before = (forms.corner[deepest, 0] - p[0]) * n[0] + (forms.corner[deepest, 1] - p[1]) * n[1]
        if w < w_before:
            deepest = c
    c, r_r, r_o = pair(forms.corner, deepest), forms.size[r, 0], forms.size[o, 0]
    s = -r_o - 0.5 * (gap - r_r - r_o)
    feature_r, feature_o = 2 * (side - forms.first[r]) + 1, 2 * (deepest - forms.first[o])
    put_planar(raw, 0, c[0] + s * n[0], c[1] + s * n[1], n, gap - r_r - r_o, feature_r, feature_o)
    return 1
