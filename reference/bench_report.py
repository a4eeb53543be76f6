"""What ``bench`` shows of its measurements: a table, a plot of error against time, and who needs less time.

Rows are dictionaries: case, method, settings (with engine, None for ours, and steps), cpu_s, error, status.

Slide S18; lectures/02_equation_of_motion.md.
"""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import measure

LOOSEST = 0.1  # an error above a tenth (of the scale, or rad) is no answer: it is shown, but decides nothing
FLOOR = 1e-16  # an error of exactly 0 is drawn here
# Okabe and Ito's colours, which colour-blind eyes can tell apart; marks and dashes say the same again.
OURS = [
    ("#0072B2", "o"),
    ("#009E73", "^"),
    ("#E69F00", "v"),
    ("#CC79A7", "D"),
    ("#56B4E9", "P"),
    ("#7F7F7F", "X"),
    ("#F0E442", "*"),
]
ENGINES = [("#D55E00", "s"), ("#000000", "s"), ("#8B4513", "s")]


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
        for engine in dict.fromkeys(entry[0] for entry in compared):
            points = [entry for entry in compared if entry[0] == engine]
            shown = [points[0], max(points, key=lambda entry: entry[3]), points[-1]]
            cells = "".join(f"{f'{ratio:.3g} at {error:.0e}':>18}" for _, error, _, ratio in shown)
            lines.append(f"  {label:<20}{engine:<10}{cells}{points[-1][1]:>10.1e}{ours[-1, 1]:>10.1e}")
    return "\n".join(lines)


def plot(label, rows, unit, path):
    """Error against CPU time, both logarithmic: our methods in solid lines, engines dashed with squares."""
    figure = Figure(figsize=(9, 5.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    looks = {False: iter(OURS), True: iter(ENGINES)}
    for method in dict.fromkeys(row["method"] for row in rows):
        mine = [
            row
            for row in rows
            if row["method"] == method and row["status"] == "ok" and row["error"] is not None
        ]
        engine = any(row["settings"]["engine"] for row in mine)
        if mine:
            colour, mark = next(looks[engine])
            seconds, errors = np.array([(row["cpu_s"], max(row["error"], FLOOR)) for row in mine]).T
            axes.loglog(
                seconds,
                errors,
                "--" if engine else "-",
                color=colour,
                marker=mark,
                markersize=5,
                lw=1.6,
                label=method.replace("_", " "),
            )
    axes.axhline(LOOSEST, color="0.6", lw=0.8, ls=":")
    axes.text(
        0.995,
        LOOSEST,
        "no answer above",
        transform=axes.get_yaxis_transform(),
        ha="right",
        va="bottom",
        fontsize=8,
        color="0.35",
    )
    axes.set(
        xlabel="CPU time of the whole run [s], setting up left out",
        ylabel=f"error [{unit}]",
        title=f"{label.replace('_', ' ')}: error against time, lower left is better",
    )
    axes.grid(which="major", color="0.9")
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside right upper", frameon=False, title="solid: ours\ndashed: engines")
    figure.savefig(path, dpi=110)
