"""A method that ``bench`` measures: an integrator and solver of ours, or an engine with its settings.

A Method can do two things with its case, in a number of steps: tell the error of the whole run, and the
processor time of ``advance``.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import numpy as np

from . import measure
from .integrators import INTEGRATORS
from .peers import ENGINES
from .simulators import Simulation

RECORDS = 64  # at which errors are taken
LONG = 5e-3  # s: a step of a large scene
PLAIN = ("integrator", "solver", "body")  # settings whose value says all


class Method:
    """One curve: an integrator of ours, with a solver where there are joints, or an engine."""

    def __init__(self, case, settings, engine=None):
        self.case, self.engine, self.settings = case, engine, settings
        words = [v if k in PLAIN else f"{k} {v}" for k, v in settings.items()]
        self.name = " ".join([engine, *words] if engine else words)
        self.inner = settings.get("substeps", 1)
        order = 1 if engine else INTEGRATORS[settings["integrator"]].order
        self.first, self.factor = (max(4, self.inner) if engine else 1), (4 if order == 1 else 2)

    def dt(self, steps):
        """The step that ``prepare`` uses, s; an engine's substeps are steps that it takes within."""
        return self.case.duration * self.inner / steps

    def prepare(self, steps, **extra):
        """The case's scene, ready to be advanced to its end in so many steps."""
        dt = self.dt(steps)
        if self.engine:
            return ENGINES[self.engine].load(self.case.scene, dt, **self.settings)
        return Simulation(self.case.scene, dt, **self.settings, **extra)

    def error(self, steps):
        """Error and status of a whole run."""
        every = max(1, steps // self.inner // RECORDS)
        if self.engine:
            with self.prepare(steps) as peer:
                run = peer.run(self.case.duration, every)
        else:
            run = self.prepare(steps, record_every=every).run(self.case.duration)
        return self.case.error(run), run.status

    def seconds(self, steps):
        """Processor seconds of one ``advance`` over the case's duration; each is a scene of its own, one step
        under way.

        The first step on a fresh scene costs more, on all sides: memory is asked for, and nothing is in the
        cache.
        """
        made = []

        def prepare():
            made.append(self.prepare(steps))
            made[-1].advance(self.dt(steps))
            return made[-1]

        try:
            return measure.cpu_seconds(
                lambda ready: ready.advance(self.case.duration), 1, prepare, least=1e-4
            )
        finally:
            self._close(made)

    def step_seconds(self, steps, repeats, together=10):
        """Processor seconds of a step, of a run that is under way: so many are timed ``together``.

        A step that takes long is timed once: what the clock and the machine do to it matters less.
        """
        ready = self.prepare(steps)
        try:
            dt = self.dt(steps)
            ready.advance(dt)
            once = measure.cpu_seconds(lambda: ready.advance(dt), 1, least=1e-4)
            if once > LONG:
                return once
            stretch = together * dt
            return measure.cpu_seconds(lambda: ready.advance(stretch), repeats, least=1e-3) / together
        finally:
            self._close([ready])

    def _close(self, made):
        for ready in made if self.engine else ():
            ready.close()


def ladder(method, longest):
    """(steps, error, status), coarse to fine, until a run takes ``longest`` s or is as good as rounding."""
    rows, steps = [], method.first
    while True:
        try:
            error, status = method.error(steps)
        except ValueError as refusal:  # so coarse a step is more than the engine takes
            error, status = np.inf, f"refused: {refusal}"
        rows.append((steps, error, status))
        rounding = error < 1e-14 or (error < 1e-9 and error > rows[-2][1] / 2)
        if rounding or (status == "ok" and method.seconds(steps) * method.factor > longest):
            return rows
        steps *= method.factor
