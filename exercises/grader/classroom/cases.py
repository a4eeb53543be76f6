"""The secret seed, and the hidden cases drawn from it.

The cases are kept beside the results: another version of NumPy may draw others from the same seed, and a
score must not depend on that. They travel to other machines in the same form.
"""

import dataclasses
import hashlib
import json
import secrets
from functools import cache
from pathlib import Path

import numpy as np

import exercises
from exercises.grader.check import Case
from exercises.grader.classroom.files import Trouble, digest, write
from exercises.grader.replies import as_argument, pack, unpack

SECRET_BITS = 128


def class_seed(folder, given=None):
    """The seed of a class: `given`, or the secret one kept in `folder`, drawn on first use."""
    if given is not None:
        return given
    path = folder / "seed.json"
    if not path.exists():
        write(
            path, json.dumps({"seed": secrets.randbits(SECRET_BITS), "keep": "secret"}) + "\n", private=True
        )
    try:
        return int(json.loads(path.read_text(encoding="utf-8"))["seed"])
    except (ValueError, KeyError, TypeError):
        raise Trouble(
            f"{path} cannot be read; without it the class would get other hidden cases. Restore it, "
            "or give the seed by --seed."
        ) from None


@cache
def check_hash(unit):
    """A fingerprint of all that decides a score: the unit's checks, answers and recordings; the machinery."""
    ours = Path(exercises.__file__).resolve().parent / "grader"
    files = [path for path in (exercises.FOLDER / unit).rglob("*") if path.suffix in (".py", ".json")]
    files = [path for path in files if not {"solutions", "mistakes"} & set(path.parts)] + list(
        ours.glob("*.py")
    )
    told = hashlib.sha256()
    for path in sorted(files, key=lambda path: path.relative_to(path.parents[1]).as_posix()):
        told.update(path.name.encode() + b"\0" + digest(path.read_bytes()).encode())
    return told.hexdigest()[:16]


def saved_cases(unit, seed, folder):
    """The hidden cases as JSON text: as they were saved, or drawn now and saved."""
    name = f"{unit}-{digest(f'seed {seed}')[:8]}-{check_hash(unit)}.json"
    path = folder / "cases" / name
    if path.exists():
        return path.read_text(encoding="utf-8")
    text = draw(unit, seed)
    write(path, text, private=True)
    return text


def draw(unit, seed):
    """The hidden cases of all checks of a unit, as JSON text."""
    hidden = {
        check.name: [[case.label, pack(case.values)] for case in check.cases(seed) if case.hidden]
        for check in exercises.part(unit, "checks").CHECKS
    }
    head = {"unit": unit, "checks": check_hash(unit), "numpy": np.__version__}
    return json.dumps({**head, "hidden": hidden}, allow_nan=False) + "\n"


def with_cases(checks, text):
    """The checks, each with these hidden cases in place of its generator."""
    hidden = json.loads(text)["hidden"]
    drawn = {name: _read(saved) for name, saved in hidden.items()}
    return [
        dataclasses.replace(check, hidden=lambda stream, cases=drawn[check.name]: cases) for check in checks
    ]


def _read(saved):
    return [Case(label, unpack(values, as_argument), hidden=True) for label, values in saved]
