"""The methods that ``bench`` compares: each an integrator of ours or an engine, with the cases they meet in.

A Method can do two things with its case, in a number of steps: tell the error of the whole run, and the
processor time of ``advance``.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import numpy as np

from . import measure
from .cases import CASES
from .cases.case import Catalogue
from .integrators import INTEGRATORS
from .peers import ENGINES
from .simulators import Simulation

RECORDS = 64  # at which errors are taken
_FLIGHT = ("splitting", "rk4")
_ROTATION = ("implicit_gyroscopic", "splitting", "implicit_midpoint", "rk4", "splitting4", "splitting6")
_SWING = ("splitting", "rk4", "splitting4", "splitting6")
_SAME = {2: ("symplectic_euler_position_first",), 3: ("symplectic_euler",)}  # what the engines do
CONTESTS = Catalogue(
    "case",
    {  # label: case, its parameters, our integrators
        **{
            f"{name}/{d}d": (name, {"dimension": d}, _SAME[d] + integrators)
            for name, integrators in (
                ("free_fall", _FLIGHT),
                ("projectile_drag", _FLIGHT),
                ("spring", _SWING),
                ("two_body_orbit", _SWING),
            )
            for d in (2, 3)
        },
        "planar_flight": ("planar_flight", {}, _SAME[2] + _FLIGHT),
        **{
            name: (name, {}, _SAME[3] + _ROTATION)
            for name in ("tumbling_box", "torque_free_top", "heavy_top")
        },
    },
)


def variants(engine, name):
    """An engine's settings that are worth trying on a case."""
    if engine == "pymunk":
        return [{}] + [{"drag": "engine"}] * (name == "projectile_drag")
    forced = name in ("projectile_drag", "spring", "two_body_orbit", "heavy_top")
    return [{}, {"body": "rigid"}] + [{"body": "rigid", "substeps": 16}] * (not forced)


class Method:
    """One curve of a contest: an integrator of ours, or an engine with its settings."""

    def __init__(self, case, settings, engine=None):
        self.case, self.engine, self.settings = case, engine, settings
        words = [v if k in ("integrator", "body") else f"{k} {v}" for k, v in settings.items()]
        self.name = " ".join([engine, *words] if engine else words)
        self.inner = settings.get("substeps", 1)
        order = 1 if engine else INTEGRATORS[settings["integrator"]].order
        self.first, self.factor = (max(4, self.inner) if engine else 1), (4 if order == 1 else 2)

    def prepare(self, steps, **extra):
        """The case's scene, ready to be advanced to its end in so many steps."""
        dt = self.case.duration * self.inner / steps
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
        made, first_step = [], self.case.duration * self.inner / steps

        def prepare():
            made.append(self.prepare(steps))
            made[-1].advance(first_step)
            return made[-1]

        try:
            return measure.cpu_seconds(
                lambda ready: ready.advance(self.case.duration), 1, prepare, least=1e-4
            )
        finally:
            for ready in made if self.engine else ():
                ready.close()


def methods_of(label):
    """The Methods of a contest: ours, then those of each engine that is installed and takes such a scene."""
    name, parameters, integrators = CONTESTS[label]
    case = CASES[name](**parameters)
    ours = [Method(case, {"integrator": integrator}) for integrator in integrators]
    engines = [
        engine.name
        for engine in ENGINES.values()
        if engine.available and engine.dimension == case.scene.dimension
    ]
    return ours + [
        Method(case, settings, engine) for engine in engines for settings in variants(engine, name)
    ]


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
