"""What comes in: folders, archives, the instructor's tables. None of it is trusted."""

import datetime
import io
import os
import stat
import tracemalloc
import zipfile
from fractions import Fraction

import pytest

from exercises.grader.classroom import collect, files, roster, submissions
from exercises.grader.classroom.files import Trouble
from tests.grading.class_support import UNIT, grade, notebook, plant, solution, use_plain_boxes

BOOK = notebook(["x = 1"])


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    use_plain_boxes(monkeypatch)


# --- submitted/ ---------------------------------------------------------------------------------------------


def found(folder):
    return {one.student: one for one in submissions.find(folder / "submitted")[0]}


def test_links_and_odd_files_are_refused(tmp_path):
    (tmp_path / "secret.ipynb").write_text(BOOK)
    for student in ("file_link", "folder_link", "fifo", "large", "several", "named", "text_only", "hard"):
        (tmp_path / "submitted" / student).mkdir(parents=True)
    unit = {name: tmp_path / "submitted" / name / UNIT.slug for name in os.listdir(tmp_path / "submitted")}
    for name, folder in unit.items():
        if name != "folder_link":
            folder.mkdir()
    (unit["file_link"] / "a.ipynb").symlink_to(tmp_path / "secret.ipynb")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "a.ipynb").write_text(BOOK)
    unit["folder_link"].symlink_to(tmp_path / "elsewhere")
    os.mkfifo(unit["fifo"] / "a.ipynb")
    with open(unit["large"] / "a.ipynb", "wb") as file:
        file.truncate(submissions.LARGEST_NOTEBOOK + 1)
    for name in ("a.ipynb", "b.ipynb"):
        (unit["several"] / name).write_text(BOOK)
        (unit["named"] / name).write_text(BOOK)
    (unit["named"] / f"{UNIT.slug}.ipynb").write_text(BOOK)
    (unit["text_only"] / "a.py").write_text("x = 1")
    os.link(tmp_path / "secret.ipynb", unit["hard"] / "a.ipynb")
    scores, _ = grade(tmp_path)
    reasons = {name: (score.result or {}).get("reason", "") for name, score in scores.items()}
    assert "link" in reasons["file_link"] and "link" in reasons["folder_link"]
    assert "plain file" in reasons["fifo"] and "bytes" in reasons["large"]
    assert "2 notebooks" in reasons["several"] and "no notebook" in reasons["text_only"]
    assert {name for name, score in scores.items() if score.status == "ok"} == {"named", "hard"}
    assert all(score.final == 0 for score in scores.values())


def test_a_link_to_a_students_folder_is_left_out(tmp_path):
    plant(tmp_path, {"ada": ["x = 1"]})
    (tmp_path / "submitted" / "eve").symlink_to(tmp_path / "submitted" / "ada")
    (tmp_path / "submitted" / "notes.txt").write_text("mine")
    (tmp_path / "submitted" / "a\x1b[31mb").mkdir()
    scores, told = grade(tmp_path)
    assert set(scores) == {"ada"} and "'eve'" in told and "notes.txt" in told and "\x1b" not in told


@pytest.mark.parametrize(
    "name", ["", ".", "..", "-rf", "a/b", "a\\b", "a\nb", "a\x00b", "a\u202eb", "x" * 101, "a "]
)
def test_names_that_are_no_names(name):
    assert files.name_fault(name)


@pytest.mark.parametrize(
    "name", ["ada", "Müller, Jürgen", "o'neil", "李雷", "=1+1", '<b>"&', "a.b@c.de", "s-1"]
)
def test_names_that_are(name):
    assert not files.name_fault(name)


def test_text_for_a_terminal_obeys_nobody():
    hostile = "a\x1b[2Jb\x1b]0;title\x07c\x9b31md\x08e\u202ef\x00g\rh\u2028i\ud800"
    text = files.printable(hostile)
    assert text.startswith("abcd") and all(letter.isprintable() or letter == "\n" for letter in text)
    assert files.line("a\nb\tc") == "a b c" and len(files.printable("x" * 10**6, 100)) < 110


@pytest.mark.parametrize(
    "text", ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "＝1", " =1"]
)
def test_no_cell_is_a_formula(text):
    assert files.cell(text).startswith("'")


@pytest.mark.parametrize("text", ["-", "-3.5", "+2", "a=b", "ada", "", "12"])
def test_other_cells_stay(text):
    assert files.cell(text) == text


# --- archives -----------------------------------------------------------------------------------------------


def archive(path, members, flags=0):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in members:
            about = (
                name if isinstance(name, zipfile.ZipInfo) else zipfile.ZipInfo(name, (2026, 3, 4, 5, 6, 8))
            )
            about.compress_type = zipfile.ZIP_DEFLATED
            made.writestr(about, content)
    return path


def unpack(tmp_path, members, people=None, unit=None):
    path = archive(tmp_path / "in.zip", members)
    return collect.collect(path, tmp_path / "class", people, unit)


def files_in(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


def test_canvas_and_moodle_downloads(tmp_path):
    people = roster.Roster(
        [
            {"id": "ada", "canvas_id": "101", "moodle_id": "7"},
            {"id": "bob", "canvas_id": "102"},
            {"id": "cy", "first_name": "Cy", "last_name": "Twombly"},
        ]
    )
    slug = UNIT.slug
    written, notes = unpack(
        tmp_path,
        [
            (f"lovelaceada_101_5000_{slug}.ipynb", BOOK),
            (f"babbagebob_LATE_102_5001_{slug}-1.ipynb", BOOK),
            (f"Cy Twombly_99_assignsubmission_file_/{slug}.ipynb", BOOK),
            ("nobody_103_5002_02_x.ipynb", BOOK),
            ("lovelaceada_101_5000_notes.txt", "hello"),
            (f"__MACOSX/._lovelaceada_101_5000_{slug}.ipynb", "junk"),
            ("readme.ipynb", BOOK),
        ],
        people,
    )
    assert written == 3 and len(notes) == 2
    books = [name for name in files_in(tmp_path / "class" / "submitted") if name.endswith(".ipynb")]
    assert books == [f"{name}/{slug}/{slug}.ipynb" for name in ("ada", "bob", "cy")]
    scores, _ = grade(tmp_path / "class")
    assert scores["ada"].when.strftime("%Y-%m-%d %H:%M") == "2026-03-04 05:06"


def test_without_a_roster_the_archives_names_serve(tmp_path):
    written, _ = unpack(
        tmp_path, [("döe_jane_55_6_02 mine.ipynb", BOOK), ("x_5_6_a.ipynb", BOOK)], unit=UNIT.slug
    )
    names = {name.split("/")[0] for name in files_in(tmp_path / "class" / "submitted")}
    assert "x_5" in names and written >= 1


def test_the_last_of_several_is_taken_and_an_old_one_kept(tmp_path):
    unpack(tmp_path, [("a_1_10_02_x.ipynb", "old")])
    unpack(tmp_path, [("a_1_12_02_x.ipynb", "newest"), ("a_1_11_02_x.ipynb", "new")])
    path = tmp_path / "class" / "submitted" / "a_1" / UNIT.slug / f"{UNIT.slug}.ipynb"
    kept = list((tmp_path / "class/instructor/replaced").rglob("*.ipynb"))
    assert path.read_text() == "newest" and [one.read_text() for one in kept] == ["old"]


EVIL = [
    "../../evil_1_2_02_x.ipynb",
    "/etc/evil_1_2_02_x.ipynb",
    "..\\evil_1_2_02_x.ipynb",
    "C:\\evil_1_2_02_x.ipynb",
    "a/../../evil_1_2_02_x.ipynb",
    "//host/evil_1_2_02_x.ipynb",
    "evil_1_2_../../02_x.ipynb",
]


@pytest.mark.parametrize("name", EVIL)
def test_no_path_leads_out(name, tmp_path):
    before = files_in(tmp_path)
    written, notes = unpack(tmp_path, [(name, BOOK)])
    assert written == 0 and notes and files_in(tmp_path) == [*before, "in.zip"]


def test_hostile_names_stay_inside(tmp_path):
    unpack(
        tmp_path,
        [("..._1_2_02_x.ipynb", BOOK), ("-rf_1_3_02_x.ipynb", BOOK), ("\u202e\x1b[2J_1_4_02_x.ipynb", BOOK)],
    )
    for name in files_in(tmp_path / "class" / "submitted"):
        assert not files.name_fault(name.split("/")[0])


def test_long_names_do_not_fall_together(tmp_path):
    long = "a" * 120
    written, _ = unpack(tmp_path, [(f"{long}_1_2_02_x.ipynb", "one"), (f"{long}_2_3_02_x.ipynb", "two")])
    assert written == 2 and len(files_in(tmp_path / "class" / "submitted")) == 4  # with their times


def test_nobody_takes_anothers_place(tmp_path):
    """Who calls herself like another, or puts another's mark into a name, is nobody's notebook."""
    people = roster.Roster([{"id": "ada", "first_name": "Ada", "last_name": "Lovelace"}])
    members = [("lovelaceada_1_2_02_x.ipynb", "hers"), ("lovelaceada_7_9_02_x.ipynb", "not hers")]
    written, notes = unpack(tmp_path, members, people)
    assert written == 0 and "lovelaceada (1) and lovelaceada (7) would be the same" in notes[-1]
    eve = "Ada_1_assignsubmission_file__7_assignsubmission_file_/02_x.ipynb"
    written, notes = unpack(tmp_path, [(eve, "not hers")])
    assert written == 0 and "names two students" in notes[0]


def test_dates_that_there_are_not(tmp_path):
    """They come from the archive, and from nbgrader's note beside a notebook."""
    about = zipfile.ZipInfo("a_1_2_02_x.ipynb")
    about.date_time = (2026, 2, 31, 25, 61, 62)
    written, _ = unpack(tmp_path, [(about, BOOK)])
    place = tmp_path / "class" / "submitted" / "a_1" / UNIT.slug
    assert written == 1 and [path.name for path in place.iterdir()] == [f"{UNIT.slug}.ipynb"]
    one = submissions.Submission("a_1", UNIT.slug, place / f"{UNIT.slug}.ipynb")
    for text in (
        "0001-01-01 00:00",
        "9999-12-31 23:59 -12:00",
        "2026-02-31 10:00",
        "2026-01-01 10:00 +9999",
    ):
        (place / "timestamp.txt").write_text(text)
        assert roster.handed_in(one).year >= 2026


def test_links_in_archives(tmp_path):
    link = zipfile.ZipInfo("evil_1_2_02_x.ipynb")
    link.create_system, link.external_attr = 3, (stat.S_IFLNK | 0o777) << 16
    written, notes = unpack(tmp_path, [(link, "/etc/passwd")])
    assert written == 0 and "link" in notes[0]
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "class" / "submitted").mkdir(parents=True)
    (tmp_path / "class" / "submitted" / "a_1").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(Trouble, match="link"):
        unpack(tmp_path, [("a_1_2_02_x.ipynb", BOOK)])
    assert not files_in(tmp_path / "elsewhere")


def test_bombs(tmp_path):
    tracemalloc.start()
    written, notes = unpack(
        tmp_path,
        [
            ("a_1_2_02_x.ipynb", bytes(9_000_000)),
            ("b_2_2_02_x.ipynb", bytes(60_000_000)),
            ("c_3_2_02_x.ipynb", BOOK),
        ],
    )
    assert written == 1 and len(notes) == 2
    lying = archive(tmp_path / "lying.zip", [("a_1_2_02_x.ipynb", bytes(60_000_000))]).read_bytes()
    size = (60_000_000).to_bytes(4, "little")
    assert lying.count(size) == 2
    (tmp_path / "lying.zip").write_bytes(lying.replace(size, (5000).to_bytes(4, "little")))
    tracemalloc.reset_peak()
    written, notes = collect.collect(tmp_path / "lying.zip", tmp_path / "class", None)
    assert written == 0 and tracemalloc.get_traced_memory()[1] < 3 * submissions.LARGEST_NOTEBOOK
    tracemalloc.stop()


def test_many_members_together_are_limited(tmp_path, monkeypatch):
    monkeypatch.setattr(collect, "MOST_BYTES", (1000, 0))
    written, notes = unpack(tmp_path, [(f"a{i}_{i}_2_02_x.ipynb", os.urandom(400)) for i in range(5)])
    assert written == 2 and len(notes) == 3


def test_what_is_no_archive(tmp_path):
    for content in (b"", b"PK\x03\x04rubbish", os.urandom(500)):
        (tmp_path / "x.zip").write_bytes(content)
        with pytest.raises(Trouble, match="ZIP"):
            collect.collect(tmp_path / "x.zip", tmp_path, None)
    out = io.BytesIO(archive(tmp_path / "y.zip", [("a_1_2_02_x.ipynb", BOOK)]).read_bytes())
    data = bytearray(out.getvalue())
    data[6] |= 1  # both say: encrypted
    data[data.index(b"PK\x01\x02") + 8] |= 1
    (tmp_path / "y.zip").write_bytes(data)
    written, notes = collect.collect(tmp_path / "y.zip", tmp_path, None)
    assert written == 0 and "encrypted" in notes[0]


# --- the instructor's tables --------------------------------------------------------------------------------


def test_roster_deadlines_and_manual_points(tmp_path):
    plant(tmp_path, {"ada": solution(0), "bob": solution(0)[:3], "eve": ["x = 1"]})
    for student, when in (("ada", "2026-05-03T11:00:00+00:00"), ("bob", "2026-05-03 11:00:00 UTC")):
        (tmp_path / "submitted" / student / UNIT.slug / "timestamp.txt").write_text(when + "\n")
    (tmp_path / "roster.csv").write_text(
        "id,first_name,last_name,email\nada,Ada,=1+1,a@b\nbob,Bob,B,\ncy,Cy,C,\n"
    )
    (tmp_path / "deadlines.csv").write_text(
        "unit;due;student;penalty_per_day;most_penalty\n02;2026-05-01 12:00+00:00;;10%;50\n"
        "02;2026-05-03T10:00+00:00;bob;;\n".replace(";", ",")
    )
    (tmp_path / "manual.csv").write_text(
        'student,unit,points,comment\nbob,02,"2,5",well explained\nbob,2,1,"and <b>drawn</b>"\n'
        "cy,02,3,by mail\n"
    )
    for _ in range(2):  # reruns keep all of it
        scores, told = grade(tmp_path)
        assert "eve is not in roster.csv" in told.replace("'", "")
        assert (scores["ada"].raw, scores["ada"].penalty, scores["ada"].final) == (100, 20, 80)
        assert (scores["bob"].raw, scores["bob"].penalty) == (Fraction(37, 2), Fraction(37, 20))
        assert scores["cy"].status == "missing" and scores["cy"].final == 3
        header, ada, bob, cy, _ = (tmp_path / "scores.csv").read_text().splitlines()
        assert header.startswith(
            "assignment,duedate,timestamp,student_id,last_name,first_name,email,raw_score,"
        )
        assert ",ada,'=1+1,Ada,a@b,100,20,80,100,ok," in ada
        assert ",18.5,1.85,16.65,100,ok,well explained and <b>drawn</b>" in bob and ",missing,by mail" in cy


@pytest.mark.parametrize(
    "name, text, complaint",
    [
        ("roster.csv", "name\nada\n", "column id"),
        ("roster.csv", "id\n../etc\n", "cannot name a folder"),
        ("roster.csv", "id\nada\nada\n", "twice"),
        ("roster.csv", "", "empty"),
        ("deadlines.csv", "unit,due\n02,tomorrow\n", "not a time"),
        ("deadlines.csv", "unit,due\n77,2026-01-01\n", "no exercise"),
        ("deadlines.csv", "unit,due,student,penalty_per_day\n02,2026-01-01,,-5\n", "0 or more"),
        ("manual.csv", "student,unit,points\nada,02,lots\n", "not a number"),
        ("manual.csv", "student,unit,points\nada,02,1e999\n", "not a number"),
        ("manual.csv", "who,unit\nada,02\n", "no column student"),
    ],
)
def test_tables_with_a_fault_say_where(name, text, complaint, tmp_path):
    plant(tmp_path, {"ada": ["x = 1"]})
    (tmp_path / name).write_text(text)
    with pytest.raises(Trouble, match=complaint):
        grade(tmp_path)


def test_penalties_are_exact():
    due = datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)
    deadline = roster.Deadline(due, Fraction(10), Fraction(25))
    late = [
        deadline.penalty(Fraction(33), due + datetime.timedelta(hours=hours))
        for hours in (-1, 0, 1, 24, 25, 999)
    ]
    assert late == [0, 0, Fraction(33, 10), Fraction(33, 10), Fraction(33, 5), Fraction(33, 4)]
