"""Notebooks as they are committed (no outputs, stable ids, cells that fit on a screen) and as they run."""

import ast
import copy
import json
import os
import re
import sys
import time
import warnings
from pathlib import Path, PurePosixPath
from typing import NamedTuple

import nbformat
from jupyter_client.kernelspec import KernelSpec
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

from . import tree

SECONDS_WARM = 20  # DESIGN, section 3: "under 20 s warm"
CELLS = (25, 40)
LINES, LINES_TAGGED = 15, 40
MACHINE_PATH = re.compile(r"(?<![\w.~/])/(?:root|home|work|tmp|Users|private|var|opt|mnt)/|\b[A-Z]:\\\w")


class Cell(NamedTuple):
    """One cell: what a fault calls it, and what it holds."""

    number: int
    kind: str
    source: str
    tags: tuple
    raw: dict

    @property
    def name(self):
        return f"cell {self.number} ({self.raw.get('id', 'no id')})"


def cells(path):
    """The cells of a notebook, numbered from 1 as a reader counts them."""
    found = []
    for number, raw in enumerate(json.loads(Path(path).read_text(encoding="utf-8"))["cells"], 1):
        source = raw["source"] if isinstance(raw["source"], str) else "".join(raw["source"])
        found.append(
            Cell(number, raw["cell_type"], source, tuple(raw.get("metadata", {}).get("tags", ())), raw)
        )
    return found


def code(cell):
    """The syntax tree of a code cell; lines meant for IPython (`%`, `!`) count as comments."""
    return ast.parse(re.sub(r"(?m)^[%!].*$", "", cell.source))


def teaching(root):
    return [file for file in tree.tracked(root, ".ipynb") if file.parent == PurePosixPath("notebooks")]


def exercises(root):
    """The exercises' starters: exercises/UNIT/UNIT.ipynb."""
    found = tree.tracked(root, ".ipynb")
    return [file for file in found if file.parts[0] == "exercises" and file.stem == file.parent.name]


# --- as committed -------------------------------------------------------------------------------------------


def committed_faults(root, file):
    """What no notebook of the house may have: outputs, counts, unstable ids, metadata of one machine."""
    path = Path(root) / file
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
        with warnings.catch_warnings(
            action="ignore"
        ):  # of ids, which nbformat would mend; we judge them below
            nbformat.validate(copy.deepcopy(raw))
    except (ValueError, nbformat.ValidationError) as problem:
        return [f"{file}: not a valid notebook: {str(problem).splitlines()[0]}"]
    faults = []
    if (raw["nbformat"], raw["nbformat_minor"]) < (4, 5):
        faults.append(f"{file}: nbformat is {raw['nbformat']}.{raw['nbformat_minor']}, must be 4.5 or later")
    metadata = raw["metadata"]
    kernel = metadata.get("kernelspec", {}).get("name")
    if kernel != "python3":
        faults.append(f"{file}: the kernel is {kernel!r}, must be 'python3'")
    language = metadata.get("language_info", {}).get("name")
    if language != "python":
        faults.append(
            f"{file}: language_info.name is {language!r}, must be 'python', or ruff passes the notebook by"
        )
    unknown = set(metadata) - {"kernelspec", "language_info", "title", "authors", "nbgrader"}
    if unknown or len(json.dumps(metadata)) > 1000:
        faults.append(f"{file}: notebook metadata beyond kernel and language: {sorted(unknown)}")
    faults += _id_faults(file, raw)
    for cell in cells(path):
        faults += [f"{file}: {cell.name} {fault}" for fault in _cell_faults(cell)]
    return faults


def _id_faults(file, raw):
    ids = [cell.get("id") for cell in raw["cells"]]
    faults = [] if all(ids) else [f"{file}: cell {ids.index(None) + 1} has no id"]
    faults += [
        f"{file}: two cells have the id {name!r}"
        for name in sorted({i for i in ids if ids.count(i) > 1 and i})
    ]
    # Eight hexadecimal digits are what nbformat draws anew each time a script builds the notebook.
    drawn = [name for name in ids if name and re.fullmatch(r"[0-9a-f]{8}", name)]
    if drawn:
        faults.append(f"{file}: ids drawn by a script, not stable: {', '.join(drawn[:3])}")
    return faults


def _cell_faults(cell):
    if cell.raw.get("outputs"):
        yield "has outputs: clear them before committing"
    if cell.raw.get("execution_count") is not None:
        yield "has an execution count: clear it before committing"
    if len(json.dumps(cell.raw["metadata"])) > 500:
        yield "has more than 500 characters of metadata"
    if MACHINE_PATH.search(cell.source):
        yield f"names a path of one machine: {MACHINE_PATH.search(cell.source).group()}"
    if cell.kind == "code":
        try:
            code(cell)
        except SyntaxError as problem:
            yield f"is not Python: {problem}"


# --- as a lesson --------------------------------------------------------------------------------------------


def lesson_faults(root, file):
    """What a teaching notebook promises (DESIGN, section 3)."""
    found = cells(Path(root) / file)
    faults = []
    if not CELLS[0] <= len(found) <= CELLS[1]:
        faults.append(f"{file}: {len(found)} cells, must be {CELLS[0]} to {CELLS[1]}")
    faults += [f"{file}: {fault}" for fault in _opening_faults(root, file, found)]
    for cell in found:
        limit = LINES_TAGGED if any(tag.startswith("ref:") for tag in cell.tags) else LINES
        lines = sum(1 for line in cell.source.splitlines() if line.strip())
        if cell.kind == "code" and lines > limit:
            faults.append(f"{file}: {cell.name} has {lines} lines of code, at most {limit} fit")
    importing = [cell.name for cell in found if cell.kind == "code" and _imports(cell)]
    if len(importing) != 1:
        faults.append(
            f"{file}: imports must stand in one cell, but stand in {', '.join(importing) or 'none'}"
        )
    return faults + [f"{file}: {fault}" for fault in _step_faults(found)]


def _opening_faults(root, file, found):
    title = str(
        tree.front_matter(root, PurePosixPath("lectures", f"{file.stem}.md")).get("title", "(no page)")
    )
    first = found[0] if found else None
    if first is None or first.kind != "markdown" or not first.source.startswith("# "):
        return ["the first cell must be text that opens with the unit's title"]
    faults = []
    if title.lower() not in first.source.splitlines()[0].lower():
        faults.append(f"the title {first.source.splitlines()[0]!r} is not that of the page, {title!r}")
    if "objectives" not in (first.source + found[1].source * (found[1].kind == "markdown")).lower():
        faults.append("the opening does not state the objectives")
    return faults


def _imports(cell):
    return any(isinstance(node, (ast.Import, ast.ImportFrom)) for node in ast.walk(code(cell)))


def _asserts(cell):
    for node in ast.walk(code(cell)):
        name = getattr(node.func, "attr", getattr(node.func, "id", "")) if isinstance(node, ast.Call) else ""
        if isinstance(node, ast.Assert) or name.startswith("assert_"):
            return True
    return False


def sections(found):
    """[(heading, cells below it)] by second-level headings; what stands before the first is left out."""
    parts = []
    for cell in found:
        heading = re.search(r"(?m)^## +(.+)$", cell.source) if cell.kind == "markdown" else None
        if heading:
            parts.append((heading.group(1).strip(), []))
        if parts:
            parts[-1][1].append(cell)
    return parts


def _step_faults(found):
    parts = sections(found)
    for word in ("engine", "recap", "on your own"):
        if not any(word in heading.lower() for heading, _ in parts):
            yield f"no section on {word!r} (a second-level heading)"
    steps = 0
    for heading, inside in parts:
        working = [cell for cell in inside if cell.kind == "code" and not _imports(cell)]
        if not working or "on your own" in heading.lower():
            continue
        steps += 1
        if not any(_asserts(cell) for cell in working):
            yield f"the step {heading!r} asserts nothing"
    if not 5 <= steps <= 10:  # 5-8 steps, and the engine's; one spare for a recap that computes
        yield f"{steps} steps with code, must be 5 to 8 and the engine's"


# --- as it runs ---------------------------------------------------------------------------------------------


class Run(NamedTuple):
    seconds: float  # by the clock, the kernel's start included
    cpu: float  # of the kernel's process
    fault: str  # empty where all cells ran
    warnings: str  # what the cells wrote to standard error
    wordless: list  # the cells that showed a picture without a description (view.show gives it one)


class OwnKernel(AsyncKernelManager):
    """The kernel of the interpreter that runs the tests, whatever is installed under `python3` elsewhere."""

    @property
    def kernel_spec(self):
        argv = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        return KernelSpec(argv=argv, display_name="Python 3", language="python")


def run(root, file, folder, timeout=300):
    """Run a copy of the notebook in a fresh kernel that works in `folder`, outside the repository."""
    folder = Path(folder)
    book = nbformat.read(Path(root) / file, as_version=4)
    book.cells.append(nbformat.v4.new_code_cell("import time as _t; print(_t.process_time())"))
    environment = dict(os.environ, PYTHONPATH=str(Path(root).resolve()), IPYTHONDIR=str(folder / ".ipython"))
    environment.pop("MPLBACKEND", None)  # pictures as in the browser, though other tests draw none
    client = NotebookClient(
        book,
        timeout=timeout,
        kernel_name="python3",
        kernel_manager_class=OwnKernel,
        force_raise_errors=True,  # the tag raises-exception excuses nothing
        resources={"metadata": {"path": str(folder)}},
    )
    start, fault = time.perf_counter(), ""
    try:
        client.execute(env=environment)
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as problem:
        fault = f"{file}: {type(problem).__name__}: {_plain(str(problem))[-1500:]}"
    seconds = time.perf_counter() - start
    cpu = 0.0 if fault else float(book.cells[-1].outputs[0].text)
    return Run(seconds, cpu, fault, _stderr(book), wordless(book))


def wordless(book):
    """The numbers of the cells whose pictures have no `alt` text of at least four words beside them."""
    found = []
    for number, cell in enumerate(book.cells, 1):
        for output in cell.get("outputs", []) if cell.cell_type == "code" else ():
            data = output.get("data", {})
            page = data.get("text/html", "")
            pictures = re.findall(r"<(?:img|svg|video|canvas)\b[^>]*", page)
            drawn = any(kind.startswith("image/") for kind in data)
            words = [re.search(r"""\b(?:alt|aria-label)=["']([^"']*)""", tag) for tag in pictures[:1]]
            if (drawn or pictures) and not (words and words[0] and len(words[0].group(1).split()) > 3):
                found.append(number)
    return found


def _plain(words):
    return re.sub(r"\x1b\[[0-9;]*m", "", words)


def _stderr(book):
    outputs = [out for cell in book.cells if cell.cell_type == "code" for out in cell.get("outputs", [])]
    return "".join(out.text for out in outputs if out.output_type == "stream" and out.name == "stderr")
