"""The students' bundle holds no solution, oracle, generator or seed; its checks work on visible answers."""

import ast
import io
import json
import os
import re
import subprocess
import sys
import zipfile

import pytest

from exercises.grader.cells import read_cells
from exercises.grader.classroom import release
from exercises.grader.marking import mark
from exercises.grader.replies import encode
from exercises.grader.shell import check_cells
from tests.exercises.exercise_support import UNITS
from tests.grading.class_support import UNIT, PlainBox, notebook, solution

pytestmark = pytest.mark.xdist_group("bundle")  # which is made once


@pytest.fixture(scope="module")
def bundle(tmp_path_factory):
    out = tmp_path_factory.mktemp("bundle")
    list(release.release(out))
    with zipfile.ZipFile(out / "course.zip") as archive:
        archive.extractall(out)
    return out


def texts(bundle):
    return {
        path: path.read_text(encoding="utf-8")
        for path in bundle.rglob("*")
        if path.suffix not in (".zip", "")
    }


def statements(path):
    """Each statement within a function of a file, long enough to be told apart, as it is written."""
    source = path.read_text(encoding="utf-8")
    for function in ast.walk(ast.parse(source)):
        for node in ast.walk(function) if isinstance(function, ast.FunctionDef) else ():
            if isinstance(node, (ast.Assign, ast.Return, ast.AugAssign, ast.Yield)):
                text = " ".join(ast.get_source_segment(source, node).split())
                if len(text) > 35:
                    yield text


@pytest.mark.parametrize("unit", UNITS, ids=lambda unit: unit.slug)
def test_no_solution_oracle_or_mistake_is_in_the_bundle(unit, bundle):
    handed_out = {f"{unit.slug}.ipynb", "given.py"}
    kept_back = [path for path in unit.folder.rglob("*.py") if path.name not in handed_out]
    assert kept_back
    names = {path.name for path in bundle.rglob("*")}
    assert not names & {path.name for path in kept_back if path.name != "checks.py"}
    assert not names & {"solutions", "mistakes", "recordings.py", "classroom", "tests", "sandbox"}
    assert not [
        path for path in bundle.rglob("*") if "recordings" in path.parts and "exercises" in path.parts
    ]
    everything = "\n".join(" ".join(text.split()) for text in texts(bundle).values())
    for path in kept_back:
        assert not leaks(unit, path, everything), path.name
        whole = everything + " ".join(path.read_text(encoding="utf-8").split())
        assert leaks(unit, path, whole) or path.parent.name == "mistakes"  # a leak would be seen


def leaks(unit, path, everything):
    """Statements of a file that stand in a text, those aside that the handed-out helpers hold too."""
    given = " ".join((unit.folder / "given.py").read_text(encoding="utf-8").split())
    return [text for text in statements(path) if text in everything and text not in given]


def test_no_generator_seed_or_hidden_case_is_in_the_bundle(bundle, tmp_path):
    from exercises.grader.classroom.cases import class_seed

    secret = str(class_seed(tmp_path))
    in_exercises = texts(bundle / "course" / "exercises")
    for path, text in texts(bundle).items():
        assert secret not in text, path
    for path, text in in_exercises.items():
        if UNIT.slug in path.parts:
            assert not re.search(r"default_rng|\bstream\b|\bhidden\b|EngineOracle", text), path
    data = json.loads((bundle / "course/exercises" / UNIT.slug / "checks.json").read_text(encoding="utf-8"))
    kept = {encode_of(case["values"]) for check in data["checks"] for case in check["cases"]}
    assert kept == {encode(case.values) for check in UNIT.checks for case in check.visible}
    assert not kept & {encode(case.values) for check in UNIT.checks for case in check.cases(2) if case.hidden}


def encode_of(packed):
    return json.dumps(packed)


def in_bundle(bundle, *arguments):
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=bundle / "course",
        env=environment,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


@pytest.mark.parametrize(
    "slip", [None, *UNIT.mistakes[::6]], ids=lambda slip: slip.path.stem if slip else "right"
)
def test_the_bundles_checks_say_what_ours_say_of_visible_cases(slip, bundle, tmp_path):
    cells = solution(0, *([slip.path] if slip else []))
    (tmp_path / "mine.ipynb").write_text(notebook(cells), encoding="utf-8")
    record = tmp_path / "record.json"
    done = in_bundle(
        bundle, "-m", "exercises.grader.shell", "--unit", "02", tmp_path / "mine.ipynb", "--json", record
    )
    box = PlainBox(UNIT.slug)
    box.load(notebook(cells))
    expected = {}
    for check in UNIT.checks:
        visible = [one for one in mark(check, box.ask).outcomes if not one.case.hidden]
        expected[check.name] = all(one.verdict.passed for one in visible)
    assert json.loads(record.read_text())["passed"] == expected, done.stdout + done.stderr


def test_the_bundle_works_where_there_is_no_engine(bundle):
    code = (
        "import sys; sys.modules.update(pymunk=None, pybullet=None)\n"
        "from exercises import load; given, check = load('02')\n"
        "def plate(outline, holes, density):\n    return 1.0\ncheck('plate')"
    )
    done = in_bundle(bundle, "-c", code)
    assert "FAILED  plate" in done.stdout and "answers kept in this copy" in done.stdout, done.stderr


@pytest.mark.parametrize("command", [["grade", "x"], ["release"], ["collect", "x.zip"]])
def test_instructors_commands_are_not_in_the_bundle(command, bundle):
    done = in_bundle(bundle, "course.py", *command)
    assert done.returncode == 2 and "students' copy" in done.stderr


def test_the_bundles_pages_lead_somewhere(bundle):
    course = bundle / "course"
    for page in [*course.glob("*.md"), *course.glob("lectures/*.md"), *course.glob("notebooks/*.ipynb")]:
        text = page.read_text(encoding="utf-8")
        if page.suffix == ".ipynb":  # code may look like a link
            cells = json.loads(text)["cells"]
            text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
            text = re.sub(r"`[^`]*`", "", text)
        for link in re.findall(r"\]\(([^)#:]+?)(?:#[^)]*)?\)", text):
            assert (page.parent / link).exists() or "$" in link or "\\\\" in link, (page.name, link)


def test_nbgraders_layout_and_metadata(bundle):
    book = json.loads((bundle / "release" / UNIT.slug / f"{UNIT.slug}.ipynb").read_text(encoding="utf-8"))
    marks = [cell["metadata"]["nbgrader"] for cell in book["cells"] if "nbgrader" in cell["metadata"]]
    graded = {mark["grade_id"]: mark["points"] for mark in marks if mark["grade"]}
    assert graded == {check.name: check.points for check in UNIT.checks}
    assert sum(mark["solution"] for mark in marks) == len(UNIT.checks)
    assert all(mark["schema_version"] == 3 for mark in marks)
    starter = json.loads(UNIT.starter.read_text(encoding="utf-8"))
    assert [cell["source"] for cell in book["cells"]] == [cell["source"] for cell in starter["cells"]]
    results, _ = check_cells(UNIT.slug, read_cells(UNIT.starter), bundle, show=lambda text: None)
    assert not any(result.passed for result in results)


def test_the_same_bundle_twice(bundle):
    again = release._zip(dict(release.bundle()))
    assert again == (bundle / "course.zip").read_bytes()
    assert all(name.startswith("course/") for name in zipfile.ZipFile(io.BytesIO(again)).namelist())
