"""Code cells of a file, and running them one after the other in a plain namespace, as a notebook would.

A file is a notebook (.ipynb) or a script whose cells begin with `# %%`. IPython's own syntax (%magic,
!command, name?) is translated by IPython's transformer and then does nothing, but for the magics that only
measure or catch what a cell does: their cell runs. A cell that raises doesn't stop the later ones.
"""

import ast
import asyncio
import inspect
import json
import linecache
import re
import types

from exercises.grader.worker import describe

RUN_THEIR_CELL = {"time", "timeit", "capture", "prun", "memit", "python", "python3"}


class Unreadable(ValueError):
    """The file is no notebook and no script."""


def read_cells(path):
    """The source of each code cell of a .ipynb or .py file, in order."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise Unreadable(f"{path} cannot be read: {error}") from None
    if path.suffix != ".ipynb":
        return [cell for cell in re.split(r"(?m)^# %%.*$", text) if cell.strip()]
    try:
        cells = [cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
        return ["".join(cell["source"]) for cell in cells]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise Unreadable(f"{path} is not a notebook: its JSON has no list of cells") from None


class Namespace:
    """Where cells run: one module's names, with what a notebook finds there."""

    def __init__(self):
        self.module = types.ModuleType("__main__")
        self.names = self.module.__dict__
        self.names.update(display=lambda *things, **options: None, get_ipython=lambda: Shell(self))

    def run(self, source, name="cell"):
        """Runs one cell. None, or the exception as `describe` tells it."""
        try:
            tree = ast.parse(_as_python(source), name)
            linecache.cache[name] = (
                len(source),
                None,
                source.splitlines(keepends=True),
                name,
            )  # lines for tracebacks
            code = compile(tree, name, "exec", flags=ast.PyCF_ALLOW_TOP_LEVEL_AWAIT)
            result = eval(code, self.names)
            if inspect.iscoroutine(result):
                asyncio.run(result)
        except BaseException as error:
            return describe(error)
        return None


def _as_python(source):
    try:
        compile(source, "cell", "exec", flags=ast.PyCF_ALLOW_TOP_LEVEL_AWAIT)
        return source
    except (SyntaxError, ValueError):
        from IPython.core.inputtransformer2 import (
            TransformerManager,  # takes time to import: only where needed
        )

        return TransformerManager().transform_cell(source)


class Shell:
    """What `get_ipython()` gives: magics and system commands that do nothing, cell magics that run their
    cell."""

    def __init__(self, namespace):
        self.namespace, self.user_ns = namespace, namespace.names

    def run_line_magic(self, magic, line, *rest):
        if magic in RUN_THEIR_CELL and line.strip():
            exec(compile(_as_python(line), "magic", "exec"), self.user_ns)

    def run_cell_magic(self, magic, line, cell):
        if magic in RUN_THEIR_CELL:
            exec(compile(_as_python(cell), "cell", "exec"), self.user_ns)

    def __getattr__(self, name):
        return lambda *arguments, **options: None
