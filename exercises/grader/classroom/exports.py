"""What other systems read: Gradescope's results.json, and tables for Canvas and Moodle.

The tables are made from a gradebook that the instructor has exported there: its rows and its names for things
come back unchanged, only the grades are ours.
"""

import json
import re
from fractions import Fraction

from exercises.grader.classroom.files import Trouble, line, printable, read_records, read_table, table, write
from exercises.grader.classroom.scores import number

CANVAS_KEYS = ("SIS User ID", "SIS Login ID", "ID", "Integration ID")
CANVAS_KEPT = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
MOODLE_KEYS = ("ID number", "Username", "Email address")
ROSTER_COLUMNS = ("canvas_id", "moodle_id", "lms_user_id", "email", "login", "sis_id")


def write_all(scores, roster, class_folder, folder, options, tell=print):
    for score in scores:
        one = score.submission
        write(folder / "gradescope" / one.unit / one.student / "results.json", gradescope(score))
    for system, path in (("canvas", options.canvas), ("moodle", options.moodle)):
        if path:
            columns = assignment_columns(class_folder, system)
            text, notes = filled(system, path, scores, roster, columns)
            write(folder / f"{system}.csv", text)
            for note in notes:
                tell(f"Note: {path.name}: {note}.")
            tell(f"To import in {system.capitalize()}: {folder / f'{system}.csv'}")


# --- Gradescope ---------------------------------------------------------------------------------------------


def gradescope(score):
    """results.json as text. Without a `score` Gradescope asks the instructor for one, as our errors must."""
    result = score.result or {}
    tests = [
        {
            "name": check["name"],
            "score": check["earned"],
            "max_score": check["points"],
            "status": "passed" if check["passed"] else "failed",
            "output": _output(check),
            "output_format": "text",
            "visibility": "visible",
        }
        for check in result.get("checks", ())
    ]
    answer = {"output": _summary(score), "output_format": "text", "visibility": "visible"}
    if score.final is not None:
        answer.update(score=float(number(score.final)), tests=tests)
    return json.dumps(answer, indent=1) + "\n"


def _summary(score):
    lines = [f"status: {score.status}"]
    if score.result and score.status != "grader_error" and score.result.get("reason"):
        lines.append(score.result["reason"])
    if score.penalty:
        lines.append(f"handed in late: −{number(score.penalty)} points")
    if score.manual and score.manual.points:
        lines.append(f"added by your instructor: {number(score.manual.points)} points")
    if score.manual and score.manual.comment:
        lines.append(score.manual.comment)
    return printable("\n".join(lines))


def _output(check):
    if check["passed"] or check.get("unasked"):
        return ""
    rows = [
        ("asked for", "title"),
        ("case", "case"),
        ("call", "call"),
        ("expected", "expected"),
        ("got", "got"),
        ("tolerance", "tolerance"),
        ("why", "why"),
        ("likely cause", "cause"),
        ("read", "section"),
    ]
    return printable("\n".join(f"{name}: {check[key]}" for name, key in rows if check.get(key)))


# --- Canvas and Moodle --------------------------------------------------------------------------------------


def assignment_columns(class_folder, system):
    """{unit: the gradebook's name for it}, from assignments.csv with the columns unit, canvas, moodle."""
    path = class_folder / "assignments.csv"
    records = read_records(path, ("unit",)) if path.is_file() else []
    return {record["unit"]: record[system] for record in records if record.get(system)}


def filled(system, path, scores, roster, columns):
    """(the table to import, notes). `columns` names the assignments that are not called like their unit."""
    header, rows = read_table(path)
    header = [cell.strip() for cell in header]
    units = sorted({score.submission.unit for score in scores})
    places = {unit: _place(header, unit, columns.get(unit), path.name) for unit in units}
    keys = [
        header.index(key) for key in (CANVAS_KEYS if system == "canvas" else MOODLE_KEYS) if key in header
    ]
    if not keys:
        known = ", ".join(CANVAS_KEYS if system == "canvas" else MOODLE_KEYS)
        raise Trouble(f"{path.name} has none of the columns {known}: is it the gradebook that was exported?")
    of = {(score.submission.unit, score.submission.student): score for score in scores}
    students = {score.submission.student for score in scores}
    kept = [i for i, name in enumerate(header) if _is_kept(system, name)]
    out, found = [], set()
    for row in rows:
        row = row + [""] * (len(header) - len(row))
        student = _student(row, keys, students, roster)
        if student is None:
            if system == "canvas" and row[0].strip() in ("Points Possible", "Manual Posting"):
                out.append([row[i] for i in kept] + [row[place] for place in places.values()])
            continue
        found.add(student)
        grades = [_grade(of.get((unit, student)), row[place]) for unit, place in places.items()]
        out.append([row[i] for i in kept] + grades)
    notes = [f"{line(name)} is not in it, and was left out" for name in sorted(students - found)]
    return table([header[i] for i in kept] + [header[place] for place in places.values()], out), notes


def _is_kept(system, name):
    if system == "canvas":
        return name in CANVAS_KEPT
    return name in (*MOODLE_KEYS, "First name", "Last name", "Surname")


def _grade(score, before):
    """Our number; what stands there already where we have none."""
    if score is None or score.final is None:
        return before
    return _Number(number(score.final))


class _Number(Fraction):
    """Keeps a number from being taken for text, and its digits as they are."""

    def __new__(cls, text):
        made = super().__new__(cls, text)
        made.text = text
        return made

    def __str__(self):
        return self.text


def _place(header, unit, name, file):
    """The column of a unit: as assignments.csv names it, or the only one that holds its slug or number."""
    if name:
        found = [
            i
            for i, cell in enumerate(header)
            if cell == name or re.fullmatch(re.escape(name) + r" \(.*\)", cell)
        ]
    else:
        digits = unit.split("_")[0]
        words = rf"(?<![\d.]){digits}(?!\d)|(?<![\d.]){int(digits)}(?![\d.])"
        found = [i for i, cell in enumerate(header) if unit in cell] or [
            i
            for i, cell in enumerate(header)
            if re.search(words, re.sub(r"\([^)]*\)\s*$", "", cell)) and "total" not in cell.lower()
        ]
    if len(found) != 1:
        choice = ", ".join(line(header[i]) for i in found) or "none"
        raise Trouble(
            f"{file}: which column is {unit}? Those that could be: {choice}. Name it in assignments.csv, "
            "beside submitted/, with the columns unit, canvas, moodle."
        )
    return found[0]


def _student(row, keys, students, roster):
    for key in keys:
        text = row[key].strip()
        if text in students:
            return text
        student = roster.known_as(text, *ROSTER_COLUMNS) if roster and text else None
        if student in students:
            return student
    return None
