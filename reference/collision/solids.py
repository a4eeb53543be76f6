"""What can be touched, as flat arrays: shapes by number, poses in the world, and who may meet whom.

A *solid* is a body with a size; solids are numbered in the order of the scene, points left out.

Slides S10; lectures/05_contact.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import inner
from ..rotation import conjugate, multiply, normalise, quaternion, rotate

# Kinds, in the order in which a pair's routine takes its two solids. In the plane boxes and capsules are
# polygons; a capsule of no length is a ball.
PLANE, BOX, POLYGON, CAPSULE, BALL = range(5)


class Forms(NamedTuple):
    """Where s solids are, and their shapes: all that a pair's routine needs. d dimensions, lengths in m."""

    size: np.ndarray  # (s, 3): half extents of a box; radius, half length, 0 of all others
    radius: np.ndarray  # (s,) of a ball about the centre that holds it; inf of a plane
    x: np.ndarray  # (s, d) position, world frame
    axes: np.ndarray  # (s, d, d) rows: the body's axes in the world; row 0 of a plane: its normal
    first: np.ndarray  # (s + 1,) int: solid a has the corners first[a] … first[a + 1] (in the plane only)
    corner: np.ndarray  # (c, 2) world frame, anticlockwise
    normal: np.ndarray  # (c, 2) world frame, of the side from this corner to the next
    length: np.ndarray  # (c,) of that side


class Solids(NamedTuple):
    """s solids in d dimensions. What ``place`` renews: form's x, axes, corner, normal; reach, low, high."""

    form: Forms
    number: np.ndarray  # (s,) int, the body's number in the scene
    slot: np.ndarray  # (s,) int, its row in the State; −1: static
    kind: np.ndarray  # (s,) int
    principal: np.ndarray  # (s, 4) in space: principal frame → body frame; (s, 0) in the plane
    corner_in_body: np.ndarray  # (c, 2)
    normal_in_body: np.ndarray  # (c, 2)
    friction: np.ndarray  # (s,)
    restitution: np.ndarray  # (s,)
    group: np.ndarray  # (s,) int; −1: none
    apart: np.ndarray  # (e,) int, sorted: a · s + b of each pair, a < b, that may not touch
    special: np.ndarray  # (p,) int, sorted: a · s + b of each pair with a law of its own
    special_law: np.ndarray  # (p, 2) friction, restitution; nan: made from the bodies' own
    reach: np.ndarray  # (s,) half the margin, and the speed bound times the step, m
    low: np.ndarray  # (s, d) lower corner of the bounding box, grown by reach
    high: np.ndarray  # (s, d) upper corner


@inner
def place(solids, state, margin, h):
    """Take the poses of what moves from the state, and renew axes, corners, reach and bounding boxes.

    margin: m, how far apart solids may be and still count; h: s, the time within which they may come closer.
    """
    for a in range(len(solids.kind)):
        slot = solids.slot[a]
        speed = 0.0
        if slot >= 0:
            speed = take_pose(solids, a, state, slot)
        solids.reach[a] = 0.5 * margin + h * speed
        bound(solids, a)


@inner
def take_pose(solids, a, state, slot):
    """Position and axes of solid a from its row of the state; returns a bound on the speed of its points."""
    squared, turning = 0.0, 0.0
    for k in range(state.x.shape[1]):
        solids.form.x[a, k] = state.x[slot, k]
        squared += state.v[slot, k] ** 2
    for k in range(state.ω.shape[1]):
        turning += state.ω[slot, k] ** 2
    if state.q.shape[1] == 1:
        place_in_plane(solids, a, state.q[slot, 0])
    else:
        q = multiply(quaternion(state.q, slot), conjugate(quaternion(solids.principal, a)))
        place_in_space(solids, a, normalise(q))
    return np.sqrt(squared) + np.sqrt(turning) * solids.form.radius[a]


@inner
def place_in_space(solids, a, q):
    """The axes of a solid that is turned by q, body frame → world."""
    axes = solids.form.axes
    axes[a, 0, 0], axes[a, 0, 1], axes[a, 0, 2] = rotate(q, (1.0, 0.0, 0.0))
    axes[a, 1, 0], axes[a, 1, 1], axes[a, 1, 2] = rotate(q, (0.0, 1.0, 0.0))
    axes[a, 2, 0], axes[a, 2, 1], axes[a, 2, 2] = rotate(q, (0.0, 0.0, 1.0))


@inner
def place_in_plane(solids, a, θ):
    """The axes and corners of a solid that is turned by θ."""
    c, s, form = np.cos(θ), np.sin(θ), solids.form
    form.axes[a, 0, 0], form.axes[a, 0, 1], form.axes[a, 1, 0], form.axes[a, 1, 1] = c, s, -s, c
    for k in range(form.first[a], form.first[a + 1]):
        x, y = solids.corner_in_body[k, 0], solids.corner_in_body[k, 1]
        form.corner[k, 0], form.corner[k, 1] = form.x[a, 0] + c * x - s * y, form.x[a, 1] + s * x + c * y
        x, y = solids.normal_in_body[k, 0], solids.normal_in_body[k, 1]
        form.normal[k, 0], form.normal[k, 1] = c * x - s * y, s * x + c * y


@inner
def bound(solids, a):
    """The bounding box of a solid, grown by its reach; that of a plane has no end."""
    kind, axes = solids.kind[a], solids.form.axes
    for k in range(axes.shape[1]):
        if kind == PLANE:
            low, high = -np.inf, np.inf
        elif kind == POLYGON:
            low, high = np.inf, -np.inf
            for c in range(solids.form.first[a], solids.form.first[a + 1]):
                low, high = min(low, solids.form.corner[c, k]), max(high, solids.form.corner[c, k])
            low, high = low - solids.form.size[a, 0], high + solids.form.size[a, 0]
        else:
            extent = solids.form.size[a, 0]
            if kind == BOX:
                extent = 0.0
                for i in range(axes.shape[1]):
                    extent += solids.form.size[a, i] * abs(axes[a, i, k])
            elif kind == CAPSULE:
                extent += solids.form.size[a, 1] * abs(axes[a, 2, k])
            low, high = solids.form.x[a, k] - extent, solids.form.x[a, k] + extent
        solids.low[a, k], solids.high[a, k] = low - solids.reach[a], high + solids.reach[a]
