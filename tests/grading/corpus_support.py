"""The corpus: hostile submissions and honest but odd ones, each a script with cells, as notebooks."""

import json
import re
from dataclasses import dataclass
from pathlib import Path

import exercises
from exercises.grader.cells import read_cells
from exercises.grader.marking import mark
from exercises.grader.sandbox import Limits, Sandbox

UNIT = "02_equation_of_motion"
FOLDER = Path(__file__).resolve().parent
SOLUTION = exercises.FOLDER / UNIT / "solutions" / "solution_a.py"
QUICK, SHORT = Limits(), Limits(cell=1.0, question=1.5, total=6.0)


@dataclass(frozen=True)
class Submission:
    """A file of the corpus. In its cells `# %% solution` stands for those of a right solution."""

    path: Path

    @property
    def name(self):
        return self.path.stem

    def header(self, word, default=""):
        found = re.search(rf"^# {word}: (.+)$", self.path.read_text(encoding="utf-8"), re.M)
        return found.group(1) if found else default

    def cells(self):
        cells = []
        for part in re.split(r"(?m)^(?=# %%)", self.path.read_text(encoding="utf-8")):
            title, _, body = part.partition("\n")
            if title.startswith("# %% solution"):
                left_out = title.removeprefix("# %% solution").removeprefix(" but ").strip()
                cells += [
                    cell for cell in read_cells(SOLUTION) if not left_out or f"def {left_out}(" not in cell
                ]
            elif title.startswith("# %%"):
                cells.append(body)
        return cells

    def notebook(self):
        return notebook_of(self.cells())


def notebook_of(cells, **metadata):
    """A notebook's bytes."""
    code = [
        {
            "cell_type": "code",
            "id": f"c{i}",
            "metadata": metadata,
            "execution_count": None,
            "outputs": [],
            "source": cell,
        }
        for i, cell in enumerate(cells)
    ]
    return json.dumps({"cells": code, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


RIGHT = notebook_of(read_cells(SOLUTION))
HOSTILE = [Submission(path) for path in sorted((FOLDER / "hostile").glob("*.txt"))]
HONEST = [Submission(path) for path in sorted((FOLDER / "honest").glob("*.txt"))]


def checks():
    return exercises.part(UNIT, "checks").CHECKS


def grade(source, limits=QUICK, unsafe=False):
    """(box, results) of a notebook's bytes, or a path."""
    with Sandbox(UNIT, limits=limits, unsafe=unsafe) as box:
        box.load(source)
        return box, [mark(check, box.ask) for check in checks()]


def earned(results):
    return sum(result.earned for result in results)


def words(box, results):
    """All that came back in words."""
    outcomes = [outcome for result in results for outcome in result.outcomes]
    messages = [str(getattr(outcome.verdict.got, "message", "")) + outcome.printed for outcome in outcomes]
    return " ".join([*messages, *(trouble.text for trouble in box.troubles), box.reason])
