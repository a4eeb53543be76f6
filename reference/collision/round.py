"""Contacts of balls and capsules in space, with each other and with a plane.

A capsule is a segment thickened by its radius. Two capsules side by side touch along a line: that makes two
contacts, at the ends of the stretch which they share, so that neither can tip about a single point.

Slides S10; lectures/05_contact.md.
"""

from ..compiled import inner
from ..rotation import vector
from .closest import (
    along,
    body_axis,
    clip,
    closest_on_segments,
    crossing,
    dot,
    minus,
    norm,
    put,
    put_balls,
    scaled,
    sign,
)

UP = (0.0, 0.0, 1.0)  # n of balls with one centre: any direction is right, this one is told

_SIDE_BY_SIDE = 1e-3  # of the radii: how much farther apart than the closest points the ends may be


@inner
def ball_ball(forms, a, b, limit, raw):
    """Returns the number of contacts, 0 or 1."""
    r_a, r_b = forms.size[a, 0], forms.size[b, 0]
    return put_balls(raw, 0, limit, vector(forms.x, a), r_a, vector(forms.x, b), r_b, UP, 0, 0)


@inner
def capsule_ball(forms, a, b, limit, raw):
    """The ball against the nearest point of the capsule's segment: 0 or 1 contacts."""
    x, c, e = vector(forms.x, a), vector(forms.x, b), body_axis(forms, a, 2)
    s = clip(dot(minus(c, x), e), -forms.size[a, 1], forms.size[a, 1])
    r_a, r_b = forms.size[a, 0], forms.size[b, 0]
    return put_balls(raw, 0, limit, along(x, s, e), r_a, c, r_b, crossing(e, e), 0, 0)


@inner
def capsule_capsule(forms, a, b, limit, raw):
    """1 contact where the segments are closest; 2 where they lie side by side.

    Features: 1 and 2 an end, 0 somewhere on the side.
    """
    x, y = vector(forms.x, a), vector(forms.x, b)
    e, g = body_axis(forms, a, 2), body_axis(forms, b, 2)
    r_a, h_a, r_b, h_b = forms.size[a, 0], forms.size[a, 1], forms.size[b, 0], forms.size[b, 1]
    s, t = closest_on_segments(x, scaled(h_a, e), y, scaled(h_b, g))
    p, q, default = along(x, s * h_a, e), along(y, t * h_b, g), crossing(e, g)
    nearest = norm(minus(q, p))
    if nearest - r_a - r_b > limit:
        return 0
    middle, half = dot(minus(y, x), e), h_b * abs(dot(e, g))  # b's shadow on a's line
    low, high = max(-h_a, middle - half), min(h_a, middle + half)
    if high - low > _SIDE_BY_SIDE * (r_a + r_b):
        turned = sign(dot(e, g))
        m, farthest = 0, 0.0
        for end in (-1.0, 1.0):
            p_end, q_end = along(x, end * h_a, e), along(y, end * turned * h_b, g)
            reach = dot(minus(q_end, x), e)
            if end * reach < h_a:  # b ends first
                p_end = along(x, clip(reach, -h_a, h_a), e)
                feature_a, feature_b = 0, 1 + (end * turned > 0)
            else:
                q_end = along(y, clip(dot(minus(p_end, y), g), -h_b, h_b), g)
                feature_a, feature_b = 1 + (end > 0), 0
            farthest = max(farthest, norm(minus(q_end, p_end)))
            m = put_balls(raw, m, limit, p_end, r_a, q_end, r_b, default, feature_a, feature_b)
        if m > 0 and farthest <= nearest + _SIDE_BY_SIDE * (r_a + r_b):
            return m
    return put_balls(raw, 0, limit, p, r_a, q, r_b, default, 0, 0)


@inner
def plane_ball(forms, a, b, limit, raw):
    """0 or 1 contacts."""
    return plane_point(forms, a, vector(forms.x, b), forms.size[b, 0], limit, raw, 0, 0)


@inner
def plane_capsule(forms, a, b, limit, raw):
    """Each end of the capsule that is near: 0 to 2 contacts."""
    m = 0
    for end in (-1.0, 1.0):
        p = along(vector(forms.x, b), end * forms.size[b, 1], body_axis(forms, b, 2))
        m = plane_point(forms, a, p, forms.size[b, 0], limit, raw, m, 1 + (end > 0))
    return m


@inner
def plane_point(forms, a, p, r, limit, raw, m, feature):
    """A ball of radius r about p against the plane a, if near; returns m, or m + 1."""
    n = body_axis(forms, a, 0)
    gap = dot(minus(p, vector(forms.x, a)), n) - r
    if not gap <= limit:
        return m
    put(raw, m, along(p, -r - 0.5 * gap, n), n, gap, 0, feature)
    return m + 1
