"""The instructor's own files, beside submitted/. The grader reads them and never writes them.

roster.csv     id, first_name, last_name, email, canvas_id, moodle_id     who is in the class
deadlines.csv  unit, due, student, penalty_per_day, most_penalty          a row with a student is an extension
manual.csv     student, unit, points, comment                             added to what the checks gave
"""

import datetime
import math
import re
from dataclasses import dataclass
from fractions import Fraction

import exercises
from exercises.grader.classroom.files import Trouble, line, name_fault, printable, read_records

ID_COLUMNS = ("id", "student_id", "student")  # nbgrader writes the first or the second


@dataclass(frozen=True)
class Deadline:
    """Until when, and what each begun day after it costs, in hundredths of the points earned."""

    due: datetime.datetime
    per_day: Fraction = Fraction(0)
    most: Fraction = Fraction(100)

    def penalty(self, points, when):
        """What `points` lose, handed in at `when`."""
        late = (when - self.due).total_seconds()
        if late <= 0 or points <= 0:
            return Fraction(0)
        return points * min(self.per_day * math.ceil(late / 86400), self.most, Fraction(100)) / 100


@dataclass(frozen=True)
class Manual:
    points: Fraction
    comment: str


class Roster:
    """The students by their ids, in order; None in place of a Roster means that there is no roster.csv."""

    def __init__(self, records):
        self.students = {}
        for record in records:
            name = next((record[key] for key in ID_COLUMNS if record.get(key)), "")
            if name_fault(name):
                raise Trouble(f"roster.csv: the id {line(name)!r} cannot name a folder: {name_fault(name)}.")
            if name in self.students:
                raise Trouble(f"roster.csv: the id {line(name)!r} stands there twice.")
            self.students[name] = {key: value for key, value in record.items() if key}
        if not self.students:
            raise Trouble("roster.csv names no student.")

    def of(self, student, column):
        return self.students.get(student, {}).get(column, "")

    def known_as(self, text, *columns):
        """The student whose id, or entry in one of the columns, is `text`; None if nobody's or several's."""
        text = text.strip().casefold()
        if not text:
            return None
        found = {name for name in self.students if name.casefold() == text} or {
            name
            for name, record in self.students.items()
            for column in columns
            if record.get(column, "").casefold() == text
        }
        return found.pop() if len(found) == 1 else None


def read_roster(folder):
    path = folder / "roster.csv"
    if not path.is_file():
        return None
    records = read_records(path)
    if records and not any(name in records[0] for name in ID_COLUMNS):
        raise Trouble(f"roster.csv needs a column id; it has {', '.join(map(line, records[0]))}.")
    return Roster(records)


def read_deadlines(folder):
    """{(unit, student or ""): Deadline}"""
    deadlines = {}
    path = folder / "deadlines.csv"
    for number, record in enumerate(read_records(path, ("unit", "due")) if path.is_file() else [], 2):
        where = f"deadlines.csv, row {number}"
        key = _unit(record["unit"], where), record.get("student", "")
        for_all = deadlines.get((key[0], ""))
        per_day = record.get("penalty_per_day") or (for_all.per_day if for_all else 0)
        most = record.get("most_penalty") or (for_all.most if for_all else 100)
        deadlines[key] = Deadline(
            moment(record["due"], where), amount(per_day, where, least=0), amount(most, where, least=0)
        )
    return deadlines


def deadline_of(deadlines, unit, student):
    return deadlines.get((unit, student)) or deadlines.get((unit, ""))


def read_manual(folder):
    """{(unit, student): Manual}; several rows for one are added up."""
    manual = {}
    path = folder / "manual.csv"
    for number, record in enumerate(read_records(path, ("student", "unit")) if path.is_file() else [], 2):
        where = f"manual.csv, row {number}"
        key = _unit(record["unit"], where), record["student"]
        before = manual.get(key, Manual(Fraction(0), ""))
        comment = "\n".join(filter(None, [before.comment, printable(record.get("comment", ""))]))
        manual[key] = Manual(before.points + amount(record.get("points") or 0, where), comment)
    return manual


def _unit(text, where):
    try:
        return exercises.slug(text)
    except ValueError as error:
        raise Trouble(f"{where}: {error}.") from None


def amount(value, where, least=None):
    """An exact number: 7.5, 7,5 or 10 %."""
    text = str(value).strip().removesuffix("%").strip().replace(",", ".")
    if not re.fullmatch(r"[+-]?\d{1,9}(\.\d{1,9})?", text) or (least is not None and Fraction(text) < least):
        raise Trouble(f"{where}: {line(value)!r} is not a number{'' if least is None else ' of 0 or more'}.")
    return Fraction(text)


def moment(text, where):
    """A time with its zone; without one, that of the machine that grades."""
    try:
        when = datetime.datetime.fromisoformat(text.strip())
    except ValueError:
        raise Trouble(
            f"{where}: {line(text)!r} is not a time; write 2026-11-22 23:59, or 2026-11-22T23:59+01:00."
        ) from None
    if len(text.strip()) <= 10:  # a day alone lasts until its end
        when += datetime.timedelta(days=1)
    return when.astimezone()


def handed_in(submission):
    """When the notebook was handed in: nbgrader's timestamp.txt beside it, else the file's own time."""
    if submission.path is None:
        return None
    note = submission.path.with_name("timestamp.txt")
    if note.is_file() and not note.is_symlink() and note.stat().st_size < 200:
        found = re.match(
            r"\d{4}-\d\d-\d\d[ T]\d\d:\d\d(:\d\d)?(\.\d+)?( ?[+-]\d\d:?\d\d| ?UTC|Z)?",
            note.read_text(encoding="utf-8", errors="replace"),
        )
        if found:
            text = re.sub(r" ?UTC$", "+00:00", found.group(0)).replace(" +", "+").replace(" -", "-")
            try:
                return datetime.datetime.fromisoformat(text).astimezone()
            except (ValueError, OverflowError):  # a date that there is not, or that no clock shows
                pass
    return datetime.datetime.fromtimestamp(submission.path.lstat().st_mtime).astimezone()
