"""The loop of the shell's subprocess: requests on standard input, responses on standard output.

    {"cell": source, "name": "cell 3"}    runs a cell              → {"error": null or {...}}
        with "part": true                 runs its definitions only
    {"calls": [...]}                      answers as worker.py says → {"replies": [...]}

The student's own printing must not get between the responses, so the two pipes are kept under other numbers,
and what cells print goes nowhere.
"""

import json
import os
import sys

import exercises
from exercises.grader import absent, ipython, numba_cache
from exercises.grader.cells import Namespace
from exercises.grader.worker import Worker


def main(unit):
    inbox = os.fdopen(os.dup(0), "r", encoding="utf-8")
    outbox = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1, 2):
        os.dup2(nowhere, number)
    exercises.silent = True
    ipython.find()
    numba_cache.off()
    absent.hide()
    namespace = Namespace()
    sys.modules["__main__"] = namespace.module  # classes and compiled functions look their module up by name
    worker = Worker(namespace.names, exercises.part(unit, "given"))
    for line in inbox:
        request = json.loads(line)
        if "cell" in request:
            run = namespace.run_definitions if request.get("part") else namespace.run
            response = json.dumps({"error": run(request["cell"], request["name"])})
        else:
            response = worker.answer(line)
        outbox.write(response + "\n")
        outbox.flush()
