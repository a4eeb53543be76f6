"""One submission: the notebook's bytes in, its result out, both in JSON text.

The same function serves a thread of the grader and a process of a cluster. It never raises: what goes wrong
on our side is the status `grader_error`, and has no score.
"""

import base64
import contextlib
import json
import platform
import time
import traceback
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np

import exercises
from exercises.grader.classroom import workers
from exercises.grader.classroom.cases import check_hash, with_cases
from exercises.grader.classroom.files import line, printable
from exercises.grader.classroom.told import told
from exercises.grader.marking import mark_in_turn

MOST_TROUBLES = 30


def payload(unit, notebook, cases, starter, unsafe=False):
    """What `grade` needs, as text."""
    return json.dumps(
        {
            "unit": unit,
            "notebook": base64.b64encode(notebook).decode(),
            "cases": cases,
            "starter": starter,
            "checks": check_hash(unit),
            "unsafe": unsafe,
        }
    )


def grade(text):
    """The result of one submission, as text."""
    began, cpu = time.monotonic(), time.thread_time()
    try:
        job = json.loads(text)
        result = _grade(job)
        if result["status"] in ("rejected", "crashed"):
            _require_a_sandbox_that_works(job, result["reason"])
    except Exception as error:
        result = grader_error(f"{type(error).__name__}: {error}", traceback.format_exc(limit=-6))
    result["seconds"] = round(time.monotonic() - began, 3)
    result["grader_cpu"] = round(time.thread_time() - cpu, 4)
    return json.dumps(result)


def grader_error(reason, details=""):
    return {
        "status": "grader_error",
        "reason": line(reason, 500),
        "details": printable(details),
        "checks": [],
    }


def _grade(job):
    unit = job["unit"]
    if job["checks"] != check_hash(unit):
        raise RuntimeError(f"this machine has other checks of {unit} than the one that sends the submissions")
    checks = checks_of(unit, job["cases"])
    with workers.open_box(unit, job["unsafe"]) as box:
        notebook = base64.b64decode(job["notebook"])
        fingerprint = workers.load(box, notebook, job["starter"])
        rejected = box.status == "rejected"
        with np.errstate(all="ignore"):  # judges reckon with whatever numbers a student sends
            marked = list(map(nothing, checks) if rejected else map(told, mark_in_turn(checks, box.ask)))
        return {
            "status": box.status,
            "reason": line(box.reason, 500),
            "isolation": box.isolation,
            "checks": marked,
            "troubles": [
                [int(one.number), line(one.title, 80), printable(one.text, 1500), bool(one.skipped)]
                for one in box.troubles[:MOST_TROUBLES]
            ],
            "environment": environment(),
            "student_seconds": round(box.seconds, 3),
            "student_cpu": round(box.cpu, 3),
            "fingerprint": {} if rejected else fingerprint,
        }


def _require_a_sandbox_that_works(job, reason):
    """A notebook's failure is its own only where an innocent one passes."""
    if not workers.takes_the_innocent(job["unit"], job["unsafe"]):
        raise RuntimeError(f"the sandbox fails innocent notebooks too: {reason}")


@cache
def checks_of(unit, cases):
    """The unit's checks with these hidden cases; once for all submissions, oracles and all."""
    return with_cases(exercises.part(unit, "checks").CHECKS, cases)


def use_exercises(folder):
    """Takes the units from `folder`, in this process: `--exercises DIR`."""
    exercises.FOLDER = Path(folder)


def work_out(unit, cases):
    """Asks all oracles once, so that their time is not taken for that of the first submission."""
    for check in checks_of(unit, cases):
        for case in check.cases(0):
            with contextlib.suppress(Exception):  # a judge may not like an empty answer: it has been asked
                check.judge(case.values, [None] * len(check.calls_of(case)))


def nothing(check):
    """A check of a submission that could not be asked."""
    about = {"name": check.name, "title": check.title, "points": check.points}
    return {**about, "earned": 0, "passed": False, "cases": 0, "failing": 0, "source": "", "unasked": True}


@cache
def environment():
    """What the score was made with."""
    packages = {}
    for name in ("numpy", "scipy", "numba", "pymunk", "pybullet"):
        with contextlib.suppress(PackageNotFoundError):
            packages[name] = version(name)
    return {
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        **packages,
    }
