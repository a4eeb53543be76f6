"""How many rows a second Gauss–Seidel renews, beside the same loop in C.

The problem looks like contact: 10,002 rows of about 30 numbers each, ``cases.lcp_lattice``. What is timed is
the whole call of the solver, and the bare loop in C, compiled by ``cc`` where there is one. All take turns in
one process, and medians count.

Slides S16, S17; lectures/07_iterative_lcp.md.
"""

import ctypes
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .cases.lcp_lattice import lattice
from .lcp import gauss_seidel
from .lcp.operators import arrays

C_LOOP = r"""
#include <stdint.h>
void sweeps(int64_t count, int64_t n, const uint32_t *start, const uint32_t *column, const double *value,
            const double *b, const double *step, const double *lower, const double *upper,
            const int64_t *normal, const double *mu, double *lambda)
{
    for (int64_t k = 0; k < count; k++)
        for (int64_t i = 0; i < n; i++) {
            double w = b[i];
            for (uint32_t j = start[i]; j < start[i + 1]; j++)
                w += value[j] * lambda[column[j]];
            double low = lower[i], high = upper[i], most;
            if (normal[i] >= 0) {
                most = mu[i] * (lambda[normal[i]] > 0 ? lambda[normal[i]] : 0);
                low = -most;
                high = most;
            }
            w = lambda[i] - step[i] * w;
            lambda[i] = w < low ? low : w > high ? high : w;
        }
}
"""


@dataclass(frozen=True)
class SweepStudy:
    """Row updates a second: ours as called, at each ``every``, for a formed and a factored A; and C."""

    label: str
    case: str
    contacts: int
    sweeps: int = 160

    def measure(self, longest, repeats, tell):
        """One row for each way: ``cpu_s`` is that of all sweeps, ``rate`` row updates a second."""
        ways, rows = self.ways(), []
        seconds = {name: [] for name in ways}
        for turn in range(max(5, 2 * repeats) + 1):  # the first turn compiles
            tell(f"{self.label}: turn {turn}")
            for name, way in ways.items():
                before = time.process_time()
                way()
                seconds[name].append(time.process_time() - before)
        for name, times in seconds.items():
            cpu = float(np.median(times[1:]))
            row = {"case": self.label, "method": name, "settings": {"sweeps": self.sweeps}, "cpu_s": cpu}
            rows.append({**row, "error": None, "status": "ok", "rate": 3 * self.contacts * self.sweeps / cpu})
        return rows

    def ways(self):
        """name → function that does all sweeps."""
        formed = lattice(self.contacts).problem
        factored = lattice(self.contacts, factored=True).problem

        def ours(problem, **options):
            gauss_seidel(problem, tolerance=1e-300, max_iterations=self.sweeps, **options)

        ways = {
            "gauss_seidel": lambda: ours(formed),
            "gauss_seidel, every 1": lambda: ours(formed, every=1),
            "gauss_seidel, factored": lambda: ours(factored),
        }
        loop = c_loop()
        return {**ways, "the loop in C": lambda: loop(formed, self.sweeps)} if loop else ways

    def table(self, rows):
        """The measurements as text."""
        in_c = next((row["rate"] for row in rows if "in C" in row["method"]), None)
        lines = [f"{self.label}: {3 * self.contacts} rows, about 30 numbers each, {self.sweeps} sweeps"]
        for row in rows:
            beside = f"{in_c / row['rate']:6.2f} × the time of C" if in_c else ""
            lines.append(f"  {row['method']:28} {row['rate'] / 1e6:6.1f} million rows a second {beside}")
        return "\n".join(lines if in_c else [*lines, "  no C compiler (cc) here to compare with"])

    def plot(self, rows, path):
        """The same as bars."""
        from .view import plt

        figure, axes = plt.subplots(figsize=(7, 2.5), layout="constrained")
        axes.barh([row["method"] for row in rows][::-1], [row["rate"] / 1e6 for row in rows][::-1])
        title = f"Gauss–Seidel with clipping, {3 * self.contacts} rows of about 30 numbers: more is better"
        axes.set(xlabel="million rows a second", title=title)
        figure.savefig(path)
        plt.close(figure)

    def summary(self, rows):
        """Nothing to compare at equal errors."""
        return []


def c_loop():
    """loop(problem, count) that does ``count`` sweeps in C and returns λ, or None without a compiler."""
    compiler = shutil.which("cc")
    if not compiler:
        return None
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "sweeps.c", Path(folder) / "sweeps.so"
        source.write_text(C_LOOP, encoding="utf-8")
        command = [compiler, "-O3", "-march=native", "-shared", "-fPIC", source, "-o", library]
        if subprocess.run(command, capture_output=True, check=False).returncode:
            return None
        function = ctypes.CDLL(str(library)).sweeps  # stays loaded when the file is gone

    def loop(problem, count):
        A, (b, d, lower, upper, normal, mu) = arrays(problem.A), problem.terms
        λ = problem.origin.copy()
        data = (*A, b, 1 / d, lower, upper, normal.astype(np.int64), mu, λ)
        pointers = [ctypes.c_void_p(array.ctypes.data) for array in data]
        function(ctypes.c_int64(count), ctypes.c_int64(problem.n), *pointers)
        return λ

    return loop


SWEEPS = {"lcp/sweeps": SweepStudy("lcp/sweeps", "lcp", 3334)}
