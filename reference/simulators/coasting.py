"""Steps in which nothing special happens, one after the other, as one compiled loop.

Most steps have no impact, no overlap to be lifted, and room enough for their contacts. Those are done here, without
going back to Python; the others are left to ``VelocityLCP.step``, which does the same for them, and more.

Slides S9, S12; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import compiled, lean
from ..integrators import copy
from .bouncing import look_ahead
from .lifting import DEEP
from .smooth import all_finite


@compiled
def coast(fill_free, detect, flight, system, state, work, speeds, collider, contacts, held, pushed, t, h, steps,
          limits, worst, timeless):  # fmt: skip
    """Up to so many steps of h s from the time t; pushed: (keys (c,), forces (c, d)) of the contacts before.

    Returns how many are done, and whether the last left the state as it was; keys and impulses of its contacts.
    It ends before a step that is none of the ordinary, or whose state would not be finite.
    """
    solids, grid, pairs, spare, raw = collider
    before, impulse = state.y.copy(), pushed[1]
    for done in range(steps):
        fill_free(system, t + done * h, h, state, speeds)
        found = detect(
            solids, grid, pairs, spare, raw, contacts, state, reach(speeds, h, limits.closed), h
        )
        if found[0] > len(pairs) or found[1] > len(contacts.gap):
            return done, False, pushed, impulse
        if not quiet(contacts, speeds, h, limits):
            return done, False, pushed, impulse
        copy(state.y, before)
        key, made, _ = flight(
            system, state, work, speeds, contacts, held, pushed[0], pushed[1], h, 1.0, limits, worst
        )
        if not all_finite(state.y):
            copy(before, state.y)
            return done, False, pushed, impulse
        impulse = made
        if limits.warm:
            pushed = key, over(impulse, h)
        if timeless and same(before, state.y):
            return done + 1, True, pushed, impulse
    return steps, False, pushed, impulse


@lean
def reach(speeds, h, closed):
    """How far apart contacts are that matter, m: as forces could bring bodies together in the time h."""
    hastening = 0.0
    for i in range(len(speeds.free)):
        for a in range(speeds.free.shape[1]):
            hastening = max(hastening, abs(speeds.free[i, a] - speeds.before[i, a]))
    return 2 * h * hastening + 100 * closed


@compiled
def quiet(contacts, speeds, h, limits):
    """Whether nothing overlaps, strikes, or is about to."""
    for q in range(contacts.count[0]):
        if contacts.gap[q] < -DEEP * limits.closed:
            return False
    _, _, _, strikes, to_come = look_ahead(contacts, speeds, h, h, h, limits.closed)
    for q in range(len(to_come)):
        if to_come[q]:
            return False
    return not strikes


@compiled
def over(impulse, h):
    """Impulses (m, d) as forces."""
    force = np.empty_like(impulse)
    for q in range(len(force)):
        for a in range(force.shape[1]):
            force[q, a] = impulse[q, a] / h
    return force


@lean
def same(a, b):
    """Whether two flat arrays are equal."""
    for k in range(len(a)):
        if a[k] != b[k]:
            return False
    return True
