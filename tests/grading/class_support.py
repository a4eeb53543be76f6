"""Support of the class's tests: folders of submissions, and a stand-in for the sandbox.

The stand-in runs a notebook's cells in this process: fit for notebooks of our own, which tell about scores,
files and pages. What the sandbox keeps out is tested with the sandbox itself.
"""

import json
from pathlib import Path
from typing import NamedTuple

import exercises
from exercises.grader.cells import Namespace, read_cells
from exercises.grader.classroom import fingerprint, run, workers
from exercises.grader.worker import Worker
from tests.exercises.exercise_support import UNITS, silent

UNIT = UNITS[0]
START = f"import math\nimport numpy as np\nfrom exercises import load\ngiven, check = load('{UNIT.slug}')"


def solution(number=0, *mistakes):
    """The cells of a right solution, with the cells of mistakes after them."""
    return [START, *(cell for path in [UNIT.solutions[number], *mistakes] for cell in read_cells(path)[1:])]


def mistake(name):
    return next(one for one in UNIT.mistakes if one.path.stem == name)


def notebook(cells, **metadata):
    """A notebook's text."""
    made = [
        {
            "cell_type": "code",
            "id": f"c{i}",
            "metadata": metadata,
            "source": cell,
            "outputs": [],
            "execution_count": None,
        }
        for i, cell in enumerate(cells)
    ]
    return json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": made})


def plant(folder, submissions, unit=UNIT.slug):
    """submitted/<student>/<unit>/<unit>.ipynb for each; a value is a list of cells, or text or bytes."""
    for student, content in submissions.items():
        path = folder / "submitted" / student / unit / f"{unit}.ipynb"
        path.parent.mkdir(parents=True)
        text = notebook(content) if isinstance(content, list) else content
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass"))
    return folder


class Trouble(NamedTuple):
    number: int
    title: str
    text: str
    skipped: bool = False


class PlainBox:
    """As Sandbox, in this process, without any isolation."""

    loaded = 0  # how many notebooks, all told

    def __init__(self, unit):
        self.unit, self.status, self.reason, self.troubles = unit, "ok", "", []
        self.isolation, self.seconds, self.cpu, self.told = "bubblewrap", 0.0, 0.0, None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def load(self, data, task=None, extra=None):
        PlainBox.loaded += 1
        try:
            self.cells = [
                "".join(cell["source"]) for cell in json.loads(data)["cells"] if cell["cell_type"] == "code"
            ]
        except (ValueError, KeyError, TypeError):
            self.status, self.reason = "rejected", "this is no notebook"
            return
        if task is not None:
            assert task == "fingerprint"
            self.told = json.loads(json.dumps(fingerprint.of_cells(self.cells, data, extra)))
        namespace = Namespace()
        with silent():
            for number, cell in enumerate(self.cells, 1):
                error = namespace.run(cell, f"cell {number}")
                if error:
                    text = f"{error['kind']}: {error['message']}"
                    self.troubles.append(Trouble(number, cell.strip().split("\n")[0], text))
        self.worker = Worker(namespace.names, exercises.part(self.unit, "given"))

    def ask(self, text):
        return self.worker.answer(text)


def use_plain_boxes(monkeypatch):
    monkeypatch.setattr(workers, "open_box", lambda unit, unsafe: PlainBox(unit))
    monkeypatch.setattr(workers, "probe", lambda: ("bubblewrap", ""))


def grade(folder, **options):
    """({student: Score}, what was told) of a run in this process."""
    told = []
    scores = run.grade(run.Options(Path(folder), **options), told.append)
    return {score.submission.student: score for score in scores}, "\n".join(told)


def feedback(folder, student):
    return (folder / "feedback" / student / UNIT.slug / f"{UNIT.slug}.html").read_text(encoding="utf-8")
