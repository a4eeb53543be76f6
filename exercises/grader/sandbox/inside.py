"""The worker's loop: parse the notebook, run its cells, answer one question, end.

Messages come one a line, in JSON; bytes that belong to one follow its line. Until the first cell runs, what
is sent back is our own word; after that it is the student's.

    {"open": slug, "given": n, "codes": k, "file": m, "form": word}
             n bytes of given.py's code, k that "compile" gave, m of the file
                                         → {"titles": [first line of each cell]} or {"rejected": why}
    {"compile": true}                    → the cells' code, so that no other worker need compile it again
    {"run": [["whole" or "part" or "no", number], ...]}       → {"done": number, "error": ...} for each
    {"task": name, "extra": ...}                              → {"task": result}; before any cell runs
    {"calls": [...]}                                          → {"replies": [...]}, and the end
        with "more": true                                     → the same, and another message follows
    {"canary": {...}}                                         → {"canary": [what got through]}, and the end
"""

import base64
import importlib
import json
import marshal
import os
import sys
import types

import exercises
from exercises.grader.cells import Namespace, Unreadable, cells_of, code_of
from exercises.grader.sandbox import TASKS
from exercises.grader.worker import Worker

MOST_CELLS = 5_000
TITLE = 60


class Inside:
    def __init__(self, inbox, outbox):
        self.inbox, self.outbox = os.fdopen(inbox, "rb"), outbox
        self.file, self.cells, self.codes, self.namespace, self.worker = b"", [], [], None, None

    def serve(self):
        for line in self.inbox:
            request = json.loads(line)
            kind = next(iter(request))
            if kind == "open":
                for message in self.open(request):
                    self.send(message)
            elif kind == "compile":
                self.write(self.compile())
            elif kind == "task":
                self.send({"task": self.task(request)})
            elif kind == "run":
                self.file = b""
                for mode, number in request["run"]:
                    self.send({"done": number, "error": self.run(mode, number)})
            else:
                self.write(self.answer(kind, request, line))
                if "more" not in request:
                    return

    def open(self, request):
        """What to send back; a notebook's cells, too, to be sent in alone from the second time on."""
        given, codes, self.file = (self.inbox.read(request[part]) for part in ("given", "codes", "file"))
        is_notebook, known = request["form"] == "notebook", request["form"] == "cells"
        try:
            self.cells = json.loads(self.file) if known else cells_of(self.file, "the file", is_notebook)
        except Unreadable as error:
            return [{"rejected": str(error)}]
        if not all(isinstance(cell, str) for cell in self.cells) or len(self.cells) > MOST_CELLS:
            return [{"rejected": f"the file is not a notebook of at most {MOST_CELLS} cells"}]
        self.namespace = Namespace()
        sys.modules["__main__"] = self.namespace.module
        module = load_given(request["open"], given)
        self.worker = Worker(self.namespace.names, module)
        if known:
            self.codes = marshal.loads(base64.b64decode(codes)) if codes else []
            return [{"titles": []}]
        return [{"titles": [title(cell) for cell in self.cells]}, self.cells]

    def compile(self):
        """Before any cell runs, so that this is still our own word."""
        self.codes = [code_of(cell, _name(number)) for number, cell in enumerate(self.cells, 1)]
        return base64.b64encode(marshal.dumps(self.codes))

    def run(self, mode, number):
        name, source = _name(number), self.cells[number - 1]
        if mode == "part":
            return self.namespace.run_definitions(source, name)
        code = self.codes[number - 1] if self.codes else None
        return self.namespace.run(source, name, code) if mode == "whole" else None

    def task(self, request):
        module, _, function = TASKS[request["task"]].partition(":")
        return getattr(importlib.import_module(module), function)(self.cells, self.file, request["extra"])

    def answer(self, kind, request, line):
        if kind == "calls":
            return self.worker.answer(line, last="more" not in request).encode()
        from exercises.grader.sandbox import canary

        return json.dumps({"canary": canary.sing(**request["canary"])}).encode()

    def send(self, message):
        self.write(json.dumps(message).encode())

    def write(self, data):
        rest = memoryview(data + b"\n")
        while rest:
            rest = rest[os.write(self.outbox, rest) :]


def _name(number):
    return f"cell {number}"


def load_given(unit, code):
    """given.py, compiled by the grader, as the module that `load` finds; and `load` told that there is this
    unit alone."""
    module = types.ModuleType(f"exercises.{unit}.given")
    exec(marshal.loads(code), module.__dict__)
    sys.modules[module.__name__] = module
    exercises.units = lambda: [unit]
    return module


def title(cell):
    line = next((line.strip() for line in cell.splitlines() if line.strip()), "")
    return line[:TITLE].encode("utf-8", "replace").decode()
