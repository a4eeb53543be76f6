"""One submission in the sandbox: its cells are loaded, then each question is put to a fresh worker, in one
message or in several."""

import json
import time
from pathlib import Path

import exercises
from exercises.grader.replies import BadReply, parse
from exercises.grader.sandbox import nursery as home
from exercises.grader.sandbox.files import compiled, contents
from exercises.grader.sandbox.isolation import choose
from exercises.grader.sandbox.limits import Limits, stretch
from exercises.grader.sandbox.preload import names_tools
from exercises.grader.sandbox.wire import Gone
from exercises.grader.sandbox.words import Trouble, clean
from exercises.grader.sandbox.workers import Worker

RANKS = ("ok", "unsandboxed", "timeout", "crashed", "rejected")
DEATHS = {
    -9: "it was killed",
    -11: "a segmentation fault",
    -6: "it aborted",
    -24: "it used up its CPU time",
    -31: "a system call that is not allowed",
}
LESS = {"whole": "part", "part": "no"}  # how much of a cell runs after it ended a worker
LONGEST_OPEN, LONGEST_REPORT, LONGEST_TITLES, LONGEST_CELLS = 30.0, 1 << 16, 1 << 21, 1 << 23
MOST_PARTS = 300_000  # of one reply: each costs the grader a hundred bytes or so to hold


class Sandbox:
    """One submission to `unit`. `given` is the file of the unit's helpers."""

    def __init__(self, unit, given=None, limits=None, unsafe=False):
        self.unit, self.limits = unit, limits or Limits()
        self.given, self.helpers_need_tools = compiled(Path(given or exercises.FOLDER / unit / "given.py"))
        self.kind = choose(unsafe)
        self.isolation = self.kind.split(",")[0]
        self.status, self.reason = "unsandboxed" if self.kind == "none" else "ok", ""
        self.troubles, self.titles, self.modes, self.data, self.form = [], [], [], b"", ""
        self.codes = b""  # of the cells; not looked at here
        self.tools = False  # needs the large ones
        self.told = None  # what our own function made of the cells
        self.worker, self.started, self.seconds, self.cpu = None, time.monotonic(), 0.0, 0.0

    def __enter__(self):
        return self

    def __exit__(self, *trouble):
        self._end()

    @property
    def cells(self):
        return len(self.titles)

    # --- what the grader asks -------------------------------------------------------------------------------

    def load(self, source, task=None, extra=None):
        """Runs all cells of a notebook or script, a path or its bytes. Returns the box itself. Before that
        our own function TASKS[task] may look at them: what it makes of them is `told`, None if it fails."""
        self.started = time.monotonic()
        try:
            self.data, self.form = contents(source, self.limits.notebook)
            self.tools = self.helpers_need_tools or names_tools(self.data)
            self._open()
            self.codes = self._ahead({"compile": True}) or b""
            if task is not None:
                told = self._ahead({"task": task, "extra": extra})
                self.told = told and parse(told.decode())["task"]
            self._run_cells(self.limits.cell)
        except (OSError, ValueError) as error:
            self._tell("rejected", f"the file cannot be read: {error}")
        except Gone as error:
            self._end()
            opened = "timeout" if error.late else "crashed"
            self._tell(opened if self.form == "cells" else "rejected", str(error))
        finally:
            self.seconds += time.monotonic() - self.started
        return self

    def ask(self, text):
        """The response to a request of marking.mark; where none comes, one that says so for every call."""
        self.started, request, goes_on = time.monotonic(), json.loads(text), False
        try:
            if self.status == "rejected":
                raise Gone(self.reason)
            visible = "more" in request
            answer, goes_on = self._answer(text, len(request["calls"]), visible), visible
            return answer
        except Gone as error:
            message = clean(error)
            if self.status != "rejected":
                self._tell("timeout" if error.late else "crashed", message)
            failure = {"error": {"kind": "no answer", "message": message, "lines": []}}
            return json.dumps({"replies": [failure] * len(request["calls"])})
        finally:
            if not goes_on:
                self._end()
            self.seconds += time.monotonic() - self.started

    # --- workers --------------------------------------------------------------------------------------------

    def _answer(self, text, calls, visible):
        if self.worker is None:
            self._open()
            self._run_cells(2 * self.limits.cell)
        seconds = min(self.limits.question, self.limits.call * calls)
        self.worker.wire.send(text.encode() + b"\n", self._left(seconds))
        return self._reply(self._left(seconds), visible)

    def _reply(self, seconds, visible):
        """Of a hidden case it is not told how the process ended: a student's code can choose how."""
        try:
            data = self.worker.wire.line(seconds, self.limits.reply)
        except Gone as error:
            if error.late:
                raise Gone(f"{error}: a loop that does not end, or far too many steps", late=True) from None
            how = f": {error}{self._last_words()}" if visible else ""
            raise Gone(f"the process that ran the code did not answer{how}") from None
        if sum(data.count(mark) for mark in (b",", b"[", b"{")) > MOST_PARTS:
            raise Gone(f"the answer has more than {MOST_PARTS:,} parts")
        return data.decode("utf-8", "replace")

    def _ahead(self, message):
        """The answer of the worker that is open, which has run none of the cells; None if that ended it."""
        try:
            self.worker.wire.send(_line(message), self.limits.cell)
            return self.worker.wire.line(self._left(self.limits.cell), LONGEST_CELLS)
        except Gone:
            self._end()
            self._open()
            return None

    def _open(self):
        """A fresh worker that holds the cells; none has run."""
        self.worker = Worker(self.kind, self.limits, self.tools)
        parts = {"given": self.given, "codes": self.codes, "file": self.data}
        header = {"open": self.unit, **{name: len(part) for name, part in parts.items()}, "form": self.form}
        try:
            self.worker.wire.send(_line(header) + b"".join(parts.values()), LONGEST_OPEN)
            answer = json.loads(self.worker.wire.line(LONGEST_OPEN, LONGEST_TITLES))
            if "unconfined" in answer:
                raise home.SandboxError(f"a worker could not be shut in: {answer['unconfined']}")
            if "rejected" in answer:
                raise Gone(clean(answer["rejected"]))
            if self.form != "cells":  # from now on the cells' source alone goes in, as the worker wrote it
                self.data, self.form = self.worker.wire.line(LONGEST_OPEN, LONGEST_CELLS), "cells"
                self.tools = self.helpers_need_tools or names_tools(self.data)
                self.titles = [clean(title, 60) for title in answer["titles"]]
                self.modes = ["whole"] * len(self.titles)
        except Gone as error:
            raise Gone(f"the file cannot be read: {error}", error.late) from None

    def _run_cells(self, seconds):
        """All cells, in this worker or, where one ends it, in the next."""
        while True:
            number = 0
            try:
                runs = [[mode, number] for number, mode in enumerate(self.modes, 1)]
                self.worker.wire.send(_line({"run": runs}), self._left(seconds))
                for _, number in runs:
                    self._note(number, self.worker.wire.line(self._left(seconds), LONGEST_REPORT))
                return
            except Gone as error:
                if number == 0 or self.modes[number - 1] == "no" or self._left(1.0) <= 0:
                    raise
                self._leave_out(number, error)
                self._end()
                self._open()

    def _note(self, number, line):
        """A cell has run; what it raised is told."""
        try:
            error = parse(line.decode("utf-8", "replace"))["error"]
            if not error or number in {trouble.number for trouble in self.troubles}:
                return
            lines = [
                f"{clean(error['kind'], 80)}: {clean(error['message'])}",
                *map(clean, error["lines"][:4]),
            ]
        except (BadReply, KeyError, TypeError, IndexError, RecursionError):
            lines = ["it sent something in place of a report"]
        self.troubles.append(Trouble(number, self.titles[number - 1], "\n".join(lines), False))

    def _leave_out(self, number, error):
        self.modes[number - 1] = LESS[self.modes[number - 1]]
        kept = (
            "its imports, definitions and literal assignments ran" if self.modes[number - 1] == "part" else ""
        )
        text = f"it was left out: {error}{self._last_words()}; {kept or 'its definitions too'}"
        self.troubles = [trouble for trouble in self.troubles if trouble.number != number]
        self.troubles.append(Trouble(number, self.titles[number - 1], clean(text), True))

    def _left(self, seconds):
        times = stretch()
        total = times * self.limits.total
        left = min(times * seconds, total - self.seconds - (time.monotonic() - self.started))
        if left <= 0:
            raise Gone(f"the submission took longer than {total:.0f} s in all", late=True)
        return left

    def _last_words(self):
        """How the worker died, in words."""
        code = self._end()
        return "" if code is None else f" ({DEATHS.get(code, f'exit code {code}')})"

    def _end(self):
        if self.worker is None:
            return None
        worker, self.worker = self.worker, None
        code, cpu = worker.end()
        self.cpu += cpu
        return code

    def _tell(self, status, reason):
        if RANKS.index(status) > RANKS.index(self.status):
            self.status, self.reason = status, clean(reason)


def _line(message):
    return json.dumps(message).encode() + b"\n"
