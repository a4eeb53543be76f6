"""Support of the tests of exercises: submissions as namespaces, and each unit with its solutions and
mistakes."""

import contextlib
import json
import re
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import exercises
from exercises.grader.cells import Namespace, read_cells
from exercises.grader.worker import Worker


@dataclass(frozen=True)
class Mistake:
    """A file of mistakes/: what it loses, the check made for it first, and what the reports must say."""

    path: Path
    loses: tuple
    says: tuple  # (check, words)

    @classmethod
    def read(cls, path):
        header = path.read_text(encoding="utf-8").split("# %%")[0]
        loses = re.search(r"^# Loses: (.+)$", header, re.M).group(1)
        says = re.findall(r"^# Says: (\w+): (.+)$", header, re.M)
        assert re.search(r"^# Mistake: \w", header, re.M), f"{path.name} does not say what the mistake is"
        return cls(path, tuple(name.strip() for name in loses.split(",")), tuple(says))


class Unit:
    def __init__(self, slug):
        self.slug, self.folder = slug, exercises.FOLDER / slug

    @cached_property
    def checks(self):
        return exercises.part(self.slug, "checks").CHECKS

    @property
    def starter(self):
        return self.folder / f"{self.slug}.ipynb"

    @cached_property
    def solutions(self):
        return sorted((self.folder / "solutions").glob("*.py"))

    @cached_property
    def mistakes(self):
        return [Mistake.read(path) for path in sorted((self.folder / "mistakes").glob("*.py"))]

    def submission(self, *paths):
        """The `ask` of a submission made of these files' cells, one after the other, in this process."""
        return submission(self.slug, paths)

    def mistaken(self, mistake):
        """A mistake's file holds only what is wrong: the rest is the first solution's."""
        return self.submission(self.solutions[0], mistake.path)


UNITS = [Unit(slug) for slug in exercises.units()]


@cache
def submission(slug, paths):
    return Submission(slug, run_cells([cell for path in paths for cell in read_cells(path)]))


@contextlib.contextmanager
def silent():
    exercises.silent = True
    try:
        yield
    finally:
        exercises.silent = False


def run_cells(cells):
    namespace = Namespace()
    with silent():
        for number, cell in enumerate(cells, 1):
            error = namespace.run(cell, f"cell {number}")
            assert error is None, error
    return namespace.names


class Submission:
    """Asks the functions of a namespace; what was asked before is answered from memory, which the seeds' test
    needs."""

    def __init__(self, slug, names):
        self.names, self.known = names, {}
        self.worker = Worker(names, exercises.part(slug, "given"))

    def __call__(self, text):
        calls = json.loads(text)["calls"]
        keys = [json.dumps(call) for call in calls]
        new = {key: call for key, call in zip(keys, calls, strict=True) if key not in self.known}
        replies = json.loads(self.worker.answer(json.dumps({"calls": list(new.values())})))["replies"]
        self.known.update(zip(new, replies, strict=True))
        return json.dumps({"replies": [self.known[key] for key in keys]})
