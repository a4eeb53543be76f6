"""What a student may read of a check's result, as JSON data: of a hidden case neither question nor answer.

A call on a hidden case tells nothing of what it printed or raised either: a function could print its
arguments.
"""

import numpy as np

from exercises.grader.classroom.files import line, printable
from exercises.grader.marking import Failure
from exercises.grader.report import calls_to_show, likely_cause, words_of, write, write_call

LONGEST_ANSWER = 1500  # characters of an expected or returned value
MOST_POINTS, LEAST_POINTS, MOST_CURVES = 200, 8, 3


def told(result):
    """One check's result."""
    check, failing = result.check, [one for one in result.outcomes if not one.verdict.passed]
    about = {
        "name": check.name,
        "title": check.title,
        "points": check.points,
        "earned": result.earned,
        "passed": result.passed,
        "cases": len(result.outcomes),
        "failing": len(failing),
        "source": check.source() if check.source else "",
    }
    return about if result.passed else {**about, **_failure(result, failing)}


def _failure(result, failing):
    check, first = result.check, failing[0]
    unwritten = all(one.verdict.got is None for one in failing)
    cause = "The function is still to be written, or its `return` is missing."
    return {
        "unwritten": unwritten,
        "hidden": first.case.hidden,  # visible cases come first: so all visible ones passed
        "case": first.case.label,
        "why": check.why,
        "form": check.form,
        "section": check.section,
        "cause": cause if unwritten else likely_cause(result),
        **(_hidden(first) if first.case.hidden else _visible(first)),
    }


def _hidden(outcome):
    verdict = outcome.verdict
    if isinstance(verdict.got, Failure):
        kinds = {
            "answer": "the answer is not of the kind asked for",
            "no answer": "no answer came in time",
            "in place": "the function changes an argument in place",
        }
        return {"got": kinds.get(verdict.got.kind, "the function raised an error")}
    return {"tolerance": f"{verdict.tolerance:.3g}"}


def _visible(outcome):
    verdict = outcome.verdict
    rows = {"call": "\n".join(write_call(call) for call in calls_to_show(outcome))}
    if outcome.printed:
        rows["printed"] = printable(outcome.printed, 400)
    if isinstance(verdict.got, Failure):
        failure = verdict.got
        if verdict.expected is not None:
            rows["expected"] = _written(verdict.expected)
        lines = [line(text) for text in failure.lines[:4]]
        if failure.value is not None:
            lines.append(line(_written(failure.value), 600))
        return {**rows, "got": line(words_of(failure), 600), "lines": lines}
    rows.update(expected=_written(verdict.expected), got=_written(verdict.got))
    rows["tolerance"] = f"{verdict.tolerance:.3g}"
    if verdict.complaint:
        rows["complaint"] = line(verdict.complaint, 400)
    else:
        rows["error"] = f"{verdict.error:.3g}{verdict.measure and ', ' + verdict.measure}"
    curves = [_curves(verdict.expected), _curves(verdict.got)]
    if None not in curves and len(curves[0]) == len(curves[1]):
        rows["curves"] = curves
    return rows


def _written(value):
    try:
        return printable(write(value), LONGEST_ANSWER)
    except Exception:  # an answer so odd that it cannot be written must not end the grading
        return "a value too odd to be written here"


def _curves(value):
    """The columns of an array as lists of rounded numbers, thinned out; None if it is no curve."""
    if not isinstance(value, np.ndarray) or value.ndim not in (1, 2) or value.dtype.kind not in "iuf":
        return None
    columns = value.reshape(len(value), -1) if len(value) else value.reshape(0, 1)
    if len(columns) < LEAST_POINTS or not 1 <= columns.shape[1] <= MOST_CURVES:
        return None
    places = np.unique(np.linspace(0, len(columns) - 1, min(len(columns), MOST_POINTS)).astype(int))
    with np.errstate(all="ignore"):
        return [
            [
                [int(i), float(f"{x:.6g}") if np.isfinite(x) else None]
                for i, x in zip(places, column, strict=True)
            ]
            for column in columns[places].T.astype(float)
        ]
