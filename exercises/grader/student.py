"""The shell's subprocess, seen from outside: it runs a student's cells, and answers over a pipe.

A cell or a question that takes too long, or that kills the process, costs only itself: a new process runs the
other cells again, and of that cell what defines things, as the class's grader does.
"""

import contextlib
import json
import os
import queue
import subprocess
import sys
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
START = (
    "import sys; sys.path.insert(0, sys.argv[1]); from exercises.grader.serve import main; main(sys.argv[2])"
)
LONGEST_START = 60.0  # seconds until Python and NumPy are there; apart from the limit on each cell


class Gone(Exception):
    """The process did not answer: it took too long, or it died."""


class StudentProcess:
    """Runs `cells` of `unit` in `folder`. `troubles` lists (cell's number from 1, what was wrong with it)."""

    def __init__(self, unit, cells, folder, limit=60.0):
        self.unit, self.cells, self.folder, self.limit = unit, cells, folder, limit
        self.partly, self.skipped, self.troubles = set(), set(), []
        self._start()

    def ask(self, text):
        """The response to a request. Where none comes, one that says so for every call."""
        try:
            return self._exchange(text)
        except Gone as reason:
            self._start()
            error = {"error": {"kind": "no answer", "message": str(reason), "lines": []}}
            return json.dumps({"replies": [error] * len(json.loads(text)["calls"])})

    def defines_any(self, names):
        """Is one of these names a function there?"""
        source = f"if not any(callable(globals().get(name)) for name in {list(names)!r}): raise LookupError"
        try:
            error = json.loads(self._exchange(json.dumps({"cell": source, "name": "names"})))["error"]
        except Gone:
            self._start()
            return True
        return not error or error["kind"] != "LookupError"

    def close(self):
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError):  # what was not yet written to a dead process
                pipe.close()

    def _start(self):
        """A new process with all cells run, but for those that ended an earlier one."""
        while True:
            self._spawn()
            try:
                number = 0
                self._exchange(json.dumps({"cell": "", "name": "start"}), LONGEST_START)
                for number, source in enumerate(self.cells, 1):
                    if number not in self.skipped:
                        self._run_cell(number, source)
                return
            except Gone as reason:
                if number == 0:
                    raise OSError(f"no Python process could be started for the check: {reason}") from None
                self._leave_out(number, reason)

    def _leave_out(self, number, reason):
        """At first all but its definitions; where these end the process, too, all of it."""
        if number in self.partly:
            self.skipped.add(number)
            return
        self.partly.add(number)
        self.troubles = [trouble for trouble in self.troubles if trouble[0] != number]
        kept = "its imports, definitions and literal assignments, if any, are kept"
        self.troubles.append((number, f"it was left out: {reason}; {kept}"))

    def _run_cell(self, number, source):
        request = {"cell": source, "name": f"cell {number}", "part": number in self.partly}
        response = self._exchange(json.dumps(request))
        error = json.loads(response)["error"]
        if error and number not in dict(self.troubles):
            self.troubles.append(
                (number, "\n".join([f"{error['kind']}: {error['message']}", *error["lines"]]))
            )

    def _spawn(self):
        if hasattr(self, "process"):
            self.close()
        environment = dict(
            os.environ, MPLBACKEND="Agg", OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", PYTHONUTF8="1"
        )
        self.process = subprocess.Popen(
            [sys.executable, "-c", START, str(ROOT), self.unit],
            cwd=self.folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
            encoding="utf-8",
        )
        self.lines = queue.Queue()
        threading.Thread(target=_read_all, args=(self.process.stdout, self.lines), daemon=True).start()

    def _exchange(self, text, limit=None):
        try:
            self.process.stdin.write(text + "\n")
            self.process.stdin.flush()
            line = self.lines.get(timeout=limit or self.limit)
        except queue.Empty:
            raise Gone(f"it took longer than {limit or self.limit:g} s") from None
        except OSError:
            line = None
        if line is None:
            raise Gone(f"the Python process ended (exit code {self.process.wait()})")
        return line


def _read_all(pipe, lines):
    """Reading with a time limit works on all systems only from a thread."""
    try:
        for line in pipe:
            lines.put(line)
    except (OSError, ValueError):
        pass
    lines.put(None)
