"""Points of the checks, the instructor's own, penalties: what counts. scores.csv, as nbgrader has it."""

import datetime
from dataclasses import dataclass
from fractions import Fraction

from exercises.grader.classroom.files import table
from exercises.grader.classroom.results import earned
from exercises.grader.classroom.roster import deadline_of, handed_in

COLUMNS = (
    "assignment",
    "duedate",
    "timestamp",
    "student_id",
    "last_name",
    "first_name",
    "email",
    "raw_score",
    "late_submission_penalty",
    "score",
    "max_score",
    "status",
    "comment",
)  # nbgrader's, then ours


@dataclass(frozen=True)
class Score:
    """None where there is no score: our own failure is never a 0."""

    submission: object
    status: str
    result: dict  # None where nothing was handed in
    checks: int  # points of the checks
    most: int
    manual: object  # Manual or None
    due: datetime.datetime
    when: datetime.datetime
    penalty: Fraction

    @property
    def raw(self):
        if self.checks is None:
            return None
        return max(Fraction(0), self.checks + (self.manual.points if self.manual else 0))

    @property
    def final(self):
        return None if self.raw is None else max(Fraction(0), self.raw - self.penalty)


def score(submission, result, most, deadlines, manual):
    """The Score of one submission; `result` is None for a missing one."""
    status = "missing" if result is None else result["status"]
    points = 0 if result is None else earned(result)
    added = manual.get(submission.key)
    when = handed_in(submission)
    deadline = deadline_of(deadlines, *submission.key)
    penalty = Fraction(0)
    if deadline and when and points is not None:
        penalty = deadline.penalty(points + (added.points if added else 0), when)
    return Score(submission, status, result, points, most, added, deadline and deadline.due, when, penalty)


def scores_table(scores, roster):
    """scores.csv as text."""
    return table(COLUMNS, [_row(score, roster) for score in scores])


def _row(score, roster):
    student = score.submission.student
    named = [roster.of(student, column) if roster else "" for column in ("last_name", "first_name", "email")]
    comment = score.manual.comment if score.manual else ""
    return [
        score.submission.unit,
        _time(score.due),
        _time(score.when),
        student,
        *named,
        number(score.raw),
        number(score.penalty if score.raw is not None else None),
        number(score.final),
        str(score.most),
        score.status,
        " ".join(comment.split()),
    ]


def number(value):
    """A fraction as a decimal: exact where it ends within six places, else rounded there; None is blank."""
    if value is None:
        return ""
    text = f"{round(value * 10**6) / 10**6:.6f}".rstrip("0").rstrip(".")
    return text or "0"


def _time(when):
    return when.astimezone(datetime.UTC).strftime("%Y-%m-%d %H:%M:%S UTC") if when else ""
