"""Impacts, each at its own time within the step, so that energy and motion are right whatever Δt is.

A step goes from impact to impact. Where something that rebounds, or lands hard, would meet another body
before the step ends, the bodies fly only until they touch, the impact law changes the velocities, and the
rest of the step follows.

A ball that bounces comes to rest after infinitely many bounces in a finite time. One that would last a
hundredth of the step or less is taken for none. In the same way a landing without rebound is hard only
where it is faster than the forces of a step can explain, and takes so much of the energy that it matters to
the whole: any other happens at the end of the step in which it comes, within the flight.

In a crowd each impact brings on others, without an end (inelastic collapse). So when often enough in a step
bodies were struck that had been struck in it before (ten times; more where few contacts make little work),
the rest of it is shared among some ``MORE``: what would touch within such a share touches now, and a rebound
slower than what forces do to a body in that time is none.

Slides S9, S10; lectures/05_contact.md. Source: McNamara & Young, Phys. Fluids A 4 (1992) 496 (the collapse).
"""

import numpy as np

from ..compiled import compiled_apart, inner
from ..contacts import label_islands, part, parting_speed, put_row, spread
from ..lcp.augmented import dot
from ..lcp.contact_sweeps import divide_by_mass
from .moving import scatter_velocities
from .paying import energies

EXACT, WORK, MORE = 10, 20_000, 20  # impacts of a step that come again: so many, or WORK/contacts² if that is
# more, each at its time; then so many more
SHORT = 1e-2  # of a step
HARD = 0.5  # times what forces change the speed by in a step: a landing that is faster is hard
MATTERS = 0.02  # of the energy of motion: a landing that takes less isn't worth a step of the whole scene


@compiled_apart
def look_ahead(contacts, speeds, filled, h, left, early, closed):
    """What these contacts (m) are about to do in the time left, s, of a step of h; w, m/s, is how fast they
    part, and rate how w would change without contact, m/s². early: s, see ``strike``.

    Returns w (m,), rate (m,), e (m,): with how much of its speed each would rebound now; strikes: whether
    some have an impact now; and to_come (m,): which may have one later. filled: s, for ``speeds``.
    """
    m, k = contacts.count[0], speeds.before.shape[1]
    w, rate, e = np.empty(m), np.empty(m), np.empty(m)
    to_come, strikes, room, energy = np.zeros(m, np.bool_), False, np.zeros((2, k)), -1.0
    for q in range(m):
        w[q] = parting_speed(contacts, q, speeds.before)
        rate[q] = (parting_speed(contacts, q, speeds.free) - w[q]) / filled
        e[q], gap, falls = contacts.restitution[q], contacts.gap[q], min(rate[q], 0.0)
        near, rebounds = gap <= closed, e[q] > 0
        # twice the speed of the slowest rebound that counts
        slow = -falls * SHORT * h if early == 0 else early * pull(contacts, q, speeds) / filled
        if slow > 0 and 2 * e[q] * -w[q] <= slow:
            e[q] = 0.0
        # a flight's row looks at the end velocity; here with twice that way, should others push as well
        comes = gap + 2 * left * (w[q] + left * falls) < 0
        hard = not rebounds and (near or comes) and -w[q] > HARD * h * abs(rate[q])
        if hard:
            energy = energies(speeds.M, speeds.before).sum() if energy < 0 else energy
            hard = impact_energy(contacts, q, w[q], speeds.M, room) > MATTERS * energy
        if near:
            strikes = strikes or (w[q] < 0 and e[q] > 0) or hard
            to_come[q] = rebounds and w[q] + left * rate[q] < 0 and 2 * w[q] > slow
        else:
            met = np.sqrt(w[q] * w[q] - 2 * gap * falls)  # how fast it comes, had it flown straight on
            to_come[q] = hard or (comes and 2 * contacts.restitution[q] * met > slow)
    return w, rate, e, strikes, to_come


@inner
def pull(contacts, q, speeds):
    """By how much forces would change the speed of one of the bodies of contact q at the most, m/s."""
    most = 0.0
    for side in range(2):
        i = contacts.slot[q, side]
        if i >= 0:
            square = 0.0
            for a in range(contacts.point.shape[1]):
                square += (speeds.free[i, a] - speeds.before[i, a]) ** 2
            most = max(most, np.sqrt(square))
    return most


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


class Hits:
    """The impacts of a step: which bodies they struck (n,), and how many came again: struck one of these
    bodies, or none.
    """

    def __init__(self):
        self.crowded = 0  # steps in which there was a crowd
        self.begin()

    def begin(self):
        """A step begins."""
        self.struck, self.again, self.crowd = False, 0, False

    def early(self, left, gap):
        """How long before its time the next impact will do, s: 0; in a crowd a share of what is left.

        gap (m,): of the contacts there are.
        """
        more = self.again - max(EXACT, WORK // max(len(gap), 1) ** 2)
        if more < 0:
            return 0.0
        self.crowded += not self.crowd
        self.crowd = True
        return left / max(MORE - more, 1)

    def add(self, hit):
        """Count one more, which struck these bodies (n,). Returns whether it struck any."""
        self.again += bool(np.any(self.struck & hit) or not hit.any())
        self.struck = self.struck | hit
        return hit.any()

    def told(self):
        """What must be said of crowds, or ""."""
        return f"in {self.crowded} steps impacts in a crowd were taken together" if self.crowded else ""


def strike(sim, contacts, h, early):
    """The impact of what touches and approaches, by the scene's law. Returns which bodies it struck (n,).

    h: the whole step, s; early: s, what would touch within this time counts as touching.
    """
    closed = part(contacts, contacts.gap <= sim.closed)
    if early:
        w, _ = motion(sim, contacts)
        closed = part(contacts, contacts.gap + early * np.minimum(w, 0.0) <= sim.closed)
        closed.gap[:] = np.minimum(closed.gap, 0.0)
    w, _, e, strikes, _ = look_ahead(closed, sim.speeds, sim.filled, h, h, early, sim.closed)
    hit = np.zeros(len(sim.before), dtype=bool)
    if not strikes:
        return hit
    struck = reached(closed, w, sim.held.rows.bodies, len(sim.before))
    closed, e = part(closed, struck), e[struck]

    def solve(rows, free):
        λ = np.zeros(len(rows.c))
        return sim.solve(rows, free, λ), λ

    rows = sim.rows(closed, np.zeros(len(e)), sim.held.at_impact(sim.closed))
    of_all = np.concatenate([e, np.zeros(len(sim.held))])
    after, λ = sim.law(rows, of_all, sim.M, sim.before, solve)
    scatter_velocities(sim.system, after, sim.state)
    impulse = spread(rows, λ, len(e), sim.d)
    sim.touched.add(closed, impulse)
    slots = closed.slot[impulse.any(axis=1)]
    hit[slots[slots >= 0]] = True
    return hit


def reached(contacts, w, joints, n):
    """(m,): which contacts an impact can reach: in their island, with these joints (r, 2), one approaches."""
    label = label_islands(np.concatenate([contacts.slot, joints]), n)
    island = label[contacts.slot.max(axis=1)]
    return np.isin(island, island[w < 0])


def motion(sim, contacts):
    """How fast each contact parts, w_n (m,), and how its rate would change without contact, per s."""
    return look_ahead(contacts, sim.speeds, sim.filled, 0.0, 0.0, 0.0, 0.0)[:2]
