"""Charts, their look, and figures with a description in words.

The colours are those of Okabe & Ito, which readers with colour vision deficiencies can tell apart; lines
differ in their dashes as well.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import base64
import io
from html import escape

import matplotlib.pyplot as plt
import numpy as np
from cycler import cycler

BLUE, VERMILLION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
PURPLE, SKY, YELLOW, BLACK, GREY = "#CC79A7", "#56B4E9", "#F0E442", "#000000", "#777777"
COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, BLACK, GREY)
DASHES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1)), (0, (1, 1)), (0, (8, 2, 1, 2)))
STYLE = {
    "axes.prop_cycle": cycler(color=COLOURS) + cycler(linestyle=DASHES),
    "axes.grid": True,
    "grid.alpha": 0.3,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.figsize": (7, 3.2),
    "figure.dpi": 100,
    "figure.constrained_layout.use": True,
    "legend.frameon": False,
}


def use_style():
    """Make the look of the course Matplotlib's own, for all figures that follow."""
    plt.rcParams.update(STYLE)


class Picture:
    """A figure as a notebook shows it: the image with its description ``alt``, and under it ``html``."""

    def __init__(self, png, alt, html=""):
        self.png, self.alt, self.html = png, alt, html

    def _repr_mimebundle_(self, **_):
        data = base64.b64encode(self.png).decode()
        image = f'<img alt="{escape(self.alt)}" src="data:image/png;base64,{data}" style="max-width:100%">'
        return {"text/html": image + self.html, "image/png": data, "text/plain": self.alt}


def show(figure, alt):
    """Close the figure and return it as a Picture; ``alt`` says in words what is to be seen."""
    if not isinstance(alt, str) or len(alt.split()) < 4:
        raise ValueError(f"alt must say in words what the figure shows, but is {alt!r}")
    file = io.BytesIO()
    figure.savefig(file, format="png", metadata={"Software": None})  # the same bytes for the same picture
    plt.close(figure)
    return Picture(file.getvalue(), alt)


def plot_convergence(dts, errors, guides=None, axes=None, ylabel="error"):
    """Errors against the time step, both logarithmic: a line for each name in ``errors``. Returns the axes.

    dts: (k,) s; each value of errors: (k,). guides: {name: order} draws a grey line with the slope of that
    order under the line of that name.
    """
    dts, axes = np.asarray(dts, dtype=float), axes or plt.subplots()[1]
    if dts.ndim != 1 or not len(dts) or not np.all(dts > 0):
        raise ValueError(f"dts must be a list of time steps greater than 0, but is {dts.tolist()}")
    if not errors:
        raise ValueError("errors must be a dictionary of at least one name and its errors, but is empty")
    for name, values in errors.items():
        _check_shape(f"errors[{name!r}]", values, dts)
        axes.loglog(dts, values, marker="o", markersize=4, label=name)
    for name, order in (guides or {}).items():
        _draw_guide(axes, dts, errors[name], order)
    axes.set(xlabel="time step h (s)", ylabel=ylabel)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))  # beside the axes, where it hides nothing
    return axes


def _draw_guide(axes, dts, errors, order):
    """A line of the given slope under the three coarsest points."""
    coarsest = np.argsort(dts)[-3:]
    h = dts[coarsest]
    line = 0.3 * np.asarray(errors, dtype=float)[coarsest[-1]] * (h / h[-1]) ** order
    axes.loglog(h, line, color="grey", linewidth=0.8, linestyle="-", zorder=1)
    style = {"textcoords": "offset points", "color": "0.35", "fontsize": 8}
    axes.annotate(f"order {order}", (h[1], line[1]), (4, -11), **style)


def _check_shape(name, values, like):
    if np.shape(values) != np.shape(like):
        raise ValueError(f"{name} must have the shape {np.shape(like)}, but has {np.shape(values)}")


def plot_series(time, series, ylabel, axes=None, log=False):
    """Quantities against time: a line for each name in ``series``. Returns the axes.

    A value of series is an array (T,) like ``time``, or a pair of its own times and an array. log: a
    logarithmic axis.
    """
    axes = axes or plt.subplots()[1]
    for name, values in series.items():
        when, values = values if isinstance(values, tuple) else (time, values)
        _check_shape(f"series[{name!r}]", values, when)
        (axes.semilogy if log else axes.plot)(when, values, label=name)
    axes.set(xlabel="time (s)", ylabel=ylabel)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))  # beside the axes, where it hides nothing
    return axes


def plot_energy(runs, axes=None):
    """The relative energy error |E − E₀| / |E₀| of each run of the dictionary ``runs``. Returns the axes."""
    errors = {}
    for name, run in runs.items():
        energy = run.energy()
        errors[name] = run.time, np.abs(energy / energy[0] - 1) + 1e-17  # above 0, for the logarithm
    return plot_series(None, errors, "relative energy error", axes, log=True)
