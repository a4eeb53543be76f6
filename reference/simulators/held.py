"""Joints among contacts: their rows as blocks of one row each, with bounds of λ, beside those of the
contacts.

    a joint        w = 0              whatever λ it takes
    a motor        w = its speed      with |λ| ≤ Δt times its force
    a limit        like a contact: λ ≥ 0, and w ≥ −φ/Δt, which just lets it be reached

Slides S6, S12; lectures/05_contact.md.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from ..lcp.augmented import ContactRows
from ..mechanism import bounded_rows, mechanism_size, rigid_rows
from ..rows import Rows, fill_rows, make_jacobian


class HeldRows(NamedTuple):
    """m rows of joints, as a flight takes them."""

    bodies: np.ndarray  # (m, 2)
    J: np.ndarray  # (m, 2, k)
    c: np.ndarray  # (m,): w = J u + c
    lower: np.ndarray  # (m,) bounds of λ
    upper: np.ndarray  # (m,)
    gap: np.ndarray  # (m,) what is left of a limit; inf for what has none
    force: np.ndarray  # (m,) of the step before


class Held:
    """The joints' rows for a scene laid out as ``bodies``; ``fill`` brings them to a state. m rows; 0
    without joints.
    """

    def __init__(self, bodies):
        rows = [rigid_rows(bodies), bounded_rows(bodies)]
        joint = np.concatenate([part.joint for part in rows])
        order = np.argsort(joint, kind="stable")  # a joint's rows stand together
        self.rows = Rows(*(np.concatenate(arrays)[order] for arrays in zip(*rows, strict=True)))
        self.jacobian = make_jacobian(len(order), len(bodies.rotating), bodies.dimension)
        self.force = np.zeros(len(order))  # of the step before, N or N m
        self.size = mechanism_size(self.rows)
        lower, upper = self.rows.lower, self.rows.upper
        self.sign = np.where((upper == 0) & (lower < 0), -1.0, 1.0)  # upper limits are turned round
        turned = self.sign < 0
        self.lower, self.upper = np.where(turned, -upper, lower), np.where(turned, -lower, upper)
        self.limit = (self.lower == 0) & (self.upper > 0)
        self.motor = ~self.limit & ((self.rows.speed != 0) | (self.upper < np.inf))
        self.rigid = ~self.limit & ~self.motor
        self.φ, self.J = np.zeros(len(order)), np.zeros_like(self.jacobian.J)

    def __len__(self):
        return len(self.force)

    def fill(self, state):
        """Bring φ and J to a state."""
        if len(self):
            fill_rows(self.rows, state, self.jacobian)
            self.φ, self.J = self.sign * self.jacobian.φ, self.sign[:, None, None] * self.jacobian.J

    def in_flight(self, h):
        """c, lower and upper of impulses for the time h."""
        c = np.where(self.motor, -self.rows.speed, np.where(self.limit, np.maximum(self.φ, 0.0) / h, 0.0))
        return c, h * self.lower, h * self.upper

    def from_start(self, h, u):
        """What ``half_way`` needs to know of the start of a flight of h s; u (n, k): the velocities there."""
        return self.in_flight(h), self.gap(), self.rates(u)

    def half_way(self, start, state, u):
        """``HeldRows`` of the middle of a flight, where state and u are. What w has changed by until there it
        will change by once more: so w is asked for at the end (see ``middle``).
        """
        (c, lower, upper), gap, w = start
        if len(self):
            self.fill(state)
            c = c + np.where(self.limit & (gap > 0), 0.0, self.rates(u) - w)
        return HeldRows(self.rows.bodies, self.J, c, lower, upper, gap, self.force)

    def rates(self, u):
        """J u of the rows (m,); u (n, k)."""
        moving = self.rows.bodies >= 0
        return np.einsum("msk,msk->m", self.J, np.where(moving[..., None], u[self.rows.bodies], 0.0))

    def at_impact(self, slack):
        """The same in no time: motors do nothing, and limits only where they are reached, to slack."""
        idle = self.motor | (self.limit & (self.φ > slack))
        lower, upper = (np.where(idle, 0.0, bound) for bound in (self.lower, self.upper))
        return np.zeros(len(self)), lower, upper

    def to_lift(self):
        """The same for a move that closes the joints: c is φ; motors have none."""
        lower, upper = (np.where(self.motor, 0.0, bound) for bound in (self.lower, self.upper))
        return np.where(self.motor, 0.0, self.φ), lower, upper

    def error(self):
        """What a correction has to take back: φ of what holds, and of limits that are passed; else 0."""
        return np.where(self.rigid, self.φ, np.where(self.limit, np.minimum(self.φ, 0.0), 0.0))

    def closed(self):
        """(m,): which rows hold: joints, and limits that are reached."""
        return self.rigid | (self.limit & (self.φ <= 0))

    def gap(self):
        """What is left of a limit, to be used up; inf for what has none."""
        return np.where(self.limit, self.φ, np.inf)

    def worst(self):
        """How far a joint is from closed, or a limit passed, at the most."""
        return max(np.abs(self.φ[self.rigid]).max(initial=0.0), (-self.φ[self.limit]).max(initial=0.0))

    def rows_with(self, c, lower, upper):
        """These rows as ``HeldRows``, with their forces of the step before."""
        return HeldRows(self.rows.bodies, self.J, c, lower, upper, self.gap(), self.force)


@compiled
def join(contact, held):
    """ContactRows: those of the contacts (what ``contacts.contact_rows`` returns), then those held."""
    bodies, J, c, block, μ, lower, upper = contact
    r, m, more = len(c), len(μ), len(held.c)
    if more == 0:
        return ContactRows(bodies, J, c, block, μ, lower, upper)
    both = ContactRows(
        np.empty((r + more, 2), np.int64),
        np.empty((r + more, 2, J.shape[2])),
        np.empty(r + more),
        np.empty(m + more + 1, np.int64),
        np.empty(m + more),
        np.empty(r + more),
        np.empty(r + more),
    )
    for k in range(r + more):
        own = k < r
        q = k if own else k - r
        both.c[k] = c[q] if own else held.c[q]
        both.lower[k] = lower[q] if own else held.lower[q]
        both.upper[k] = upper[q] if own else held.upper[q]
        for side in range(2):
            both.bodies[k, side] = bodies[q, side] if own else held.bodies[q, side]
            for a in range(J.shape[2]):
                both.J[k, side, a] = J[q, side, a] if own else held.J[q, side, a]
    for q in range(m + more):
        both.block[q] = block[q] if q < m else r + q - m
        both.μ[q] = μ[q] if q < m else -1.0
    both.block[m + more] = r + more
    return both
