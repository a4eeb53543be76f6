"""Scores: the same everywhere, exact, and nothing hidden gets out."""

import dataclasses
import json
import stat

import numpy as np
import pytest

import exercises
from exercises.grader.check import SELF_STUDY_SEED
from exercises.grader.classroom import cases, job, workers
from exercises.grader.marking import mark
from exercises.grader.replies import encode
from exercises.grader.shell import check_cells
from tests.grading.class_support import (
    UNIT,
    PlainBox,
    feedback,
    grade,
    mistake,
    notebook,
    plant,
    solution,
    use_plain_boxes,
)


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    use_plain_boxes(monkeypatch)


def test_a_class_gets_its_right_scores(tmp_path):
    slips = ["swing_damped", "kutta_is_rk4"]
    plant(
        tmp_path,
        {
            "ada": solution(0),
            "bob": solution(1),
            "cy": ["1/0", *solution(0, *(mistake(name).path for name in slips))],
            "dee": UNIT.starter.read_text(encoding="utf-8"),
            "eve": "{]",
            "flo": b"\xff\xfe\x00",
        },
    )
    (tmp_path / "submitted" / "gus" / UNIT.slug).mkdir(parents=True)
    scores, _ = grade(tmp_path, seed=5)
    lost = {name for slip in slips for name in mistake(slip).loses}
    expected = 100 - sum(check.points for check in UNIT.checks if check.name in lost)
    assert {name: score.final for name, score in scores.items()} == {
        "ada": 100,
        "bob": 100,
        "cy": expected,
        "dee": 0,
        "eve": 0,
        "flo": 0,
        "gus": 0,
    }
    assert [scores[name].status for name in ("ada", "eve", "flo", "gus")] == [
        "ok",
        "rejected",
        "rejected",
        "missing",
    ]
    assert "ZeroDivisionError" in feedback(tmp_path, "cy") and "ZeroDivisionError" not in feedback(
        tmp_path, "ada"
    )


@pytest.mark.parametrize(
    "slip", [None, *UNIT.mistakes[::5]], ids=lambda slip: slip.path.stem if slip else "right"
)
def test_the_public_seed_gives_the_score_of_notebook_and_shell(slip, tmp_path):
    cells = solution(0, *([slip.path] if slip else []))
    shell, _ = check_cells(UNIT.slug, cells, tmp_path, show=lambda text: None)
    box = PlainBox(UNIT.slug)
    box.load(notebook(cells))
    in_notebook = [mark(check, box.ask).earned for check in UNIT.checks]  # what NotebookCheck does
    scores, _ = grade(plant(tmp_path, {"ada": cells}), seed=SELF_STUDY_SEED)
    assert [check["earned"] for check in scores["ada"].result["checks"]] == in_notebook
    assert [result.earned for result in shell] == in_notebook


def test_the_secret_seed_is_drawn_once(tmp_path):
    first, again = cases.class_seed(tmp_path / "a"), cases.class_seed(tmp_path / "a")
    assert first == again != cases.class_seed(tmp_path / "b") and first.bit_length() > 90
    assert stat.S_IMODE((tmp_path / "a" / "seed.json").stat().st_mode) == 0o600
    assert cases.class_seed(tmp_path / "a", 7) == 7 and cases.class_seed(tmp_path / "a") == first
    (tmp_path / "a" / "seed.json").write_text("{")
    with pytest.raises(cases.Trouble, match="--seed"):
        cases.class_seed(tmp_path / "a")


@pytest.mark.parametrize("seed", [0, SELF_STUDY_SEED, 2**127 + 1])
def test_saved_cases_are_the_drawn_ones(seed, tmp_path):
    text = cases.saved_cases(UNIT.slug, seed, tmp_path)
    for drawn, saved in zip(UNIT.checks, cases.with_cases(UNIT.checks, text), strict=True):
        pairs = zip(drawn.cases(seed), saved.cases(0), strict=True)
        assert all(encode(a.values) == encode(b.values) and a.hidden == b.hidden for a, b in pairs)


def test_saved_cases_outlive_the_generators(tmp_path, monkeypatch):
    text = cases.saved_cases(UNIT.slug, 3, tmp_path)
    others = tuple(dataclasses.replace(check, hidden=lambda stream: []) for check in UNIT.checks)
    monkeypatch.setattr(exercises.part(UNIT.slug, "checks"), "CHECKS", others)
    assert cases.saved_cases(UNIT.slug, 3, tmp_path) == text
    assert cases.saved_cases(UNIT.slug, 4, tmp_path) != text


class OnlyVisible(PlainBox):
    """Right on visible cases, wrong on all others: as one who has copied the visible answers."""

    def load(self, data, *task):
        super().load(data, *task)
        self.known = {
            json.dumps([call.function, [encode(argument) for argument in call.arguments]])
            for check in UNIT.checks
            for case in check.visible
            for call in check.calls_of(case)
        }

    def ask(self, text):
        calls, replies = json.loads(text)["calls"], json.loads(super().ask(text))["replies"]
        for call, reply in zip(calls, replies, strict=True):
            if (
                json.dumps([call["function"], [json.dumps(one) for one in call["arguments"]]])
                not in self.known
            ):
                reply["value"] = 0.125
                reply["printed"] = "SECRET"
        return json.dumps({"replies": replies})


def test_visible_answers_alone_earn_nothing_and_nothing_hidden_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(workers, "open_box", lambda unit, unsafe: OnlyVisible(unit))
    scores, _ = grade(plant(tmp_path, {"ada": solution(0)}))
    result, page = scores["ada"].result, feedback(tmp_path, "ada")
    assert scores["ada"].final == 0 and all(check["hidden"] for check in result["checks"])
    told = (
        json.dumps(result["checks"])
        + page
        + (tmp_path / "instructor/gradescope" / UNIT.slug / "ada/results.json").read_text()
    )
    assert not any(
        key in check for check in result["checks"] for key in ("expected", "call", "curves", "printed")
    )
    assert "SECRET" not in told and "0.125" not in told
    seed = str(cases.class_seed(tmp_path / "instructor"))
    for hidden in json.loads(next((tmp_path / "instructor/cases").iterdir()).read_text())["hidden"].values():
        for _, values in hidden:
            numbers = [repr(item) for item in _numbers(values)]
            assert seed not in told and not [
                number for number in numbers if len(number) > 5 and number in told
            ]


def _numbers(packed):
    """All numbers in packed data, those of arrays too."""
    if isinstance(packed, dict) and "array" in packed:
        from exercises.grader.replies import unpack

        yield from np.ravel(unpack(packed)).tolist()
    elif isinstance(packed, (dict, list)):
        for item in packed.values() if isinstance(packed, dict) else packed:
            yield from _numbers(item)
    elif isinstance(packed, float):
        yield packed


class Raising(PlainBox):
    def ask(self, text):
        raise OSError("the disk of the grader is full")


def test_our_own_failure_is_blank_and_tried_again(tmp_path, monkeypatch):
    plant(tmp_path, {"ada": solution(0)})
    with monkeypatch.context() as broken:
        broken.setattr(workers, "open_box", lambda unit, unsafe: Raising(unit))
        scores, told = grade(tmp_path)
    assert (
        scores["ada"].status == "grader_error" and scores["ada"].final is None and "tries those again" in told
    )
    row = (tmp_path / "scores.csv").read_text().splitlines()[1].split(",")
    assert row[7:10] == ["", "", ""] and row[11] == "grader_error"
    assert "no fault of yours" in feedback(tmp_path, "ada") and "disk" not in feedback(tmp_path, "ada")
    gradescope = json.loads((tmp_path / "instructor/gradescope" / UNIT.slug / "ada/results.json").read_text())
    assert "score" not in gradescope and "tests" not in gradescope
    assert grade(tmp_path)[0]["ada"].final == 100


def test_a_judge_that_raises_is_our_failure():
    def judge(values, answers):
        raise ZeroDivisionError

    broken = dataclasses.replace(UNIT.checks[0], judge=judge)
    text = job.payload(UNIT.slug, notebook(solution(0)).encode(), cases.draw(UNIT.slug, 1), [])
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(job, "checks_of", lambda unit, text: [broken])
        result = json.loads(job.grade(text))
    assert result["status"] == "grader_error" and "ZeroDivisionError" in result["reason"]


class Refusing(PlainBox):
    def load(self, data, *task):
        super().load(data, *task)
        self.status, self.reason = "rejected", "the worker ended"


def test_a_sandbox_that_refuses_everyone_gives_nobody_a_0(tmp_path, monkeypatch):
    plant(tmp_path, {"ada": solution(0)})
    monkeypatch.setattr(workers, "open_box", lambda unit, unsafe: Refusing(unit))
    score = grade(tmp_path)[0]["ada"]
    assert (score.status, score.final) == ("grader_error", None) and "innocent" in score.result["reason"]


def test_another_machine_with_other_checks_does_not_grade():
    data = json.loads(job.payload(UNIT.slug, b"{}", "{}", []))
    result = json.loads(job.grade(json.dumps({**data, "checks": "other"})))
    assert result["status"] == "grader_error" and "other checks" in result["reason"]
