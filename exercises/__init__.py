"""The exercises, one folder a unit, and `load`, which a notebook calls to get at one of them.

    from exercises import load
    given, check = load("02")        # or load(2), or load("02_equation_of_motion")

`given` holds the unit's helpers. `check("name")` checks one function of the calling notebook, `check()` all.
"""

import importlib.util
import sys
import types
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

silent = False  # True in a worker: the grader asks from outside, and a notebook's own check cells do nothing


def units():
    """Slugs of all units that have an exercise, in order."""
    return sorted(folder.name for folder in FOLDER.iterdir() if (folder / "given.py").is_file())


def slug(unit):
    """The slug of `unit`, which may be a number (2), its digits ("02") or the slug itself."""
    text = str(unit).strip()
    for name in units():
        number = name.split("_")[0]
        if text == name or (text.isdecimal() and int(text) == int(number)):
            return name
    raise ValueError(f"unit {unit!r} has no exercise here; there is: {', '.join(units())}")


def part(unit, name):
    """The module exercises/<slug>/<name>.py. (A slug starts with a digit, so `import` cannot reach it.)"""
    full_name = f"exercises.{slug(unit)}.{name}"
    if full_name not in sys.modules:
        spec = importlib.util.spec_from_file_location(full_name, FOLDER / slug(unit) / f"{name}.py")
        module = importlib.util.module_from_spec(spec)
        sys.modules[full_name] = module
        try:
            spec.loader.exec_module(module)
        except BaseException:
            del sys.modules[full_name]  # a half-made module must not be found by the next call
            raise
    return sys.modules[full_name]


def load(unit):
    """`(given, check)` of a unit, for its notebook."""
    given = part(unit, "given")
    if silent:
        return _without_pictures(given), lambda name=None: None
    from exercises.grader.notebook import NotebookCheck

    return given, NotebookCheck(slug(unit))


def _without_pictures(given):
    """The helpers, of which show_… do nothing: they call a student's functions thousands of times for a
    picture that nobody sees, and a cell runs again for each check."""
    seen = types.ModuleType(given.__name__, given.__doc__)
    seen.__dict__.update(vars(given))
    for name in vars(given):
        if name.startswith("show_"):
            setattr(seen, name, lambda *arguments, **options: None)
    return seen
