"""The store: one file a submission, written as soon as it is graded, whole. What is finished stays finished.

instructor/results/<unit>/<student>.json     the result that counts
instructor/history.jsonl                     every change of a score: when, from, to, why
"""

import datetime
import json

from exercises.grader.classroom.files import append, write


class Results:
    def __init__(self, folder):
        self.folder = folder

    def path(self, submission):
        return self.folder / "results" / submission.unit / f"{submission.student}.json"

    def read(self, submission):
        """The finished result, or None."""
        try:
            return json.loads(self.path(submission).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None

    def write(self, submission, result):
        """Keeps a result, and notes in the history what it replaces."""
        before = self.read(submission)
        if before is not None:
            self.note(submission, before, result, "replaced")
        write(self.path(submission), json.dumps(result) + "\n")

    def note(self, submission, before, after, what):
        append(
            self.folder / "history.jsonl",
            {
                "when": datetime.datetime.now().astimezone().isoformat(timespec="seconds"),
                "unit": submission.unit,
                "student": submission.student,
                "what": what,
                "old": _brief(before),
                "new": _brief(after),
            },
        )


def _brief(result):
    kept = ("status", "reason", "notebook", "checks_hash", "cases", "environment")
    return {"earned": earned(result), **{key: result[key] for key in kept if key in result}}


def earned(result):
    """Points of the checks; None where our own failure left none."""
    if result is None or result["status"] == "grader_error":
        return None
    return sum(check["earned"] for check in result["checks"])


def possible(result):
    return sum(check["points"] for check in result["checks"])


def finished(result, notebook_digest):
    """True if this notebook has been graded, and no fault of ours kept it from a score."""
    return result is not None and result["status"] != "grader_error" and result["notebook"] == notebook_digest


def is_lower(old, new):
    """True if the new score would take something away."""
    return earned(old) is not None and (earned(new) is None or earned(new) < earned(old))
