"""Steps in which nothing special happens, one after the other, as one compiled loop.

Most steps have no impact, and room enough for their contacts. Those are done here, without going back to
Python; the others are left to ``VelocityLCP.step``, which does the same for them, and more.

Slides S9, S12; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import compiled, inner
from ..integrators import copy
from .bouncing import look_ahead
from .lifting import DEEP, MOST_LIFTS, deepest, slow_down, told_depth
from .middle import match, moves, reach
from .moving import move
from .paying import kinetic
from .smooth import all_finite


@compiled
def coast(fill_free, detect, raise_apart, push, system, state, work, speeds, middle, near, contacts, held,
          pushed, t, h, steps, limits, worst, lifted, timeless):  # fmt: skip
    """Up to so many steps of h s from the time t; pushed: keys (c,) and forces (c, d) of the contacts before.

    Returns how many are done; whether the last left the state as it was; whether there was room for all
    contacts after it, so that overlaps are lifted apart; ``pushed`` now; and the contacts, half way, and the
    impulses of the last step. It ends before a step that is none of the ordinary, or whose state would not be
    finite. lifted (2,): the energy that lifting added, J, is added to the first; the
    second is the deepest that stays in each other.
    """
    solids, grid, pairs, spare, raw = near.collider
    before, start, impulse, there = state.y.copy(), state.x.copy(), pushed[1], contacts
    label, had, way = np.arange(len(start)), np.zeros(len(start)), np.zeros_like(speeds.before)
    for done in range(steps + 1):
        now, lifts = t + done * h, 0
        while True:  # find the contacts of the step from now on, and lift apart what overlaps
            fill_free(system, now, h, state, speeds)
            margin = reach(speeds, h, limits.closed)
            found = detect(solids, grid, pairs, spare, raw, contacts, state, margin, h)
            room = found[0] <= len(pairs) and found[1] <= len(contacts.gap)
            if not room or lifts == MOST_LIFTS or deepest(contacts) <= limits.closed * (1 if lifts else DEEP):
                break
            if lifts == 0:
                begin_lifts(state, speeds, start, label, had, way)
            raise_apart(state, contacts, held, speeds, label, way, limits)
            lifts += 1
        if lifts > 0:
            lifted[1] = max(lifted[1], told_depth(contacts, limits.closed))
            lifted[0] += slow_down(system, state, start, had, way, label, speeds)
            fill_free(system, now, h, state, speeds)
        if done == steps or not (room and quiet(contacts, speeds, h, limits)):
            return done, False, room, pushed, there, impulse
        copy(state.y, before)
        half = contacts
        move(system, speeds.before, speeds.before, 0.5 * h, state, work)
        if moves(contacts, speeds.before):
            found = detect(solids, grid, pairs, spare, raw, near.room, state, margin, h)
            if found[0] <= len(pairs) and found[1] <= len(near.room.gap):
                match(contacts, near.room, near.half, limits.bodies)
                half = near.half
        fill_free(system, now + 0.5 * h, h, state, middle)
        key, made, _ = push(
            system, state, work, speeds, middle, contacts, half, held, pushed[0], pushed[1], h, limits, worst
        )
        if not all_finite(state.y):
            copy(before, state.y)
            return done, False, True, pushed, there, impulse
        there, impulse = half, made
        if limits.warm:
            pushed = key, over(impulse, h)
        if timeless and same(before, state.y):
            return done + 1, True, True, pushed, there, impulse
    return steps, False, True, pushed, there, impulse


@inner
def begin_lifts(state, speeds, start, label, had, way):
    """Where the bodies are and how much energy of motion they have, before any are lifted."""
    for i in range(len(start)):
        label[i], had[i] = i, kinetic(speeds.M, speeds.before, i)
        for a in range(start.shape[1]):
            start[i, a] = state.x[i, a]
        for a in range(way.shape[1]):
            way[i, a] = 0.0


@compiled(door=False)
def quiet(contacts, speeds, h, limits):
    """Whether nothing strikes, or is about to."""
    _, _, _, strikes, to_come = look_ahead(contacts, speeds, h, h, h, 0.0, limits.closed)
    for q in range(len(to_come)):
        if to_come[q]:
            return False
    return not strikes


@compiled(door=False)
def over(impulse, h):
    """Impulses (m, d) as forces."""
    force = np.empty_like(impulse)
    for q in range(len(force)):
        for a in range(force.shape[1]):
            force[q, a] = impulse[q, a] / h
    return force


@inner
def same(a, b):
    """Whether two flat arrays are equal."""
    differ = 0
    for k in range(len(a)):
        differ += a[k] != b[k]
    return differ == 0
