"""The contests of ``bench``: cases with a known answer, on which our methods meet the engines.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import gc
from dataclasses import dataclass

import numpy as np

from .bench_methods import Method, ladder
from .bench_report import comparison_of, plot, row, table
from .cases import CASES
from .cases.case import Catalogue
from .peers import ENGINES
from .simulators import model


@dataclass(frozen=True)
class Contest:
    """A case, our settings (dictionaries, each a method), and those of the engines that run it.

    both: also an engine of the other dimension takes part, with the same case in its own dimension.
    """

    label: str
    case: str
    parameters: dict
    ours: tuple
    engines: dict
    both: bool = False

    def methods(self):
        """The Methods: ours, then those of each engine that is installed and takes such a scene."""
        case = CASES[self.case](**self.parameters)
        found = [Method(case, settings) for settings in self.ours]
        for engine in ENGINES.values():
            if engine.available and (self.both or engine.dimension == case.scene.dimension):
                own = case
                if engine.dimension != case.scene.dimension:
                    own = CASES[self.case](**{**self.parameters, "dimension": engine.dimension})
                found += [Method(own, settings, engine.name) for settings in self.engines[engine.name]]
        return found

    def measure(self, longest, repeats, tell):
        """All measurements, as dictionaries: what the JSON lines hold."""
        plan = []
        for method in self.methods():
            tell(f"{self.label}: {method.name}: errors")
            plan += [(method, *rung) for rung in ladder(method, longest)]
        times = np.full((repeats, len(plan)), np.nan)
        gc.disable()
        for turn in range(repeats):
            for k, (method, steps, _, status) in enumerate(plan):
                tell(f"{self.label}: timing, turn {turn + 1} of {repeats}, run {k + 1} of {len(plan)}")
                if status == "ok":
                    times[turn, k] = method.seconds(steps)
        gc.enable()
        medians = np.median(times, axis=0)
        return [
            row(self.label, method, steps, seconds, error, status)
            for (method, steps, error, status), seconds in zip(plan, medians, strict=True)
        ]

    def table(self, rows):
        """The measurements as text, and what of a simulator this scene does not need."""
        return f"{table(self.label, rows)}\n  {not_built(CASES[self.case](**self.parameters).scene)}"

    def plot(self, rows, path):
        """Error against time, as a picture."""
        plot(self.label, rows, CASES[self.case](**self.parameters).unit, path)

    def summary(self, rows):
        """Lines that compare us with each engine."""
        return comparison_of(self.label, rows)


def not_built(scene):
    """A line that says what ``model`` leaves out."""
    return "not built: " + ", ".join(model(scene).absent)


def _integrators(*names, **settings):
    return tuple({"integrator": name, **settings} for name in names)


def _free(name):
    """The engines' settings for a case without joints that are worth trying."""
    forced = name in ("projectile_drag", "spring", "two_body_orbit", "heavy_top")
    return {
        "pymunk": ({}, *[{"drag": "engine"}] * (name == "projectile_drag")),
        "pybullet": ({}, {"body": "rigid"}, *[{"body": "rigid", "substeps": 16}] * (not forced)),
    }


_FLIGHT = ("splitting", "rk4")
_ROTATION = ("implicit_gyroscopic", "splitting", "implicit_midpoint", "rk4", "splitting4", "splitting6")
_SWING = ("splitting", "rk4", "splitting4", "splitting6")
_SAME = {2: ("symplectic_euler_position_first",), 3: ("symplectic_euler",)}  # what the engines do
_PYMUNK = ({}, {"error_bias": 0.0})
_LOOPS = ({}, {"error_bias": 0.0, "iterations": 50})
_TREE = ({},)
_RIGID = ({"body": "rigid"},)


def _contests():
    for name, integrators in (
        ("free_fall", _FLIGHT),
        ("projectile_drag", _FLIGHT),
        ("spring", _SWING),
        ("two_body_orbit", _SWING),
    ):
        for d in (2, 3):
            ours = _integrators(*_SAME[d], *integrators)
            yield Contest(f"{name}/{d}d", name, {"dimension": d}, ours, _free(name))
    yield Contest("planar_flight", "planar_flight", {}, _integrators(*_SAME[2], *_FLIGHT), _free(""))
    for name in ("tumbling_box", "torque_free_top", "heavy_top"):
        yield Contest(name, name, {}, _integrators(*_SAME[3], *_ROTATION), _free(name))
    yield from _jointed_contests()


def _jointed_contests():
    few = _integrators(*_SAME[2], "rk4", solver="cholesky")
    many = _integrators(*_SAME[2], "rk4", solver="sparse") + _integrators("rk4", solver="tree")
    loops = _integrators(*_SAME[2], "rk4", solver="minimum_norm")
    redundant = _integrators(*_SAME[3], "rk4", solver="minimum_norm")
    engines = {"pymunk": _PYMUNK, "pybullet": (*_TREE, *_RIGID)}
    yield Contest("pendulum", "pendulum", {}, few, engines, both=True)
    yield Contest("double_pendulum", "double_pendulum", {}, few, engines, both=True)
    for n in (20, 100):
        for end in (1, 1000):
            parameters = {"n": n, "end_mass": end}
            yield Contest(f"chain/{n}/{end}", "chain", parameters, many, engines, both=True)
    balls = {"n": 100, "end_mass": 1000, "dimension": 3, "joint": "ball"}
    yield Contest("chain/100/1000/balls", "chain", balls, many, {"pybullet": _RIGID})
    for name in ("four_bar", "slider_crank", "n_four_bars"):
        form = _TREE if name == "slider_crank" else (*_TREE, *_RIGID)
        yield Contest(name, name, {}, loops, {"pymunk": _LOOPS, "pybullet": form}, both=True)
    for name in ("door", "bricard"):
        yield Contest(name, name, {}, redundant, {"pybullet": (*_TREE, *_RIGID)})
    yield Contest("gimbal_gyroscope", "gimbal_gyroscope", {"precession": 0.0}, few, engines)


CONTESTS = Catalogue("case", {contest.label: contest for contest in _contests()})
