"""The door to the sandbox: one submission at a time in a process, and what its result may hold."""

import json
from functools import cache
from pathlib import Path

import exercises
from exercises.grader import sandbox
from exercises.grader.cells import read_cells
from exercises.grader.classroom.fingerprint import shingles


def probe():
    """(kind of isolation that holds here, or "none"; why not, in words), by the canary."""
    found = sandbox.probe()
    return found.name or "none", "" if found.kind else found.sentence()


def open_box(unit, unsafe):
    return sandbox.Sandbox(unit, given=exercises.FOLDER / unit / "given.py", unsafe=unsafe)


def takes_the_innocent(unit, unsafe):
    """True if the sandbox runs a notebook that can do no harm: else what befell another is no fault of its"""
    cell = {"cell_type": "code", "metadata": {}, "source": "def one():\n    return 1"}
    with open_box(unit, unsafe) as box:
        box.load(json.dumps({"cells": [cell]}).encode())
        answer = box.ask(json.dumps({"calls": [{"function": "one", "arguments": []}]}))
        return box.status in ("ok", "unsandboxed") and json.loads(answer) == {"replies": [{"value": 1}]}


def load(box, notebook, starter):
    """Runs the notebook's cells. Returns its fingerprint, checked: it comes from where students' text is."""
    box.load(notebook, "fingerprint", starter)
    answer = box.told if isinstance(box.told, dict) else {}
    numbers, hints = answer.get("numbers"), answer.get("hints")
    if not isinstance(numbers, list) or not all(type(n) is int and 0 <= n < 2**62 for n in numbers[:5000]):
        numbers = []
    if not isinstance(hints, list) or not all(isinstance(hint, str) for hint in hints[:100]):
        hints = []
    return {"numbers": numbers[:5000], "hints": hints[:100]}


@cache
def of_starter(unit):
    """The same numbers of our own starter's cells, whose code is nobody's."""
    path = exercises.FOLDER / unit / f"{unit}.ipynb"
    return sorted(shingles(read_cells(Path(path)))) if path.is_file() else []
