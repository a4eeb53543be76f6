"""Checks a file in the shell, as the notebook's own check() would.

    python -m exercises.grader.shell --unit 02 PATH [--json FILE] [--seed N] [--limit SECONDS]

PATH is a notebook, or a script with cells. All its code cells run in a fresh Python process. The exit code is
0 if all checks pass, 1 if some fail, 2 if the file could not be checked.
"""

import argparse
import json
import re
import sys
import traceback
from pathlib import Path

import exercises
from exercises.grader.cells import read_cells
from exercises.grader.check import SELF_STUDY_SEED, Unrecorded
from exercises.grader.marking import mark_in_turn
from exercises.grader.notebook import page
from exercises.grader.replies import Student
from exercises.grader.report import report, total
from exercises.grader.student import StudentProcess


def main(arguments=None):
    options = _options(arguments)
    sys.stdout.reconfigure(
        errors="replace"
    )  # a console that cannot show a student's letters must not stop us
    try:
        unit = exercises.slug(options.unit)
        cells = read_cells(options.path)
    except ValueError as error:  # Unreadable is one
        print(error, file=sys.stderr)
        return 2
    try:
        results, troubles = check_cells(
            unit, cells, options.path.resolve().parent, options.seed, options.limit
        )
    except (Unrecorded, NotTheExercise) as error:
        print(error, file=sys.stderr)
        return 2
    except Exception:
        traceback.print_exc()
        print("The check itself went wrong: this is not a fault of the checked file.", file=sys.stderr)
        return 2
    _tell_troubles(cells, troubles)
    summary = summarise(unit, results)
    if options.json:
        options.json.write_text(json.dumps(summary) + "\n", encoding="utf-8")
    print(total(results))
    return 0 if summary["earned"] == summary["possible"] else 1


def check_cells(unit, cells, folder, seed=SELF_STUDY_SEED, limit=60.0, show=print):
    """(results, troubles): every check of the unit put to these cells, reports shown as they come."""
    student = StudentProcess(unit, cells, folder, limit)
    try:
        results = []
        checks = exercises.part(unit, "checks").CHECKS
        _require_a_copy(unit, functions_of(checks), cells, student)
        for result in mark_in_turn(checks, student.ask, seed):
            results.append(result)
            show(report(result, page(unit)))
        return results, student.troubles
    finally:
        student.close()


class NotTheExercise(ValueError):
    """The file may be a notebook, but it is another one."""


def functions_of(checks):
    """The names of the functions that the checks ask for, in order."""
    calls = [call for check in checks for case in check.visible for call in check.calls_of(case)]
    handed = [one.name for call in calls for one in call.arguments if isinstance(one, Student)]
    return list(dict.fromkeys([call.function for call in calls] + handed))


def _require_a_copy(unit, names, cells, student):
    """Some function is there, or at least begun: a cell with a slip in it may define none."""
    begun = re.compile(rf"\bdef +(?:{'|'.join(map(re.escape, names))})\b")
    if not any(begun.search(cell) for cell in cells) and not student.defines_any(names):
        number, listed = unit.split("_")[0], ", ".join(names)
        raise NotTheExercise(f"This is not a copy of exercise {number}: none of its cells defines {listed}.")


def summarise(unit, results):
    return {
        "unit": unit,
        "earned": sum(result.earned for result in results),
        "possible": sum(result.check.points for result in results),
        "passed": {result.check.name: result.passed for result in results},
    }


def _tell_troubles(cells, troubles):
    for number, trouble in troubles:
        first_line = next((line.strip() for line in cells[number - 1].splitlines() if line.strip()), "")
        print(f"Note: code cell {number} ({first_line[:60]}) did not run to its end.")
        print("\n".join(f"    {line}" for line in trouble.splitlines()))


def _options(arguments):
    parser = argparse.ArgumentParser(
        prog="python -m exercises.grader.shell", description=__doc__.split("\n")[0]
    )
    parser.add_argument(
        "path", type=Path, metavar="PATH", help="a notebook (.ipynb), or a script with # %%%% cells"
    )
    parser.add_argument("--unit", required=True, help="number or slug of the unit, such as 02")
    parser.add_argument(
        "--json", type=Path, metavar="FILE", help="write unit, earned, possible, passed there"
    )
    parser.add_argument("--seed", type=int, default=SELF_STUDY_SEED, help="draws the hidden cases")
    parser.add_argument(
        "--limit", type=float, default=60.0, metavar="SECONDS", help="for each cell and each check"
    )
    return parser.parse_args(arguments)


if __name__ == "__main__":
    sys.exit(main())
