"""Impacts, each at its own time within the step, so that energy and motion are right whatever Δt is.

A step goes from impact to impact. Where something that rebounds, or lands hard, would meet another body
before the step ends, the bodies fly only until they touch, the impact law changes the velocities, and the
rest of the step follows.

A ball that bounces comes to rest after infinitely many bounces in a finite time. One that would last a
thousandth of the step or less is taken for none. In the same way a landing without rebound is hard only
where it is faster than the forces of a step can explain, and takes so much of the energy that it matters to
the whole: any other happens at the end of the step in which it comes, within the flight.

Slides S9, S10; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import compiled, compiled_apart, inner
from ..contacts import keys, part, parting_speed, put_row, spread
from ..lcp.augmented import dot
from ..lcp.contact_sweeps import divide_by_mass
from .flight import scatter_velocities

MOST_IMPACTS = 100  # in one step; after them nothing bounces any more until the step's end
SHORT = 1e-3  # of a step
HARD = 0.5  # times what forces change the speed by in a step: a landing that is faster is hard
MATTERS = 0.02  # of the energy of motion: a landing that takes less isn't worth a step of the whole scene
MOST_TRIES = 60  # at the time of an impact
SHORTEST = 1e-9  # of the time searched: less is no flight


@compiled_apart
def look_ahead(contacts, speeds, filled, h, left, closed):
    """What these contacts (m) are about to do in the time left, s, of a step of h; w, m/s, is how fast they
    part, and rate how w would change without contact, m/s².

    Returns w (m,), rate (m,), e (m,): with how much of its speed each would rebound now; strikes: whether
    some have an impact now; and to_come (m,): which may have one later. filled: s, for ``speeds``.
    """
    m, k = contacts.count[0], speeds.before.shape[1]
    w, rate, e = np.empty(m), np.empty(m), np.empty(m)
    to_come, strikes, room, energy = np.zeros(m, np.bool_), False, np.zeros((2, k)), -1.0
    for q in range(m):
        w[q] = parting_speed(contacts, q, speeds.before)
        rate[q] = (parting_speed(contacts, q, speeds.free) - w[q]) / filled
        e[q] = contacts.restitution[q]
        if e[q] > 0 and rate[q] < 0 and 2 * e[q] * w[q] / rate[q] <= SHORT * h:
            e[q] = 0.0
        near, rebounds = contacts.gap[q] <= closed, contacts.restitution[q] > 0
        # a flight's row looks at the end velocity; here with twice that way, should others push as well
        comes = contacts.gap[q] + 2 * left * (w[q] + left * min(rate[q], 0.0)) < 0
        hard = not rebounds and (near or comes) and -w[q] > HARD * h * abs(rate[q])
        if hard:
            energy = kinetic_energy(speeds.M, speeds.before) if energy < 0 else energy
            hard = impact_energy(contacts, q, w[q], speeds.M, room) > MATTERS * energy
        if near:
            strikes = strikes or (w[q] < 0 and e[q] > 0) or hard
            to_come[q] = rebounds and w[q] + left * rate[q] < 0 and 2 * w[q] > -SHORT * h * rate[q]
        else:
            to_come[q] = hard or (rebounds and comes)
    return w, rate, e, strikes, to_come


@inner
def kinetic_energy(M, u):
    """½ uᵀ M u, J."""
    total = 0.0
    for i in range(len(u)):
        for a in range(u.shape[1]):
            for b in range(u.shape[1]):
                total += 0.5 * u[i, a] * M[i, a, b] * u[i, b]
    return total


@inner
def impact_energy(contacts, q, w, M, room):
    """½ w² over 1/m as contact q feels it: what an impact of it alone would take, J. room (2, k)."""
    lightness, row, moved = 0.0, room[0], room[1]
    for side in range(2):
        i = contacts.slot[q, side]
        if i >= 0:
            put_row(row, contacts.frame[q, 0], contacts.arm[q, side], 1.0)
            divide_by_mass(M[i], row, moved)
            lightness += dot(row, moved)
    return 0.5 * w * w / lightness


def strike(sim, contacts, h):
    """The impact of what touches and approaches, by the scene's law. Returns whether there was one.

    h: the whole step, s.
    """
    closed = part(contacts, contacts.gap <= sim.closed)
    _, _, e, strikes, _ = look_ahead(closed, sim.speeds, sim.filled, h, h, sim.closed)
    if not strikes:
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


def hop(sim, contacts, h, left):
    """Move on by what is left of a step of h, or until the next impact; returns by how much, s."""
    w, rate, _, _, to_come = look_ahead(contacts, sim.speeds, sim.filled, h, left, sim.closed)
    if not to_come.any():
        return sim.fly(contacts, left)
    coming, others = part(contacts, to_come), part(contacts, ~to_come)
    w, rate, start, slack = w[to_come], rate[to_come], sim.keep(), 0.5 * sim.closed

    def gaps_after(time):
        """The gaps of what is to come, after the bodies have flown for this time as if it did not."""
        sim.restore(start)
        sim.fly(others, time)
        return gaps_now(coming, others, sim.find(left), sim.limits.bodies)

    def gap_after(time):
        return gaps_after(time).min() - slack

    gaps, end = gaps_after(left), left
    gap = gaps.min() - slack
    expected = coming.gap + left * (w + 0.5 * left * rate)  # had it flown straight on, unhindered
    through = (expected < -sim.closed) & (coming.gap > sim.closed) & np.isinf(gaps)
    if gap >= 0 and not through.any():
        return left
    if gap >= 0:  # right through the other, or past it: look for the moment when it was there
        end = left * (coming.gap[through] / (coming.gap[through] - expected[through])).min()
        gap = gap_after(end)
    begin, height = 0.0, coming.gap.min()
    turning = (coming.gap <= sim.closed) & (rate < 0)
    if turning.any():  # what leaves comes back after it has turned round: the first of them
        q = np.argmin(np.where(turning, -w / np.where(turning, rate, 1.0), np.inf))
        begin, height = -w[q] / rate[q], coming.gap[q] - 0.5 * w[q] ** 2 / rate[q]
    else:
        q = np.argmin(expected)
    if not begin < end:
        begin = 1e-6 * end
    guess = first_guess(coming.gap[q] - slack, w[q], gap, end)
    return root(gap_after, begin, end, height, gap, guess, slack)


def motion(sim, contacts):
    """How fast each contact parts, w_n (m,), and how its rate would change without contact, per s."""
    return look_ahead(contacts, sim.speeds, sim.filled, 0.0, 0.0, 0.0)[:2]


@compiled
def gaps_now(coming, others, now, bodies):
    """The least gap, now, of each pair that was coming (c,), seen from the same side; inf where none is near.

    What the flight itself kept apart, ``others``, is not meant.
    """
    kept, key, p = keys(others, bodies), keys(now, bodies), 0
    least = np.full(coming.count[0], np.inf)
    for q in range(len(key)):
        while p < len(kept) and kept[p] < key[q]:
            p += 1
        if p < len(kept) and kept[p] == key[q]:
            continue
        for c in range(len(least)):
            same = coming.bodies[c, 0] == now.bodies[q, 0] and coming.bodies[c, 1] == now.bodies[q, 1]
            if same and now.gap[q] < least[c] and same_side(coming.frame[c, 0], now.frame[q, 0]):
                least[c] = now.gap[q]
    return least


@inner
def same_side(n, other):
    """Whether two normals point the same way, roughly."""
    product = 0.0
    for a in range(len(n)):
        product += n[a] * other[a]
    return product > 0


def first_guess(gap, w, gap_end, end):
    """When a body that flies as a stone does meets the other: gap now, closing at −w, and gap_end at the end.

    The gap is then a parabola: gap + w t + ½ a t², which is right for free flight, and nearly for any other.
    """
    a = 2 * (gap_end - gap - w * end) / end**2
    under = w * w - 2 * a * gap
    if not under > 0:
        return 0.5 * end
    return 2 * gap / (np.sqrt(under) - w) if w < 0 else (w + np.sqrt(under)) / -a


def root(f, begin, end, f_begin, f_end, guess, tolerance):
    """The time in (begin, end] where f goes from + to −, to |f| ≤ tolerance, by the Illinois method.

    The last call of f is at the time that is returned; where f has no such change of sign that is
    ``end``. f_begin: an estimate is enough. Source: Dowell & Jarratt, BIT 11 (1971) 168.
    """
    if abs(f_end) <= tolerance or f_end > 0:
        return end
    low, high, f_low, f_high, kept = begin, end, f_begin, f_end, 0
    time = guess
    for _ in range(MOST_TRIES):
        if not low < time < high:
            time = low + 0.5 * (high - low)
        value = f(time)
        if abs(value) <= tolerance or time - low <= SHORTEST * end:
            break
        if value > 0:  # kept: which end stayed in the last try: −1 the lower, 1 the upper
            low, f_low, f_high = time, value, f_high / 2 if kept == 1 else f_high
            kept = 1
        else:
            high, f_high, f_low = time, value, f_low / 2 if kept == -1 else f_low
            kept = -1
        steep = f_low - f_high
        time = low + (high - low) * (f_low / steep if np.isfinite(steep) and f_low > 0 else 0.5)
    else:
        f(time)
    return time
