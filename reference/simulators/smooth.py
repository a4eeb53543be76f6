"""The smooth simulator: no contact is possible, so an integrator alone moves the bodies, to any order it
likes.

``run`` is the whole simulation: it repeats the integrator's step (S9). It is compiled together with the step
and the force; a force that is the user's own Python function makes ``run`` and the step plain Python around
compiled parts.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

import functools

import numpy as np

from ..compiled import bind, compiled, plain
from ..forces import external_force, with_user_forces
from ..integrators import INTEGRATORS, make_work
from ..trajectory import BodyState


@compiled
def run(step, system, state, t, h, steps, every, max_iterations, tolerance, record, solves):
    """Do so many steps of h from time t; every so many, and after the last, write y and the solves' worst
    into a row.

    record (rows, size of y); solves (rows, 2): iterations and residual; no rows: nothing is recorded.
    Returns how many steps were done: fewer than ``steps`` if the state stopped being finite.
    """
    work = make_work(len(state.x), len(state.q), state.x.shape[1], max_iterations, tolerance)
    row = 0
    for done in range(1, steps + 1):
        step(system, t + (done - 1) * h, h, state, work)
        if not all_finite(state.y):
            return done - 1
        if len(record) > 0 and (done % every == 0 or done == steps):
            record[row] = state.y
            solves[row] = work.solve
            work.solve[:] = 0
            row += 1
    return steps


@compiled
def all_finite(y):
    """Whether no entry is inf or nan."""
    total = 0.0
    for k in range(len(y)):
        total += 0 * y[k]  # nan, if y[k] is inf or nan
    return total == 0


class Smooth:
    """A scene made ready to run with one integrator: ``advance`` moves ``state``, and records if told to."""

    def __init__(self, bodies, user_forces, integrator, max_iterations, tolerance):
        self.bodies, self.state = bodies, bodies.state()
        self.limits = max_iterations, tolerance
        method = INTEGRATORS[integrator]
        if user_forces:
            force = with_user_forces(bodies, user_forces, self.public_state)
            base = plain(method.base) if method.base else None
            step = functools.partial(plain(method.step), functools.partial(base, force) if base else force)
            self.run = functools.partial(plain(run), step)
        else:
            self.run = bind(run, method.bind(external_force))

    def advance(self, t, h, steps, every=1, record=None, solves=None):
        """So many steps of h from time t; returns how many were done before the state stopped being
        finite.
        """
        record = np.empty((0, self.state.y.size)) if record is None else record
        solves = np.empty((0, 2)) if solves is None else solves
        return self.run(self.bodies.system, self.state, t, h, steps, every, *self.limits, record, solves)

    def public_state(self, t, state):
        """The State as a ``BodyState`` of all bodies."""
        return BodyState(t, *(array[0] for array in self.bodies.unpack(state.y[None])))

    def set_state(self, start):
        """Take over a ``BodyState``."""
        self.state = self.bodies.state(
            start.position, start.orientation, start.velocity, start.angular_velocity
        )
