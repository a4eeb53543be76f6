"""The middle of a step: where the contacts are when their impulses act.

A step flies for half its time with the velocities u, there u changes to u⁺, and it flies on with these. So
what turns on a corner, or rolls over another body, is pushed along the normal that it has half way, and the
error of a step is of order h³, not h².

Such a contact needs more than w⁺ = 0, half way. While a body turns about its corner, the corner's velocity
as the rows tell it changes by J̇ u h from the step's start to its end. Half of that is seen on the way to the
middle, w − w_start. The other half is to come, and w⁺ must leave room for it:

    w⁺ + (w − w_start) ≥ 0        so that w is 0, not half way, but at the end

(At the level of accelerations, J u̇ + J̇ u ≥ 0: S5.) Where something lands the rows stay as they are.

Slides S5, S9, S12; lectures/05_contact.md. Source: Jean, CMAME 177 (1999) 235 (contact at the middle of the
step).
"""

from typing import NamedTuple

import numpy as np

from ..collision import ContactArrays
from ..collision.find import make_contacts
from ..compiled import compiled_apart, inner, lean, lean_apart
from ..contacts import along, key_of, label_islands, owner, part, parting_speed, relative_velocity
from ..lcp.augmented import dot
from .moving import move

SAME = 0.9  # cosine of the angle between two normals of one contact, at least
LEFT = 0.25  # of the bias: by so much its error may let a contact close
TOUCHES = 100  # times the gap that counts as none: what is so near isn't brought nearer


class Near(NamedTuple):
    """What the contacts half way are looked for with."""

    collider: tuple  # the arrays that ``collision.detect`` takes
    room: ContactArrays
    half: ContactArrays  # those of the start, as they are half way


def make_near(collider, d):
    """``Near`` for a Collider; None: nothing can touch. d dimensions."""
    if not collider:
        return Near((), make_contacts(0, d), make_contacts(0, d))
    return Near(collider.arrays, *collider.spare)


def half_way(collider, system, state, work, speeds, near, contacts, h, limits):
    """Fly for half of h with the velocities that there are. Returns these contacts as they are half way."""
    move(system, speeds.before, speeds.before, 0.5 * h, state, work)
    if not collider or not moves(contacts, speeds.before):
        return contacts
    margin = reach(speeds, h, limits.closed)
    pairs, found = collider.detect(*near.collider, near.room, state, margin, h)
    if pairs > len(near.collider[2]) or found > len(near.room.gap):  # no room: that of the start will do
        return contacts
    match(contacts, near.room, near.half, limits.bodies)
    return part(near.half, slice(0, contacts.count[0]))


@lean
def reach(speeds, h, closed):
    """How far apart contacts are that matter, m: as forces could bring bodies together in the time h."""
    hastening = 0.0
    for i in range(len(speeds.free)):
        for a in range(speeds.free.shape[1]):
            hastening = max(hastening, abs(speeds.free[i, a] - speeds.before[i, a]))
    return 2 * h * hastening + TOUCHES * closed


@lean
def moves(contacts, u):
    """Whether anything moves that has a contact."""
    for q in range(contacts.count[0]):
        for side in range(2):
            i = contacts.slot[q, side]
            if i >= 0:
                for a in range(u.shape[1]):
                    if u[i, a] != 0:
                        return True
    return False


@lean_apart
def match(contacts, now, half, bodies):
    """Into half: the same contacts (m,) with the points, frames and arms that they have now, where found."""
    p, half.count[0] = 0, contacts.count[0]
    for q in range(contacts.count[0]):
        key = key_of(contacts, q, bodies)
        while p < now.count[0] and key_of(now, p, bodies) < key:
            p += 1
        copy_contact(contacts, q, half, q)
        found = p < now.count[0] and key_of(now, p, bodies) == key
        if found and dot(contacts.frame[q, 0], now.frame[p, 0]) > SAME:
            copy_place(now, p, half, q)


@inner
def copy_contact(contacts, q, to, row):
    """All of one contact."""
    to.id[row], to.gap[row] = contacts.id[q], contacts.gap[q]
    to.friction[row], to.restitution[row] = contacts.friction[q], contacts.restitution[q]
    for side in range(2):
        to.bodies[row, side], to.slot[row, side] = contacts.bodies[q, side], contacts.slot[q, side]
    copy_place(contacts, q, to, row)


@inner
def copy_place(contacts, q, to, row):
    """Where a contact is: its point, frame and arms."""
    for a in range(contacts.point.shape[1]):
        to.point[row, a] = contacts.point[q, a]
        for b in range(contacts.point.shape[1]):
            to.frame[row, a, b] = contacts.frame[q, a, b]
        for side in range(2):
            to.arm[row, side, a] = contacts.arm[q, side, a]


@compiled_apart(door=False)
def add_bias(rows, contacts, half, start, middle, gap, h, closed):
    """To c of the contacts' rows, what w has changed by until half way; to gap (m,), what its error may be.

    start (n, k): the velocities at the start. An island in which something lands, by the speed that it has
    then, is left as it is.
    """
    before, label = middle.before, label_islands(rows.bodies, len(start))
    lands = np.zeros(len(start), np.bool_)
    for q in range(contacts.count[0]):
        if contacts.gap[q] > closed and contacts.gap[q] + h * parting_speed(contacts, q, start) < 0:
            lands[label[owner(contacts.slot, q)]] = True
    for q in range(contacts.count[0]):
        if lands[label[owner(contacts.slot, q)]]:
            continue
        first = rows.block[q]
        bias = parting_speed(half, q, before) - parting_speed(contacts, q, start)
        rows.c[first] += bias
        gap[q] += LEFT * h * abs(bias)
        now, then = relative_velocity(half, q, before), relative_velocity(contacts, q, start)
        changed = now[0] - then[0], now[1] - then[1], now[2] - then[2]
        for r in range(first + 1, rows.block[q + 1]):
            rows.c[r] += along(half.frame[q, r - first], changed)
