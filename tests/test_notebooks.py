"""Every notebook runs in a fresh kernel, and is committed clean: no outputs, stable ids, short cells."""

import json
import sys
from pathlib import PurePosixPath

import pytest

from tests.house import notebooks, sample
from tests.house.notebooks import cells, committed_faults, lesson_faults, run
from tests.house.sample import EXERCISE, LESSON
from tests.house.tree import ROOT, tracked

ALL = tracked(ROOT, ".ipynb")
LESSONS, STARTERS = notebooks.teaching(ROOT), notebooks.exercises(ROOT)


def identify(file):
    return file.as_posix()


# --- this repository ----------------------------------------------------------------------------------------


def test_there_is_something_to_test():
    assert LESSONS and STARTERS


@pytest.mark.parametrize("file", ALL, ids=identify)
def test_committed_clean(file):
    assert committed_faults(ROOT, file) == []


@pytest.mark.parametrize("file", LESSONS, ids=identify)
def test_is_a_lesson(file):
    assert lesson_faults(ROOT, file) == []


@pytest.mark.parametrize("file", LESSONS + STARTERS, ids=identify)
def test_runs(file, tmp_path, capsys):
    """No cell fails; a lesson takes under 20 s of CPU once its functions are compiled and cached."""
    done = run(ROOT, file, tmp_path)
    if not done.fault and done.cpu > notebooks.SECONDS_WARM:
        done = run(ROOT, file, tmp_path)  # the first run compiled
    with capsys.disabled():
        print(f"\n{file}: {done.seconds:.1f} s, {done.cpu:.1f} s of CPU {done.warnings[:200]}")
    assert done.fault == ""
    assert done.wordless == [], "cells with a picture and no words: show it by view.show(figure, alt)"
    assert done.cpu <= notebooks.SECONDS_WARM


# --- the rules themselves: one fault planted in a tree that has none ----------------------------------------


@pytest.fixture
def root(tmp_path):
    return sample.plant(tmp_path)


def replant(root, change, name=LESSON):
    """Change the raw notebook by `change(book)`."""
    book = json.loads((root / name).read_text())
    change(book)
    (root / name).write_text(json.dumps(book))
    return PurePosixPath(name)


def test_a_good_tree_has_no_faults(root):
    for name in (LESSON, EXERCISE):
        assert committed_faults(root, PurePosixPath(name)) == []
    assert lesson_faults(root, PurePosixPath(LESSON)) == []
    assert [notebooks.teaching(root), notebooks.exercises(root)] == [
        [PurePosixPath(LESSON)],
        [PurePosixPath(EXERCISE)],
    ]


def put(place, key, value):
    """A change that sets one entry: of a cell by its number (from 0), or of the notebook."""

    def change(book):
        (book if place is None else book["cells"][place])[key] = value

    return change


PRINTED = [{"output_type": "stream", "name": "stdout", "text": "1"}]
COMMITTED = {
    "output": (put(1, "outputs", PRINTED), "has outputs"),
    "count": (put(1, "execution_count", 3), "execution count"),
    "no id": (lambda book: book["cells"][2].pop("id"), "cell 3 has no id"),
    "bad id": (put(2, "id", "has blanks"), "not a valid notebook"),
    "one id twice": (put(2, "id", "cell-01"), "two cells have the id 'cell-01'"),
    "drawn id": (put(2, "id", "0f3a9c1e"), "drawn by a script"),
    "old format": (put(None, "nbformat_minor", 4), "not a valid notebook"),
    "older format": (
        lambda book: [book.update(nbformat_minor=4), [c.pop("id") for c in book["cells"]]],
        "must be 4.5",
    ),
    "kernel": (lambda book: book["metadata"]["kernelspec"].update(name="venv"), "must be 'python3'"),
    "language": (lambda book: book["metadata"].pop("language_info"), "language_info.name is None"),
    "widgets": (lambda book: book["metadata"].update(widgets={}), "beyond kernel and language: ['widgets']"),
    "metadata": (put(2, "metadata", {"note": "x" * 600}), "more than 500 characters"),
    "path": (put(4, "source", "open('/" + "home/me/x')"), "path of one machine"),
    "drive": (put(4, "source", r"open(r'C:" + r"\data')"), "path of one machine"),
    "not Python": (put(4, "source", "assert ="), "is not Python"),
}


@pytest.mark.parametrize("fault", COMMITTED)
def test_finds_what_must_not_be_committed(root, fault):
    change, words = COMMITTED[fault]
    found = committed_faults(root, replant(root, change))
    assert any(words in line for line in found), found


def drop_cells(book):
    del book["cells"][12:20]


def add_cells(book):
    book["cells"] += [
        {"cell_type": "markdown", "id": f"more-{n}", "metadata": {}, "source": "."} for n in range(20)
    ]


LESSON_FAULTS = {
    "too few cells": (drop_cells, "cells, must be 25 to 40"),
    "too many cells": (add_cells, "cells, must be 25 to 40"),
    "title": (put(0, "source", "# Another\n\nObjectives"), "is not that of the page"),
    "no title": (put(0, "source", "Objectives"), "opens with the unit's title"),
    "no objectives": (put(0, "source", "# The equation of motion"), "objectives"),
    "long cell": (put(6, "source", "x = 1\n" * 16), "has 16 lines"),
    "long tagged cell": (put(9, "source", "x = 1\n" * 41), "has 41 lines"),
    "second import": (put(7, "source", "import math\nassert True"), "imports must stand in one cell"),
    "hidden import": (
        put(7, "source", "def f():\n    import math\nassert True"),
        "imports must stand in one cell",
    ),
    "no import": (put(1, "source", "np = None"), "but stand in none"),
    "no assertion": (put(4, "source", "accelerate(1.0, 2.0)"), "'1 Force' asserts nothing"),
    "word assert": (put(4, "source", "print('assert')  # assert"), "'1 Force' asserts nothing"),
    "no engine": (put(23, "source", "## Against nothing"), "no section on 'engine'"),
    "few steps": (
        lambda b: [c.update(source="x") for c in b["cells"] if c["source"][:4] in ("## 2", "## 4", "## 5")],
        "3 steps",
    ),
}


@pytest.mark.parametrize("fault", LESSON_FAULTS)
def test_finds_what_is_no_lesson(root, fault):
    change, words = LESSON_FAULTS[fault]
    found = lesson_faults(root, replant(root, change))
    assert any(words in line for line in found), found


def test_an_allowed_length_passes(root):
    file = replant(root, put(6, "source", "x = 1\n\n" * 15))
    assert lesson_faults(root, file) == []
    assert len(cells(root / file)) == len(sample.lesson())


def test_runs_with_this_python_outside_the_tree(root, tmp_path):
    probe = f"""import os, sys, reference
assert sys.executable == {sys.executable!r}
assert os.path.samefile(os.getcwd(), {str(tmp_path / "aside")!r})
assert os.path.samefile(os.path.dirname(reference.__file__), {str(root / "reference")!r})"""
    (tmp_path / "aside").mkdir()
    sample.write_notebook(root / LESSON, [sample.code(probe)])
    before = (root / LESSON).read_bytes()
    done = run(root, PurePosixPath(LESSON), tmp_path / "aside")
    assert done.fault == ""
    assert min(done.cpu, done.seconds) > 0
    assert (root / LESSON).read_bytes() == before


@pytest.mark.parametrize("tags", [(), ("raises-exception",)])
def test_a_cell_that_raises_is_a_fault(root, tmp_path, tags):
    sample.write_notebook(
        root / LESSON, [sample.code("x = 1"), sample.code("assert x == 2, 'planted'", *tags)]
    )
    assert "planted" in run(root, PurePosixPath(LESSON), tmp_path).fault


def test_a_picture_without_words_is_a_fault(root, tmp_path):
    bare = "import matplotlib.pyplot as plt\nplt.plot([1, 2])\nplt.show()"
    page = "class Page:\n    def _repr_html_(self):\n        return {!r}\nPage()".format
    cells = [bare, page("<img alt='A line rises to two' src=''>"), page("<img src=''>"), page("<b>Two</b>")]
    sample.write_notebook(root / LESSON, [sample.code(source) for source in cells])
    done = run(root, PurePosixPath(LESSON), tmp_path)
    assert (done.fault, done.wordless) == ("", [1, 3])


def test_a_cell_that_hangs_is_a_fault(root, tmp_path):
    sample.write_notebook(root / LESSON, [sample.code("import time; time.sleep(60)")])
    assert "Timeout" in run(root, PurePosixPath(LESSON), tmp_path, timeout=2).fault
