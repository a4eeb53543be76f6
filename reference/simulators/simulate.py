"""``simulate`` runs a scene and returns a trajectory; ``Simulation`` does it step by step.

Slides S3, S9; lectures/02_equation_of_motion.md.
"""

from contextlib import nullcontext
from functools import partial

import numpy as np

from .. import inputs
from ..integrators import INTEGRATORS
from ..layout import Bodies
from ..rotation import rotation_angle
from ..trajectory import BodyState, Trajectory
from .model import model
from .settings import SIMULATORS, Settings

JOINED = 1e-9  # of a mechanism's size: a gap in the joints after a step that is told
SAME = 1e-9  # m, or of a coordinate; rad: so far apart, a static body counts as where it was
CONTACT_MOST_DRAG = 2.0  # h · drag/mass with contact, as ``Integrator.most_drag``


def simulate(scene, duration, dt, *, start=None, **settings):
    """Run a scene for ``duration`` s in steps of ``dt`` s and return its ``Trajectory``.

    settings: simulator, integrator, substeps, record_every, … as in ``Settings``. What is not said is chosen
    by what the scene needs; the result's ``settings`` tells what was. start: a state to go on from,
    ``sim.state`` or ``run.state()``; the clock that forces see goes on from its time, while the result's
    ``time`` counts from 0 again. None: as the scene says, at t = 0.

    Raises ValueError or TypeError for bad input, naming the argument (a dt so long that drag would speed a
    body up is bad too); Unsupported where something can't be expressed. A run whose state stops being finite
    returns what it has, with status "diverged" and the time.
    """
    return Simulation(scene, dt, start=start, **settings).run(duration)


class Simulation:
    """A scene made ready to run: ``step()``, ``advance(duration)``, ``run(duration)``, ``state``, ``time``.

    Arguments as for ``simulate``. ``status`` is "ok", or "diverged" once the state stopped being finite;
    ``reason`` says when. ``state`` is then the one before the step that failed, and going on is a ValueError.
    """

    def __init__(self, scene, dt, *, start=None, **settings):
        chosen = Settings.chosen(model(scene), **settings)
        self.dt, self.substeps = inputs.number("dt", dt, above=0), chosen.substeps
        self.record_every, self.tolerance, self.iterations = (
            chosen.record_every,
            chosen.tolerance,
            chosen.iterations,
        )
        self.settings = chosen.told(self.dt, scene.user_forces)
        self.bodies = Bodies(scene)
        _check_drag(self.bodies, self.dt, self.dt / self.substeps, chosen)
        self.status, self.reason = "ok", ""
        self._family = SIMULATORS[chosen.simulator](scene, self.bodies, chosen)
        # the plain form of the loops would warn of what the status will tell; the compiled form can't
        self._silence = nullcontext if self.settings["compiled"] else partial(np.errstate, all="ignore")
        own = "look whether your own force is finite there, or " if scene.user_forces else ""
        self._remedy = f"{own}try a smaller dt"
        self._origin, self._done = 0.0, 0  # when it started, and substeps done since
        if start is not None:
            self._origin = _checked_start(start, self.bodies)
            self._family.set_state(start)

    @property
    def time(self):
        """Now, s."""
        return self._origin + self._done * (self.dt / self.substeps)

    @property
    def state(self):
        """All bodies now: a ``BodyState``, a copy."""
        return self._family.public_state(self.time, self._family.state)

    def step(self):
        """Move on by dt."""
        self._advance(1)

    def advance(self, duration):
        """Move on by a whole number of dt, recording nothing."""
        self._advance(count_steps(duration, self.dt))

    def run(self, duration):
        """Move on by a whole number of dt; returns the ``Trajectory``, whose time counts from now."""
        steps, start = count_steps(duration, self.dt), self.time
        done = np.append(np.arange(0, steps, self.record_every), steps)  # steps done at each record
        record, solves = np.empty((len(done), self._family.state.y.size)), np.zeros((len(done), 2))
        record[0] = self._family.state.y
        finished = self._advance(steps, record[1:], solves[1:])
        kept = int(np.searchsorted(done, finished, side="right"))
        if not self._family.tells_unsolved:
            self._tell_unsolved(solves[:kept])
        self._tell(self._family.note())
        time = done[:kept] * duration / steps
        find_forces = partial(self._family.joint_forces, start + time, record[:kept])
        return Trajectory(
            self.bodies,
            time,
            *self.bodies.unpack(record[:kept]),
            contacts=self._family.contacts(kept),
            status=self.status,
            reason=self.reason,
            residual=solves[:kept, 1].copy(),
            iterations=solves[:kept, 0].astype(int),
            settings=dict(self.settings),
            start_time=start,
            find_joint_forces=find_forces,
        )

    def _advance(self, steps, record=None, solves=None):
        """So many steps of dt; returns how many of them were finished."""
        if self.status != "ok":
            raise ValueError(f"this simulation can't go on: {self.reason}")
        wanted, every, h = steps * self.substeps, self.record_every * self.substeps, self.dt / self.substeps
        with self._silence():
            done = self._family.advance(self._origin, self._done, h, wanted, every, record, solves)
        self._done += done
        if done < wanted:
            self.status, what = self._family.failure() or ("diverged", "the state stopped being finite in")
            self.reason = f"{what} the step from t = {self.time:.6g} s; {self._remedy}"
        return done // self.substeps

    def _tell(self, what):
        """Add a sentence to ``reason``, once."""
        if what and what not in self.reason:
            self.reason = "; ".join(part for part in (self.reason, what) if part)

    def _tell_unsolved(self, solves):
        """Say it in ``reason`` where an implicit step used all its iterations short of its tolerance."""
        worst = solves[:, 1].max()
        if self.status == "ok" and worst > (JOINED if self.bodies.joints else self.tolerance):
            self.reason = (
                f"some steps stopped within {self.iterations} iterations with a residual up to {worst:.2g}, "
                f"above the tolerance {self.tolerance:g}"
            )


def count_steps(duration, dt):
    """How many steps of dt make the duration; ValueError unless it is a whole number, at least 1."""
    duration = inputs.number("duration", duration, above=0)
    if dt > duration * (1 + 1e-9):
        raise ValueError(f"dt must be at most the duration, {duration:g} s, but is {dt:g} s")
    steps = round(duration / dt)
    if abs(steps * dt - duration) > 1e-9 * duration:
        raise ValueError(
            f"duration must be a whole number of dt = {dt:g} s, but is {duration:g} s: "
            f"{steps * dt:.12g} s would be right"
        )
    return steps


def _checked_start(start, bodies):
    """The time of a ``BodyState``; ValueError or TypeError unless its arrays fit and are finite, and what is
    static is where the scene has it, at rest.
    """
    if not isinstance(start, BodyState):
        raise TypeError(f"start must be a state, from sim.state or run.state(), but is {start!r}")
    for name in ("position", "orientation", "velocity", "angular_velocity"):
        inputs.array(f"start.{name}", getattr(start, name), getattr(bodies, name).shape)
    for q in start.orientation if bodies.dimension == 3 else ():
        inputs.unit_quaternion("start.orientation", q)
    away = np.abs(start.position - bodies.position) > SAME * np.maximum(1.0, np.abs(bodies.position))
    turned = _angles(bodies.orientation, start.orientation) > SAME
    for i in (i for i, body in enumerate(bodies.declared) if body.static):
        if away[i].any() or turned[i] or np.any(start.velocity[i]) or np.any(start.angular_velocity[i]):
            raise ValueError(
                f"start must leave body {i}, which is static, where the scene has it, at rest: position "
                f"{bodies.position[i].tolist()}, orientation {bodies.orientation[i].tolist()}, but has it at "
                f"{start.position[i].tolist()}, {start.orientation[i].tolist()}, with velocity "
                f"{start.velocity[i].tolist()}, {start.angular_velocity[i].tolist()}"
            )
    return inputs.number("start.time", start.time)


def _angles(p, q):
    """By how much the attitudes p and q differ, rad, 0 … π: (n,)."""
    return rotation_angle(p, q) if p.ndim == 2 else np.abs((q - p + np.pi) % (2 * np.pi) - np.pi)


def _check_drag(bodies, dt, h, settings):
    """ValueError where steps of h would make drag speed up what it should slow down.

    All methods here are explicit in it: each step multiplies v by a polynomial in h · drag/mass, which is
    greater than 1 beyond a bound. What joints hold is left out: others' masses can keep it stable.
    """
    most = INTEGRATORS[settings.integrator].most_drag if settings.integrator else CONTACT_MOST_DRAG
    held = {i for joint in bodies.joints for i in joint.ends}
    system = bodies.system
    for k, (linear, angular) in zip(system.drag_bodies, system.drag_law, strict=True):
        i, rate = int(bodies.moving[k]), linear / system.mass[k]
        if k < len(system.inertia):
            rate = max(rate, angular / system.inertia[k].min())
        if i not in held and h * rate > most * (1 + 1e-9):
            raise ValueError(
                f"dt must be at most {most / rate * dt / h:.6g} s for the drag of body {i}, but is "
                f"{dt:g} s: in longer steps this method would let drag speed it up"
            )
