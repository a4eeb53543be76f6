"""The step as slide S9 has it, and as engines do it: fixed Δt, one solve, positions by the end velocity.

Contacts are found at the step's start; what approaches fast enough to meet within the step rebounds with the
speed that it has at the start; and positions move with the velocities at the end. Bodies go into each other
that way, and joints open. The ``correction`` is what is done about it:

    none            nothing
    baumgarte       rows ask for w ≥ (fraction/Δt) depth
    soft            rows give way as springs and dampers do: softness γ on A's diagonal
    split_impulse   a second solve for velocities that move the bodies, and are forgotten
    nonlinear       sweeps over the positions after the step

Slides S9, S13; lectures/09_error_correction.md. Source: Catto, Iterative dynamics with temporal
coherence (2005).
"""

import numpy as np

from ..contacts import gather, keys, look_up, spread
from ..correction import (
    baumgarte_velocity,
    displace,
    position_sweep,
    pseudo_velocities,
    soft_coefficients,
    soft_velocity,
)
from .bouncing import motion
from .impacts import rates
from .moving import move
from .solving import moves_and_diagonal
from .velocity_lcp import VelocityLCP


class FixedStep(VelocityLCP):
    """A scene made ready to run by S9's step, with a correction that is not the projection."""

    coasts = False

    def __init__(self, scene, bodies, settings):
        self.correction, self.parameters = settings.correction
        super().__init__(scene, bodies, settings)

    def begin(self):
        """Joints and contacts begin as they are: closing them is the correction's work."""

    def step(self, t, h):
        """One step of S9."""
        self.fill(t, h)
        contacts = self.find(h)
        rows, softness = self.constraints(contacts, h)
        λ = h * self.pushed_before(contacts, rows)
        after = self.solver(rows, self.M, self.free, λ, softness, t)  # the constraint force, the velocities
        moving = after
        if self.correction == "split_impulse":
            moving = after + self.pseudo(contacts, after, h)
        move(self.system, moving, after, h, self.state, self.work)  # the positions
        self.keep_impulses(contacts, rows, λ, h)
        if self.correction == "nonlinear":
            self.correct_positions(t + h, h)

    def pushed_before(self, contacts, rows):
        """The forces (r,) of the step before on these rows; 0 where they are new, or without warm start."""
        pushed = look_up(self.key, self.force, keys(contacts, self.limits.bodies))
        return gather(rows, pushed, self.held.force)

    def keep_impulses(self, contacts, rows, λ, h):
        """For the record, and for the next step to begin with."""
        impulse = spread(rows, λ, len(contacts.gap), self.d)
        self.note_impulses(contacts, keys(contacts, self.limits.bodies), impulse, λ, h)

    def constraints(self, contacts, h):
        """The rows of this step, w = J u + c, and their softness (r,), None where all are rigid."""
        open_, back = np.maximum(contacts.gap, 0.0) / h, self.rebounds(contacts, h)
        rows = self.rows(contacts, np.where(back > 0, -back, open_), self.held.in_flight(h))
        error, given = np.minimum(contacts.gap, 0.0), self.parameters
        first, joints = rows.block[: len(error)], rows.block[len(error) : -1]
        if self.correction == "baumgarte":
            wanted = baumgarte_velocity(error, h, **given)
            rows.c[first] = np.where(wanted > 0, np.minimum(rows.c[first], -wanted), rows.c[first])
            rows.c[joints] -= baumgarte_velocity(self.held.error(), h, given["fraction"])
        if self.correction != "soft":
            return rows, None
        γ, share = soft_coefficients(1 / moves_and_diagonal(rows, self.M)[1], h, **given)
        closed = (contacts.gap <= 0) & (back == 0)
        gives = np.zeros(len(rows.c), dtype=bool)
        gives[first], gives[joints] = closed, self.held.closed()
        wanted = np.zeros(len(rows.c))
        wanted[first], wanted[joints] = error, self.held.error()
        wanted = soft_velocity(wanted, h, share)
        rows.c[gives] -= wanted[gives]
        return rows, np.where(gives, γ, 0.0)

    def rebounds(self, contacts, h):
        """How fast each contact must part after this step because it rebounds in it, m/s (m,); else 0.

        Where a bounce would be over within a step it is none.
        """
        if not contacts.restitution.any():
            return np.zeros(len(contacts.gap))
        w, hastening = motion(self, contacts)
        e, meets = contacts.restitution, contacts.gap + h * (w + h * hastening) < 0
        lasts = 2 * e * -w > h * np.maximum(-hastening, 0.0)
        return np.where(meets & (w < 0) & lasts, -e * w, 0.0)

    def pseudo(self, contacts, after, h):
        """Split impulse: ũ (n, k), which lifts apart what overlaps; 0 where nothing does."""
        error, joints = np.minimum(contacts.gap, 0.0), self.held.error()
        if max(np.abs(error).max(initial=0.0), np.abs(joints).max(initial=0.0)) <= self.closed:
            return np.zeros_like(after)
        frictionless = contacts._replace(friction=np.zeros(len(error)))
        _, lower, upper = self.held.to_lift()
        rows = self.rows(frictionless, np.zeros(len(error)), (np.zeros(len(joints)), lower, upper))
        # what is open may close by what u⁺ leaves of the gap, and no more
        gap = np.concatenate([contacts.gap, np.where(self.held.limit, self.held.φ, 0.0)])
        open_ = gap > 0
        rows.c[open_] = np.maximum((gap / h + rates(rows, after))[open_], 0.0)
        wanted = np.concatenate(
            [
                baumgarte_velocity(error, h, **self.parameters),
                baumgarte_velocity(joints, h, self.parameters["fraction"]),
            ]
        )
        rows.c[~open_] = -wanted[~open_]
        return pseudo_velocities(self.solve, rows, len(after))

    def correct_positions(self, t, h):
        """Nonlinear Gauss–Seidel: sweeps over what overlaps or is open after the step."""
        fraction, slop, most = (self.parameters[name] for name in ("fraction", "slop", "most"))
        for _ in range(int(self.parameters["sweeps"])):
            self.fill(t, h)
            contacts = self.within(2 * slop)
            frictionless = contacts._replace(friction=np.zeros(len(contacts.gap)))
            rows = self.rows(frictionless, contacts.gap, self.held.to_lift())
            if not len(rows.c):
                return
            moves, diagonal = moves_and_diagonal(rows, self.M)
            δ = np.zeros_like(self.before)
            pushes = np.concatenate([np.ones(len(contacts.gap), dtype=bool), self.held.limit])
            position_sweep(rows.bodies, rows.J, moves, diagonal, rows.c, pushes, fraction, slop, most, δ)
            displace(self.state, δ[:, : self.d], δ[: len(self.state.q), self.d :])
