"""What a question changes is put back: names, containers, arrays, attributes, generators."""

import collections
import contextlib
import functools
import random

import numpy as np
import pytest

import exercises
from exercises.grader import worker
from exercises.grader.marking import mark_all
from exercises.grader.shell import check_cells
from exercises.grader.state import put_back
from exercises.grader.worker import Worker
from tests.exercises.exercise_support import UNITS, run_cells
from tests.grading.corpus_support import HONEST, UNIT, earned, grade

ODD = next(one for one in HONEST if one.name == "state_between_checks")

CHANGES = {
    "a name": ("x = 1", "x", "global x\n    x = 2"),
    "a new name": ("y = 1", "globals().get('new', 0)", "globals()['new'] = 5"),
    "a name that goes": ("x = 1", "x", "global x\n    del x"),
    "a list": ("x = [1, [2]]", "str(x)", "x[1].append(3); x.append(4)"),
    "a dictionary": ("x = {1: {2: 3}}", "str(x)", "x[1][2] = 4; x[5] = 6"),
    "a set": ("x = {1}", "sorted(x)", "x.add(2); x.discard(1)"),
    "a default": (
        "def g(a, seen=[]):\n    seen.append(a)\n    return len(seen)",
        "str(g.__defaults__)",
        "g(1)",
    ),
    "an attribute": ("def g(): pass\ng.count = 0", "g.count", "g.count += 1"),
    "a closure": (
        "def make():\n    n = 0\n    def g():\n        nonlocal n\n        n += 1\n    return g\ng = make()",
        "g.__closure__[0].cell_contents",
        "g()",
    ),
    "a class": ("class C:\n    count = 0", "C.count", "C.count += 1"),
    "an object": ("class C: pass\nc = C()\nc.count = [0]", "c.count[0]", "c.count[0] += 1; c.more = 1"),
    "an array": ("import numpy as np\nx = (np.zeros(2),)", "x[0].sum()", "x[0][:] = 7"),
}


def alone(source):
    names = {"__name__": "student"}
    exec(source, names)
    return names


@pytest.mark.parametrize("before, look, change", CHANGES.values(), ids=CHANGES)
def test_changes_are_put_back(before, look, change):
    names = alone(f"{before}\ndef look():\n    return {look}\ndef change():\n    {change}")
    was = names["look"]()
    with put_back(names):
        names["change"]()
        with contextlib.suppress(NameError):
            assert names["look"]() != was
    assert names["look"]() == was


def test_other_things_that_keep_state():
    names = alone("")
    names.update(
        queue=collections.deque([1]),
        old=random.Random(1),
        new=np.random.default_rng(1),
        table=functools.cache(abs),
    )
    names["part"] = functools.partial(print, names["queue"])
    state = names["old"].getstate(), names["new"].bit_generator.state
    with put_back(names):
        names["queue"].append(2)
        names["old"].random(), names["new"].random(), names["table"](-1)
    assert names["queue"] == collections.deque([1]) and names["table"].cache_info().currsize == 0
    assert (names["old"].getstate(), names["new"].bit_generator.state) == state


def test_things_that_mind_and_rings_do_no_harm():
    names = alone(
        "class Odd(dict):\n    def items(self): raise KeyError\n    __iter__ = keys = items\n"
        "    def __setitem__(self, *all): raise KeyError\n"
        "class Slots:\n    __slots__ = ('a',)\n    __class__ = property(lambda self: 1 / 0)\n"
        "ring = [Odd(a=1), Slots()]\nring.append(ring)"
    )
    with put_back(names):
        names["ring"].clear()
    assert len(names["ring"]) == 3 and names["ring"][2] is names["ring"]


def points_in_notebook():
    given = exercises.part(UNIT, "given")
    return earned(mark_all(UNITS[0].checks, Worker(run_cells(ODD.cells()), given).answer))


def test_state_between_checks_scores_alike_in_notebook_shell_and_class(tmp_path, monkeypatch):
    """Its functions fail when they are called more often than one check does."""
    box, results = grade(ODD.notebook())
    shell, _ = check_cells(UNIT, ODD.cells(), tmp_path, show=lambda text: None)
    assert (earned(results), earned(shell), points_in_notebook()) == (100, 100, 100), box.reason
    monkeypatch.setattr(worker, "put_back", lambda names: contextlib.nullcontext())
    assert points_in_notebook() < 100  # so the state did count
