"""The sandbox itself: which kind works, what it refuses, its limits, and that nothing of it stays behind."""

import contextlib
import itertools
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from exercises.grader.sandbox import (
    Limits,
    NoSandbox,
    Sandbox,
    clean,
    close,
    folder,
    isolation,
    kernel,
    limits,
    nursery,
    seccomp,
    syscalls,
)
from exercises.grader.sandbox.isolation import send_canary, trouble
from exercises.grader.sandbox.survey import INTERPRETER, ROOT, survey
from exercises.grader.sandbox.wire import Gone, Wire
from tests.grading.corpus_support import SOLUTION, UNIT, checks, earned, grade, notebook_of, read_cells

pytestmark = pytest.mark.xdist_group("sandbox")  # in one process, with one parent of each kind
KINDS = [kind for kind in nursery.KINDS if kind != "none"]
each_kind = pytest.mark.parametrize("kind", KINDS)
RIGHT = read_cells(SOLUTION)


@pytest.fixture(scope="module", autouse=True)
def _close_at_the_end():
    yield
    close()


# --- which isolation ----------------------------------------------------------------------------------------


@each_kind
def test_the_canary_does_not_get_out(kind):
    if trouble(kind) != "ok":
        pytest.skip(f"{kind} does not work here: {trouble(kind)}")
    for tools in (False, True):
        assert send_canary(nursery.nursery(kind, tools)) == []
    nursery.forget(kind, True)


def test_without_isolation_the_canary_gets_out():
    through = send_canary(nursery.nursery("none"))
    nursery.forget("none")
    assert {
        "reads a file outside",
        "lists a folder outside",
        "opens a socket",
        "forks",
        "runs a program",
    } <= set(through)


def test_the_first_kind_that_works_is_taken(monkeypatch):
    told = {"bubblewrap": "no", "landlock": "ok", "landlock, scratch on disk": "ok"}
    monkeypatch.setattr(isolation, "trouble", told.get)
    found = isolation._probe.__wrapped__(0)
    assert found.kind == "landlock" and found.reasons == {"bubblewrap": "no", "landlock": "ok"}


def without_any(monkeypatch):
    nothing = isolation.Isolation(None, {"bubblewrap": "not installed", "landlock": "not in this kernel"})
    monkeypatch.setattr(isolation, "probe", lambda: nothing)


def test_where_none_works_it_refuses_and_says_why(monkeypatch):
    without_any(monkeypatch)
    with pytest.raises(NoSandbox, match="bubblewrap: not installed; landlock: not in this kernel"):
        Sandbox(UNIT)


def test_unsafe_is_stamped(monkeypatch):
    without_any(monkeypatch)
    box, results = grade(notebook_of(RIGHT), unsafe=True)
    nursery.forget("none")
    assert (box.status, box.isolation, earned(results)) == ("unsandboxed", "none", 100)


def test_unsafe_takes_the_sandbox_that_works():
    if isolation.probe().kind is None:
        pytest.skip(isolation.probe().sentence())
    with Sandbox(UNIT, unsafe=True) as box:
        assert box.isolation in ("bubblewrap", "landlock") and box.load(notebook_of([])).status == "ok"


@pytest.mark.parametrize("hidden", ["bubblewrap", "bubblewrap;landlock"])
def test_a_kind_less_is_no_harm(hidden):
    """The whole way in a process of its own, where bwrap is absent, and where nothing can be mounted."""
    assert run_probe([], {isolation.DISABLE: hidden})["earned"] == 100


PROBE = """
import json, sys
from tests.grading.corpus_support import RIGHT, earned, grade
from exercises.grader.sandbox import probe
box, results = grade(RIGHT)
print(json.dumps({"kind": probe().kind, "earned": earned(results), "reasons": probe().reasons}))
"""


def run_probe(wrapper, environment=None, interpreter=sys.executable, path=()):
    path = os.pathsep.join([str(ROOT), *path])
    plain = {
        "PATH": os.environ.get("PATH", ""),
        "PYTHONPATH": path,
        "PYTHONDONTWRITEBYTECODE": "1",
        **(environment or {}),
    }
    done = subprocess.run(
        [*wrapper, interpreter, "-c", PROBE],
        capture_output=True,
        text=True,
        env=plain,
        cwd=ROOT,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.splitlines()[-1])


def tools_path():
    return survey().path


def other_user_can_read(*paths):
    return all(
        subprocess.run(
            ["setpriv", "--reuid=12345", "--clear-groups", "test", "-r", path], check=False
        ).returncode
        == 0
        for path in paths
    )


needs_root = pytest.mark.skipif(
    os.getuid() != 0 or not shutil.which("setpriv"), reason="needs root and setpriv"
)
FORBID = 'echo 0 > /proc/sys/user/max_user_namespaces; exec setpriv --ambient-caps=-all --inh-caps=-all "$@"'


def test_where_user_namespaces_are_forbidden():
    if not shutil.which("unshare") or not shutil.which("setpriv"):
        pytest.skip("needs unshare and setpriv, to forbid them in a namespace of its own")
    inside = ["unshare", "-U", "--map-user=1000", "--map-group=1000", "--keep-caps", "sh", "-c", FORBID, "sh"]
    if subprocess.run([*inside, "true"], capture_output=True, check=False).returncode != 0:
        pytest.skip("user namespaces are forbidden here: all other tests show it")
    found = run_probe(inside, path=tools_path())
    assert found["kind"] == "landlock, scratch on disk" and found["earned"] == 100


@needs_root
def test_a_root_that_may_not_mount():
    found = run_probe(["setpriv", "--bounding-set=-sys_admin", "--inh-caps=-sys_admin"], path=tools_path())
    assert found["earned"] == 100


@needs_root
@pytest.mark.slow
def test_an_ordinary_user_with_the_interpreter_at_home(tmp_path_factory):
    """A copy of the interpreter in a folder that only this user may enter."""
    home = Path("/tmp") / f"grading-home-{os.getpid()}"
    if not other_user_can_read(*tools_path(), str(ROOT / "exercises" / "__init__.py")):
        pytest.skip("the tools or the course lie where another user cannot read them")
    try:
        base, version = (
            Path(INTERPRETER).parents[1],
            f"python{sys.version_info.major}.{sys.version_info.minor}",
        )
        leave = shutil.ignore_patterns("site-packages", "test", "__pycache__", "config-*")
        shutil.copytree(base / "lib" / version, home / "lib" / version, ignore=leave)
        for library in (base / "lib").glob("libpython*"):
            shutil.copy(library, home / "lib")
        (home / "bin").mkdir()
        copy = shutil.copy(INTERPRETER, home / "bin")
        subprocess.run(["chown", "-R", "12345:12345", str(home)], check=True)
        home.chmod(0o700)
        user = ["setpriv", "--reuid=12345", "--regid=12345", "--clear-groups"]
        for hidden in ("", "bubblewrap", "bubblewrap;landlock"):
            assert run_probe(user, {isolation.DISABLE: hidden}, copy, tools_path())["earned"] == 100
    finally:
        shutil.rmtree(home, ignore_errors=True)


# --- files that are no notebooks ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "data, told",
    [
        (b"", "not a notebook"),
        (b"\xff\xfe\x00", "cannot be read"),
        (b"[" * 5_000_000, "not a notebook"),
        (b'{"cells": ' + b"[" * 200_000 + b"]" * 200_000 + b"}", "not a notebook"),
        (b'{"cells": 1}', "not a notebook"),
        (b'{"cells": [{"cell_type": "code"}]}', "not a notebook"),
        (b'{"cells": [{"cell_type": "code", "source": 5}]}', "not a notebook"),
        (b'{"cells": [{"cell_type": "code", "source": [1, 2]}]}', "not a notebook"),
        (b"\x80\x04\x95cos\nsystem\n", "cannot be read"),
        (b"9" * 1_000_000, "not a notebook"),
        (json.dumps({"cells": [{"cell_type": "code", "source": ""}] * 6000}).encode(), "at most"),
        (b" " * 50_000_001, "more than 50,000,000 bytes"),
    ],
)
def test_what_is_no_notebook_is_rejected(data, told):
    box, results = grade(data)
    assert box.status == "rejected" and told in box.reason and earned(results) == 0


def test_links_pipes_and_folders_are_rejected(tmp_path):
    (tmp_path / "secret.ipynb").write_bytes(notebook_of(RIGHT))
    (tmp_path / "link.ipynb").symlink_to(tmp_path / "secret.ipynb")
    (tmp_path / "folder.ipynb").mkdir()
    os.mkfifo(tmp_path / "pipe.ipynb")
    for name in ("link", "folder", "pipe", "nothing"):
        box, _ = grade(tmp_path / f"{name}.ipynb")
        assert box.status == "rejected" and box.reason
    assert grade(tmp_path / "secret.ipynb")[0].status == "ok"


def test_tags_and_metadata_skip_no_cell():
    tags = {
        "tags": ["skip-execution", "raises-exception", "remove-cell"],
        "nbgrader": {"locked": True, "points": 1000},
    }
    assert earned(grade(notebook_of(RIGHT, **tags))[1]) == 100


def test_a_notebook_in_another_dress_is_the_same():
    """As old and foreign programs save it: no metadata, no ids, lines of Windows, a byte order mark, the same
    key twice, text between the cells that looks like code."""
    cells = [
        {"cell_type": "code", "source": cell.replace("\n", "\r\n").splitlines(keepends=True)}
        for cell in RIGHT
    ]
    aside = {"cell_type": "markdown", "source": "def plate(*arguments):\n    return 0"}
    raw = {"cell_type": "raw", "source": ["1/0"], "metadata": None}
    book = json.dumps({"nbformat": 4, "nbformat_minor": 0, "cells": [aside, *cells, raw, aside]}, indent=1)
    twice = '{"cells": [],' + book.removeprefix("{")
    box, results = grade(b"\xef\xbb\xbf" + twice.replace("\n", "\r\n").encode())
    assert (box.status, earned(results), box.troubles) == ("ok", 100, [])


def test_a_notebook_of_format_3_is_read():
    """Sheets of cells, whose text is their input."""
    cells = [{"cell_type": "code", "language": "python", "input": cell.splitlines(True)} for cell in RIGHT]
    sheets = [{"cells": cells[:3]}, {"cells": [{"cell_type": "markdown", "source": ""}, *cells[3:]]}]
    book = json.dumps({"nbformat": 3, "nbformat_minor": 0, "metadata": {"name": ""}, "worksheets": sheets})
    box, results = grade(book.encode())
    assert (box.status, earned(results), box.troubles) == ("ok", 100, [])


def test_how_a_process_ends_tells_nothing_of_hidden_cases():
    """A student's code can choose the number it ends with: by it, it could tell what it was asked."""
    visible = len(checks()[1].visible)
    cell = f"""
import itertools, os
turns, right = itertools.count(), body_rate
def body_rate(q, omega):
    if next(turns) >= {visible}:
        os._exit(int(abs(q[0]) * 100) + 100)
    return right(q, omega)
"""
    box, results = grade(notebook_of([*RIGHT, cell]))
    (lost,) = [result for result in results if not result.passed]
    got = next(one.verdict.got for one in lost.outcomes if not one.verdict.passed)
    assert lost.check.name == "body_rate" and earned(results) == 100 - lost.check.points
    assert {got.message, box.reason} == {"the process that ran the code did not answer"}


# --- limits -------------------------------------------------------------------------------------------------


def test_an_overloaded_machine_gives_more_time(monkeypatch):
    """And no more than three times as much, however busy a notebook makes it."""
    processors = len(os.sched_getaffinity(0))
    for load, times in ((0.0, 1.0), (processors, 1.0), (2 * processors, 2.0), (99 * processors, 3.0)):
        monkeypatch.setattr(os, "getloadavg", lambda load=load: (load, 0.0, 0.0))
        assert limits.stretch() == times
    cells = notebook_of(["import time\ntime.sleep(1.0)"])
    assert grade(cells, Limits(cell=0.6))[0].troubles == []
    monkeypatch.setattr(os, "getloadavg", lambda: (0.0, 0.0, 0.0))
    assert "longer than" in grade(cells, Limits(cell=0.6))[0].troubles[0].text


def test_a_submission_ends_in_its_time(monkeypatch):
    monkeypatch.setattr(os, "getloadavg", lambda: (0.0, 0.0, 0.0))
    endless = ["while True: pass"] * 30
    started = time.monotonic()
    box, results = grade(notebook_of(endless), Limits(cell=0.5, question=1.0, total=4.0))
    assert time.monotonic() - started < 8 and box.status == "timeout" and earned(results) == 0


def test_a_cell_that_was_left_out_is_told():
    box, _ = grade(
        notebook_of(["import math\nx = 1\nwhile True: pass", "y = x + math.pi", "1/0"]), Limits(cell=0.5)
    )
    assert [(trouble.number, trouble.skipped) for trouble in box.troubles] == [(1, True), (3, False)]
    first, last = box.troubles
    assert "longer than" in first.text and "definitions" in first.text and first.title == "import math"
    assert "ZeroDivisionError" in last.text and box.status == "ok"


@pytest.mark.parametrize("cell", ["kept = bytearray(2 << 30)", "import numpy as np\nkept = np.ones(1 << 28)"])
def test_memory_has_a_limit(cell):
    box, _ = grade(notebook_of([cell]))
    assert "MemoryError" in box.troubles[0].text.replace("_ArrayMemoryError", "MemoryError")


def test_a_worker_that_stops_reading():
    wire = Wire()
    started = time.monotonic()
    with pytest.raises(Gone, match="longer"):
        wire.send(b"x" * (1 << 20), 0.3)
    assert time.monotonic() - started < 2
    wire.release()
    with pytest.raises(Gone, match="ended"):
        wire.send(b"x", 1.0)
    wire.close()


@pytest.mark.parametrize("piece, pause, told", [(b"x" * 4096, 0, "bytes"), (b"x", 0.02, "longer")])
def test_a_worker_that_floods_or_drips(piece, pause, told):
    wire = Wire()
    stop = threading.Event()

    def talk():
        while not stop.is_set():
            os.write(wire.theirs[1], piece)
            time.sleep(pause)

    thread = threading.Thread(target=talk)
    thread.start()
    try:
        with pytest.raises(Gone, match=told):
            wire.line(0.5, 100_000)
    finally:
        stop.set()
        os.set_blocking(wire.theirs[1], False)
        with contextlib.suppress(BlockingIOError):
            os.read(wire.incoming, 1 << 16)
        thread.join()
        wire.close()


# --- nothing stays, nothing breaks --------------------------------------------------------------------------


def test_a_parent_that_fell_is_replaced():
    kind = isolation.probe().kind
    assert grade(notebook_of([]))[0].status == "ok"
    nursery.nursery(kind).process.kill()
    nursery.nursery(kind).process.wait()
    assert earned(grade(notebook_of(RIGHT))[1]) == 100


@each_kind
def test_closing_leaves_nothing(kind):
    if trouble(kind) != "ok":
        pytest.skip(trouble(kind))
    home = nursery.nursery(kind)
    folder, process = home.folder, home.process
    nursery.forget(kind)
    assert not folder.exists() and process.returncode is not None


@each_kind
def test_closing_with_a_worker_at_work_leaves_no_process(kind):
    """Nor if the parent does not react: then it is killed, and its workers with it."""
    if trouble(kind) != "ok":
        pytest.skip(trouble(kind))
    for stopped in (False, True):
        home, wire = nursery.nursery(kind), Wire()
        home.spawn(Limits(), wire)
        wire.release()
        parent = home.process.pid
        if stopped:
            os.killpg(parent, signal.SIGSTOP)
        nursery.forget(kind)
        deadline = time.monotonic() + (5 if stopped else 0)
        while (left := in_group(parent)) and time.monotonic() < deadline:
            time.sleep(0.02)
        wire.close()
        assert not left


def in_group(leader):
    """Processes of this group, or below a process of it."""
    found = {leader}
    for _ in range(3):
        for stat in Path("/proc").glob("[0-9]*/stat"):
            with contextlib.suppress(OSError):
                about = stat.read_text().rpartition(")")[2].split()
                if int(about[1]) in found or int(about[2]) == leader:
                    found.add(int(stat.parent.name))
    return found - {leader} | ({leader} if Path(f"/proc/{leader}").exists() else set())


def test_a_grader_that_is_killed_takes_all_with_it():
    """Even by a signal that it cannot catch, in the middle of an endless question."""
    code = (
        "from tests.grading.corpus_support import *; from exercises.grader.sandbox import Sandbox, nursery\n"
        "box = Sandbox(UNIT); box.load(notebook_of([]))\n"
        "print(nursery.nursery(box.kind).process.pid, flush=True)\n"
        "box.load(notebook_of(['while True: pass']))"
    )
    grader = subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    parent = int(grader.stdout.readline())
    time.sleep(0.5)
    grader.send_signal(signal.SIGKILL)
    grader.wait()
    grader.stdout.close()
    deadline = time.monotonic() + 5
    while Path(f"/proc/{parent}").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not Path(f"/proc/{parent}").exists()


# --- parts --------------------------------------------------------------------------------------------------


def test_the_filter_fits_the_kernels_machine():
    for machine, flat in itertools.product(syscalls.MACHINES, (False, True)):
        lines = seccomp.program(machine, 1234, flat)
        assert len(lines) < 4096 and lines[-1] == seccomp.refuse()
        for place, (code, yes, no, _) in enumerate(lines):
            assert code in (0x20, 0x15, 0x35, 0x45, 0x06) and max(yes, no) < 256
            assert place + max(yes, no) < len(lines)


def test_no_system_call_is_listed_twice():
    for machine in syscalls.MACHINES:
        tables = (syscalls.ALLOWED, syscalls.GUARDED, syscalls.PRETENDED, syscalls.UNKNOWN)
        listed = [number for table in tables for number in syscalls.numbers(table, machine).values()]
        assert len(listed) == len(set(listed))


def test_the_survey_holds_no_answers():
    known = survey()
    assert kernel.machine() in syscalls.MACHINES
    assert not [path for path in known.readable if "exercises" in path or "reference" in path]
    assert not [
        path for path in known.readable if any(word in path for word in ("pymunk", "pybullet", "pytest"))
    ]
    assert all(Path(path).name not in ("site-packages", "dist-packages") for path in known.readable)


def test_text_for_terminals_and_pages():
    assert clean("a\x1b[31mb\x1b]0;title\x07c\x00\u202e\ud800d\ne") == "ab0;titlecd\ne"
    assert len(clean("x" * 10_000)) == 500


def test_folders_of_killed_graders_are_swept(tmp_path, monkeypatch):
    monkeypatch.setattr(folder.tempfile, "tempdir", str(tmp_path))
    left, lock = folder.make()
    lock.close()  # as the kernel does when a grader is killed
    used, held = folder.make()
    assert left.exists() and used.is_dir()  # too new to be judged
    folder.sweep(age=0.0)
    assert used.is_dir() and not left.exists()
    held.close()
    folder.sweep(age=0.0)
    assert not used.exists()
