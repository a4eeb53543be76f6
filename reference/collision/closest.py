"""Vectors as components, closest points of segments, and the contact of two balls: what all pairs need.

A shape is a *core* (a point, a segment, a polygon, a box) that is thickened by a radius. Where cores are
apart, the closest points of the cores give the contact, whatever the shapes.

Slides S10; lectures/05_contact.md. Source of the segments: Ericson, Real-Time Collision Detection (2005),
section 5.1.9.
"""

import numpy as np

from ..compiled import inner
from ..rotation import cross, store

# Relative to the pair's size: what counts as touching a boundary (ids don't change within it), and as a tie.
SLOP, TIE = 1e-5, 1e-6


@inner
def dot(a, b):
    """a·b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inner
def minus(a, b):
    """a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@inner
def along(p, s, n):
    """p + s n."""
    return p[0] + s * n[0], p[1] + s * n[1], p[2] + s * n[2]


@inner
def scaled(s, n):
    """s n."""
    return s * n[0], s * n[1], s * n[2]


@inner
def norm(a):
    """|a|."""
    return np.sqrt(a[0] ** 2 + a[1] ** 2 + a[2] ** 2)


@inner
def clip(s, low, high):
    """s, or the bound it lies beyond."""
    return min(max(s, low), high)


@inner
def sign(s):
    """−1 for what is negative, else 1."""
    return -1.0 if s < 0 else 1.0


@inner
def tangent(n):
    """A unit vector t1 at right angles to n; t1(−n) = t1(n), so that only t2 = n × t1 turns with the sign.

    x for n along y or z, y for n along x. In between, the projection of a fixed polynomial of n, so t1 is
    continuous but at the two directions ±(.73, .58, .37) or so, where this projection vanishes: no tangent
    field can be continuous on the whole sphere, and these are directions no usual scene prefers.
    """
    s = n[0] * n[0]
    a = (1 - s, s, s * (1 - s))
    t = along(a, -dot(a, n), n)
    length = norm(t)
    if length < 1e-7:  # n is one of the two directions
        t = (1 - n[0] * n[0], -n[0] * n[1], -n[0] * n[2])
        length = norm(t)
    return scaled(1 / length, t)


@inner
def closest_on_segments(p, a, q, b):
    """(s, t), both −1 … 1, of the closest points p + s a and q + t b of two segments, neither a point.

    Parallel segments: the pair that the middle of the first would choose.
    """
    r = minus(p, q)
    aa, bb, ab, ar, br = dot(a, a), dot(b, b), dot(a, b), dot(a, r), dot(b, r)
    squared_sine = aa * bb - ab * ab
    s = clip((ab * br - ar * bb) / squared_sine, -1.0, 1.0) if squared_sine > 1e-14 * aa * bb else 0.0
    t = clip((ab * s + br) / bb, -1.0, 1.0)
    return clip((ab * t - ar) / aa, -1.0, 1.0), t


@inner
def body_axis(forms, a, k):
    """Axis k of solid a, world frame."""
    return forms.axes[a, k, 0], forms.axes[a, k, 1], forms.axes[a, k, 2]


@inner
def put(raw, k, point, n, gap, feature_a, feature_b):
    """Write contact k: the point half way between the surfaces, n from a to b, the gap, what touches what."""
    store(raw.point, k, point)
    store(raw.normal, k, n)
    raw.gap[k] = gap
    raw.feature[k, 0] = feature_a
    raw.feature[k, 1] = feature_b


@inner
def put_balls(raw, k, limit, p, r_p, q, r_q, default, feature_a, feature_b):
    """The contact of balls about p (of a) and q (of b), if its gap is within the limit; returns k, or k + 1.

    ``default``: n where the centres coincide.
    """
    Δ = minus(q, p)
    distance = norm(Δ)
    gap = distance - r_p - r_q
    if not gap <= limit:
        return k
    n = default if distance < 1e-14 * (r_p + r_q) or distance == 0 else scaled(1 / distance, Δ)
    put(raw, k, along(p, r_p + 0.5 * gap, n), n, gap, feature_a, feature_b)
    return k + 1


@inner
def crossing(a, b):
    """A unit vector at right angles to the unit vectors a and b, parallel or not."""
    n = cross(a, b)
    length = norm(n)
    return scaled(1 / length, n) if length > 1e-7 else tangent(a)
