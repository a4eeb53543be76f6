"""Pages and tables that go out: whatever a student writes stays text."""

import html.parser
import json
import math
import re

import numpy as np
import pytest

from exercises.grader.check import Call, Case
from exercises.grader.classroom import curve, exports, feedback, overview, scores, similarity
from exercises.grader.classroom.files import Trouble, read_table
from exercises.grader.classroom.fingerprint import of_cells
from exercises.grader.classroom.roster import Manual, Roster
from exercises.grader.classroom.submissions import Submission
from exercises.grader.classroom.told import told
from exercises.grader.judges import Verdict
from exercises.grader.marking import Failure, Outcome, Result
from tests.grading.class_support import UNIT, grade, mistake, notebook, plant, solution, use_plain_boxes
from tests.grading.class_support import feedback as page_of

HOSTILE = (
    "</pre></svg></title></style><script>alert(1)</script><img src=x onerror=alert(1)>\"' onload=x "
    "javascript:x \x1b[2J\x1b]8;;http://evil\x07\x00\x9b31m\u202e{{7*7}}&lt;&#x3c;script> <!-- ]]> \ud800"
)
TAGS = set(
    "html head meta title style body h1 h2 h3 p b table tr th td pre section ul li code div".split()  # noqa: SIM905
    + ["svg", "path", "text", "tspan", "rect"]
)


class Strict(html.parser.HTMLParser):
    """Fails on any tag or attribute that is not ours, and collects the text."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.words, self.tags = [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        assert tag in TAGS, tag
        for name, value in attributes:
            assert not name.startswith("on") and name not in (
                "src",
                "href",
                "xlink:href",
                "style",
                "action",
            ), name
            assert name == "aria-label" or not re.search("script|<", (value or "").lower())

    def handle_comment(self, data):
        raise AssertionError(data)

    def handle_data(self, data):
        self.words.append(data)


def parsed(text):
    assert text.startswith("<!DOCTYPE html>") and "Content-Security-Policy" in text[:300]
    assert "default-src 'none'" in text and "script-src" not in text
    assert not re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\ud800-\udfff]", text)
    strict = Strict()
    strict.feed(text)
    strict.close()
    assert {"script", "img"}.isdisjoint(strict.tags)
    return " ".join(strict.words)


def everything_hostile():
    """A Score all of whose texts are hostile."""
    check = {
        **dict.fromkeys(
            ("name", "title", "source", "case", "call", "expected", "got", "printed", "complaint", "error")
            + ("tolerance", "why", "form", "section", "cause"),
            HOSTILE,
        ),
        "points": 5,
        "earned": 0,
        "passed": False,
        "cases": 2,
        "failing": 1,
        "hidden": False,
        "unwritten": False,
        "lines": [HOSTILE],
        "curves": [[[[0, 1.0], [1, 2.0]]], [[[0, None], [1, 1e99]]]],
    }
    result = {
        "status": "crashed",
        "reason": HOSTILE,
        "details": HOSTILE,
        "isolation": HOSTILE,
        "environment": {HOSTILE: HOSTILE},
        "checks": [check],
        "troubles": [[1, HOSTILE, HOSTILE, True]],
        "fingerprint": {"numbers": [], "hints": [HOSTILE]},
    }
    one = Submission(HOSTILE, UNIT.slug)
    return scores.Score(one, "crashed", result, 0, 5, Manual(0, HOSTILE), None, None, 0)


def test_hostile_text_in_every_field_stays_text(tmp_path):
    score = everything_hostile()
    words = parsed(feedback.of_score(score))
    assert words.count("alert(1)") >= 2 * 15  # all of it is told, none of it obeyed
    other = Submission("other", UNIT.slug)
    people = Roster([{"id": "x", "first_name": HOSTILE}])
    overview.write_all([score], [(1.0, score.submission, other)], people, tmp_path)
    assert parsed((tmp_path / "overview.html").read_text(encoding="utf-8")).count("alert(1)") >= 6
    answer = json.loads(exports.gradescope(score))
    assert (
        "\x1b" not in json.dumps(answer, ensure_ascii=False) and answer["tests"][0]["output_format"] == "text"
    )
    assert "\x1b" not in (tmp_path / "similar.csv").read_text(encoding="utf-8")


def test_hostile_answers_stay_text(tmp_path, monkeypatch):
    use_plain_boxes(monkeypatch)
    shout = (
        "class Evil(Exception):\n    pass\nEvil.__name__ = '<script>x</script>'\n"
        "def plate(*a):\n    print(TEXT)\n    raise Evil(TEXT)\n"
        "def body_rate(*a):\n    print(TEXT)\n    return {TEXT: 1.0}\n"
        "def air_force(*a):\n    return TEXT\n"
        "def swing(*a):\n    return np.full(41, 1e308)\n"
        "def march(*a):\n    return tuple(tuple([0.0] * 50) for i in range(50))\n"
        "raise Evil(TEXT)\n"
    )
    text = HOSTILE.replace("\ud800", "")
    plant(tmp_path, {"<b>eve": [*solution(0), f"TEXT = {text!r}\n{shout}"], "=1+1": ["<script>", "x ="]})
    grade(tmp_path)
    words = parsed(page_of(tmp_path, "<b>eve"))
    assert "alert(1)" in words and "<script>x</script>" in words
    parsed(page_of(tmp_path, "=1+1"))
    parsed((tmp_path / "instructor/overview.html").read_text(encoding="utf-8"))
    assert (
        "\n02_equation_of_motion,,2" in (table := (tmp_path / "scores.csv").read_text())
        and ",'=1+1," in table
    )


def result_of(verdict, case=None, printed=""):
    check = UNIT.checks[-1]
    case = case or check.visible[0]
    return Result(check, [Outcome(case, [Call("swing", (1, 2))], verdict, printed)])


def test_hidden_cases_tell_neither_question_nor_answer():
    hidden = Case("label", {"x": 41.25}, hidden=True)
    for got in (np.arange(9.0), 3.25, Failure("E41.25", "41.25", ("41.25",)), None, "41.25"):
        data = told(result_of(Verdict(1.0, 1e-9, 41.25, got, "41.25", "41.25"), hidden, "41.25"))
        assert "41.25" not in json.dumps(data) and not {"call", "expected", "curves", "printed"} & set(data)
        assert data["why"] and data["cause"] and data["section"]


def test_a_failed_visible_check_tells_all_and_draws(tmp_path, monkeypatch):
    use_plain_boxes(monkeypatch)
    grade(plant(tmp_path, {"ada": solution(0, mistake("swing_damped").path)}))
    text = page_of(tmp_path, "ada")
    words = parsed(text)
    for row in (
        "expected",
        "got",
        "tolerance",
        "why that tolerance",
        "likely cause",
        "read",
        "call",
        "What engines do",
    ):
        assert row in words
    drawing = text[text.index("<svg") : text.index("</svg>")]
    assert drawing.count("<path") == 3 and drawing.count("L") > 50
    assert len(text) < 60_000


@pytest.mark.parametrize(
    "got",
    [
        np.full(41, np.nan),
        np.full(41, np.inf),
        np.full(41, 1e308),
        np.zeros((41, 3)),
        np.zeros(41, dtype=int),
        np.zeros(10**6),
        np.full(41, -1e-320),
        np.zeros((0, 0)),
        np.zeros((5, 0)),
        np.float64(3),
        np.zeros((41, 2, 1)),
    ],
)
def test_any_numbers_can_be_drawn_or_are_left_out(got):
    data = told(result_of(Verdict(1.0, 1e-9, np.linspace(0, 1, len(np.atleast_1d(got))), got)))
    drawing = curve.svg(data["curves"], "x") if "curves" in data else ""
    assert len(json.dumps(data)) < 50_000 and len(drawing) < 20_000
    assert not re.search(r"nan|inf", drawing.lower().replace("font", ""))


def test_a_plot_takes_numbers_only():
    good = [[0, 1.0], [1, 2.0]]
    for bad in ("<script>", True, [1], math.inf, {"a": 1}):
        assert curve.svg([[good], [[[0, bad], [1, 1.0]]]], "x") == ""
    assert "<script" not in curve.svg([[good], [good]], "<script>")


# --- the class as a whole -----------------------------------------------------------------------------------


def test_the_overview_counts(tmp_path, monkeypatch):
    use_plain_boxes(monkeypatch)
    slip = mistake("body_rate_no_half")
    plant(
        tmp_path,
        {"ada": solution(0), "bob": solution(1), "cy": solution(1, slip.path), "dee": solution(0, slip.path)},
    )
    (tmp_path / "roster.csv").write_text("id\nada\nbob\ncy\ndee\neve\n")
    grade(tmp_path)
    words = parsed((tmp_path / "instructor/overview.html").read_text(encoding="utf-8"))
    assert "mean 95.0, median 95, least 90, most 100" in words and "Missing: eve" in words
    assert re.search(r"2\s+body_rate\s+The factor ½ is missing", words)
    grade(tmp_path, anonymous=True)
    for name in ("overview.html", "similar.csv"):
        text = (tmp_path / "instructor" / name).read_text(encoding="utf-8")
        assert not re.search(r"\b(ada|bob|cy|dee|eve)\b", text) and "student 1" in text


def renamed(cells):
    """The same code as someone would disguise it: names, spacing and comments changed."""
    changed = []
    for cell in cells:
        for old, new in (("angle", "phi"), ("rate", "speed_of"), ("omega", "w_"), ("area", "a_r_e_a")):
            cell = re.sub(rf"\b{old}\b", new, cell)
        changed.append("# my own work\n" + cell.replace("    return", "    # so\n    return"))
    return changed


def test_near_identical_code_is_listed_and_the_starter_is_not(tmp_path, monkeypatch):
    use_plain_boxes(monkeypatch)
    starter = UNIT.starter.read_text(encoding="utf-8")
    plant(
        tmp_path,
        {"ada": solution(0), "bob": solution(1), "cy": renamed(solution(0)), "dee": starter, "eve": starter},
    )
    grade(tmp_path)
    rows = (tmp_path / "instructor/similar.csv").read_text().splitlines()[1:]
    assert [row.split(",")[2:] for row in rows] == [["ada", "cy"]]
    for student in ("ada", "cy"):
        assert (
            "similar" not in page_of(tmp_path, student).lower()
            and "cy" not in page_of(tmp_path, "ada").split()
        )
    assert not [path for path in (tmp_path / "feedback").rglob("*") if "similar" in path.name]


def test_a_group_of_copies_is_listed_however_large():
    numbers = {Submission(f"s{i}", UNIT.slug): set(range(100)) for i in range(50)}
    assert len(list(similarity._same(numbers))) == 49


@pytest.mark.parametrize("cells", [["x = ("], ["\x00"], ["'''"], ["x" * 10**6], ["(" * 5000], ["\ud800"], []])
def test_code_that_is_none_has_numbers_all_the_same(cells):
    answer = of_cells(cells, b"{", [])
    assert isinstance(answer["numbers"], list) and answer["hints"] == []


def test_nbgraders_metadata_earn_nothing_and_are_shown(tmp_path, monkeypatch):
    use_plain_boxes(monkeypatch)
    mark = {"grade": True, "grade_id": "another_exercise", "points": 1000, "solution": False, "locked": True}
    plant(tmp_path, {"ada": notebook(["x = 1"], nbgrader=mark)})
    scores, _ = grade(tmp_path)
    assert scores["ada"].final == 0 and scores["ada"].most == 100
    assert "another_exercise" in (tmp_path / "instructor/overview.html").read_text(encoding="utf-8")


def test_nbgraders_metadata_are_hints():
    cells = {"cells": [{"metadata": {"nbgrader": {"grade": True, "grade_id": "plate", "points": 1000}}}, {}]}
    assert of_cells([], json.dumps(cells).encode(), [])["hints"] == ["plate"]
    for odd in ('{"cells": 5}', '{"cells": [5]}', '{"cells": [{"metadata": 3}]}', "[" * 10**5):
        assert of_cells([], odd.encode(), [])["hints"] == []


# --- other systems ------------------------------------------------------------------------------------------

CANVAS = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Exercise 02 (4711),Exercise 12 (4712),Final Score\n"
    ",,,,,Manual Posting,,\n    Points Possible,,,,,100,100,(read only)\n"
    '"Lovelace, Ada",1,ada,ada@x,A,,,\n=cmd|\' /C calc\'!A0,2,u2,bob@x,A,55,,\n"Third, C",3,u3,cy@x,A,12,,\n'
)


def marked(tmp_path, monkeypatch):
    use_plain_boxes(monkeypatch)
    plant(tmp_path, {"ada": solution(0), "bob": ["x = 1"]})
    (tmp_path / "roster.csv").write_text("id,email,canvas_id\nada,ada@x,1\nbob,bob@x,2\n")


def test_canvas(tmp_path, monkeypatch):
    marked(tmp_path, monkeypatch)
    (tmp_path / "book.csv").write_text(CANVAS)
    _, told = grade(tmp_path, canvas=tmp_path / "book.csv")
    header, rows = read_table(tmp_path / "instructor/canvas.csv")
    assert header == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Exercise 02 (4711)"]
    assert rows[-2] == ["Lovelace, Ada", "1", "ada", "ada@x", "A", "100"]
    assert rows[-1] == ["'=cmd|' /C calc'!A0", "2", "u2", "bob@x", "A", "0"] and "Third" not in str(rows)
    assert "To import in Canvas" in told


def test_moodle(tmp_path, monkeypatch):
    marked(tmp_path, monkeypatch)
    (tmp_path / "book.csv").write_text(
        "First name,Last name,ID number,Email address,Assignment: Exercise 2 (Real),Course total (Real)\n"
        "Ada,L,,ada@x,-,-\nBob,B,bob,,-,-\n"
    )
    grade(tmp_path, moodle=tmp_path / "book.csv")
    header, rows = read_table(tmp_path / "instructor/moodle.csv")
    assert header[-1] == "Assignment: Exercise 2 (Real)" and [row[-1] for row in rows] == ["100", "0"]


def test_a_gradebook_whose_column_is_not_clear(tmp_path, monkeypatch):
    marked(tmp_path, monkeypatch)
    (tmp_path / "book.csv").write_text(CANVAS.replace("Exercise 02 (4711)", "Motion (4711)"))
    with pytest.raises(Trouble, match=r"assignments\.csv"):
        grade(tmp_path, canvas=tmp_path / "book.csv")
    (tmp_path / "assignments.csv").write_text(f"unit,canvas,moodle\n{UNIT.slug},Motion,\n")
    grade(tmp_path, canvas=tmp_path / "book.csv")
    assert read_table(tmp_path / "instructor/canvas.csv")[0][-1] == "Motion (4711)"


def test_our_own_failure_leaves_a_gradebooks_grade_alone(tmp_path, monkeypatch):
    marked(tmp_path, monkeypatch)
    from exercises.grader.classroom import job

    monkeypatch.setattr(job, "_grade", lambda job: 1 / 0)
    (tmp_path / "book.csv").write_text(CANVAS)
    grade(tmp_path, canvas=tmp_path / "book.csv")
    assert [row[-1] for row in read_table(tmp_path / "instructor/canvas.csv")[1]][-2:] == ["", "55"]
