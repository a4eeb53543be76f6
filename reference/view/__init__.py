"""Pictures: charts of errors and of series in time, bodies at an instant, animations that need no network.

``show(figure, alt)`` puts a figure into a notebook together with its description in words.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

from .charts import Picture, plot_convergence, plot_energy, plot_series, plt, show, use_style
from .drawing import animate, draw, key_frames

__all__ = [
    "Picture",
    "animate",
    "draw",
    "key_frames",
    "plot_convergence",
    "plot_energy",
    "plot_series",
    "plt",
    "show",
    "use_style",
]
