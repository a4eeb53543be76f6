"""The command as an instructor types it, with the real sandbox."""

import json
import os
import resource
import signal
import subprocess
import sys
import time

import pytest

import exercises
from exercises.grader.classroom import cases, job
from exercises.grader.marking import mark
from exercises.grader.shell import check_cells
from tests.grading.class_support import UNIT, PlainBox, feedback, mistake, notebook, plant, solution

ROOT = exercises.FOLDER.parent
MOST_OVERHEAD = 1.6  # CPU of a submission beyond its own code, in starts of a Python with NumPy


def command(*arguments, environment=(), **options):
    environment = dict(os.environ, COURSE_PYTHON=sys.executable, **dict(environment))
    return subprocess.Popen(
        [sys.executable, str(ROOT / "course.py"), *map(str, arguments)],
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", **options,
    )  # fmt: skip


def run(*arguments, **options):
    process = command(*arguments, **options)
    out, error = process.communicate(timeout=300)
    if "Nothing was graded" in error:
        pytest.skip(f"no sandbox works here: {error}")
    return process.returncode, out, error


def test_one_command_grades_a_class(tmp_path):
    slip = mistake("swing_damped")
    hang = "def plate(*arguments):\n    while True:\n        pass"
    plant(tmp_path, {
        "ada": solution(1),
        "bob": ["%matplotlib inline", "1/0", *solution(0, slip.path)],
        "eve": [*solution(0), hang],
        "flo": "no notebook",
    })  # fmt: skip
    (tmp_path / "roster.csv").write_text("id\nada\nbob\neve\nflo\ngus\n")
    code, out, error = run("grade", tmp_path.name, "--seed", "2", "--jobs", "2", cwd=tmp_path.parent)
    assert code == 0, out + error
    rows = [line.split(",") for line in (tmp_path / "scores.csv").read_text().splitlines()[1:]]
    scores = {row[3]: (row[9], row[11]) for row in rows}
    shell, _ = check_cells(UNIT.slug, solution(0, slip.path), tmp_path, show=lambda text: None)
    assert scores == {
        "ada": ("100", "ok"),
        "bob": (str(sum(result.earned for result in shell)), "ok"),
        "eve": ("85", "timeout"),
        "flo": ("0", "rejected"),
        "gus": ("0", "missing"),
    }
    assert "4 of 4 graded" in error and "5 submissions" in out
    similar = (tmp_path / "instructor" / "similar.csv").read_text().splitlines()
    assert any("bob" in row and "eve" in row for row in similar[1:])  # the same solution, told from numbers
    result = json.loads((tmp_path / "instructor/results" / UNIT.slug / "ada.json").read_text())
    assert result["isolation"] in ("bubblewrap", "landlock")
    before = (tmp_path / "scores.csv").read_bytes()
    code, out, _ = run("grade", tmp_path)
    assert code == 0 and "to grade" not in out and (tmp_path / "scores.csv").read_bytes() == before


def test_without_a_sandbox_nothing_is_graded_unless_told(tmp_path):
    plant(tmp_path, {"ada": ["x = 1"]})
    without = {"GRADER_WITHOUT": "bubblewrap,landlock"}
    process = command("grade", tmp_path, environment=without)
    _, error = process.communicate(timeout=120)
    assert process.returncode == 2 and "Nothing was graded" in error and "no sandbox works here" in error
    assert not (tmp_path / "scores.csv").exists()
    code, out, error = run("grade", tmp_path, "--unsafe-no-sandbox", "--jobs", "1", environment=without)
    assert code == 0 and "1 unsandboxed" in out, error
    assert ",unsandboxed," in (tmp_path / "scores.csv").read_text()
    assert "NO SANDBOX" in (tmp_path / "instructor/overview.html").read_text(encoding="utf-8")
    assert "without a sandbox" in feedback(tmp_path, "ada")


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [1, 2])
def test_ctrl_c_ends_it_soon_and_the_next_run_goes_on(jobs, tmp_path):
    slow = "import time\ntime.sleep(0.5)"
    plant(tmp_path, {f"student{i}": [*solution(0)[:3], slow] for i in range(6)})
    process = command("grade", tmp_path, "--jobs", jobs, start_new_session=True)
    results = tmp_path / "instructor" / "results" / UNIT.slug
    deadline = time.monotonic() + 120
    while not list(results.glob("*.json")) and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does
    began = time.monotonic()
    _, error = process.communicate(timeout=60)
    if "Nothing was graded" in error:
        pytest.skip(f"no sandbox works here: {error}")
    assert process.returncode == 130 and "goes on from there" in error and "Traceback" not in error, error
    assert time.monotonic() - began < 30
    done = len(list(results.glob("*.json")))
    assert 1 <= done < 6
    code, out, _ = run("grade", tmp_path, "--jobs", jobs)
    assert code == 0 and f"{6 - done} submissions to grade" in out
    assert (tmp_path / "scores.csv").read_text().count(",ok,") == 6


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def by_heart(cells):
    """The cells, and one more that knows the answers which they give: their own code takes no time."""
    answers, box = {}, PlainBox(UNIT.slug)
    box.load(notebook(cells))

    def ask(text):
        answer, calls = box.ask(text), json.loads(text)["calls"]
        for call, reply in zip(calls, json.loads(answer)["replies"], strict=True):
            answers.setdefault(call["function"], []).append(json.dumps(reply["value"]))
        return answer

    for check in job.checks_of(UNIT.slug, cases.draw(UNIT.slug, 2)):
        mark(check, ask)
    known = "\n".join(f"{name} = said(known[{name!r}])" for name in answers)
    return [*cells, f"{TELLER}\nknown = json.loads({json.dumps(answers)!r})\n{known}"]


TELLER = """
import itertools, json
from exercises.grader.replies import unpack


def said(answers):
    turn = itertools.count()
    return lambda *arguments: unpack(json.loads(answers[next(turn)]))
"""


@pytest.mark.slow
def test_what_grading_costs_beyond_oracles_and_own_code(tmp_path):
    """300 submissions may take 60 s, so one 0.2 s: told in starts of a Python, since machines differ."""
    few, more = 4, 40
    cells = [by_heart(solution(i)) for i in (0, 1)]
    plant(tmp_path / "few", {f"student{i:02}": [*cells[i % 2], f"note = {i}"] for i in range(few)})
    plant(tmp_path / "more", {f"student{i:02}": [*cells[i % 2], f"note = {i}"] for i in range(more)})
    used = {}
    for name in ("few", "more"):  # few: the start, the oracles, and some submissions
        began = cpu_of_children()
        run("grade", tmp_path / name, "--jobs", "1", "--seed", "2")
        used[name] = cpu_of_children() - began
        assert ",100," in (tmp_path / name / "scores.csv").read_text()
    began = cpu_of_children()
    for _ in range(9):
        subprocess.run([sys.executable, "-c", "import numpy"], check=True)
    start = (cpu_of_children() - began) / 9
    beyond = (used["more"] - used["few"]) / (more - few)
    print(f"beyond oracles and own code: {beyond:.3f} s a submission, {beyond / start:.2f} starts of Python")
    assert beyond < MOST_OVERHEAD * start
