"""Every hostile submission earns nothing and reaches nothing, every honest one earns what it should.

Daily, a few that tell much run in the best isolation that works here; with `-m study` the whole corpus
does, in every kind that works.
"""

import os
import resource
from pathlib import Path

import pytest

from exercises.grader.sandbox import box, close, isolation, nursery
from tests.grading.corpus_support import (
    HONEST,
    HOSTILE,
    QUICK,
    SHORT,
    SOLUTION,
    earned,
    grade,
    notebook_of,
    read_cells,
    words,
)

pytestmark = pytest.mark.xdist_group("sandbox")  # in one process, with one parent of each kind
BEST = "best"  # whichever kind is the best that works here
KINDS = [kind for kind in nursery.KINDS if kind != "none"]
DAILY = {
    "fork_bomb", "network", "open_files", "read_answers", "signals", "state_between_questions",
    "numba_kinds", "solution_with_pictures",
}  # fmt: skip


def runs():
    """Which kinds work is asked when a test runs: to find the tests must cost nothing."""
    for submission in HOSTILE + HONEST:
        if submission.name in DAILY:
            yield pytest.param(BEST, submission, id=f"{BEST}-{submission.name}")
        for kind in KINDS:
            name = f"{kind}-{submission.name}"
            yield pytest.param(kind, submission, marks=pytest.mark.study, id=name)


@pytest.fixture(scope="module", autouse=True)
def _no_parents_left():
    if isolation.probe().kind is not None:
        grade(HONEST[0].notebook())  # loads the engines, which is not a leak
    yield
    close()
    assert not processes_of_workers()


def use(kind, monkeypatch):
    """The kind that is used from now on; the test is skipped where it does not work."""
    if kind == BEST:
        kind = isolation.probe().kind or pytest.skip(isolation.probe().sentence())
    elif isolation.trouble(kind) != "ok":
        pytest.skip(f"{kind} does not work here: {isolation.trouble(kind)}")
    monkeypatch.setattr(box, "choose", lambda unsafe: kind)
    return kind


def processes_of_workers():
    """Processes that workers left: below one of our parents; as root, all of the user that only workers
    are."""
    user, found, above = nursery.user_of_workers(), [], {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            lines = (folder / "status").read_text().splitlines()
        except OSError:
            continue
        status = dict(line.split(":", 1) for line in lines if ":" in line)
        above.setdefault(int(status["PPid"]), []).append(int(folder.name))
        if user is not None and int(status["Uid"].split()[0]) == user:
            found.append(int(folder.name))
    for (kind, *_), home in nursery._current.items():
        below = above.get(home.process.pid, [])
        found += [pid for parent in below for pid in above.get(parent, [])] if kind == "bubblewrap" else below
    return found


def files_left(kind):
    home = nursery.nursery(kind)
    scratch = (
        [] if kind == "bubblewrap" else [path.name for path in (home.folder / "around" / "scratch").iterdir()]
    )
    names = (
        "/tmp/breach",
        "/tmp/seen.txt",
        "/dev/shm/hog",
        "/tmp/written_by_a_student",
        "/written_by_a_student",
    )
    return scratch + [name for name in names if os.path.exists(name)]


def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


@pytest.mark.parametrize("kind, submission", list(runs()))
def test_corpus(kind, submission, monkeypatch):
    kind = use(kind, monkeypatch)
    hostile = submission in HOSTILE
    before = resident()
    graded, results = grade(submission.notebook(), SHORT if hostile else QUICK)
    told = words(graded, results)
    assert "BREACH" not in told, told
    assert earned(results) == int(submission.header("Earns", "0"))
    assert graded.status in (submission.header("Status").split() or ["ok", "timeout", "crashed"])
    assert hostile or graded.status == "ok" or submission.header("Status")
    skipped = [str(trouble.number) for trouble in graded.troubles if trouble.skipped]
    assert hostile or skipped == submission.header("Skips").split()
    assert not any(
        ord(letter) < 32 and letter not in "\t\n" for trouble in graded.troubles for letter in trouble.text
    )
    assert not (submission.header("Troubles") and graded.troubles), graded.troubles
    assert not processes_of_workers() and not files_left(kind)
    assert resident() < before + (64 << 20)


@pytest.mark.parametrize("kind", [BEST, *(pytest.param(kind, marks=pytest.mark.slow) for kind in KINDS)])
def test_neighbours_are_untouched(kind, monkeypatch):
    """A right solution, hostile ones, the same solution: nothing has changed, and nothing of it was seen."""
    use(kind, monkeypatch)
    cells = ["NEIGHBOURS_SOLUTION = 'NEIGHBOURS_SOLUTION' * 1000", *read_cells(SOLUTION)]
    hostile = {submission.name: submission for submission in HOSTILE}
    for name in ("neighbours_memory", "tamper_with_libraries", "state_between_questions", "memory_hog"):
        assert earned(grade(notebook_of(cells))[1]) == 100
        graded, results = grade(hostile[name].notebook(), SHORT)
        assert earned(results) == 0 and "BREACH" not in words(graded, results)
    assert earned(grade(notebook_of(cells))[1]) == 100


def test_the_corpus_is_large_enough():
    assert len(HOSTILE) >= 60 and len(HONEST) >= 20
    assert all(submission.path.read_text(encoding="utf-8").startswith("# Attack: ") for submission in HOSTILE)
    assert all(submission.path.read_text(encoding="utf-8").startswith("# Odd: ") for submission in HONEST)
