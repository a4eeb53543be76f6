"""The store: what is finished stays finished, whatever interrupts; no score falls by itself."""

import dataclasses
import json
import os
import signal
import subprocess
import sys
import time

import pytest

import exercises
from exercises.grader.classroom import cases, files, results
from tests.grading.class_support import UNIT, PlainBox, grade, notebook, plant, solution, use_plain_boxes

# A run that grades slowly, as a process that can be killed.
SLOW_RUN = """
import sys, time
from tests.grading import class_support as support
class Slow(support.PlainBox):
    def load(self, data, *task):
        time.sleep(0.3)
        super().load(data, *task)
support.workers.open_box = lambda unit, unsafe: Slow(unit)
support.workers.probe = lambda: ("bubblewrap", "")
support.grade(sys.argv[1])
"""


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    use_plain_boxes(monkeypatch)


@pytest.fixture
def few_checks(monkeypatch):
    """Two checks of the unit, and a way to change them."""
    checks = exercises.part(UNIT.slug, "checks")
    monkeypatch.setattr(checks, "CHECKS", UNIT.checks[1:3])

    def change(points):
        changed = dataclasses.replace(checks.CHECKS[0], points=points)
        monkeypatch.setattr(checks, "CHECKS", (changed, *checks.CHECKS[1:]))
        monkeypatch.setattr(cases, "check_hash", lambda unit: f"changed to {points}")
        from exercises.grader.classroom import job

        monkeypatch.setattr(job, "check_hash", lambda unit: f"changed to {points}")
        job.checks_of.cache_clear()

    yield change
    from exercises.grader.classroom import job

    job.checks_of.cache_clear()


def result_files(folder):
    return {path: path.stat().st_mtime_ns for path in (folder / "instructor/results").rglob("*.json")}


def test_a_killed_run_goes_on_where_it_stopped(tmp_path):
    plant(tmp_path, {f"student{i:02}": solution(i % 2) for i in range(12)})
    process = subprocess.Popen([sys.executable, "-c", SLOW_RUN, str(tmp_path)], cwd=exercises.FOLDER.parent)
    deadline = time.monotonic() + 60
    while len(result_files(tmp_path)) < 4 and time.monotonic() < deadline:
        time.sleep(0.02)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    before, loaded = result_files(tmp_path), PlainBox.loaded
    assert 4 <= len(before) < 12 and not (tmp_path / "scores.csv").exists()
    for path in before:
        json.loads(path.read_text())  # whole, each of them
    scores, told = grade(tmp_path)
    assert f"{12 - len(before)} submissions to grade" in told and PlainBox.loaded - loaded == 12 - len(before)
    assert {path: when for path, when in result_files(tmp_path).items() if path in before} == before
    assert len(scores) == 12 and all(score.final == 100 for score in scores.values())
    assert "submissions to grade" not in grade(tmp_path)[1]


def test_a_half_written_file_is_no_result(tmp_path):
    plant(tmp_path, {"ada": solution(0)})
    grade(tmp_path)
    path = next(iter(result_files(tmp_path)))
    path.write_text(path.read_text()[:100])
    assert grade(tmp_path)[0]["ada"].final == 100


def test_writing_is_all_or_nothing(tmp_path, monkeypatch):
    files.write(tmp_path / "a.json", "old")
    monkeypatch.setattr(os, "fsync", lambda number: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        files.write(tmp_path / "a.json", "new")
    assert (tmp_path / "a.json").read_text() == "old"


def test_a_new_notebook_is_graded_and_the_old_score_noted(tmp_path):
    plant(tmp_path, {"ada": solution(0), "bob": solution(1)})
    grade(tmp_path)
    (tmp_path / "submitted/ada" / UNIT.slug / f"{UNIT.slug}.ipynb").write_text(notebook(solution(0)[:3]))
    scores, told = grade(tmp_path)
    assert "1 submissions to grade" in told and scores["ada"].final == UNIT.checks[0].points
    history = [json.loads(line) for line in (tmp_path / "instructor/history.jsonl").read_text().splitlines()]
    assert [(line["student"], line["old"]["earned"], line["new"]["earned"]) for line in history] == [
        ("ada", 100, 15)
    ]


def test_regrade_lists_old_and_new_and_lowers_nothing(tmp_path, few_checks):
    plant(tmp_path, {"ada": solution(0), "bob": ["x = 1"]})
    assert grade(tmp_path)[0]["ada"].final == 25
    few_checks(4)
    scores, told = grade(tmp_path)
    assert scores["ada"].final == 25 and "2 finished results were made with other checks" in told
    scores, told = grade(tmp_path, regrade=True)
    assert scores["ada"].final == 25 and "ada: 25 → 19; the old one is kept" in told and "bob" not in told
    assert "Regraded 2: 1 differ" in told
    few_checks(30)
    scores, told = grade(tmp_path, regrade=True)
    assert scores["ada"].final == 45 and "ada: 25 → 45" in told and "kept" not in told
    few_checks(4)
    scores, told = grade(tmp_path, regrade=True, allow_lower=True)
    assert scores["ada"].final == 19 and "ada: 45 → 19" in told
    what = [
        json.loads(line)["what"] for line in (tmp_path / "instructor/history.jsonl").read_text().splitlines()
    ]
    assert what.count("kept the old one: the new one is lower") == 1


def test_a_failed_regrade_takes_no_score_away(tmp_path, monkeypatch):
    plant(tmp_path, {"ada": solution(0)})
    grade(tmp_path)
    monkeypatch.setattr(PlainBox, "ask", lambda self, text: 1 / 0)
    scores, told = grade(tmp_path, regrade=True)
    assert scores["ada"].final == 100 and "ada: 100 → blank (grader_error); the old one is kept" in told


def test_results_say_with_what_they_were_made(tmp_path):
    plant(tmp_path, {"ada": solution(0)})
    grade(tmp_path)
    result = json.loads(next(iter(result_files(tmp_path))).read_text())
    assert result["checks_hash"] == cases.check_hash(UNIT.slug) and result["environment"]["numpy"]
    assert result["isolation"] == "bubblewrap" and len(result["notebook"]) == 64 and result["cases"]


def test_only_our_own_failures_have_no_points():
    checks = [{"earned": 3}, {"earned": 4}]
    assert results.earned({"status": "timeout", "checks": checks}) == 7
    assert results.earned({"status": "grader_error", "checks": checks}) is None
    assert results.is_lower({"status": "ok", "checks": checks}, {"status": "grader_error", "checks": []})
    assert not results.is_lower({"status": "grader_error", "checks": []}, {"status": "ok", "checks": []})


# A process of the grader that dies, as an engine's crash would make it.
DYING_RUN = """
import json, os, sys, time
from exercises.grader.classroom import job, local
def grade(text):
    number = json.loads(text)["number"]
    once = os.path.join(sys.argv[1], "once")
    if number == 3 or number == 5 and not os.path.exists(once):
        open(once, "w").close() if number == 5 else None
        os.kill(os.getpid(), 9)
    return json.dumps({"status": "ok", "number": number})
job.grade = grade
if __name__ == "__main__":
    payloads = ((number, json.dumps({"number": number})) for number in range(10))
    results = [(key, json.loads(text)["status"]) for key, text in local.run(payloads, 2, sys.argv[1])]
    print(json.dumps(sorted(results)))
"""


def test_a_process_that_dies_costs_no_neighbour(tmp_path):
    script = tmp_path / "run.py"
    script.write_text(DYING_RUN)
    environment = dict(os.environ, PYTHONPATH=str(exercises.FOLDER.parent))
    done = subprocess.run(
        [sys.executable, script, tmp_path], capture_output=True, text=True, env=environment, check=False
    )
    statuses = dict(json.loads(done.stdout))
    assert statuses == {number: "grader_error" if number == 3 else "ok" for number in range(10)}, done.stderr
