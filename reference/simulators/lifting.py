"""What went into each other is lifted apart, and joints are closed, by the smallest move that does it (S13).

Smallest in the measure of the kinetic energy: δ with ½ |δ|²_M least and gap + J δ ≥ 0 for all contacts
near, again and again until none is deep. Lifting adds potential energy, which is taken from the speed of
the same bodies, as far as they have any. What is left is counted: it is the energy that lifting out an
overlap adds.

Slides S12, S13; lectures/05_contact.md.
"""

import numpy as np

from ..compiled import compiled
from ..contacts import label_islands
from ..correction import displace
from .flight import scatter_velocities

DEEP = 10  # times the gap that counts as none
MOST_LIFTS = 20
TORN = 1e-6  # of the mechanism's size: an opening of joints that no move mends


def lift(sim, contacts, h):
    """Bring apart what is deeper in each other than rounding explains. Returns the contacts that there
    are then.
    """
    if depth(sim, contacts) <= DEEP * sim.closed:
        return contacts
    label, height = np.arange(len(sim.before)), sim.state.x.copy()
    for _ in range(MOST_LIFTS):
        frictionless = contacts._replace(friction=np.zeros(len(contacts.gap)))
        rows = sim.rows(frictionless, contacts.gap, sim.held.to_lift())
        δ = sim.solve(rows, np.zeros_like(sim.before), np.zeros(len(rows.c)))
        label = np.minimum(label, label_islands(rows.bodies, len(δ)))
        d = sim.d
        displace(sim.state, δ[:, :d], δ[: len(sim.state.q), d:])
        sim.fill(sim.now, h)
        contacts = sim.find(h)
        if depth(sim, contacts) <= sim.closed:
            break
    if sim.held.worst() > TORN * sim.held.size:
        sim.open = sim.held.worst()
        sim.state.y[:] = np.nan  # which ends the run: no step may be built on joints that don't close
    gain = -(sim.system.mass[:, None] * sim.system.gravity * (sim.state.x - height)).sum(axis=1)
    sim.lifted += pay(label, gain, sim.M, sim.before)
    scatter_velocities(sim.system, sim.before, sim.state)
    sim.fill(sim.now, h)
    return contacts


def depth(sim, contacts):
    """How deep in each other, or how far from closed, anything is at the most, m (a turn, rad, of joints)."""
    return max(-contacts.gap.min(initial=0.0), sim.held.worst())


@compiled
def pay(label, gain, M, u):
    """Slow each island's bodies until they have lost the energy that lifting gave; returns what could not
    be paid, J.
    """
    n, k = u.shape
    gained, has = np.zeros(n), np.zeros(n)
    for i in range(n):
        gained[label[i]] += gain[i]
        for a in range(k):
            for b in range(k):
                has[label[i]] += 0.5 * u[i, a] * M[i, a, b] * u[i, b]
    unpaid = 0.0
    for i in range(n):
        if gained[i] > has[i]:
            unpaid += gained[i] - has[i]
    for i in range(n):
        island = label[i]
        if gained[island] > 0 and has[island] > 0:
            share = np.sqrt(max(0.0, 1 - gained[island] / has[island]))
            for a in range(k):
                u[i, a] *= share
    return unpaid
