"""What the lecture pages' figures and tables are made by: one file a unit, named as its page is.

Each file defines FIGURES and TABLES, name → function. A figure's function returns a Matplotlib figure, a
table's function yields the lines that stand on the page. lectures/figures.py runs them.
"""

import importlib.util
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent


def units():
    """Slugs of the units that have figures or tables, in order."""
    return sorted(file.stem for file in FOLDER.glob("[0-9]*.py"))


def load(slug):
    """The module of a unit. (A slug starts with a digit, so ``import`` cannot reach it.)"""
    spec = importlib.util.spec_from_file_location(f"lectures.plots.{slug}", FOLDER / f"{slug}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def shown(value):
    """A number as the page shows it: one digit, and no digits of what may be rounding."""
    if not np.isfinite(value):
        return "breaks down"
    return "< 1e-9" if value < 1e-9 else f"{value:.0e}".replace("e-0", "e-").replace("e+00", "")


def draw_laws(panels, laws):
    """Constraints as lines in the (w, λ) plane (S12): laws, title → (w, λ), one on each of the panels."""
    for axes, (title, (w, λ)) in zip(panels, laws.items(), strict=True):
        axes.axhline(0, color="0.7", linewidth=0.8)
        axes.axvline(0, color="0.7", linewidth=0.8)
        axes.plot(w, λ, color="#D55E00", linestyle="-", linewidth=2.5)
        axes.set(title=title, xlabel="w", xlim=(-1, 1), ylim=(-1, 1), xticks=[], yticks=[])
        axes.title.set_fontsize(10)
        axes.xaxis.label.set_fontsize(11)
    panels[0].set_ylabel("λ", rotation=0, fontsize=11)
