"""A face of one box against a face of another: the second face's outline, cut to the first.

The *reference* face is the one whose normal is n. The *incident* face is the other box's face that looks most
towards it. All is measured in the reference face's own coordinates: u, v from its middle, height w above it,
so a corner's gap is w.

Each corner of what is left lies on two lines, and their names make its id: two edges of the incident face (a
corner of that box), one edge of each (a crossing), or two edges of the reference face (a corner of that box).
So an id says which features touch, and doesn't depend on which face was the reference. Corners that are
outside by less than ``SLOP`` are moved on to the edge: so equal boxes on top of each other keep their ids.

Features of a box: 0–7 a corner (bit k set: positive along axis k), 8–19 an edge, 20–22 a face, by its axis,
26 any.

Slides S10; lectures/05_contact.md. Source: Sutherland & Hodgman, Reentrant Polygon Clipping (1974).
"""

import numpy as np

from ..compiled import inner
from ..rotation import store, vector
from .closest import SLOP, TIE, along, body_axis, dot, minus, put, scaled, sign

_LEVEL = 1e-4  # of the face's size: depths that differ by less are equally deep, when four corners are chosen


@inner
def box_edge(k, edge):
    """The feature of a box's edge along axis k; edge: two bits, its sides along axes k + 1 and k + 2."""
    return 8 + 4 * k + edge


@inner
def face_contact(forms, a, b, face, n, limit, raw):
    """(m, lowest): contacts of boxes a and b by a face (0–2 of a, 3–5 of b), n from a to b.

    m: 0 to 4, with gaps within the limit; lowest: the least height of a corner, inf if the faces don't meet.
    """
    r, o, k, turn = (a, b, face, 1.0) if face < 3 else (b, a, face - 3, -1.0)
    n_r = scaled(turn, n)
    own = 1 if dot(body_axis(forms, r, k), n_r) > 0 else 0  # which of the two faces along axis k
    l = facing(forms, o, n_r)
    other = 1 if dot(body_axis(forms, o, l), n_r) < 0 else 0
    outline_incident(forms, r, k, n_r, o, l, other, raw)
    size = min(
        max(forms.size[r, (k + 1) % 3], forms.size[r, (k + 2) % 3]),
        max(forms.size[o, (l + 1) % 3], forms.size[o, (l + 2) % 3]),
    )
    corners = 4
    for side in range(4):
        corners = cut(raw, corners, side, forms.size[r, (k + 1 + side // 2) % 3], SLOP * size)
        if corners == 0:
            return 0, np.inf
    lowest = np.inf
    m = 0
    for c in range(corners):
        w = raw.corner[c, 2]
        lowest = min(lowest, w)
        if w <= limit and not repeated(raw, c, m, SLOP * size):
            before = raw.label[c - 1] if c > 0 else raw.label[corners - 1]
            feature_r, feature_o = features(before, raw.label[c], k, own, l, other)
            copy_corner(raw.corner, c, raw.corner, m)
            raw.pick[m, 0], raw.pick[m, 1] = feature_r, feature_o
            m += 1
    if m > 4:
        choose_four(raw, m, size)
        m = 4
    u_axis, v_axis = body_axis(forms, r, (k + 1) % 3), body_axis(forms, r, (k + 2) % 3)
    for c in range(m):
        u, v, w = vector(raw.corner, c)
        point = along(along(vector(forms.x, r), u, u_axis), v, v_axis)
        point = along(point, forms.size[r, k] + 0.5 * w, n_r)
        feature_r, feature_o = raw.pick[c, 0], raw.pick[c, 1]
        if face < 3:
            put(raw, c, point, n, w, feature_r, feature_o)
        else:
            put(raw, c, point, n, w, feature_o, feature_r)
    return m, lowest


@inner
def facing(forms, o, n):
    """The axis of box o that is most nearly parallel to n; of equals the first."""
    best = 0
    for k in range(1, 3):
        lean = abs(dot(body_axis(forms, o, k), n))
        if lean > abs(dot(body_axis(forms, o, best), n)) + TIE:
            best = k
    return best


@inner
def outline_incident(forms, r, k, n_r, o, l, other, raw):
    """Fill raw.corner with the incident face's four corners as (u, v, w), raw.label with its edges."""
    u_axis, v_axis = body_axis(forms, r, (k + 1) % 3), body_axis(forms, r, (k + 2) % 3)
    l1, l2 = (l + 1) % 3, (l + 2) % 3
    d = minus(vector(forms.x, o), vector(forms.x, r))
    middle = along(d, (1.0 if other else -1.0) * forms.size[o, l], body_axis(forms, o, l))
    for c in range(4):
        s1, s2 = 1.0 if c == 0 or c == 3 else -1.0, 1.0 if c < 2 else -1.0
        p = along(middle, s1 * forms.size[o, l1], body_axis(forms, o, l1))
        p = along(p, s2 * forms.size[o, l2], body_axis(forms, o, l2))
        store(raw.corner, c, (dot(p, u_axis), dot(p, v_axis), dot(p, n_r) - forms.size[r, k]))
        raw.label[c] = c


@inner
def cut(raw, corners, side, extent, slop):
    """Cut the outline at a side of the reference face (0, 1: ±u; 2, 3: ±v); returns how many corners it has.

    raw.label[c]: the line from corner c to the next, 0–3 an incident edge, 4 + side a side.
    """
    along_k, s, kept = side // 2, 1.0 if side % 2 == 0 else -1.0, 0
    for c in range(corners):
        following = c + 1 if c + 1 < corners else 0
        out, out_next = s * raw.corner[c, along_k] - extent, s * raw.corner[following, along_k] - extent
        inside, inside_next = out <= slop, out_next <= slop
        if inside:
            copy_corner(raw.corner, c, raw.spare, kept)
            if out > 0:
                raw.spare[kept, along_k] = s * extent
            raw.spare_label[kept] = raw.label[c]
            kept += 1
        if inside != inside_next:
            part = out / (out - out_next)
            for i in range(3):
                raw.spare[kept, i] = raw.corner[c, i] + part * (raw.corner[following, i] - raw.corner[c, i])
            raw.spare[kept, along_k] = s * extent
            raw.spare_label[kept] = 4 + side if inside else raw.label[c]
            kept += 1
    for c in range(kept):
        copy_corner(raw.spare, c, raw.corner, c)
        raw.label[c] = raw.spare_label[c]
    return kept


@inner
def copy_corner(a, i, b, j):
    """Row i of a into row j of b."""
    b[j, 0], b[j, 1], b[j, 2] = a[i, 0], a[i, 1], a[i, 2]


@inner
def repeated(raw, c, m, slop):
    """Whether corner c coincides with one of the first m, those already kept."""
    for i in range(m):
        if (
            abs(raw.corner[i, 0] - raw.corner[c, 0]) <= slop
            and abs(raw.corner[i, 1] - raw.corner[c, 1]) <= slop
            and abs(raw.corner[i, 2] - raw.corner[c, 2]) <= slop
        ):
            return True
    return False


@inner
def features(before, after, k, own, l, other):
    """(of the reference, of the incident box): what meets where the lines ``before`` and ``after`` do.

    k, l: the axes of the reference and the incident face; own, other: 1 for the face on the positive side.
    """
    if before < 4 and after < 4:
        s1, s2 = 1 if after == 0 or after == 3 else 0, 1 if after < 2 else 0
        return 20 + k, corner_code(l, other, s1, s2)
    if before >= 4 and after >= 4:
        u_side, v_side = min(before, after) - 4, max(before, after) - 4
        return corner_code(k, own, 1 - u_side % 2, 1 - v_side % 2), 20 + l
    side, edge = max(before, after) - 4, min(before, after)
    return side_edge(k, own, side), incident_edge(l, other, edge)


@inner
def corner_code(k, s, s1, s2):
    """The corner with these signs (0, 1) along the axes k, k + 1 and k + 2."""
    return s << k | s1 << (k + 1) % 3 | s2 << (k + 2) % 3


@inner
def side_edge(k, s, side):
    """The edge of a face (axis k, sign s) on one of its sides: 0, 1 at ±u, 2, 3 at ±v."""
    positive = 1 - side % 2
    if side < 2:  # runs along v, axis k + 2; its bits are the axes k and k + 1
        return box_edge((k + 2) % 3, s + 2 * positive)
    return box_edge((k + 1) % 3, positive + 2 * s)  # along u, axis k + 1; its bits are the axes k + 2 and k


@inner
def incident_edge(l, s, edge):
    """The edge from corner ``edge`` of an incident face to the next: they run −u, −v, +u, +v round it."""
    if edge == 0 or edge == 2:
        return side_edge(l, s, 2 if edge == 0 else 3)
    return side_edge(l, s, 1 if edge == 1 else 0)


@inner
def choose_four(raw, m, size):
    """Put four of the m corners first: the deepest, then what makes the largest triangle and quadrangle.

    A candidate must win clearly, else the one before stays: so the choice doesn't flicker.
    """
    for chosen in range(4):
        best, score = chosen, -np.inf
        for c in range(chosen, m):
            value = worth(raw, c, chosen)
            if value > score + _LEVEL * (size if chosen == 0 else size * size):
                best, score = c, value
        for i in range(3):
            raw.corner[chosen, i], raw.corner[best, i] = raw.corner[best, i], raw.corner[chosen, i]
        for i in range(2):
            raw.pick[chosen, i], raw.pick[best, i] = raw.pick[best, i], raw.pick[chosen, i]


@inner
def worth(raw, c, chosen):
    """What corner c adds to those chosen: depth, squared distance, area, area outside the triangle."""
    if chosen == 0:
        return -raw.corner[c, 2]
    if chosen == 1:
        return (raw.corner[c, 0] - raw.corner[0, 0]) ** 2 + (raw.corner[c, 1] - raw.corner[0, 1]) ** 2
    whole = area(raw, 0, 1, c if chosen == 2 else 2)
    if chosen == 2:
        return abs(whole)
    turn = sign(whole)
    return max(-turn * area(raw, 0, 1, c), -turn * area(raw, 1, 2, c), -turn * area(raw, 2, 0, c))


@inner
def area(raw, i, j, k):
    """Twice the area of three corners in the face, positive if anticlockwise."""
    return (raw.corner[j, 0] - raw.corner[i, 0]) * (raw.corner[k, 1] - raw.corner[i, 1]) - (
        raw.corner[j, 1] - raw.corner[i, 1]
    ) * (raw.corner[k, 0] - raw.corner[i, 0])
