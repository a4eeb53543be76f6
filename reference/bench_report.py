"""What ``bench`` shows of its measurements: a table, a plot of error against time, and who needs less time.

Rows are dictionaries: case, method, settings (with engine, None for ours, and steps), cpu_s, error, status.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

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
ENGINE_LOOKS = [("#D55E00", "s"), ("#000000", "d"), ("#8B4513", "p")]


def table(label, rows):
    """The measurements of a contest as text, methods in turn."""
    lines = [label, f"  {'method':<34}{'steps':>9}{'error':>12}{'CPU µs':>12}  status"]
    for row in rows:
        error = "—" if row["error"] is None else f"{row['error']:.2e}"
        cost = "—" if row["cpu_s"] is None else f"{row['cpu_s'] * 1e6:.1f}"
        lines.append(
            f"  {row['method']:<34}{row['settings']['steps']:>9}{error:>12}{cost:>12}  {row['status'][:60]}"
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


def summary(rows):
    """For each case and engine: our time over the engine's at the errors it reaches, and both best errors."""
    lines = [
        "Our CPU time over the engine's, at each error up to 0.1 that it reaches (the goal: at most 1)",
        f"  {'case':<20}{'engine':<10}{'loosest':>18}{'worst':>18}{'finest':>18}{'its best':>10}"
        f"{'our best':>10}",
    ]
    for label in dict.fromkeys(row["case"] for row in rows):
        chosen = [row for row in rows if row["case"] == label]
        ours = best([row for row in chosen if not row["settings"]["engine"]])
        compared = comparison(chosen)
        for engine in sorted(
            {row["settings"]["engine"] or "" for row in chosen} - {"", *(e[0] for e in compared)}
        ):
            lines.append(
                f"  {label:<20}{engine:<10}  never at 0.1 or below in this run; ours best {ours[-1, 1]:.1e}"
            )
        for engine in dict.fromkeys(entry[0] for entry in compared):
            points = [entry for entry in compared if entry[0] == engine]
            shown = [points[0], max(points, key=lambda entry: entry[3]), points[-1]]
            cells = "".join(f"{f'{ratio:.3g} at {error:.0e}':>18}" for _, error, _, ratio in shown)
            lines.append(f"  {label:<20}{engine:<10}{cells}{points[-1][1]:>10.1e}{ours[-1, 1]:>10.1e}")
    return "\n".join(lines)


def plot(label, rows, unit, path):
    """Error against CPU time, both logarithmic: our methods in solid lines, engines dashed."""
    figure = Figure(figsize=(9, 5.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    engine_looks = iter(ENGINE_LOOKS)
    for method in dict.fromkeys(row["method"] for row in rows):
        mine = [row for row in rows if row["method"] == method and row["error"] is not None and row["cpu_s"]]
        points = np.array(
            [(row["cpu_s"], max(row["error"], FLOOR)) for row in mine if row["error"] < HIGHEST]
        )
        if len(points):
            colour, mark = LOOKS[method] if method in LOOKS else next(engine_looks)
            style = {"color": colour, "marker": mark, "ls": "-" if method in LOOKS else "--"}
            axes.loglog(*points.T, **style, markersize=6, lw=1.6, label=method.replace("_", " "))
    axes.axhline(LOOSEST, color="0.5", lw=1, ls=":", label="0.1: above is no answer")
    place = label.replace("/2d", ", in the plane").replace("/3d", ", in space").replace("_", " ")
    axes.set(xlabel="CPU time of the whole run [s], setting up left out", ylabel=f"error [{unit}]")
    axes.set(title=f"{place}: error against time (lower left is better)")
    axes.grid(which="major", color="0.9")
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside right upper", frameon=False, title="solid: ours, dashed: engines")
    figure.savefig(path, dpi=110)
