"""Draw the figures of the lecture pages, and print the tables of numbers that stand on them.

    .venv/bin/python lectures/figures.py [UNIT ...] [--out FOLDER]

writes ``lectures/figures/*.svg`` and prints the tables as they stand on the pages; a test compares them. UNIT
is a number, such as 02; none named: all. What is drawn stands in ``lectures/plots``, one file a unit. All of
it comes from ``reference``, in about a minute the first time, a few seconds after that.
"""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import matplotlib.pyplot as plt

from lectures import plots
from reference import view


def slug_of(word):
    """The slug of the unit that 3, 03 or 03_jacobian names. Raises SystemExit where there is none."""
    number = word.split("_")[0].zfill(2)
    for slug in plots.units():
        if slug.split("_")[0] == number:
            return slug
    sys.exit(f"there is no unit {word!r} with figures; there is: {', '.join(plots.units())}")


def main():
    """Draw and print what the command line names."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("unit", nargs="*", help="a unit's number, such as 02; none: all")
    parser.add_argument(
        "--out", type=Path, default=Path(__file__).parent / "figures", help="folder for the figures"
    )
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    view.use_style()
    # the same bytes each time, and small
    plt.rcParams.update({"svg.hashsalt": "course", "svg.fonttype": "none"})
    for slug in [slug_of(word) for word in arguments.unit] or plots.units():
        unit, number = plots.load(slug), slug.split("_")[0]
        for name, draw in unit.FIGURES.items():
            draw().savefig(arguments.out / f"{number}_{name}.svg", metadata={"Date": None})
            plt.close("all")
            print(f"{number}_{name}.svg")
        for name, table in unit.TABLES.items():
            print(f"\n{number}_{name}", *table(), sep="\n")


if __name__ == "__main__":
    main()
