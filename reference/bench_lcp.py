"""Residual and error of λ against processor time, for every solver that takes the problem.

``course.py bench lcp`` runs these studies, ``course.py bench lcp/stack/1000`` one of them.

A solver is a curve: it is given 1, 4, 16 … iterations, until it has solved the problem, says why it can't, or
takes longer than is granted. What is timed is the whole call. The solvers take turns, and medians count.
Both errors stand side by side, since a small residual promises a small error of λ only where A is well
conditioned. Pivoting solvers and those that need A as a whole are left out where n is beyond them.

A problem is any function that returns a ``Known``, such as those recorded from a step of a scene, where λ
often isn't unique: then "error" is that of w.

Slides S13–S17; lectures/07_iterative_lcp.md.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from . import measure
from .bench_sweeps import SWEEPS
from .cases.case import Catalogue
from .cases.lcp_lattice import lattice
from .cases.lcp_problems import LCP_PROBLEMS
from .cases.lcp_recorded import SCENES, recorded
from .lcp import SOLVERS

_ROW_BY_ROW = (
    "jacobi", "damped_jacobi", "gauss_seidel", "symmetric_gauss_seidel", "sor", "red_black", "block_jacobi",
    "block_gauss_seidel", "nncg", "apgd",
)  # fmt: skip
LARGEST = {"enumeration": 12, **dict.fromkeys(("murty", "dantzig", "lemke"), 500)}  # n; else 1000
_FACTOR = 4
AIMS = (1e-2, 1e-4, 1e-6, 1e-8)
FLOOR, HIGHEST = 1e-16, 10  # what is drawn of errors
# One mark and line for each family: pivoting, splitting, by blocks, Newton, gradients.
_FAMILIES = (
    ("s", "-", ("enumeration", "murty", "dantzig", "lemke")),
    ("o", "-", ("jacobi", "damped_jacobi", "gauss_seidel", "symmetric_gauss_seidel", "sor", "red_black")),
    ("x", ":", ("block_jacobi", "block_gauss_seidel")),
    ("^", "--", ("min_map_newton", "fischer_newton", "interior_point")),
    ("D", "-.", ("nncg", "apgd")),
)
LOOKS = {name: (mark, line, k) for mark, line, names in _FAMILIES for k, name in enumerate(names)}


@dataclass(frozen=True)
class LcpStudy:
    """One problem, all solvers. make(**parameters): a Known."""

    label: str
    make: Callable
    parameters: dict = field(default_factory=dict)
    case: str = "lcp"

    def solvers(self, n):
        """The names of the solvers of an LCP that are not overtaxed by n rows."""
        return [
            name
            for name in SOLVERS
            if name in _ROW_BY_ROW or (n <= LARGEST.get(name, 1000) and not name.startswith("cone"))
        ]

    def measure(self, longest, repeats, tell):
        """All measurements, as dictionaries: ``residual`` and ``error`` of λ beside ``cpu_s``."""
        known, plan = self.make(**self.parameters), []
        for name in self.solvers(known.problem.n):
            tell(f"{self.label}: {name}")
            plan += [(name, *step) for step in self.ladder(known.problem, SOLVERS[name], longest)]
        times = np.zeros((repeats, len(plan)))
        for turn in range(repeats):
            for k, (name, most, _) in enumerate(plan):
                tell(f"{self.label}: turn {turn + 1} of {repeats}, {name}")
                times[turn, k] = _seconds(known.problem, SOLVERS[name], most)
        return [
            self._row(known, *entry, float(seconds))
            for entry, seconds in zip(plan, np.median(times, axis=0), strict=True)
        ]

    def ladder(self, problem, solver, longest):
        """(max_iterations, Solution), few to many."""
        most = 1
        solver(problem, max_iterations=1)  # compiles
        while True:
            solution = solver(problem, max_iterations=most)
            yield most, solution
            if solution.status != "max_iterations" or _seconds(problem, solver, most) * _FACTOR > longest:
                return
            most *= _FACTOR

    def _row(self, known, name, most, solution, seconds):
        error = None if known.answer is None and known.w is None else float(known.error(solution.lam))
        residual = float(solution.residual)
        return {
            "case": self.label,
            "method": name,
            "settings": {"max_iterations": most},
            "iterations": solution.iterations,
            "cpu_s": seconds,
            "residual": residual if np.isfinite(residual) else None,
            "error": error if error is not None and np.isfinite(error) else None,
            "of": "λ" if known.w is None else "w",
            "status": solution.status,
            "n": known.problem.n,
        }

    def table(self, rows):
        """Milliseconds to each residual, and what was reached in the end."""
        aims = "".join(f"{f'to {aim:.0e}':>10}" for aim in AIMS)
        lines = [f"{self.label}: milliseconds until the residual is …", f"  {'':24}{aims}   in the end"]
        for name in dict.fromkeys(row["method"] for row in rows):
            mine = [row for row in rows if row["method"] == name]
            known = [row for row in mine if row["residual"] is not None]
            curve = measure.front([(row["cpu_s"], max(row["residual"], 1e-16)) for row in known])
            times = (measure.time_at(curve, aim) * 1e3 for aim in AIMS)
            cells = "".join(f"{time:10.3g}" if np.isfinite(time) else f"{'—':>10}" for time in times)
            last = mine[-1]
            error = "" if last["error"] is None else f", error of {last['of']} {last['error']:.1e}"
            lines.append(f"  {name:24}{cells}   {last['status']}, {last['iterations']} iterations{error}")
        return "\n".join(lines)

    def plot(self, rows, path):
        """Residual against seconds, beside it the error of λ, where an answer is known. Who can't treat the
        problem is left out.
        """
        from .view.charts import COLOURS, STYLE, plt

        quantities = {"residual": "residual", "error": f"error of {rows[0]['of']}, relative"}
        if all(row["error"] is None for row in rows):
            del quantities["error"]
        many = len(quantities)
        with plt.rc_context(STYLE):
            figure, axes = plt.subplots(
                1, many, figsize=(2 + 4.5 * many, 4.5), sharex=True, sharey=True, squeeze=False
            )
        axes = axes[0]
        rows = [row for row in rows if row["status"] != "unsuitable"]
        for name in dict.fromkeys(row["method"] for row in rows):
            for chart, quantity in zip(axes, quantities, strict=True):
                mine = [row for row in rows if row["method"] == name and row[quantity] is not None]
                values = np.maximum([row[quantity] for row in mine], FLOOR)
                mark, line, k = LOOKS[name]
                look = {"marker": mark, "linestyle": line, "color": COLOURS[k], "markersize": 4}
                chart.loglog([row["cpu_s"] for row in mine], values, label=name, **look)
        seconds = [row["cpu_s"] for row in rows]
        decades = np.floor(np.log10(min(seconds))), np.ceil(np.log10(max(seconds)))
        axes[0].set(xlim=10.0 ** np.array(decades), ylim=(FLOOR / 3, HIGHEST))
        for chart, title in zip(axes, quantities.values(), strict=True):
            chart.set(xlabel="processor time of the call [s]", title=title)
            chart.tick_params(labelleft=True)
        axes[-1].legend(fontsize=7, handlelength=4, frameon=False, bbox_to_anchor=(1, 1), loc="upper left")
        words = "lower left is better" + ", what leaves at the top diverges" * (many > 1)
        figure.suptitle(f"{self.label}, {rows[0]['n']} rows: {words}")
        figure.savefig(path)
        plt.close(figure)

    def summary(self, rows):
        """Nothing to compare with engines: they don't show their λ's residual."""
        return []


def _seconds(problem, solver, most):
    return measure.cpu_seconds(lambda: solver(problem, max_iterations=most), repeats=1, least=1e-3)


def _studies():
    for words, heavy in (("equal", 1), ("100", 100), ("1000", 1000)):
        yield LcpStudy(f"lcp/stack/{words}", LCP_PROBLEMS["column"], {"n": 50, "heavy": heavy})
        yield LcpStudy(f"lcp/chain/{words}", LCP_PROBLEMS["column"], {"n": 50, "heavy": heavy, "chain": True})
    yield LcpStudy("lcp/tower", LCP_PROBLEMS["tower"], {"n": 10, "aspect": 8.0})
    for kind in ("pd", "psd", "p", "copositive"):
        for n in (100, 500):
            yield LcpStudy(f"lcp/{kind}/{n}", LCP_PROBLEMS["planted"], {"kind": kind, "n": n})
    yield LcpStudy("lcp/pd/1000", LCP_PROBLEMS["planted"], {"n": 1000})
    yield LcpStudy("lcp/degenerate", LCP_PROBLEMS["degenerate"], {"n": 200})
    yield LcpStudy("lcp/redundant", LCP_PROBLEMS["redundant"], {"n": 50})
    yield LcpStudy("lcp/pd/10000/sparse", LCP_PROBLEMS["planted"], {"n": 10_000, "density": 3e-4})
    for name in SCENES:
        yield LcpStudy(f"lcp/recorded/{name}", recorded, {"name": name})
    for contacts in (3334, 10_000):
        for form in ("sparse", "factored"):
            parameters = {"contacts": contacts, "factored": form == "factored"}
            yield LcpStudy(f"lcp/lattice/{3 * contacts}/{form}", lattice, parameters)
    yield LcpStudy("lcp/lattice/10002/friction", lattice, {"frictionless": False})


LCP_STUDIES = Catalogue("case", {**{study.label: study for study in _studies()}, **SWEEPS})
