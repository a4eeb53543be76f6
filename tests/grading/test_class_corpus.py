"""A class that is out to cheat: the whole corpus in one run, between honest neighbours."""

import hashlib
import json
import resource

import pytest

from exercises.grader.classroom import workers
from exercises.grader.sandbox import Sandbox, probe
from tests.grading import corpus_support as corpus
from tests.grading.class_support import UNIT, feedback, grade, plant
from tests.grading.test_class_feedback import parsed

NEIGHBOURS = ("a_first", "m_between", "z_last")
MOST_MEMORY = 400  # MB of the grader's own process, at the end


def fingerprints(folder):
    return {
        path: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.rglob("*") if path.is_file()
    }


@pytest.mark.study
def test_the_corpus_as_a_class(tmp_path, monkeypatch):
    if probe().kind is None:
        pytest.skip(probe().sentence())
    hostile = {one.notebook() for one in corpus.HOSTILE}

    class Box(Sandbox):
        """Hostile ones get less time: many only wait for its end."""

        def load(self, source, *task):
            self.limits = corpus.SHORT if source in hostile else corpus.QUICK
            return super().load(source, *task)

    monkeypatch.setattr(workers, "open_box", lambda unit, unsafe: Box(unit, unsafe=unsafe))
    students = {f"h_{one.name}": (one, "0") for one in corpus.HOSTILE}
    students |= {f"o_{one.name}": (one, "100") for one in corpus.HONEST}
    plant(tmp_path, {student: one.notebook() for student, (one, _) in students.items()})
    plant(tmp_path, dict.fromkeys(NEIGHBOURS, corpus.RIGHT))
    handed_in = fingerprints(tmp_path)
    scores, _ = grade(tmp_path, seed=2)
    expected = {student: one.header("Earns", usual) for student, (one, usual) in students.items()}
    expected |= dict.fromkeys(NEIGHBOURS, "100")
    assert {student: str(score.final) for student, score in scores.items()} == expected
    assert all(score.status != "grader_error" for score in scores.values())
    assert {path: mark for path, mark in fingerprints(tmp_path).items() if path in handed_in} == handed_in
    for student in scores:
        parsed(feedback(tmp_path, student))
    parsed((tmp_path / "instructor" / "overview.html").read_text(encoding="utf-8"))
    kept = (tmp_path / "instructor" / "results" / UNIT.slug).glob("*.json")
    assert all(json.loads(path.read_text(encoding="utf-8"))["checks"] for path in kept)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024 < MOST_MEMORY
