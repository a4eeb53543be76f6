"""Speed against error: our integrators beside pymunk and pybullet, on every case with a known answer.

``python -m reference.bench [CASE…] [--out DIR] [--quick]``, or ``course.py bench``.

A method is a curve: for each case and method, error against processor seconds as dt falls. What is timed is
``advance`` on a scene that is ready, on all sides: an engine's loop over its steps counts, since that is how it is
used, and setting the scene up does not. The methods of a case take turns, several times, and medians count, so that a
busy moment of the machine meets all of them. Compiling comes before. Errors are those of separate runs, over up to 64
records. pybullet's substeps are steps that it takes in C++, without going back to Python.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import argparse
import gc
import json
import sys
from pathlib import Path

import numpy as np

from . import measure
from .bench_report import plot, summary, table
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
CONTESTS = Catalogue("case", {  # label: case, its parameters, our integrators
    **{f"{name}/{d}d": (name, {"dimension": d}, _SAME[d] + integrators)
       for name, integrators in (("free_fall", _FLIGHT), ("projectile_drag", _FLIGHT), ("spring", _SWING), ("two_body_orbit", _SWING))
       for d in (2, 3)},
    "planar_flight": ("planar_flight", {}, _SAME[2] + _FLIGHT),
    **{name: (name, {}, _SAME[3] + _ROTATION) for name in ("tumbling_box", "torque_free_top", "heavy_top")},
})


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
        words = [v if isinstance(v, str) else f"{k} {v}" for k, v in settings.items()]
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
        """Processor seconds of one ``advance`` over the case's duration; each is a scene of its own, one step under way.

        The first step on a fresh scene costs more, on all sides: memory is asked for, and nothing is in the cache.
        """
        made, first_step = [], self.case.duration * self.inner / steps

        def prepare():
            made.append(self.prepare(steps))
            made[-1].advance(first_step)
            return made[-1]

        try:
            return measure.cpu_seconds(lambda ready: ready.advance(self.case.duration), 1, prepare, least=2e-4)
        finally:
            for ready in made if self.engine else ():
                ready.close()


def methods_of(label):
    """The Methods of a contest: ours, then those of each engine that is installed and takes such a scene."""
    name, parameters, integrators = CONTESTS[label]
    case = CASES[name](**parameters)
    ours = [Method(case, {"integrator": integrator}) for integrator in integrators]
    engines = [engine.name for engine in ENGINES.values() if engine.available and engine.dimension == case.scene.dimension]
    return ours + [Method(case, settings, engine) for engine in engines for settings in variants(engine, name)]


def ladder(method, longest):
    """(steps, error, status) from coarse to fine, until a run takes ``longest`` seconds or is as good as rounding."""
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


def contest(label, longest, repeats, tell):
    """All measurements of a contest, as dictionaries: what the JSON lines hold."""
    plan = []
    for method in methods_of(label):
        tell(f"{label}: warming up {method.name}, and its errors")
        method.prepare(64 * method.inner).advance(method.case.duration)
        plan += [(method, *row) for row in ladder(method, longest)]
    times = np.full((repeats, len(plan)), np.nan)
    gc.disable()
    for turn in range(repeats):
        for k, (method, steps, _, status) in enumerate(plan):
            tell(f"{label}: timing, turn {turn + 1} of {repeats}, run {k + 1} of {len(plan)}")
            if status == "ok":
                times[turn, k] = method.seconds(steps)
    gc.enable()
    return [_row(label, *entry, seconds) for entry, seconds in zip(plan, np.median(times, axis=0), strict=True)]


def _row(label, method, steps, error, status, seconds):
    settings = {"engine": method.engine, **method.settings, "steps": steps, "dt": method.case.duration / steps}
    return {"case": label, "method": method.name, "settings": settings, "cpu_s": float(seconds) if status == "ok" else None,
            "error": float(error) if np.isfinite(error) else None, "status": status}


def chosen_labels(names):
    """The contests of the given cases: a contest's label, or a case's name for all of its contests; none: all."""
    if not names:
        return list(CONTESTS)
    labels = [label for name in names for label in ([name] if name in CONTESTS else [k for k, v in CONTESTS.items() if v[0] == name] or [name])]
    for label in labels:
        CONTESTS[label]  # an unknown name raises KeyError with the list
    return labels


def main(arguments=None):
    """Run the contests; table, JSON lines, plots and summary go to the output folder, the text to the terminal too."""
    parser = argparse.ArgumentParser(prog="bench", description="Speed against error, beside pymunk and pybullet.")
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"one or more of {', '.join(CONTESTS)}; none: all")
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parents[1] / "build" / "bench", help="output folder")
    parser.add_argument("--quick", action="store_true", help="short runs, few repeats: a look, not a measurement")
    options = parser.parse_args(arguments)
    try:
        labels = chosen_labels(options.cases)
    except KeyError as error:
        parser.error(error.args[0])
    longest, repeats = (0.01, 3) if options.quick else (0.3, 7)
    options.out.mkdir(parents=True, exist_ok=True)
    everything, text = [], []
    for number, label in enumerate(labels, start=1):
        rows = contest(label, longest, repeats, _progress(f"[{number}/{len(labels)}] "))
        everything += rows
        text.append(table(label, rows))
        print(text[-1], flush=True)
        plot(label, rows, CASES[CONTESTS[label][0]]().unit, options.out / f"{label.replace('/', '_')}.png")
    text.append(summary(everything))
    print(text[-1])
    (options.out / "bench.txt").write_text("\n\n".join(text) + "\n", encoding="utf-8")
    (options.out / "bench.jsonl").write_text("".join(json.dumps(row) + "\n" for row in everything), encoding="utf-8")
    print(f"\nWritten to {options.out}: bench.txt, bench.jsonl and a plot a case.")


def _progress(prefix):
    """A function that shows what is being done: on one line of a terminal, else nothing but the first of its kind."""
    def tell(message):
        if sys.stderr.isatty():
            print(f"\r\033[K{prefix}{message}"[:150], end="", file=sys.stderr, flush=True)

    if not sys.stderr.isatty():
        print(prefix + "measuring …", file=sys.stderr, flush=True)
    return tell


if __name__ == "__main__":
    main()
