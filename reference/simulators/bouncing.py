"""Bounces: each impact at its own time within the step, so that the energy is right whatever Δt is.

A step goes from impact to impact. Where something that rebounds would meet another body before the step
ends, the bodies fly only until they touch, the impact law changes the velocities, and the rest of the
step follows.

A ball that bounces comes to rest after infinitely many bounces in a finite time. One that would last a
thousandth of the step or less is taken for none.

Slides S9, S10; lectures/05_contact.md.
"""

import numpy as np

from ..contacts import part, spread
from .flight import scatter_velocities
from .impacts import rates

MOST_IMPACTS = 100  # in one step; after them nothing bounces any more until the step's end
SHORT = 1e-3  # of a step
MOST_TRIES = 60  # at the time of an impact


def strike(sim, contacts, h):
    """The impact of what touches, approaches and rebounds, by the scene's law. Returns whether there was one.

    h: the whole step, s.
    """
    closed = part(contacts, contacts.gap <= sim.closed)
    if not closed.restitution.any():
        return False
    w, hastening = motion(sim, closed)
    lasts = np.full(len(w), np.inf)  # how long a bounce would last: until the force brings it back
    pressed = hastening < 0
    lasts[pressed] = 2 * closed.restitution[pressed] * w[pressed] / hastening[pressed]
    e = np.where(lasts > SHORT * h, closed.restitution, 0.0)
    if not np.any((e > 0) & (w < 0)):
        return False

    def solve(rows, free):
        λ = np.zeros(len(rows.c))
        return sim.solve(rows, free, λ), λ

    rows = sim.rows(closed, np.zeros(len(e)), sim.held.at_impact(sim.closed))
    of_all = np.concatenate([e, np.zeros(len(sim.held))])
    after, λ = sim.law(rows, of_all, sim.M, sim.before, solve)
    scatter_velocities(sim.system, after, sim.state)
    sim.touched.add(closed, spread(rows, λ, len(e), sim.d))
    return True


def hop(sim, contacts, h):
    """Move on by h, or until the next impact of what rebounds; returns by how much, s."""
    w, hastening = motion(sim, contacts)
    leaving = (contacts.gap <= sim.closed) & (w > 0)
    to_come = (contacts.restitution > 0) & ((contacts.gap > sim.closed) | leaving)
    if not np.any(to_come):
        return sim.fly(contacts, h)
    coming, others = part(contacts, to_come), part(contacts, ~to_come)
    start = sim.keep()

    def gap_after(time):
        """The least gap of what is to come, after the bodies have flown for this time as if it did not."""
        sim.restore(start)
        sim.fly(others, time)
        return least_gap(coming, sim.find(h)) - 0.5 * sim.closed

    gap, end = gap_after(h), h
    expected = coming.gap + h * (w + 0.5 * h * hastening)[to_come]  # had it flown straight on, unhindered
    through = (expected < -sim.closed) & (coming.gap > sim.closed)
    if gap >= 0 and not np.any(through):
        return h
    if gap >= 0:  # right through the other, or past it: look for the moment when it was there
        end = h * (coming.gap[through] / (coming.gap[through] - expected[through])).min()
        gap = gap_after(end)
    turning = leaving & to_come & (hastening < 0)
    begin = np.min(-w[turning] / hastening[turning], initial=np.inf)  # when the first of them turns back
    begin = begin if begin < end else 1e-6 * end
    return root(gap_after, begin, end, gap, 0.5 * sim.closed)


def motion(sim, contacts):
    """How fast each contact parts, w_n (m,), and how its rate would change without contact, per s."""
    m = len(contacts.gap)
    rows = sim.rows(contacts, np.zeros(m), sim.held.at_impact(sim.closed))
    first = rows.block[:m]
    return rates(rows, sim.before)[first], rates(rows, sim.free - sim.before)[first] / sim.filled


def least_gap(coming, now):
    """The least gap of the pairs that were coming, among the contacts now; inf where none is near."""
    pairs = {tuple(pair) for pair in coming.bodies.tolist()}
    return min(
        (gap for pair, gap in zip(now.bodies.tolist(), now.gap, strict=True) if tuple(pair) in pairs),
        default=np.inf,
    )


def root(f, begin, end, f_end, tolerance):
    """The time in (begin, end] where f goes from + to −, to |f| ≤ tolerance, by the Illinois method.

    The last call of f is at the time that is returned; where f has no such change of sign that is
    ``end``. Source: Dowell & Jarratt, BIT 11 (1971) 168.
    """
    if abs(f_end) <= tolerance or f_end > 0:
        return end
    low, high, f_low, f_high = begin, end, f(begin), f_end
    time, value, kept = low, f_low, 0  # kept: which end stayed in the last try: −1 the lower, 1 the upper
    for _ in range(MOST_TRIES):
        if abs(value) <= tolerance:
            return time
        steep = f_low - f_high
        time = low + (high - low) * (f_low / steep if np.isfinite(steep) and f_low > 0 else 0.5)
        value = f(time)
        if value > 0:
            low, f_low, f_high = time, value, f_high / 2 if kept == 1 else f_high
            kept = 1
        else:
            high, f_high, f_low = time, value, f_low / 2 if kept == -1 else f_low
            kept = -1
    return time
