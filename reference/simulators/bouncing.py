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
from ..contacts import keys, label_islands, part, parting_speed, put_row, spread
from ..lcp.augmented import dot
from ..lcp.contact_sweeps import divide_by_mass
from .moving import scatter_velocities
from .paying import energies

MOST_IMPACTS = 100  # in one step; after them nothing bounces any more until the step's end
SHORT = 1e-3  # of a step
HARD = 0.5  # times what forces change the speed by in a step: a landing that is faster is hard
MATTERS = 0.02  # of the energy of motion: a landing that takes less isn't worth a step of the whole scene
MOST_TRIES, SURE = 60, 12  # at the time of an impact; so many by parabolas, the others by halves
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
            energy = energies(speeds.M, speeds.before).sum() if energy < 0 else energy
            hard = impact_energy(contacts, q, w[q], speeds.M, room) > MATTERS * energy
        if near:
            strikes = strikes or (w[q] < 0 and e[q] > 0) or hard
            to_come[q] = rebounds and w[q] + left * rate[q] < 0 and 2 * w[q] > -SHORT * h * rate[q]
        else:
            to_come[q] = hard or (rebounds and comes)
    return w, rate, e, strikes, to_come


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
    w, _, e, strikes, _ = look_ahead(closed, sim.speeds, sim.filled, h, h, sim.closed)
    if not strikes:
        return False
    struck = reached(closed, w, sim.held.rows.bodies, len(sim.before))
    closed, e = part(closed, struck), e[struck]

    def solve(rows, free):
        λ = np.zeros(len(rows.c))
        return sim.solve(rows, free, λ), λ

    rows = sim.rows(closed, np.zeros(len(e)), sim.held.at_impact(sim.closed))
    of_all = np.concatenate([e, np.zeros(len(sim.held))])
    after, λ = sim.law(rows, of_all, sim.M, sim.before, solve)
    scatter_velocities(sim.system, after, sim.state)
    sim.touched.add(closed, spread(rows, λ, len(e), sim.d))
    return True


def reached(contacts, w, joints, n):
    """(m,): which contacts an impact can reach: in their island, with these joints (r, 2), one approaches."""
    label = label_islands(np.concatenate([contacts.slot, joints]), n)
    island = label[contacts.slot.max(axis=1)]
    return np.isin(island, island[w < 0])


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

    gaps, end = gaps_after(left), left
    expected = coming.gap + left * (w + 0.5 * left * rate)  # had it flown straight on, unhindered
    through = (expected < -sim.closed) & (coming.gap > sim.closed) & np.isinf(gaps)
    if gaps.min() >= slack:
        if not through.any():
            return left
        # right through the other, or past it: look for the moment when it was there
        end = left * (coming.gap[through] / (coming.gap[through] - expected[through])).min()
        gaps = gaps_after(end)
        if gaps.min() >= 0:
            return end
    low, high, time = 0.0, end, meeting(coming.gap, w, gaps, end, slack)
    for tries in range(MOST_TRIES):
        if tries > SURE or not low < time < high:
            time = 0.5 * (low + high)
        gaps = gaps_after(time)
        gap = gaps.min() - slack
        if abs(gap) <= slack or high - low <= SHORTEST * end:
            break
        low, high = (time, high) if gap > 0 else (low, time)
        time = meeting(coming.gap, w, gaps, time, slack)
    return time


@compiled
def meeting(gap, w, gap_end, end, slack):
    """The first of the times at which contacts (c,) meet that are gap apart now, and gap_end at the time end.

    Each gap is taken for a parabola, gap + w t + ½ a t²: right for free flight, and the better for any other
    the nearer the end is to the answer. inf, where none meets.
    """
    first = np.inf
    for q in range(len(gap)):
        a = 2 * (gap_end[q] - gap[q] - w[q] * end) / end**2
        under = w[q] * w[q] - 2 * a * (gap[q] - slack)
        if not (under >= 0 and gap_end[q] < np.inf):
            continue
        root = np.sqrt(under)
        if w[q] < 0:
            first = min(first, 2 * (gap[q] - slack) / (root - w[q]))
        elif a < 0:
            first = min(first, (w[q] + root) / -a)
    return first


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
            if same and now.gap[q] < least[c] and dot(coming.frame[c, 0], now.frame[q, 0]) > 0:
                least[c] = now.gap[q]
    return least
