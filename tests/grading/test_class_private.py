"""`--exercises DIR`: units of one's own, graded, collected and handed out by the same machinery.

The made-up unit shares nothing with the course's: so nothing in the grader is special to one of these.
"""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import exercises
from tests.grading.class_support import notebook, plant

SLUG = "41_springs"
START = f"import numpy as np\nfrom exercises import load\ngiven, check = load('{SLUG}')"
RIGHT = [
    START,
    "import scipy.sparse\n"
    "def stiffness(bodies, k):\n"
    "    parts = [-1.0, 2.0, -1.0]\n"
    "    return k * scipy.sparse.diags_array(parts, offsets=[-1, 0, 1], shape=(bodies, bodies))",
    "def force(spring, stretch):\n    return spring(stretch)",
    "def modes(matrix):\n    return np.linalg.eigvalsh(matrix)[::-1, None]",
    "def verdict(stiffness, force):\n"
    "    pull = force(given.spring(stiffness), 1.0)\n"
    "    return 'stable' if pull < 0 else 'unstable'",
    "check()",
]
SLIP = [*RIGHT, "old = stiffness\ndef stiffness(bodies, k):\n    return -old(bodies, k).toarray()"]
GUESS = [
    START,
    "def verdict(stiffness, force):\n    return 'stable'",
    "def modes(matrix):\n    return matrix",
]


@pytest.fixture
def private(tmp_path):
    """A folder of units as an instructor has it."""
    folder = tmp_path / "private"
    shutil.copytree(Path(__file__).with_name("made_up"), folder)
    starter = notebook([START, "def stiffness(bodies, k):\n    ...", 'check("stiffness")'])
    (folder / SLUG / f"{SLUG}.ipynb").write_text(starter, encoding="utf-8")
    return folder


def run(private, command, *arguments):
    whole = [sys.executable, "-m", "exercises.grader.classroom", command, "--exercises", private, *arguments]
    done = subprocess.run(
        list(map(str, whole)), cwd=exercises.FOLDER.parent, capture_output=True, text=True, check=False
    )
    if "Nothing was graded" in done.stderr:
        pytest.skip(f"no sandbox works here: {done.stderr}")
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_class_of_a_made_up_unit(private, tmp_path):
    folder = tmp_path / "class"
    plant(folder, {"ada": RIGHT, "bob": SLIP, "eve": GUESS}, unit=SLUG)
    run(private, "grade", folder, "--jobs", "2")
    rows = [row.split(",") for row in (folder / "scores.csv").read_text().splitlines()[1:]]
    assert [(row[0], row[3], row[9], row[10], row[11]) for row in rows] == [
        (SLUG, "ada", "20", "20", "ok"),
        (SLUG, "bob", "15", "20", "ok"),
        (SLUG, "eve", "0", "20", "ok"),
    ]
    page = (folder / "feedback" / "bob" / SLUG / f"{SLUG}.html").read_text(encoding="utf-8")
    assert "The sign is wrong." in page and f"lectures/{SLUG}.md, section “Springs”" in page


def test_it_is_collected_by_its_own_name(private, tmp_path):
    with zipfile.ZipFile(tmp_path / "canvas.zip", "w") as archive:
        archive.writestr(f"lovelaceada_12_345_{SLUG}.ipynb", notebook(RIGHT))
    run(private, "collect", tmp_path / "canvas.zip", "--out", tmp_path / "class")
    path = tmp_path / "class" / "submitted" / "lovelaceada_12" / SLUG / f"{SLUG}.ipynb"
    assert path.read_text(encoding="utf-8") == notebook(RIGHT)


def test_it_is_handed_out(private, tmp_path):
    run(private, "release", "--out", tmp_path / "out")
    with zipfile.ZipFile(tmp_path / "out" / "course.zip") as archive:
        units = {name.split("/")[2] for name in archive.namelist() if name.startswith("course/exercises/")}
    assert units == {"__init__.py", "grader", SLUG}
    assert (tmp_path / "out" / "release" / SLUG / f"{SLUG}.ipynb").is_file()
