"""The shell: exit codes, odd cells, cells that hang or kill; and the same score as in a notebook."""

import ast
import inspect
import json
import re
import subprocess
import sys

import nbformat
import pytest
from nbclient import NotebookClient

import exercises
from exercises.grader import shell
from exercises.grader.cells import Namespace, Unreadable, read_cells
from exercises.grader.student import StudentProcess
from tests.exercises.exercise_support import UNITS, silent

UNIT = UNITS[0]
SOLUTION = UNIT.solutions[0]
each_unit = pytest.mark.parametrize("unit", UNITS, ids=lambda unit: unit.slug)


def run(*arguments):
    root = exercises.FOLDER.parent
    command = [sys.executable, "-m", "exercises.grader.shell", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, encoding="utf-8", cwd=root, check=False)


def notebook_of(cells, path):
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbformat.write(book, path)
    return path


# --- exit codes and the record ------------------------------------------------------------------------------


def test_all_passed_is_0_and_the_record_is_written(tmp_path):
    done = run("--unit", "2", SOLUTION, "--json", tmp_path / "record.json")
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == "" and done.stdout.splitlines()[-1] == "100 of 100 points"
    names = {check.name: True for check in UNIT.checks}
    record = {"unit": UNIT.slug, "earned": 100, "possible": 100, "passed": names}
    assert json.loads((tmp_path / "record.json").read_text()) == record


def test_some_failed_is_1(tmp_path):
    done = run("--unit", UNIT.slug, UNIT.starter, "--json", tmp_path / "record.json")
    assert done.returncode == 1 and json.loads((tmp_path / "record.json").read_text())["earned"] == 0


@pytest.mark.parametrize("text", [None, "no notebook", "[]", '{"cells": 1}', '{"cells": [1]}', "[" * 100_000])
def test_what_cannot_be_read_is_2(tmp_path, text):
    path = tmp_path / "file.ipynb"
    if text is not None:
        path.write_text(text)
    done = run("--unit", "02", path)
    assert done.returncode == 2 and "file.ipynb" in done.stderr and "Traceback" not in done.stderr


def test_an_unknown_unit_is_2():
    done = run("--unit", "77", SOLUTION)
    assert done.returncode == 2 and "unit '77' has no exercise here; there is: 02_" in done.stderr


def test_another_notebook_is_2_and_one_line(tmp_path):
    cells = ["import math", "plate = 3\nx = plate", "def other(): pass", "1/0"]
    done = run("--unit", "02", notebook_of(cells, tmp_path / "teaching.ipynb"))
    assert done.returncode == 2 and done.stdout == "", done.stdout
    assert done.stderr.startswith("This is not a copy of exercise 02: ") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("cell", ["def plate(\n", "plate = lambda *all: None", "1/0\ndef plate(): pass"])
def test_a_function_begun_is_enough(tmp_path, cell):
    done = run("--unit", "02", notebook_of(["x = 1", cell], tmp_path / "mine.ipynb"))
    assert done.returncode == 1 and "not a copy" not in done.stderr


def test_our_own_fault_is_2(monkeypatch, capsys):
    monkeypatch.setattr(shell, "check_cells", lambda *arguments: 1 / 0)
    assert shell.main(["--unit", "02", str(SOLUTION)]) == 2
    assert "not a fault of the checked file" in capsys.readouterr().err


# --- cells --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "cell, name, value",
    [
        ("%matplotlib inline\nx = 1", "x", 1),
        ("x = %time 2", "x", 2),
        ("%%time\nx = 3", "x", 3),
        ("%%capture out\nx = 4", "x", 4),
        ("%%writefile nowhere.txt\nx = 5", "x", None),
        ("!ls\nx = 6", "x", 6),
        ("x = !ls", "x", []),
        ("len?\n", "x", None),
        ("if True:\n    %timeit 1\n    x = 7", "x", 7),
        ("import asyncio\nawait asyncio.sleep(0)\nx = 8", "x", 8),
        ("display(1)\nget_ipython().run_line_magic('load_ext', 'autoreload')\nx = 9", "x", 9),
        ("x = 10;", "x", 10),
        ("%%time\nimport asyncio\nawait asyncio.sleep(0)\nx = 11", "x", 11),
        ("%%capture out --no-stderr\n%matplotlib inline\nx = 12", "x", 12),
        ("%time x = await __import__('asyncio').sleep(0, 13)", "x", 13),
        ("import math\nmath.sin?\nmath??\n*.pi*?\nx = 14", "x", 14),
        ("x = %pwd", "x", None),
        ("!!ls\n%cd /\n%env A=1\n%who\nx = 15", "x", 15),
        ("if True:\n    %matplotlib inline\n    files = !ls *.py\n    x = len(files) + 16", "x", 16),
        ("async def g():\n    yield 17\nx = [i async for i in g()][0]", "x", 17),
        ("y = %timeit -o -n1 -r1 1 + 1\ny.best\nx = 18", "x", 18),
        ("get_ipython().run_cell('%time x = 19')", "x", 19),
        ("get_ipython().run_cell_magic('time', '', 'x = 20')", "x", 20),
        (">>> x = 22\n>>> y = 4", "x", 22),
        ("  x = 23\n  y = 5", "x", 23),
        ('x = """\n%time 1\n!ls\n"""', "x", "\n%time 1\n!ls\n"),
        ("%%javascript\nalert(1)", "x", None),
        ("", "x", None),
    ],
)
def test_odd_cells_run(cell, name, value):
    namespace = Namespace()
    assert namespace.run(cell) is None
    assert namespace.names.get(name) == value


@pytest.mark.parametrize(
    "cell, kind", [("1/0", "ZeroDivisionError"), ("def", "SyntaxError"), ("exit()", "SystemExit")]
)
def test_a_cell_that_raises_is_told(cell, kind):
    assert Namespace().run(cell)["kind"] == kind


def test_cells_of_a_script_and_of_a_notebook(tmp_path):
    script = tmp_path / "a.py"
    script.write_text("# header\n\n# %%\nx = 1\n\n# %% [two]\ny = 2\n")
    assert read_cells(script) == ["# header\n\n", "\nx = 1\n\n", "\ny = 2\n"]
    assert read_cells(notebook_of(["x = 1", "y = 2"], tmp_path / "a.ipynb")) == ["x = 1", "y = 2"]
    with pytest.raises(Unreadable):
        read_cells(tmp_path / "none.ipynb")


def test_odd_notebooks_earn_their_right_score(tmp_path):
    odd = [
        "1/0",
        "%matplotlib inline\n!echo",
        "check()",
        "import sys; sys.stdout.close()",
        "print('{\"replies\": 1}')",
        "import os; os.write(1, b'{}\\n')",
        "input()",
        "this is no Python",
        "import reference; reference.simulate()",
    ]
    done = run("--unit", "02", notebook_of([*odd, *read_cells(SOLUTION), *odd], tmp_path / "odd.ipynb"))
    assert done.returncode == 0, done.stdout
    assert "code cell 1 (1/0) did not run to its end" in done.stdout and "ZeroDivisionError" in done.stdout


def test_cells_that_hang_or_kill_cost_only_themselves(tmp_path):
    cells = ["while True: pass", "import os; os._exit(3)", *read_cells(SOLUTION)]
    results, troubles = shell.check_cells(UNIT.slug, cells, tmp_path, limit=4.0, show=lambda text: None)
    assert all(result.passed for result in results)
    assert [number for number, _ in troubles] == [1, 2]
    assert "longer than 4 s" in troubles[0][1] and "exit code 3" in troubles[1][1]


def test_a_function_that_hangs_or_kills_costs_only_its_check(tmp_path):
    bad = (
        "def plate(*arguments):\n    while True: pass\ndef body_rate(*arguments):\n    import os; os._exit(4)"
    )
    results, _ = shell.check_cells(
        UNIT.slug, [*read_cells(SOLUTION), bad], tmp_path, limit=4.0, show=lambda text: None
    )
    assert [result.check.name for result in results if not result.passed] == ["plate", "body_rate"]


def test_no_process_is_left(tmp_path):
    process = StudentProcess(UNIT.slug, ["x = 1"], tmp_path)
    process.close()
    assert process.process.poll() is not None


# --- one score everywhere -----------------------------------------------------------------------------------


def functions_in(cell):
    """The names of the functions that a cell defines."""
    return [node.name for node in ast.parse(cell).body if isinstance(node, ast.FunctionDef)]


def functions_of(path):
    """Source of a script's cells, by the function that it defines."""
    return {name: cell for cell in read_cells(path) for name in functions_in(cell)}


def filled(unit, *paths):
    """The starter as a student would hand it in: each unwritten function's cell is that of the solution,
    whose imports and helpers come first."""
    book, written = nbformat.read(unit.starter, as_version=4), {}
    for path in paths:
        written.update(functions_of(path))
    asked = set()
    for cell in book.cells:
        begins = re.match(r"def (\w+)\(", cell.source)
        if cell.cell_type == "code" and begins and begins.group(1) in written:
            cell.source = "import math\n" + written[begins.group(1)]
            asked.add(begins.group(1))
    first = next(k for k, cell in enumerate(book.cells) if cell.cell_type == "code")
    others = [cell for path in paths for cell in read_cells(path) if not asked & set(functions_in(cell))]
    book.cells[first + 1 : first + 1] = [nbformat.v4.new_code_cell(cell) for cell in others]
    return book


def passed_in_notebook(book, folder):
    """Names of the checks that pass where the notebook's own last cell, check(), runs in a kernel."""
    NotebookClient(
        book, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    ).execute()
    assert book.cells[-1].cell_type == "markdown"
    text = "".join(output.get("text", "") for output in book.cells[-2].outputs)
    return set(re.findall(r"^passed +(\w+):", text, re.M)), text


@each_unit
@pytest.mark.parametrize("kind", ["starter", "solution", pytest.param("mistake", marks=pytest.mark.slow)])
def test_notebook_and_shell_give_the_same_score(unit, kind, tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(exercises.FOLDER.parent))
    paths = {
        "starter": [],
        "solution": unit.solutions[:1],
        "mistake": [unit.solutions[0], unit.mistakes[-1].path],
    }
    path = tmp_path / "mine.ipynb"
    nbformat.write(filled(unit, *paths[kind]), path)
    in_notebook, text = passed_in_notebook(nbformat.read(path, as_version=4), tmp_path)
    done = run("--unit", unit.slug, path, "--json", tmp_path / "record.json")
    record = json.loads((tmp_path / "record.json").read_text())
    assert in_notebook == {name for name, passed in record["passed"].items() if passed}, done.stdout
    assert (
        text.splitlines()[-1]
        == done.stdout.splitlines()[-1]
        == f"{record['earned']} of {record['possible']} points"
    )
    if kind != "mistake":
        assert record["earned"] == (0 if kind == "starter" else record["possible"])
    else:
        assert set(record["passed"]) - in_notebook == set(unit.mistakes[-1].loses)


@each_unit
def test_pictures_are_drawn_for_students_alone(unit):
    """Where a class is graded, show_… calls nothing; other helpers, and those of a notebook, stay."""
    given = exercises.part(unit.slug, "given")
    with silent():
        silenced, _ = exercises.load(unit.slug)
    pictures = [name for name in vars(given) if name.startswith("show_")]
    for name in pictures:
        assert getattr(silenced, name)(None, None, None) is None
        assert exercises.load(unit.slug)[0] is given
        with pytest.raises(TypeError):  # None cannot be called
            getattr(given, name)(*[None] * len(inspect.signature(getattr(given, name)).parameters))
    assert all(vars(silenced)[name] is value for name, value in vars(given).items() if name not in pictures)


def test_check_in_a_namespace(capsys):
    with pytest.raises(ValueError, match="unit 99"):
        exercises.load(99)
    given, check = exercises.load(2)
    assert exercises.load("02")[0] is given and exercises.load("02_equation_of_motion")[0] is given
    assert check("no such check") is None
    assert "There is no check 'no such check'" in capsys.readouterr().out
    assert "body_rate" not in globals()
    check("body_rate")
    assert "body_rate is not defined" in capsys.readouterr().out


def test_what_a_hanging_cell_defines_is_kept(tmp_path):
    cells = [
        *read_cells(SOLUTION),
        "half = 0.5\ndef twice(x): return 2 * x\nwhile True: pass",
        "assert twice(half) == 1",
    ]
    results, troubles = shell.check_cells(UNIT.slug, cells, tmp_path, limit=4.0, show=lambda text: None)
    assert all(result.passed for result in results)
    assert [number for number, _ in troubles] == [len(cells) - 1] and "definitions" in troubles[0][1]
