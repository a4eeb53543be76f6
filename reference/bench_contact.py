"""The contact contests of ``bench``: rest, friction and impacts, ours beside the engines at chosen settings.

Rest has no order of convergence: what is at rest is right at any dt, or creeps. So each method here is one
point, an engine's as it comes, then with the best settings found, and the table gives what it costs for each
second of the scene. Scenes stand in the plane for us and pymunk, in space for pybullet, with the same answer.

Slides S10–S13, S18; lectures/05_contact.md.
"""

import gc
import time
from dataclasses import dataclass, field

import numpy as np

from .bench_contests import not_built
from .bench_report import comparison_of, plot, row
from .cases import CASES
from .cases.case import Catalogue
from .peers import ENGINES
from .simulators import Simulation

PATIENCE = 20  # times ``longest``: what takes longer is timed once

OURS = ({"rate": 60},)
BY_DEFAULT = {"pymunk": ({"rate": 60},), "pybullet": ({"rate": 240},)}
_CALM = {"residual": 0.0, "contact_erp": 0.05}
BEST = {
    "pymunk": (
        {"rate": 1000, "iterations": 100, "slop": 1e-4},
        {"rate": 4000, "iterations": 30, "slop": 1e-3},
        {"rate": 4000, "iterations": 30, "slop": 1e-5, "collision_bias": 0.0},
    ),
    "pybullet": (
        {"rate": 1000, "body": "rigid", "iterations": 200, **_CALM, "warm_start": 0.95},
        {"rate": 1000, "body": "multibody", "iterations": 50, **_CALM},
    ),
}


@dataclass(frozen=True)
class Entry:
    """A case in an engine (None: ours) at so many steps a second; settings without the rate."""

    case: object
    engine: str | None
    rate: int
    settings: dict

    @property
    def name(self):
        """Who, and all settings."""
        shown = {k: v for k, v in self.settings.items() if k in SHOWN}
        words = [v if k == "body" else f"{k} {v}" for k, v in shown.items()]
        return " ".join([self.engine or "velocity_lcp", f"{self.rate} Hz", *words])

    @property
    def steps(self):
        """Of the whole run."""
        return round(self.rate * self.case.duration)

    def prepare(self):
        """The case's scene, ready to be advanced."""
        dt = self.case.duration / self.steps
        if self.engine:
            return ENGINES[self.engine].load(self.case.scene, dt, **self.settings)
        return Simulation(self.case.scene, dt, record_contacts=False, **self.settings)

    def outcome(self):
        """Error and status of a whole run; contacts are not read, for no error here needs them."""
        ready = self.prepare()
        if not self.engine:
            run = ready.run(self.case.duration)
            return self.case.error(run), run.status
        with ready as peer:
            run = peer.run(self.case.duration, max(1, self.steps // 300), record_contacts=False)
        return self.case.error(run), run.status

    def seconds(self):
        """Processor seconds of one ``advance`` over the case's duration, from the scene's start."""
        ready = self.prepare()
        try:
            start = time.process_time()
            ready.advance(self.case.duration)
            return time.process_time() - start
        finally:
            if self.engine:
                ready.close()


SHOWN = ("body", "iterations", "slop", "contact_erp", "substeps", "collision_bias")


@dataclass(frozen=True)
class ContactContest:
    """A case, with settings for ours and each engine: dictionaries with a "rate", steps a second.

    flat: the case takes a ``dimension``, and pybullet runs it in space; else only the engine of its own
    dimension takes part.
    """

    label: str
    case: str
    parameters: dict = field(default_factory=dict)
    ours: tuple = OURS
    engines: dict = field(default_factory=lambda: {name: BY_DEFAULT[name] + BEST[name] for name in BEST})
    both: bool = True

    def entries(self):
        """Ours, then those of each engine that is installed."""
        made = {}
        for engine in (None, *(e for e in ENGINES.values() if e.available)):
            d = 2 if engine is None else engine.dimension
            if self.both and d not in made:
                made[d] = CASES[self.case](**self.parameters, dimension=d)
            case = made[d] if self.both else made.setdefault("own", CASES[self.case](**self.parameters))
            if engine is None or engine.dimension == case.scene.dimension:
                for settings in self.ours if engine is None else self.engines[engine.name]:
                    rest = {k: v for k, v in settings.items() if k != "rate"}
                    yield Entry(case, engine and engine.name, settings["rate"], rest)

    def measure(self, longest, repeats, tell):
        """All measurements, as dictionaries: ``cpu_s`` is that of the whole duration."""
        plan = []
        for entry in self.entries():
            tell(f"{self.label}: {entry.name}: error")
            plan.append((entry, *entry.outcome()))
        times = np.full((repeats, len(plan)), np.nan)
        gc.disable()
        for turn in range(repeats):
            for k, (entry, _, status) in enumerate(plan):
                tell(f"{self.label}: timing, turn {turn + 1} of {repeats}, run {k + 1} of {len(plan)}")
                if status == "ok" and not times[0, k] > PATIENCE * longest:
                    times[turn, k] = entry.seconds()
        gc.enable()
        return [
            row(self.label, entry, entry.steps, seconds, error, status)
            for (entry, error, status), seconds in zip(plan, map(_median, times.T), strict=True)
        ]

    def table(self, rows):
        """The measurements as text: error, and CPU milliseconds for each second of the scene."""
        case = CASES[self.case](**self.parameters)
        lines = [
            f"{self.label}: error [{case.unit}] after {case.duration:g} s",
            f"  {'method':<74}{'error':>10}{'CPU ms/s':>10}",
        ]
        for one in rows:
            error = "—" if one["error"] is None else f"{one['error']:.1e}"
            cost = "—" if one["cpu_s"] is None else f"{one['cpu_s'] / case.duration * 1e3:.2f}"
            lines.append(f"  {one['method']:<74}{error:>10}{cost:>10}  {one['status'][:40]}".rstrip())
        return "\n".join([*lines, f"  {not_built(case.scene)}"])

    def plot(self, rows, path):
        """Error against time, as a picture."""
        plot(self.label, rows, CASES[self.case](**self.parameters).unit, path)

    def summary(self, rows):
        """Lines that compare us with each engine."""
        return comparison_of(self.label, rows)


def _median(seconds):
    """Of those that were taken; nan if none was."""
    taken = seconds[np.isfinite(seconds)]
    return np.median(taken) if len(taken) else np.nan


def _cradle(incoming):
    one = {"pymunk": ({"rate": 60},), "pybullet": ({"rate": 240},)}
    best = {"pymunk": BEST["pymunk"], "pybullet": ({"rate": 1000, "rest_speed": 0.0, "residual": 0.0},)}
    engines = {name: one[name] + best[name] for name in one}
    ours = ({"rate": 60, "impact": "sequential"},)
    return ContactContest(f"cradle/{incoming}", "cradle", {"incoming": incoming}, ours, engines)


_FAST = {"pymunk": ({"rate": 100}, {"rate": 10_000, "iterations": 100, "slop": 1e-5})}

CONTACTS = Catalogue(
    "case",
    {
        contest.label: contest
        for contest in (
            ContactContest("stack/10/1000", "stack", {"n": 10, "heavy": 1000}),
            ContactContest("stack/20/1000", "stack", {"n": 20, "heavy": 1000}),
            ContactContest("stack/50", "stack", {"n": 50}),
            ContactContest("slope/creep", "slope"),
            ContactContest("slope/slide", "slope", {"share": 0.95}, ({"rate": 10}, {"rate": 60})),
            ContactContest("arch", "arch", both=False),
            ContactContest("heavy_on_two/400", "heavy_on_two"),
            ContactContest("card_house/3", "card_house", {"storeys": 3}, both=False),
            ContactContest("bridge/160", "bridge", both=False),
            _cradle(1),
            _cradle(2),
            ContactContest("painleve", "painleve", {}, ({"rate": 100}, {"rate": 1000}), _FAST, both=False),
            ContactContest("pyramid/20", "pyramid", {"base": 20, "duration": 2.0}),
            ContactContest("bounce", "bounce"),
            ContactContest("rocking_block", "rocking_block", {}, ({"rate": 60}, {"rate": 1000}), both=False),
        )
    },
)
