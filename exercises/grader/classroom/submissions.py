"""Whose notebook is where: submitted/<student>/<unit>/*.ipynb, as nbgrader lays it out.

Nothing is followed and nothing is opened that is not a plain file of a sensible size in its place.
"""

import os
import stat
from dataclasses import dataclass
from pathlib import Path

import exercises
from exercises.grader.classroom.files import Trouble, line, name_fault

LARGEST_NOTEBOOK = 50_000_000  # bytes: code alone has 50,000; a film among the outputs has millions
MOST_ENTRIES = 10_000  # files looked at in one student's folder


@dataclass(frozen=True)
class Submission:
    student: str
    unit: str
    path: Path = None  # None: missing, or refused
    refused: str = ""  # why, in words for the student

    @property
    def key(self):
        return self.unit, self.student


class Refused(Exception):
    """The file is not read. The text says why."""


def home(folder):
    """(the class's folder, its submitted/). Either may be given."""
    folder = Path(folder)
    if folder.name == "submitted" and folder.is_dir():
        return folder.parent, folder
    if (folder / "submitted").is_dir():
        return folder, folder / "submitted"
    raise Trouble(
        f"{folder} holds no folder submitted/<student>/<unit>/; '{folder}/submitted' should be there."
    )


def find(submitted, students=None, units=None):
    """(submissions sorted by unit and student, notes). `students` is the roster's, if there is one."""
    notes, present = [], []
    for entry in sorted(os.scandir(submitted), key=lambda entry: entry.name):
        if not entry.is_dir(follow_symlinks=False):
            if not entry.name.startswith("."):
                notes.append(
                    f"{line(entry.name)!r} in submitted/ is no folder of a student, and was left out"
                )
        elif name_fault(entry.name):
            notes.append(f"the folder {line(entry.name)!r} was left out: {name_fault(entry.name)}")
        else:
            present.append(entry.name)
    if students is not None:
        notes += [f"{line(name)} is not in roster.csv" for name in present if name not in students]
    everyone = sorted({*present, *(students or ())})
    found = {}
    for student in present:
        for unit, folder in _units_of(submitted / student, notes):
            if (unit, student) in found:
                notes.append(f"{line(student)} has two folders of {unit}; {line(folder.name)} was left out")
            else:
                found[unit, student] = _choose(student, unit, folder)
    chosen = sorted({unit for unit, _ in found}) if not units else [exercises.slug(unit) for unit in units]
    return [found.get((u, s), Submission(s, u)) for u in chosen for s in everyone], notes


def _units_of(folder, notes):
    for number, entry in enumerate(sorted(os.scandir(folder), key=lambda entry: entry.name)):
        if number >= MOST_ENTRIES:
            notes.append(
                f"{line(folder.name)}: more than {MOST_ENTRIES} entries; the others were not looked at"
            )
            return
        try:
            yield exercises.slug(entry.name), Path(entry.path)
        except ValueError:
            if not entry.name.startswith("."):
                notes.append(f"{line(folder.name)}/{line(entry.name)} is no unit's folder, and was left out")


def _choose(student, unit, folder):
    """The one notebook in a folder; the one with the unit's name, if there are several."""
    if folder.is_symlink() or not folder.is_dir():
        return Submission(student, unit, refused=f"{unit} is not a folder but a link or a file")
    with os.scandir(folder) as entries:
        names = [entry.name for _, entry in zip(range(MOST_ENTRIES), entries, strict=False)]
    names = sorted(name for name in names if name.lower().endswith(".ipynb") and not name.startswith("."))
    if not names:
        return (
            Submission(student, unit, refused="there is no notebook (.ipynb) in the folder")
            if _holds(folder)
            else Submission(student, unit)
        )
    if len(names) > 1 and f"{unit}.ipynb" not in names:
        return Submission(
            student, unit, refused=f"there are {len(names)} notebooks, and none is {unit}.ipynb"
        )
    return Submission(student, unit, folder / (names[0] if len(names) == 1 else f"{unit}.ipynb"))


def _holds(folder):
    return any(
        entry.name != "timestamp.txt" and not entry.name.startswith(".") for entry in os.scandir(folder)
    )


def read(path):
    """The notebook's bytes. Refused: what is no plain file, a link, or too large."""
    try:
        number = os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
    except OSError as error:
        link = path.is_symlink()
        raise Refused(
            "it is a link to another file" if link else f"it cannot be opened: {error.strerror}"
        ) from None
    with open(number, "rb") as file:
        about = os.fstat(number)
        if not stat.S_ISREG(about.st_mode):
            raise Refused("it is not a plain file")
        if about.st_size > LARGEST_NOTEBOOK:
            raise Refused(
                f"it has {about.st_size:,} bytes; at most {LARGEST_NOTEBOOK:,} are taken "
                "(clear the outputs, then save it again)"
            )
        data = file.read(LARGEST_NOTEBOOK + 1)
    if len(data) > LARGEST_NOTEBOOK:
        raise Refused(f"it has more than {LARGEST_NOTEBOOK:,} bytes")
    return data
