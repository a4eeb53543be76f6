"""What went into each other is lifted apart, and joints are closed, by the smallest move that does it (S13).

Smallest in the measure of the kinetic energy: δ with ½ |δ|²_M least and gap + J δ ≥ 0 for all contacts
near, again and again until none is deep. Lifting adds potential energy, and turning a body that spins in
space may add energy of motion; both are taken from the speed of the same bodies: first from that along the
move, which leaves momentum alone as contact does, then from all speeds alike, as far as there are any. What
is left is counted: it is the energy that lifting out an overlap adds.

Slides S12, S13; lectures/05_contact.md.
"""

import numpy as np

from ..collision import ContactArrays
from ..compiled import compiled, compiled_apart
from ..contacts import contact_rows, label_islands, root
from ..correction import displace
from .flight import Limits
from .held import join
from .moving import scatter_velocities
from .paying import energies, pay

DEEP = 10  # times the gap that counts as none
MOST_LIFTS, MOST_CLOSINGS = 20, 200  # moves in one step; where light links bear much, joints need many
BESIDE = 100  # times the depth: gaps that a move may close
ENOUGH, LEAST, MOST = 1e-3, 1e-13, 1e-6  # of the depth: to this is each move computed, within limits
TORN = 1e-6  # of the mechanism's size: an opening of joints that no move mends


def lift(sim, contacts, h):
    """Bring apart what is deeper in each other than rounding explains. Returns the contacts that there
    are then.
    """
    if depth(sim, contacts) <= DEEP * sim.closed:
        return contacts
    label, start, had = np.arange(len(sim.before)), sim.state.x.copy(), energies(sim.M, sim.before)
    way = np.zeros_like(sim.before)
    for _ in range(MOST_CLOSINGS if len(sim.held) else MOST_LIFTS):
        held = sim.held.rows_with(*sim.held.to_lift())
        sim.raise_apart(sim.state, contacts, held, sim.speeds, label, way, sim.limits)
        sim.fill(sim.now, h)
        contacts = sim.find(h)
        if depth(sim, contacts) <= sim.closed:
            break
    sim.lifted[1] = max(sim.lifted[1], told_depth(contacts, sim.closed))
    if sim.held.worst() > TORN * sim.held.size:
        sim.open = sim.held.worst()
        sim.state.y[:] = np.nan  # which ends the run: no step may be built on joints that don't close
    sim.lifted[0] += slow_down(sim.system, sim.state, start, had, way, label, sim.speeds)
    sim.fill(sim.now, h)
    return contacts


def depth(sim, contacts):
    """How deep in each other, or how far from closed, anything is at the most, m (a turn, rad, of joints)."""
    return max(-contacts.gap.min(initial=0.0), sim.held.worst())


@compiled
def told_depth(contacts, closed):
    """How deep in each other two bodies still are after lifting, m; 0 where it is what rounding explains."""
    depth = deepest(contacts)
    return depth if depth > DEEP * closed else 0.0


@compiled
def deepest(contacts):
    """How deep in each other any two bodies are at the most, m."""
    depth = 0.0
    for q in range(contacts.count[0]):
        depth = max(depth, -contacts.gap[q])
    return depth


@compiled_apart
def raise_apart(solve, state, contacts, held, speeds, label, way, limits):
    """One move that brings all gaps, as they are to first order, to 0 at least; friction has no part in it.

    label (n,): the islands of the moves before, and with those of this one; way (n, k): their sum.
    """
    rows, δ, λ = upright_rows(contacts, held, speeds.before)
    limits = Limits(how_well(rows), limits.iterations, limits.closed, limits.bodies, limits.warm)
    δ = solve(rows, speeds.M, δ, λ, limits, np.zeros(3))
    join_islands(label, rows.bodies)
    displace_by(state, δ)
    for i in range(len(way)):
        for a in range(way.shape[1]):
            way[i, a] += δ[i, a]


@compiled
def how_well(rows):
    """A tolerance for one move: a share of what is deepest, or farthest from closed, over the largest c."""
    depth, largest = 0.0, 0.0
    for r in range(len(rows.c)):
        off = abs(rows.c[r])
        largest = max(largest, off)
        if rows.c[r] < 0 or rows.lower[r] < 0:
            depth = max(depth, off)
    return min(max(ENOUGH * depth / largest, LEAST), MOST) if largest > 0 else MOST


@compiled_apart
def upright_rows(contacts, held, u):
    """The rows of the normals of what is deep or near, and those held; and zeros for u (n, k) and λ."""
    depth = deepest(contacts)
    for r in range(len(held.c)):
        depth = max(depth, abs(held.c[r]))
    c, q = contacts, np.flatnonzero(contacts.gap[: contacts.count[0]] <= BESIDE * depth)
    frictionless = ContactArrays(
        np.full(1, len(q)), c.bodies[q], c.slot[q], c.id[q], c.point[q], c.frame[q], c.gap[q], c.arm[q],
        np.zeros(len(q)), c.restitution[q],
    )  # fmt: skip
    rows = join(contact_rows(frictionless, frictionless.gap, u.shape[1]), held)
    return rows, np.zeros_like(u), np.zeros(len(rows.c))


@compiled
def join_islands(label, bodies):
    """Join islands that these rows (m, 2) connect: label (n,) in place."""
    now = label_islands(bodies, len(label))
    for i in range(len(label)):
        one, other = root(label, i), root(label, now[i])
        label[max(one, other)] = min(one, other)
    for i in range(len(label)):
        label[i] = root(label, i)


@compiled
def displace_by(state, δ):
    """Move all bodies by δ (n, k), lengths and angles."""
    d, turning = state.x.shape[1], np.zeros((len(state.q), state.ω.shape[1]))
    for i in range(len(turning)):
        for a in range(turning.shape[1]):
            turning[i, a] = δ[i, d + a]
    displace(state, δ[:, :d], turning)


@compiled_apart
def slow_down(system, state, start, had, way, label, speeds):
    """Take the energy that lifting gave from the speeds; returns what is not paid, J. start (n, d), had (n,):
    where the bodies were, and their energies of motion; way (n, k): how they were moved.
    """
    has = energies(speeds.M, speeds.before)
    gain = np.zeros(len(start))
    for i in range(len(start)):
        gain[i] = has[i] - had[i]
        for a in range(start.shape[1]):
            gain[i] -= system.mass[i] * system.gravity[a] * (state.x[i, a] - start[i, a])
    unpaid = pay(label, gain, has, way, speeds.M, speeds.before, np.zeros((4, len(start))))
    scatter_velocities(system, speeds.before, state)
    return unpaid
