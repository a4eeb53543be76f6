"""The velocity-based simulator, the widely used one: contact at the level of velocities and impulses (S12).

A step of Δt, as S9 has it, but made in its middle: find the contacts; move half way; there solve
w = A λ + b for the impulses λ, which keep bodies from going into each other; with them the new velocities;
with these the other half. What went into each other all the same is lifted apart at the end (S13), and where
something rebounds the step stops at each impact.

Slides S9–S12; lectures/05_contact.md. Source: Stewart & Trinkle, Int. J. Numer. Methods Eng. 39 (1996)
2673; Anitescu & Potra, Nonlinear Dynamics 14 (1997) 231.
"""

import numpy as np

from ..collision import find_contacts, make_collider
from ..collision.find import make_contacts
from ..compiled import bind
from ..contacts import contact_rows, part
from ..forces import external_force, with_user_forces
from ..trajectory import BodyState
from .bouncing import Hits, strike
from .coasting import coast
from .flight import Limits, Turning, push
from .free import fill_free, make_speeds
from .held import Held, join
from .impact_time import hop
from .impacts import IMPACTS
from .lifting import lift, raise_apart
from .middle import half_way, make_near, reach
from .smooth import all_finite
from .solving import StepSolver, Unsolvable, newton_in_cones
from .touched import Touched

CLOSED = 1e-9  # of the smallest body's size: a gap that counts as none


class VelocityLCP:
    """A scene made ready to run with contact: ``advance`` moves ``state``, and records if told to.

    While a step is under way: M, before and free are the mass matrices, the velocities u now and those
    that there would be after ``filled`` s without contact; ``now`` is the time of the clock; ``middle`` is
    the same as M, before and free, but half way.
    """

    coasts = True  # whether ``coast`` may take the steps in which nothing special happens

    def __init__(self, scene, bodies, settings):
        self.bodies, self.system, self.state = bodies, bodies.system, bodies.state()
        self.collider, self.held = make_collider(bodies, scene), Held(bodies)
        self.solver = StepSolver(settings.solver, settings.friction, settings.tolerance, settings.iterations)
        self.tells_unsolved = self.solver.name != "cone_newton"  # step by step, in ``note``
        self.law, self.hits, self.ended = IMPACTS[settings.impact], Hits(), None
        self.warm, self.recording = settings.warm_start, settings.record_contacts
        force = external_force
        if scene.user_forces:
            force = with_user_forces(bodies, tuple(scene.user_forces), self.public_state)
        self.timeless = not scene.user_forces  # the same state gives the same force
        self.fill_free = bind(fill_free, force)
        n, self.d = self.state.x.shape
        self.k = 6 if self.d == 3 else 3
        self.speeds, self.middle = (make_speeds(n, self.d, self.k, self.state.ω) for _ in range(2))
        self.M, self.before, self.free, _, _ = self.speeds
        self.work = Turning(30, 1e-15, np.zeros(2), np.zeros_like(self.state.L))
        radius = self.collider.solids.form.radius if self.collider else np.zeros(0)
        self.closed = CLOSED * float(radius[np.isfinite(radius)].min(initial=self.held.size))
        self.key, self.force = np.zeros(0, dtype=np.int64), np.zeros((0, self.d))  # of the contacts before
        self.now, self.filled, self.still, self.lifted = 0.0, 0.0, False, np.zeros(2)
        self.touched, self.worst, self.open = Touched(self.d), self.solver.worst, 0.0
        self.limits = Limits(*self.solver.limits, self.closed, len(bodies.mass), self.warm)
        compiled_whole = self.solver.name == "cone_newton"
        solve = newton_in_cones if compiled_whole else self.solve_in_flight
        self.push, self.raise_apart = bind(push, solve), bind(raise_apart, solve)
        self.coast = None  # what takes ordinary steps by itself
        simple = not len(self.held) and not scene.user_forces
        if self.coasts and compiled_whole and self.collider and simple:
            self.coast = bind(coast, self.fill_free, self.collider.detect, self.raise_apart, self.push)
        self.begin()

    def advance(self, origin, first, h, steps, every=1, record=None, solves=None):
        """So many steps of h; the time is origin + h · (steps done before, ``first``, and since).

        Every so many steps, and after the last, a row of record and of solves is written, as in
        ``smooth.run``. Returns how many steps were done: fewer than ``steps`` if the next would not have
        been finite.
        """
        row, done, noted = 0, 0, record is not None and self.recording
        while done < steps:
            due = steps if record is None else min(steps, every * (row + 1))
            new = self.go(origin + (first + done) * h, h, 1 if noted else due - done)
            if not new:
                return done
            done += new
            if record is not None and done == due:
                record[row], solves[row] = self.state.y, self.worst[:2]
                self.worst[:2], row = 0, row + 1
                if noted:
                    self.touched.close(self.within(2 * self.closed), self.closed)
            if not noted:
                self.touched.back_to(0)
        return steps

    def go(self, t, h, steps):
        """Up to so many steps from the time t; returns how many are done: 0, if the next is not finite."""
        if self.still:  # the same state again, and so the same forces
            for _ in range(steps if self.recording else 0):
                self.touched.repeat()
            return steps
        done = self.coast_on(t, h, steps) if self.coast else 0
        if done:
            return done
        kept = self.keep()
        try:
            with np.errstate(all="ignore"):  # what isn't finite ends the run, and is told there
                self.step(t, h)
        except Unsolvable as why:
            self.ended = why.status, str(why)
        if not self.ended and all_finite(self.state.y):
            return 1
        self.restore(kept)
        return 0

    def coast_on(self, t, h, steps):
        """Up to so many ordinary steps, in which nothing strikes or overlaps; returns how many are done."""
        near, contacts = make_near(self.collider, self.d), self.collider.contacts
        done, self.still, room, pushed, half, impulse = self.coast(
            self.system, self.state, self.work, self.speeds, self.middle, near, contacts,
            self.held.rows_with(*self.held.in_flight(h)), (self.key, self.force), t, h, steps, self.limits,
            self.worst, self.lifted, self.timeless,
        )  # fmt: skip
        self.key, self.force = pushed
        if done and self.recording:
            self.touched.add(part(half, slice(0, len(impulse))), impulse)
        if done and not room:
            self.fill(t + done * h, h)
            lift(self, self.find(h), h)
        return done

    def step(self, t, h):
        """One step of S9, from impact to impact."""
        start, left, hops = self.state.y.copy(), h, 0
        self.hits.begin()
        while left > 0:
            self.fill(t + h - left, left)
            contacts = lift(self, self.find(left), left)
            early = self.hits.early(left, contacts.gap)
            if self.hits.add(strike(self, contacts, h, early)):
                self.fill(t + h - left, left)
            done = hop(self, contacts, h, left, early) if early < left else self.fly(contacts, left)
            left, hops = left - done if done < left else 0.0, hops + 1
        self.still = self.timeless and hops == 1 and np.array_equal(start, self.state.y)
        if not self.still:  # what is recorded is a state that joints and contacts allow
            self.fill(t + h, h)
            lift(self, self.find(h), h)

    def fill(self, t, h):
        """M, u, and the velocities that there would be after h without contact."""
        self.now, self.filled = t, h
        self.fill_free(self.system, t, h, self.state, self.speeds)
        self.held.fill(self.state)

    def find(self, h):
        """All contacts that could matter within h."""
        return self.within(reach(self.speeds, h, self.closed), h)

    def within(self, margin, h=0.0):
        """The contacts with gaps up to margin, and those that speeds could close within h besides."""
        if not self.collider:
            return make_contacts(0, self.d)
        m = find_contacts(self.collider, self.state, margin, h)
        return part(self.collider.contacts, slice(0, m))

    def rows(self, contacts, target, held):
        """The contacts' rows, with w_n ≥ −target, and those of the joints with (c, lower, upper) = held."""
        return join(contact_rows(contacts, target, self.k), self.held.rows_with(*held))

    def solve(self, rows, free, λ):
        """The velocities u⁺; λ in place."""
        return self.solver(rows, self.M, free, λ, time=self.now)

    def solve_in_flight(self, rows, M, free, λ, limits, worst):
        """``solve``, for ``flight``, which leaves out what rests."""
        return self.solver(rows, M, free, λ, time=self.now)

    def fly(self, contacts, h):
        """Move on by h, without rebound: half way, the impulses there, and the other half. Returns h."""
        self.held.fill(self.state)
        start = self.held.from_start(h, self.before)
        near = make_near(self.collider, self.d)
        half = half_way(
            self.collider, self.system, self.state, self.work, self.speeds, near, contacts, h, self.limits
        )
        self.fill_free(self.system, self.now + 0.5 * h, h, self.state, self.middle)
        held = self.held.half_way(start, self.state, self.middle.before)
        key, impulse, λ = self.push(
            self.system, self.state, self.work, self.speeds, self.middle, contacts, half, held, self.key,
            self.force, h, self.limits, self.worst,
        )  # fmt: skip
        self.note_impulses(half, key, impulse, λ, h)
        return h

    def note_impulses(self, contacts, key, impulse, λ, h):
        """For the record, and for the next step to begin with: of contacts with these keys (m,) and impulses
        (m, d) in their frames; λ (r,): of all rows.
        """
        self.touched.add(contacts, impulse)
        if self.warm:
            self.key, self.force = key, impulse / h
            self.held.force = λ[len(λ) - len(self.held) :] / h

    def keep(self):
        """What ``restore`` needs to go back to now."""
        state = self.state
        return state.y.copy(), state.L.copy(), self.key, self.force, self.held.force, self.touched.mark()

    def restore(self, kept):
        """Go back to what ``keep`` kept."""
        self.state.y[:], self.state.L[:], self.key, self.force, self.held.force, mark = kept
        self.touched.back_to(mark)

    def set_state(self, start):
        """Take over a ``BodyState``."""
        self.state = self.bodies.state(
            start.position, start.orientation, start.velocity, start.angular_velocity
        )
        self.still = False
        self.begin()

    def begin(self):
        """Close the joints; ValueError where they can't be closed."""
        if len(self.held):
            self.fill(0.0, 1.0)
            lift(self, self.within(0.0), 1.0)
            self.lifted[:] = 0.0
            if self.open:
                raise ValueError(
                    f"joints must be able to hold at the same time, but one stays open by {self.open:.3g} "
                    "whatever the bodies do: look at lengths and points of the loops that they close"
                )

    def public_state(self, t, state):
        """The State as a ``BodyState`` of all bodies."""
        return BodyState(t, *(array[0] for array in self.bodies.unpack(state.y[None])))

    def contacts(self, records):
        """The ``ContactHistory`` of so many records."""
        return self.touched.history(records)

    def failure(self):
        """The status and reason where ``advance`` ended early, or None, where there is nothing to add."""
        return ("torn", f"a joint stayed open by {self.open:.2g} in") if self.open else self.ended

    def note(self):
        """What must be said of the contacts, or ""."""
        gain, depth = self.lifted
        lifted = f"lifting overlaps apart has added {gain:.3g} J" if gain > 0 else ""
        stays = f"an overlap of up to {depth:.3g} m could not be lifted apart" if depth > 0 else ""
        return "; ".join(part for part in (self.solver.told(), self.hits.told(), lifted, stays) if part)

    def joint_forces(self, times, records):
        """ValueError: impulses of joints are not kept here."""
        raise ValueError("joint_forces() needs a run under 'smooth': 'velocity_lcp' has no forces of joints")
