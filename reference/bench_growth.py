"""What a step costs as a scene grows: the other half of speed, beside error.

Slides S9, S18; lectures/02_equation_of_motion.md.
"""

from dataclasses import dataclass

import numpy as np

from .bench_contests import not_built
from .bench_methods import Method
from .bench_report import growth_plot, growth_table, row
from .cases import CASES
from .cases.case import Catalogue
from .peers import ENGINES

RATE = 1000  # steps a second


@dataclass(frozen=True)
class Growth:
    """A case whose parameter ``n`` grows through ``sizes``; else as a Contest.

    A method takes part up to the first size at which a step takes a quarter of what is granted or is refused.
    """

    label: str
    case: str
    parameters: dict
    sizes: tuple
    ours: tuple
    engines: dict

    def methods(self, n):
        """The Methods at one size: ours, then the engines', each in its own dimension."""
        made = {}
        for engine in (None, *ENGINES.values()):
            if engine is None or engine.available:
                d = self.parameters["dimension"] if engine is None else engine.dimension
                if d not in made:
                    made[d] = CASES[self.case](**{**self.parameters, "n": n, "dimension": d})
                for settings in self.ours if engine is None else self.engines[engine.name]:
                    yield Method(made[d], settings, engine and engine.name)

    def measure(self, longest, repeats, tell):
        """All measurements, as dictionaries: ``cpu_s`` is that of one step."""
        rows, stopped = [], set()
        for n in self.sizes:
            for method in self.methods(n):
                if method.name in stopped:
                    continue
                tell(f"{self.label}: {method.name}: n = {n}")
                steps, status, seconds = round(RATE * method.case.duration), "ok", np.nan
                try:
                    seconds = method.step_seconds(steps, repeats)
                except ValueError as refusal:
                    status = f"refused: {refusal}"
                rows.append(row(self.label, method, steps, seconds, np.inf, status, n=n))
                if not seconds * 4 < longest:  # the next size may take several times as long
                    stopped.add(method.name)
        return rows

    def table(self, rows):
        """The measurements as text, and what of a simulator this scene does not need."""
        scene = CASES[self.case](**{**self.parameters, "n": self.sizes[0]}).scene
        return f"{growth_table(self.label, rows)}\n  {not_built(scene)}"

    def plot(self, rows, path):
        """Time of a step against n, as a picture."""
        growth_plot(self.label, rows, path)

    def summary(self, rows):
        """Nothing to compare at equal errors: there are none."""
        return []


GROWTHS = Catalogue(
    "case",
    {
        "links": Growth(
            "links",
            "chain",
            {"dimension": 2},
            (10, 30, 100, 300, 1000, 3000, 10_000),
            tuple({"integrator": "rk4", "solver": solver} for solver in ("cholesky", "sparse", "tree")),
            {"pymunk": ({},), "pybullet": ({}, {"body": "rigid"})},
        )
    },
)
