"""``simulate`` runs a scene and returns a trajectory; ``Simulation`` does it step by step.

Slides S3, S9; lectures/02_equation_of_motion.md.
"""

import numpy as np

from .. import inputs
from ..compiled import COMPILED
from ..integrators import INTEGRATORS
from ..layout import Bodies
from ..scene import Unsupported
from ..trajectory import BodyState, ContactHistory, Trajectory
from .model import model
from .smooth import Smooth

SIMULATORS = {"smooth": Smooth}
FAMILIES = ("penalty", "impulse", "acceleration_lcp", "velocity_lcp", "reduced", "smooth")  # of S3
_NEWTON = {"iterations": 30, "tolerance": 1e-14}  # for integrators with an equation to solve


class Simulation:
    """A scene made ready to run: ``step()``, ``advance(duration)``, ``run(duration)``, ``state``.

    Arguments as for ``simulate``. ``status`` is "ok", or "diverged" once the state stopped being finite;
    ``reason`` says when. After that, ``state`` is the last finite one recorded, and going on raises
    ValueError.
    """

    def __init__(
        self,
        scene,
        dt,
        *,
        simulator=None,
        solver=None,
        integrator=None,
        friction=None,
        impact=None,
        correction=None,
        iterations=None,
        tolerance=None,
        substeps=1,
        warm_start=True,
        seed=0,
        record_every=1,
        record_contacts=True,
        start=None,
    ):
        needs = model(scene)
        self.dt = inputs.number("dt", dt, above=0)
        self.substeps = inputs.whole("substeps", substeps, least=1)
        self.record_every = inputs.whole("record_every", record_every, least=1)
        inputs.whole("seed", seed)
        simulator = inputs.choice("simulator", needs.simulator if simulator is None else simulator, FAMILIES)
        if simulator not in SIMULATORS:
            raise Unsupported(
                f"simulator {simulator!r} is not part of the course yet: there is {', '.join(SIMULATORS)}"
            )
        for name, value in (
            ("solver", solver),
            ("friction", friction),
            ("impact", impact),
            ("correction", correction),
        ):
            if value is not None:
                raise Unsupported(
                    f"{name}={value!r} has no effect under {simulator!r}: without contact there is nothing "
                    "for it to do"
                )
        integrator = inputs.choice(
            "integrator", needs.integrator if integrator is None else integrator, INTEGRATORS
        )
        limits = {
            "iterations": _NEWTON["iterations"]
            if iterations is None
            else inputs.whole("iterations", iterations, least=1),
            "tolerance": _NEWTON["tolerance"]
            if tolerance is None
            else inputs.number("tolerance", tolerance, least=0),
        }
        self.settings = {
            "simulator": simulator,
            "integrator": integrator,
            "dt": self.dt,
            "substeps": self.substeps,
            **limits,
            "record_every": self.record_every,
            "compiled": COMPILED and not scene.user_forces,
        }
        self.bodies = Bodies(scene)
        self.time, self.status, self.reason = 0.0, "ok", ""
        self._family = SIMULATORS[simulator](
            self.bodies, tuple(scene.user_forces), integrator, *limits.values()
        )
        if start is not None:
            self._family.set_state(_checked_start(start, self.bodies))
            self.time = float(start.time)

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
        """Move on by a whole number of dt; returns the ``Trajectory`` from now to now + duration."""
        steps, every, start = count_steps(duration, self.dt), self.record_every, self.time
        done = np.append(np.arange(0, steps, every), steps)  # steps done at each record
        record, solves = np.empty((len(done), self._family.state.y.size)), np.zeros((len(done), 2))
        record[0] = self._family.state.y
        finished = self._advance(steps, record[1:], solves[1:])
        kept = len(done) if finished == steps else np.searchsorted(done, finished, side="right")
        self._tell_unsolved(solves[:kept])
        return Trajectory(
            self.bodies,
            start + done[:kept] * duration / steps,
            *self.bodies.unpack(record[:kept]),
            contacts=ContactHistory.empty(kept, self.bodies.dimension),
            status=self.status,
            reason=self.reason,
            residual=solves[:kept, 1].copy(),
            iterations=solves[:kept, 0].astype(int),
            settings=dict(self.settings),
        )

    def _advance(self, steps, record=None, solves=None):
        """So many steps of dt; returns how many of them were finished."""
        if self.status != "ok":
            raise ValueError(f"this simulation can't go on: {self.reason}")
        h, start = self.dt / self.substeps, self.time
        with np.errstate(all="ignore"):  # the plain form of the loops warns of what the status will tell
            done = self._family.advance(
                start, h, steps * self.substeps, self.record_every * self.substeps, record, solves
            )
        self.time = start + done * h
        if done < steps * self.substeps:
            self.status = "diverged"
            self.reason = (
                f"the state stopped being finite in the step from t = {self.time:.6g} s; try a smaller dt"
            )
        return done // self.substeps

    def _tell_unsolved(self, solves):
        """Put it into ``reason`` where an implicit step used all its iterations and did not reach
        its tolerance.
        """
        worst = solves[:, 1].max()
        if self.status == "ok" and worst > self.settings["tolerance"]:
            self.reason = (
                f"some steps stopped at {self.settings['iterations']} iterations with a residual up to "
                f"{worst:.2g}, above the tolerance {self.settings['tolerance']:g}"
            )


def simulate(
    scene,
    duration,
    dt,
    *,
    simulator=None,
    solver=None,
    integrator=None,
    friction=None,
    impact=None,
    correction=None,
    iterations=None,
    tolerance=None,
    substeps=1,
    warm_start=True,
    seed=0,
    record_every=1,
    record_contacts=True,
    start=None,
):
    """Run a scene for ``duration`` s in steps of ``dt`` s and return its ``Trajectory``.

    None means chosen by what the scene needs; ``settings`` of the result says what was. Promised for the
    families of S3; what is not there yet, or can't do what is asked, raises Unsupported.

    simulator: "smooth", where nothing can touch. integrator: a name in ``reference.integrators.INTEGRATORS``.
    iterations, tolerance: limits of an implicit integrator's own Newton iteration. substeps: steps of
    dt/substeps for each dt. record_every: records each so-manieth step, and always the last. start: a state
    to go on from, ``sim.state`` or ``run.state()``, its time included; None: as the scene says, at t = 0.
    solver, friction, impact, correction are for contact; warm_start, seed and record_contacts make no
    difference where there is none.

    Raises ValueError or TypeError for bad input, naming the argument. A run whose state stops being finite
    returns what it has, with status "diverged" and the time.
    """
    settings = {name: value for name, value in locals().items() if name not in ("scene", "duration", "dt")}
    simulation = Simulation(scene, dt, **settings)
    return simulation.run(duration)


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
    """A ``BodyState`` whose arrays fit the bodies, finite, with unit quaternions."""
    if not isinstance(start, BodyState):
        raise TypeError(f"start must be a state, from sim.state or run.state(), but is {start!r}")
    names = ("position", "orientation", "velocity", "angular_velocity")
    arrays = {
        name: inputs.array(f"start.{name}", getattr(start, name), getattr(bodies, name).shape)
        for name in names
    }
    if bodies.dimension == 3:
        for q in arrays["orientation"]:
            inputs.unit_quaternion("start.orientation", q)
    return BodyState(inputs.number("start.time", start.time), **arrays)
