"""What ``bench`` shows of its measurements: a table, a plot of error against time, and who needs less time.

Rows are dictionaries: case, method, settings (with engine, None for ours, and steps), cpu_s, error, status.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

from collections import Counter
from itertools import cycle

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import measure

LOOSEST = 0.1  # an error above a tenth (of the scale, or rad) is no answer: it is shown, but decides nothing
HIGHEST = 10  # errors above are not drawn
FLOOR = 1e-16  # an error of exactly 0 is drawn here
# Colours that colour-blind eyes can tell apart (Okabe and Ito's, and an indigo); marks say the same again.
LOOKS = {
    "symplectic_euler": ("#0072B2", "o"),
    "symplectic_euler_position_first": ("#0072B2", "o"),
    "implicit_gyroscopic": ("#009E73", "^"),
    "splitting": ("#E69F00", "v"),
    "implicit_midpoint": ("#CC79A7", "D"),
    "rk4": ("#56B4E9", "P"),
    "splitting4": ("#7F7F7F", "X"),
    "splitting6": ("#332288", "*"),
}
OURS = ("#0072B2", "o")  # of a method of ours without an integrator to choose
ENGINE_LOOKS = [("#D55E00", "s"), ("#000000", "d"), ("#8B4513", "p")]
FILLS = ("full", "none", "left", "right")  # of marks, where one look serves several methods


def row(label, method, steps, seconds, error, status, **more):
    """A measurement as a dictionary; more: further settings."""
    settings = {"engine": method.engine, **method.settings, **more, "steps": steps}
    return {
        "case": label,
        "method": method.name,
        "settings": {**settings, "dt": method.case.duration / steps},
        "cpu_s": float(seconds) if status == "ok" else None,
        "error": float(error) if np.isfinite(error) else None,
        "status": status,
    }


def table(label, rows):
    """The measurements of a contest as text, methods in turn."""
    lines = [label, f"  {'method':<44}{'steps':>9}{'error':>12}{'CPU µs':>12}  status"]
    for row in rows:
        error = "—" if row["error"] is None else f"{row['error']:.2e}"
        cost = "—" if row["cpu_s"] is None else f"{row['cpu_s'] * 1e6:.1f}"
        lines.append(
            f"  {row['method']:<44}{row['settings']['steps']:>9}{error:>12}{cost:>12}  {row['status'][:60]}"
        )
    return "\n".join(lines)


def best(rows):
    """The front (m, 2) of seconds and error over the rows that ended well."""
    return measure.front(
        [
            (row["cpu_s"], max(row["error"], FLOOR))
            for row in rows
            if row["status"] == "ok" and row["error"] is not None
        ]
    )


def comparison(rows):
    """(engine, its error, its seconds, ours / its) for each point of an engine's front, errors above LOOSEST
    left out.

    ``ours`` is the time at which our front reaches that error, infinite if it never does.
    """
    ours, result = best([row for row in rows if not row["settings"]["engine"]]), []
    for engine in sorted({row["settings"]["engine"] or "" for row in rows} - {""}):
        for seconds, error in best([row for row in rows if row["settings"]["engine"] == engine]):
            if error <= LOOSEST:
                result.append((engine, error, seconds, measure.time_at(ours, error) / seconds))
    return result


HEADING = (
    "Our CPU time over the engine's, at each error up to 0.1 that it reaches (the goal: at most 1)\n"
    f"  {'case':<22}{'engine':<10}{'loosest':>18}{'worst':>18}{'finest':>18}{'its best':>10}{'our best':>10}"
)


def comparison_of(label, rows):
    """Lines, one for each engine: our time over its own at the errors it reaches, and both best errors."""
    ours, lines = best([row for row in rows if not row["settings"]["engine"]]), []
    reached = f"{ours[-1, 1]:.1e}" if len(ours) else "none"
    compared = comparison(rows)
    for engine in sorted({row["settings"]["engine"] or "" for row in rows} - {"", *(e[0] for e in compared)}):
        lines.append(f"  {label:<22}{engine:<10}  never at 0.1 or below in this run; ours best {reached}")
    for engine in dict.fromkeys(entry[0] for entry in compared):
        points = [entry for entry in compared if entry[0] == engine]
        shown = [points[0], max(points, key=lambda entry: entry[3]), points[-1]]
        cells = "".join(f"{f'{ratio:.3g} at {error:.0e}':>18}" for _, error, _, ratio in shown)
        lines.append(f"  {label:<22}{engine:<10}{cells}{points[-1][1]:>10.1e}{reached:>10}")
    return lines


def plot(label, rows, unit, path):
    """Error against CPU time, both logarithmic: our methods in solid lines, engines dashed."""
    figure, axes = _axes()
    for method, style in _styles(rows).items():
        mine = [row for row in rows if row["method"] == method and row["error"] is not None and row["cpu_s"]]
        points = np.array(
            [(row["cpu_s"], max(row["error"], FLOOR)) for row in mine if row["error"] < HIGHEST]
        )
        if len(points):
            axes.loglog(*points.T, **style)
    axes.axhline(LOOSEST, color="0.5", lw=1, ls=":", label="0.1: above is no answer")
    place = label.replace("/2d", ", in the plane").replace("/3d", ", in space").replace("_", " ")
    axes.set(xlabel="CPU time of the whole run [s], setting up left out", ylabel=f"error [{unit}]")
    axes.set(title=f"{place}: error against time (lower left is better)")
    _finish(figure, axes, path)


def growth_table(label, rows):
    """Processor time of a step as n grows, µs; last, p in time ~ nᵖ over the last tenfold."""
    sizes = list(dict.fromkeys(row["settings"]["n"] for row in rows))
    lines = [
        f"{label}: CPU µs a step",
        f"  {'method':<44}" + "".join(f"{f'n={n}':>11}" for n in sizes) + "   grows as",
    ]
    for method in dict.fromkeys(row["method"] for row in rows):
        mine = {row["settings"]["n"]: row for row in rows if row["method"] == method}
        cells = [f"{mine[n]['cpu_s'] * 1e6:.1f}" if n in mine and mine[n]["cpu_s"] else "—" for n in sizes]
        refused = next((row["status"] for row in mine.values() if row["status"] != "ok"), "")
        grows = f"   n^{power(mine.values()):.2f}  {refused[:90]}"
        lines.append(f"  {method:<44}" + "".join(f"{cell:>11}" for cell in cells) + grows)
    return "\n".join(lines)


def power(rows):
    """p in time ~ nᵖ, between the largest n measured and the one nearest to a tenth of it; else nan."""
    points = np.array([(row["settings"]["n"], row["cpu_s"]) for row in rows if row["cpu_s"]])
    if len(points) < 2:
        return np.nan
    n, seconds = points.T
    k = np.argmin(np.abs(np.log(n[:-1] * 10 / n[-1])))
    return np.log(seconds[-1] / seconds[k]) / np.log(n[-1] / n[k])


def growth_plot(label, rows, path):
    """Processor time of a step against n, both logarithmic, and a line of slope 1."""
    figure, axes = _axes()
    for method, style in _styles(rows).items():
        mine = [row for row in rows if row["method"] == method and row["cpu_s"]]
        if mine:
            axes.loglog([row["settings"]["n"] for row in mine], [row["cpu_s"] for row in mine], **style)
    n = np.array(sorted({row["settings"]["n"] for row in rows}))
    axes.loglog(n, n * 1e-7, color="0.5", lw=1, ls=":", label="0.1 µs for each")
    axes.set(
        xlabel="n", ylabel="CPU time of a step [s]", title=f"{label}: what a step costs (lower is better)"
    )
    _finish(figure, axes, path)


def _axes():
    figure = Figure(figsize=(9, 5.2), layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots()


def _styles(rows):
    """How each method is drawn: ours by integrator, filled for the first solver and hollow for the next."""
    styles, engine_looks, seen = {}, cycle(ENGINE_LOOKS), Counter()
    for row in rows:
        method, settings = row["method"], row["settings"]
        if method not in styles:
            ours = not settings["engine"]
            colour, mark = LOOKS.get(settings.get("integrator"), OURS) if ours else next(engine_looks)
            fill = FILLS[seen[colour] % len(FILLS)]
            seen[colour] += 1
            styles[method] = {"color": colour, "marker": mark, "ls": "-" if ours else "--", "fillstyle": fill}
            styles[method] |= {"markersize": 6, "lw": 1.6, "label": method.replace("_", " ")}
    return styles


def _finish(figure, axes, path):
    axes.grid(which="major", color="0.9")
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside right upper", frameon=False, title="solid: ours, dashed: engines")
    figure.savefig(path, dpi=110)
