"""Steps in which nothing special happens, one after the other, as one compiled loop.

Most steps have no impact, and room enough for their contacts. Those are done here, without going back to
Python; the others are left to ``VelocityLCP.step``, which does the same for them, and more.

Slides S9, S12; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import bind, compiled, compiled_apart, inner, lean_apart
from ..integrators import copy
from .bouncing import look_ahead
from .lifting import DEEP, MOST_LIFTS, deepest, energies, slow_down, told_depth
from .middle import reach
from .smooth import all_finite


@compiled
def coast(fill_free, settle, half_way, push, system, state, work, speeds, middle, near, contacts, held,
          pushed, t, h, steps, limits, worst, lifted, timeless):  # fmt: skip
    """Up to so many steps of h s from the time t; pushed: keys (c,) and forces (c, d) of the contacts before.

    Returns how many are done; whether the last left the state as it was; ``pushed`` now; and the contacts,
    half way, and the impulses of the last step. It ends before a step that is none of the ordinary, or whose
    state would not be finite.
    """
    before, impulse, there = state.y.copy(), pushed[1], contacts
    room = settle(system, state, speeds, near, contacts, held, t, h, limits, worst, lifted)
    for done in range(steps):
        if not (room and quiet(contacts, speeds, h, limits)):
            return done, False, pushed, there, impulse
        copy(state.y, before)
        half = half_way(system, state, work, speeds, near, contacts, h, limits)
        fill_free(system, t + (done + 0.5) * h, h, state, middle)
        key, made, _ = push(
            system, state, work, speeds, middle, contacts, half, held, pushed[0], pushed[1], h, limits, worst
        )
        if not all_finite(state.y):
            copy(before, state.y)
            return done, False, pushed, there, impulse
        there, impulse = half, made
        if limits.warm:
            pushed = key, over(impulse, h)
        if timeless and same(before, state.y):
            return done + 1, True, pushed, there, impulse
        now = t + (done + 1) * h
        room = settle(system, state, speeds, near, contacts, held, now, h, limits, worst, lifted)
    return steps, False, pushed, there, impulse


@compiled_apart
def settle(look, lift_all, system, state, speeds, near, contacts, held, t, h, limits, worst, lifted):
    """Find the contacts of the step from t on, and lift apart what overlaps. Returns whether there was room.

    lifted (2,): the energy that lifting added, J, is added to the first; the second is the deepest that
    stays in each other.
    """
    room = look(system, state, speeds, near, contacts, t, h, limits)
    if not room or deepest(contacts) <= DEEP * limits.closed:
        return room
    return lift_all(system, state, speeds, near, contacts, held, t, h, limits, worst, lifted)


def make_settle(fill_free, detect, raise_apart):
    """``settle`` with these functions."""
    seen = bind(look, fill_free, detect)
    return bind(settle, seen, bind(lift_all, seen, raise_apart))


@lean_apart
def look(fill_free, detect, system, state, speeds, near, contacts, t, h, limits):
    """Fill in the speeds, and find the contacts of the step from t on. Returns whether there was room."""
    solids, grid, pairs, spare, raw = near.collider
    fill_free(system, t, h, state, speeds)
    margin = reach(speeds, h, limits.closed)
    found = detect(solids, grid, pairs, spare, raw, contacts, state, margin, h)
    return found[0] <= len(pairs) and found[1] <= len(contacts.gap)


@compiled_apart
def lift_all(look, raise_apart, system, state, speeds, near, contacts, held, t, h, limits, worst, lifted):
    """Lift apart what overlaps, again and again; as ``settle``."""
    start, label, had = state.x.copy(), np.arange(len(state.x)), energies(speeds.M, speeds.before)
    way, room = np.zeros_like(speeds.before), True
    for _ in range(MOST_LIFTS):
        raise_apart(state, contacts, held, speeds, label, way, limits, worst)
        room = look(system, state, speeds, near, contacts, t, h, limits)
        if not room or deepest(contacts) <= limits.closed:
            break
    lifted[1] = max(lifted[1], told_depth(contacts, limits.closed))
    lifted[0] += slow_down(system, state, start, had, way, label, speeds)
    return room and look(system, state, speeds, near, contacts, t, h, limits)


@compiled(door=False)
def quiet(contacts, speeds, h, limits):
    """Whether nothing strikes, or is about to."""
    _, _, _, strikes, to_come = look_ahead(contacts, speeds, h, h, h, limits.closed)
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
