"""The smooth simulator: no contact is possible, so an integrator alone moves the bodies; joints allowed.

``run`` is the whole simulation: it repeats the step (S9). Where there are joints, each stage of the
integrator finds their force at the level of accelerations, and after each step positions and velocities are
projected back onto them. It is compiled together with the step
and the force; a force that is the user's own Python function makes ``run`` and the step plain Python around
compiled parts.

Slides S4, S9; lectures/02_equation_of_motion.md.
"""

import numpy as np

from ..compiled import bind, lean, merged
from ..correction import project
from ..embedding import constrained_force
from ..forces import external_force, with_user_forces
from ..integrators import INTEGRATORS, copy, make_work
from ..trajectory import BodyState, ContactHistory, JointForces
from .jointed import Joints

TORN = 1e-6  # of the mechanism's size: a joint error that no projection could mend; the run stops


@lean
def run(step, system, state, work, origin, first, h, steps, every, record, solves):
    """Do so many steps of h; the time is ``origin`` + h · (steps done before, ``first``, and since).

    Every so many steps, and after the last, y goes into a row of record (rows, size of y), and the iterations
    and the residual of implicit steps, the worst since the row before, into solves (rows, 2); no rows: no
    record. Returns how many steps were done: fewer than ``steps`` if the next would not have been finite;
    the state is then the last that was.
    """
    copy(state.y, work.before)
    work.solve[:] = 0
    row = 0
    for done in range(steps):
        step(system, origin + (first + done) * h, h, state, work)
        if not all_finite(state.y):
            copy(work.before, state.y)
            return done
        copy(state.y, work.before)
        if len(record) > 0 and ((done + 1) % every == 0 or done + 1 == steps):
            copy(state.y, record[row])
            copy(work.solve, solves[row])
            work.solve[:] = 0
            row += 1
    return steps


@merged
def all_finite(y):
    """Whether no entry is inf or nan."""
    total = 0.0
    for k in range(len(y)):
        total += 0 * y[k]  # nan, if y[k] is inf or nan
    return total == 0


@merged
def jointed_step(step, system, t, h, state, work):
    """A step of S9 with joints: constraint forces, velocities and positions; then what drifted is put back.

    A gap that stays is one that no step may be built on: the state becomes nan, which ends the run.
    """
    step(system, t, h, state, work)
    iterations, gap = project(system, state)
    work.solve[0] = max(work.solve[0], iterations)
    work.solve[1] = max(work.solve[1], gap)
    if gap > TORN:
        system.mechanism.watch[3] = gap
        state.y[:] = np.nan


class Smooth:
    """A scene made ready to run with one integrator: ``advance`` moves ``state``, and records if told to."""

    tells_unsolved = False  # how an implicit step's iteration ended is told of ``solves``

    def __init__(self, scene, bodies, settings):
        user_forces = scene.user_forces
        self.bodies, self.state = bodies, bodies.state()
        self.work = make_work(
            len(self.state.x), len(self.state.q), bodies.dimension, settings.iterations, settings.tolerance
        )
        self.nothing = np.empty((0, self.state.y.size)), np.empty((0, 2))
        method, self.system, self.joints = INTEGRATORS[settings.integrator], bodies.system, None
        force = external_force
        if user_forces:
            force = with_user_forces(bodies, tuple(user_forces), self.public_state)
        if bodies.joints:
            self.joints = Joints(bodies, settings.solver)
            self.system = self.joints.system
            self.run = bind(run, bind(jointed_step, method.bind(bind(constrained_force, force))))
            self.begin()
        else:
            self.run = bind(run, method.bind(force))

    def advance(self, origin, first, h, steps, every=1, record=None, solves=None):
        """So many steps of h; see ``run``."""
        if record is None:
            record, solves = self.nothing
        start = self.state.y.copy()
        done = self.run(self.system, self.state, self.work, origin, first, h, steps, every, record, solves)
        if not (self.joints and self.joints.near and done):
            return done
        kept = record[: len(record) if done == steps else done // every]
        states = np.concatenate([start[None], kept if len(record) else self.state.y[None]])
        last = self.joints.last_credible(states)
        if last == len(states) - 1:
            return done
        self.state.y[:] = states[last]
        return last * every

    def public_state(self, t, state):
        """The State as a ``BodyState`` of all bodies."""
        return BodyState(t, *(array[0] for array in self.bodies.unpack(state.y[None])))

    def set_state(self, start):
        """Take over a ``BodyState``."""
        self.state = self.bodies.state(
            start.position, start.orientation, start.velocity, start.angular_velocity
        )
        if self.joints:
            self.begin()

    def begin(self):
        """Close the joints and take out velocities that they don't allow: steps that take no time.

        The second one finds the joints closed, and so has J for the velocities where they are.
        """
        before = self.state.y.copy()
        if self.run(self.system, self.state, self.work, 0.0, 0, 0.0, 2, 1, *self.nothing) < 2:
            self.joints.refuse_start()
        self.joints.compare_start(before, self.state)

    def joint_forces(self, times, records):
        """``JointForces`` at these times, from the records y (T, size): found anew by steps of no time."""
        if not self.joints:
            raise ValueError("joint_forces() needs a scene with joints: this one has none")
        kept, found = self.state, []
        for t, y in zip(times, records, strict=True):
            then = self.public_state(t, kept._replace(y=y))
            self.state = self.bodies.state(
                then.position, then.orientation, then.velocity, then.angular_velocity
            )
            self.advance(t, 0, 0.0, 1)
            found.append(self.joints.forces(self.state))
        self.state = kept
        return JointForces(*(np.array(part) for part in zip(*found, strict=True)), self.joints.rows.joint)

    def contacts(self, records):
        """No contact in any of the records."""
        return ContactHistory.empty(records, self.bodies.dimension)

    def failure(self):
        """The status and reason where ``advance`` ended early."""
        return self.joints.failure() if self.joints else None

    def note(self):
        """What must be said of the joints, or ""."""
        return self.joints.note() if self.joints else ""
