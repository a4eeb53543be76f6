"""Code cells of a file, and running them one after the other in a plain namespace, as a notebook would.

A file is a notebook (.ipynb) or a script whose cells begin with `# %%`. IPython's own syntax (%magic,
!command, name?) is translated by IPython's transformer and then does nothing, but for the magics that only
measure or catch what a cell does: their cell runs. A cell that raises doesn't stop the later ones.
"""

import __future__

import ast
import asyncio
import inspect
import json
import linecache
import os
import re
import sys
import types

from exercises.grader import absent, ipython
from exercises.grader.worker import describe

FUTURE = __future__.annotations.compiler_flag
RUN_THEIR_CELL = {"time", "timeit", "capture", "prun", "memit", "python", "python3"}


OPTIONS = re.compile(r"^(?:-[a-z]+\s*\d*\s+)+")  # %timeit -n 10 -r3


class Unreadable(ValueError):
    """The file is no notebook and no script."""


def read_cells(path):
    """The source of each code cell of a .ipynb or .py file, in order."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise Unreadable(f"{path} cannot be read: {error}") from None
    return cells_of(data, path, path.suffix == ".ipynb")


def cells_of(data, name, is_notebook):
    """The same of a file's bytes; `name` stands in the error."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unreadable(f"{name} cannot be read: {error}") from None
    if not is_notebook:
        return [cell for cell in re.split(r"(?m)^# %%.*$", text) if cell.strip()]
    try:
        book = json.loads(text)
        if "cells" not in book and "worksheets" in book:  # how notebooks of format 3 were written
            book = {"cells": [cell for sheet in book["worksheets"] for cell in sheet["cells"]]}
        cells = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
        return ["".join(cell["source"] if "source" in cell else cell["input"]) for cell in cells]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise Unreadable(f"{name} is not a notebook: its JSON has no list of cells") from None


class Namespace:
    """Where cells run: one module's names, with what a notebook finds there."""

    def __init__(self):
        self.module, self.future = types.ModuleType("__main__"), 0
        self.names = self.module.__dict__
        self.names.update(display=lambda *things, **options: None, get_ipython=lambda: absent.shell)
        absent.shell = Shell(self)

    def run(self, source, name="cell", code=None):
        """Runs one cell, whose code may be known already. None, or the exception as `describe` tells it."""
        _reopen_output()
        try:
            if code is None or self.future:
                code = _compiled(source, name, self.future)
            lines = source.splitlines(keepends=True)
            linecache.cache[name] = (len(source), None, lines, name)  # for tracebacks
            self.future |= code.co_flags & FUTURE  # `from __future__ import …` holds in later cells too
            _run(code, self.names)
        except BaseException as error:
            return describe(error)
        return None

    def run_definitions(self, source, name="cell"):
        """Runs only a cell's imports, definitions and literal assignments, each whether or not others
        raise."""
        for part in definitions(source):
            self.run(part, name)


def _reopen_output():
    """A cell that closed the output must not make the next one's print raise."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name, None)
        if stream is None or getattr(stream, "closed", False):
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115 (stays open)


def definitions(source):
    """What is left of a cell that cannot run as a whole."""
    try:
        body = _compiled(source, "cell", ast.PyCF_ONLY_AST).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    return [ast.unparse(statement) for statement in body if _defines(statement)]


def _defines(statement):
    if isinstance(statement, ast.Assign | ast.AnnAssign):
        try:
            ast.literal_eval(statement.value)
            return True
        except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError):
            return False
    kinds = (ast.Import, ast.ImportFrom, ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    return isinstance(statement, kinds)


def code_of(source, name="cell"):
    """The code of a cell that is plain Python, else None."""
    try:
        return compile(source, name, "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT, dont_inherit=True)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _compiled(source, name, flags=0):
    """The code of a cell, translated where it is no plain Python. (The other way round, each plain cell would
    be translated in vain.)"""
    flags |= ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
    try:
        return compile(source, name, "exec", flags, dont_inherit=True)
    except (SyntaxError, ValueError):
        return compile(ipython.translate(source), name, "exec", flags, dont_inherit=True)


def _run(code, names):
    """Runs the code of a cell, and awaits what it awaits."""
    result = eval(code, names)
    if inspect.iscoroutine(result):
        asyncio.run(result)


class Shell:
    """What `get_ipython()` gives: magics and system commands that do nothing, cell magics that run their
    cell."""

    def __init__(self, namespace):
        self.namespace, self.user_ns = namespace, namespace.names

    def run_line_magic(self, magic, line, *rest):
        options = OPTIONS.match(line.strip())
        line = OPTIONS.sub("", line.strip())
        if magic not in RUN_THEIR_CELL or not line:
            return None
        try:
            code = compile(line, "magic", "eval")
        except SyntaxError:  # no expression: `%time x = 1`
            return _run(_compiled(line, "magic"), self.user_ns)
        result = eval(code, self.user_ns)
        if magic == "time":
            return result
        return absent.INERT_THING if options and "-o" in options[0] else None  # how long it took

    def run_cell_magic(self, magic, line, cell):
        if magic == "capture" and (name := line.split("-")[0].strip()):
            self.user_ns[name] = absent.INERT_THING  # what was printed, if anybody asks
        if magic in RUN_THEIR_CELL:
            _run(_compiled(cell, "cell"), self.user_ns)

    def run_cell(self, cell, *rest, **options):
        self.namespace.run(cell)

    def getoutput(self, command, *rest, **options):
        return []

    def __getattr__(self, name):
        return absent.INERT_THING
