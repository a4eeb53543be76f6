"""course.py: setting up and what can go wrong with it, the copies in work/, and the commands.

Every test has a small course of its own: course.py as it is, two units, and one package to install.
"""

import importlib.util
import json
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import time
import urllib.request
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOK, EXERCISE = "notebooks/01_first.ipynb", "exercises/02_second/02_second.ipynb"
POSIX = pytest.mark.skipif(os.name == "nt", reason="runs scripts as programs, as Windows does not")

# A stand-in for the exercises' grader: the score is the number of @ in the file.
SHELL = """import json, sys
unit, answer, file = sys.argv[2], sys.argv[4], sys.argv[5]
earned = min(open(file, encoding="utf-8").read().count("@"), 5)
print("checked", unit, earned)
json.dump({"unit": unit, "earned": earned, "possible": 5, "passed": {}}, open(answer, "w"))
sys.exit(earned < 5)
"""


def notebook(*sources, count=None):
    cells = [
        {
            "cell_type": "code",
            "id": f"c{i}",
            "metadata": {},
            "execution_count": count,
            "outputs": [],
            "source": source,
        }
        for i, source in enumerate(sources)
    ]
    return json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells})


@pytest.fixture
def folder(tmp_path):
    """A small course; the blank in its path is part of the test."""
    folder = tmp_path / "my course"
    files = {
        "course.py": (ROOT / "course.py").read_text(encoding="utf-8"),
        "environment.txt": "# pins\ntiny==1.0\n",
        NOTEBOOK: notebook("1 + 1"),
        "notebooks/02_second.ipynb": notebook("2 + 2"),
        EXERCISE: notebook("a = 0"),
        "exercises/__init__.py": "",
        "exercises/grader/__init__.py": "",
        "exercises/grader/shell.py": SHELL,
        "reference/__init__.py": "",
        "reference/bench.py": "import sys; print('bench', *sys.argv[1:])",
        "lectures/page.md": "# Page\n",
        "lectures/figures/1.svg": "<svg/>",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture
def wheels(tmp_path):
    """A folder with the one package that the small course needs."""
    (tmp_path / "wheels").mkdir()
    info = "tiny-1.0.dist-info/"
    with zipfile.ZipFile(tmp_path / "wheels" / "tiny-1.0-py3-none-any.whl", "w") as wheel:
        wheel.writestr("tiny.py", "SIZE = 1\n")
        wheel.writestr(info + "METADATA", "Metadata-Version: 2.1\nName: tiny\nVersion: 1.0\n")
        wheel.writestr(info + "WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        wheel.writestr(info + "RECORD", f"tiny.py,,\n{info}METADATA,,\n{info}WHEEL,,\n{info}RECORD,,\n")
    return tmp_path / "wheels"


@pytest.fixture
def course(folder, monkeypatch):
    """The small course's course.py, as a module."""
    monkeypatch.delenv("COURSE_PYTHON", raising=False)  # whoever runs the tests may have set it
    spec = importlib.util.spec_from_file_location("course_under_test", folder / "course.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def clean(**changes):
    """An environment that tells nothing of the one that runs the tests."""
    ours = (
        "COURSE_PYTHON",
        "PYTHONPATH",
        "VIRTUAL_ENV",
        "PIP_INDEX_URL",
        "PIP_EXTRA_INDEX_URL",
        "PIP_FIND_LINKS",
    )
    return {**{key: value for key, value in os.environ.items() if key not in ours}, **changes}


def ask(folder, *arguments, python=sys.executable, **changes):
    return subprocess.run(
        [python, "course.py", *map(str, arguments)],
        cwd=folder,
        env=clean(**changes),
        check=False,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        encoding="utf-8",
    )


def ready(folder, *arguments):
    """Asks with the packages of the Python that runs the tests, so that nothing is set up."""
    return ask(folder, *arguments, COURSE_PYTHON=sys.executable)


def script(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("#!/bin/sh\n" + text)
    file.chmod(file.stat().st_mode | stat.S_IXUSR)
    return file


# --- finding a Python ---------------------------------------------------------------------------------------


def old_pythons():
    """Whatever Python before 3.11 this machine has, one of each version."""
    folders = [
        *os.environ.get("PATH", "").split(os.pathsep),
        *map(str, Path.home().glob(".pyenv/versions/*/bin")),
    ]
    found = {}
    for version in ("3.6", "3.7", "3.8", "3.9", "3.10"):
        for file in filter(None, (shutil.which("python" + version, path=folder) for folder in folders)):
            if subprocess.run([file, "-c", ""], capture_output=True, check=False).returncode == 0:
                found.setdefault(version, file)
    return list(found.values()) or [pytest.param(None, marks=pytest.mark.skip("no Python before 3.11 here"))]


@pytest.mark.parametrize("python", old_pythons())
def test_an_old_python_says_what_is_missing(folder, python):
    told = ask(folder, "lab", python=python, PATH="")
    assert told.returncode == 2
    assert "The course needs Python 3.11 to 3.14" in told.stderr and "install" in told.stderr
    assert len(told.stderr.splitlines()) == 1
    assert ask(folder, python=python, PATH="").returncode == 0


@POSIX
@pytest.mark.parametrize("python", old_pythons())
def test_an_old_python_finds_a_suitable_one(folder, tmp_path, python):
    version = "python{}.{}".format(*sys.version_info)
    script(tmp_path / "shims" / version, "echo 'version not installed' >&2; exit 127\n")
    good = script(tmp_path / "bin" / version, f'exec "{sys.executable}" "$@"\n')
    told = subprocess.run(
        [python, "-c", "import course; print(course.find_python())"],
        cwd=folder,
        check=True,
        env=clean(PATH=f"{tmp_path / 'shims'}{os.pathsep}{tmp_path / 'bin'}"),
        capture_output=True,
    )
    assert told.stdout.decode().strip() == str([str(good)])


def test_the_python_that_runs_is_preferred(course, monkeypatch):
    monkeypatch.setattr(course, "probe", lambda command: (3, 12, 1, 1))
    assert course.find_python() == [sys._base_executable]


@pytest.mark.parametrize(
    "answer, words",
    [
        ((3, 10, 1, 1), "needs Python 3.11 to 3.14"),  # too old
        ((3, 15, 1, 1), "needs Python 3.11 to 3.14"),  # too new: there are no packages for it
        ((3, 12, 1, 0), "64 bit"),  # 32 bit, or not CPython
        ((0, 0, 0, 0), "needs Python 3.11 to 3.14"),  # does not run at all
        ((3, 11, 0, 1), "Python 3.11 is here, but not its part that makes environments"),
    ],
)
def test_unsuitable_pythons(course, monkeypatch, answer, words):
    monkeypatch.setattr(course, "probe", lambda command: answer)
    with pytest.raises(course.Trouble, match=words):
        course.find_python()


@pytest.mark.parametrize(
    "system, advice",
    [
        ("ID=debian\n", "sudo apt install python3.11-venv"),
        ('ID=pop\nID_LIKE="ubuntu debian"\n', "python3.11-venv"),
        ("ID=fedora\n", "sudo dnf install"),
        ("ID=arch\n", "sudo pacman"),
        ("ID=strange\n", "your system's packages"),
    ],
)
def test_each_system_has_its_own_advice(course, monkeypatch, system, advice):
    monkeypatch.setattr(course.sys, "platform", "linux")
    monkeypatch.setattr(course, "WINDOWS", False)
    monkeypatch.setattr(course.Path, "read_text", lambda self, encoding: system)
    assert advice in course.install_advice("3.11")


# --- setting up ---------------------------------------------------------------------------------------------


def set_up(folder, wheels):
    return ask(folder, "test", "--wheels", wheels, "--version", PIP_NO_INDEX="1")


def test_sets_up_offline_recovers_and_is_quick_after(folder, wheels, course):
    (folder / ".venv" / "lib").mkdir(parents=True)
    course.STAMP.touch()  # half made, and interrupted
    told = set_up(folder, wheels)
    assert "1 of 1" in told.stdout and "installed" in told.stdout
    assert "No module named pytest" in told.stderr  # set up, and then what was asked for
    assert not (folder / ".venv" / "lib" / "half").exists()

    where = "import tiny, reference, exercises; print(reference.__file__)"
    told = subprocess.run(
        [course.VENV_PYTHON, "-c", where], cwd=wheels, env=clean(), check=True, capture_output=True
    )
    assert Path(told.stdout.decode().strip()) == folder / "reference" / "__init__.py"

    start = cpu_of_children()
    for _ in range(3):
        assert ask(folder, "bench", "top", "--quick").stdout == "bench top --quick\n"
    assert cpu_of_children() - start < 3  # seconds, for three

    course.PINS.write_text("tiny==1.0\n# new pins\n", encoding="utf-8")
    assert not course.is_ready()


def cpu_of_children():
    used = os.times()
    return used.children_user + used.children_system


@pytest.mark.slow
def test_no_network_is_told_and_the_next_run_recovers(folder, wheels, course):
    nowhere = {
        "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
        "PIP_RETRIES": "1",
        "PIP_CONFIG_FILE": os.devnull,
    }
    told = ask(folder, "test", **nowhere)
    assert told.returncode == 2
    assert told.stderr.startswith("There is no network") and "--wheels" in told.stderr
    assert not course.is_ready()
    set_up(folder, wheels)
    assert course.is_ready()
    (course.VENV_PYTHON).unlink()  # as after an upgrade of the system's Python
    assert not course.is_ready()


@pytest.mark.parametrize(
    "text, words",
    [
        (
            "ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device",
            "The disk is full",
        ),
        ("OSError: [WinError 112] There is not enough space on the disk", "The disk is full"),
        (
            "The virtual environment was not created successfully because ensurepip is not\navailable.",
            "environments",
        ),
        ("[Errno 13] Permission denied: 'course.lock'", "may not be written"),
        ("PermissionError: [WinError 5] Access is denied: 'python.exe'", "may not be written"),
        ("[Errno 30] Read-only file system: '.venv'", "may not be written"),
        (
            "Retrying (Retry(total=4)) after connection broken by 'NewConnectionError('<...>: Failed to "
            "establish a new connection: [Errno -3] Temporary failure in name resolution')'\n"
            "ERROR: No matching distribution found for a==1",
            "no network",
        ),
        ("ReadTimeoutError(\"HTTPSConnectionPool(host='x'): Read timed out.\")", "no network"),
        ("SSLError(SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED]'))", "could not be trusted"),
        ("ERROR: No matching distribution found for numba==1.2", "numba==1.2 is not to be had"),
        ("something else", None),
    ],
)
def test_remedies(course, text, words):
    told = course.remedy(text)
    assert told is None if words is None else words in told and "\n" not in told


def test_a_full_disk_is_told_before_anything_is_made(course, monkeypatch, capsys):
    monkeypatch.setattr(course.shutil, "disk_usage", lambda path: shutil._ntuple_diskusage(1, 1, 0))
    monkeypatch.setattr(course.sys, "argv", ["course.py", "test"])
    assert course.guarded_main() == 2
    assert "The disk is full: free 1.5 GB" in capsys.readouterr().err
    assert not course.VENV.exists()


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_may_not_be_written(folder):
    folder.chmod(0o500)
    told = ask(folder, "test")
    folder.chmod(0o700)
    assert told.returncode == 2 and "may not be written" in told.stderr


def test_an_environment_of_somebody_else_is_set_aside(course, capsys):
    (course.VENV / "precious").mkdir(parents=True)
    course.clear_environment()
    assert not course.VENV.exists()
    assert [path.name for path in course.ROOT.glob(".venv-set-aside-*/*")] == ["precious"]


def test_a_missing_folder_of_wheels(folder):
    told = ask(folder, "test", "--wheels", "nowhere")
    assert told.returncode == 2 and "--wheels nowhere: there is no such folder" in told.stderr
    assert not (folder / ".venv").exists()


def test_two_at_once_wait_for_each_other(folder):
    hold = "import course, time\nwith course.alone():\n    print('held', flush=True); time.sleep({})\n"
    first = subprocess.Popen([sys.executable, "-c", hold.format(2)], cwd=folder, stdout=subprocess.PIPE)
    assert first.stdout.readline().strip() == b"held"
    second = subprocess.run(
        [sys.executable, "-c", hold.format(0)], cwd=folder, capture_output=True, check=True
    )
    assert first.wait() == 0
    assert b"waiting for it to end" in second.stdout


@POSIX
@pytest.mark.slow
def test_killed_while_setting_up(folder, wheels, course):
    child = subprocess.Popen(
        [sys.executable, "course.py", "test", "--wheels", str(wheels)],
        cwd=folder,
        env=clean(),
        stdout=subprocess.DEVNULL,
        start_new_session=True,
    )
    while not list(folder.glob(".venv/lib/python*/site-packages/pip/*")):
        time.sleep(0.01)
    os.killpg(child.pid, signal.SIGKILL)
    child.wait()
    assert not course.is_ready()
    set_up(folder, wheels)
    assert course.is_ready()


# --- the copies in work/ ------------------------------------------------------------------------------------


def test_copies_are_never_written_over(course):
    assert course.make_copies() == []
    copy = course.WORK / NOTEBOOK
    assert copy.read_bytes() == (course.ROOT / NOTEBOOK).read_bytes()
    for linked in ("lectures/page.md", "lectures/figures/1.svg", "reference/bench.py"):
        assert (course.WORK / linked).exists()
    copy.write_text("mine")
    (course.ROOT / NOTEBOOK).write_text(notebook("new"))
    assert course.make_copies() == [NOTEBOOK]
    assert copy.read_text() == "mine"


def test_update_replaces_what_was_only_run(course, capsys):
    course.make_copies()
    (course.WORK / NOTEBOOK).write_text(notebook("1 + 1", count=7))
    (course.ROOT / NOTEBOOK).write_text(notebook("1 + 2"))
    assert course.main(["update"]) == 0
    assert (course.WORK / NOTEBOOK).read_text() == notebook("1 + 2")
    assert len(list((course.WORK / "notebooks").iterdir())) == 2


def test_update_puts_the_new_version_beside_an_edited_copy_once(course, capsys):
    course.make_copies()
    copy = course.WORK / EXERCISE
    copy.write_text(notebook("a = 1"))
    course.main(["update"])
    assert list(copy.parent.iterdir()) == [copy]  # edited, but there is nothing new
    (course.ROOT / EXERCISE).write_text(notebook("a = 0", "b = 0"))
    course.main(["update"])
    course.main(["update"])
    assert copy.read_text() == notebook("a = 1")
    (beside,) = set(copy.parent.iterdir()) - {copy}
    assert re.fullmatch(r"02_second\.new-\d{4}-\d\d-\d\d\.ipynb", beside.name)
    assert beside.read_text() == notebook("a = 0", "b = 0")
    assert "beside it" in capsys.readouterr().out


def test_update_without_a_record_loses_nothing(course, capsys):
    course.make_copies()
    (course.WORK / NOTEBOOK).write_text(notebook("mine"))
    course.RECORD.write_text("{ broken")
    course.main(["update"])
    kept = {path.read_text() for path in (course.WORK / "notebooks").glob("01_first*")}
    assert kept == {notebook("mine"), notebook("1 + 1")}


@pytest.mark.parametrize("unit", ["2", "02", "02_second"])
def test_reset_sets_the_old_copies_aside(course, monkeypatch, capsys, unit):
    monkeypatch.setattr(course, "now", lambda: "2026-01-02-030405")
    course.make_copies()
    for text in ("first", "second"):  # twice within the same second
        (course.WORK / EXERCISE).write_text(text)
        assert course.main(["reset", unit]) == 0
    course.main(["reset", unit])  # nothing to set aside
    kept = {path.name: path.read_text() for path in (course.WORK / EXERCISE).parent.iterdir()}
    assert kept == {
        "02_second.ipynb": notebook("a = 0"),
        "02_second.old-2026-01-02-030405.ipynb": "first",
        "02_second.old-2026-01-02-030405-2.ipynb": "second",
    }
    assert not (course.WORK / "notebooks" / "02_second.old-2026-01-02-030405.ipynb").exists()


@pytest.mark.parametrize("command", ["reset", "check"])
def test_an_unknown_unit(folder, command):
    told = ready(folder, command, "7")
    assert told.returncode == 2
    assert "There is no unit '7'" in told.stderr and "02_second" in told.stderr


# --- the commands -------------------------------------------------------------------------------------------


def test_check_keeps_the_best_result(folder, course):
    assert "not in work/ yet" in ready(folder, "check", "02").stderr
    course.make_copies()
    copy = folder / "work" / EXERCISE
    for answer, code, state in (
        (notebook("@"), 1, "1 of 5 points"),
        (notebook("@@@@@"), 0, "done, 5 of 5 points"),
        (notebook("@"), 1, "done, 5 of 5 points"),
    ):
        copy.write_text(answer)
        told = ready(folder, "check", "2")
        assert told.returncode == code and "checked 02_second" in told.stdout
        assert re.search(r"02_second\s+" + state, ask(folder, "check").stdout)


def test_check_any_file(folder, tmp_path, course):
    (tmp_path / "02_mine.ipynb").write_text("@@@@@")
    assert ready(folder, "check", tmp_path / "02_mine.ipynb").returncode == 0
    assert "not checked yet" in ask(folder, "check").stdout  # a file from elsewhere does not count
    (tmp_path / "02_second" / "deep").mkdir(parents=True)
    (tmp_path / "02_second" / "deep" / "mine.py").write_text("@@@@@")
    assert ready(folder, "check", tmp_path / "02_second" / "deep" / "mine.py").returncode == 0
    (tmp_path / "mine.py").write_text("@@@@@")
    told = ready(folder, "check", tmp_path / "mine.py")
    assert told.returncode == 2 and "--unit" in told.stderr
    assert ready(folder, "check", tmp_path / "mine.py", "--unit", "2").returncode == 0


def called(course, monkeypatch, *arguments):
    """What a command would run last, and in which environment."""
    calls = []
    monkeypatch.setenv("COURSE_PYTHON", sys.executable)
    monkeypatch.setattr(
        course, "run", lambda python, command, **changes: calls.append((command, changes)) or 0
    )
    assert course.main([*arguments]) == 0
    return calls[-1]


def test_arguments_reach_pytest_and_bench_in_order(course, monkeypatch):
    arguments = ["-m", "slow", "tests/test_a.py", "-k", "not b", "-x"]
    command, changes = called(course, monkeypatch, "test", *arguments)
    assert command == ["-m", "pytest", *course.SIDE_BY_SIDE, *arguments]
    assert changes["OPENBLAS_NUM_THREADS"] == "1"
    command, changes = called(course, monkeypatch, "bench", "top", "--out", "here")
    assert command == ["-m", "reference.bench", "top", "--out", "here"]
    assert changes["OMP_NUM_THREADS"] == "1"


@pytest.mark.parametrize("user, root", [(0, True), (1000, False)])
def test_lab_serves_work_and_only_our_kernel(course, monkeypatch, user, root):
    monkeypatch.setattr(course.os, "geteuid", lambda: user, raising=False)
    command, changes = called(course, monkeypatch, "lab", "--no-browser", "--port", "8901")
    assert command[:3] == ["-m", "jupyterlab", str(course.WORK)]
    assert "--LabApp.default_url=/lab/tree/notebooks/01_first.ipynb" in command
    assert "--KernelSpecManager.allowed_kernelspecs={'python3'}" in command
    assert {"--ServerApp.port=8901", "--ServerApp.open_browser=False"} <= set(command)
    assert ("--allow-root" in command) == root
    assert Path(changes["JUPYTER_DATA_DIR"]).is_relative_to(course.WORK)


def test_foreign_settings_do_not_reach_children(course, monkeypatch):
    for name in ("PYTHONPATH", "PYTHONHOME", "PYTHONDONTWRITEBYTECODE", "JUPYTER_PATH"):
        monkeypatch.setenv(name, "elsewhere")
    child = course.environment(EXTRA="1")
    assert child["PYTHONPATH"] == str(course.ROOT) and child["PYTHONUTF8"] == "1" and child["EXTRA"] == "1"
    assert not {"PYTHONHOME", "PYTHONDONTWRITEBYTECODE", "JUPYTER_PATH"} & set(child)


@pytest.mark.parametrize(
    "command", ["lab", "test", "check", "reset", "update", "bench", "book", "release", "grade", "collect"]
)
def test_help_and_overview(folder, command):
    told = ask(folder, command, "--help")
    assert told.returncode == 0 and "usage: " in told.stdout
    told = ask(folder)
    assert told.returncode == 0 and re.search(rf"^ +{command} ", told.stdout, re.MULTILINE)


def test_what_is_to_come_says_so(folder):
    told = ask(folder, "book")
    assert told.returncode == 2 and "is not part of the course yet" in told.stderr


@pytest.mark.parametrize(
    "command", [["release", "--out", "x"], ["grade", "submitted", "--jobs", "2"], ["collect", "x.zip"]]
)
def test_a_students_copy_has_no_instructors_commands(folder, command):
    told = ask(folder, *command)
    assert told.returncode == 2 and "students' copy" in told.stderr


@pytest.mark.parametrize(
    "command", [["nonsense"], ["lab", "--nonsense"], ["reset"], ["--nonsense"], ["lab", "--port", "x"]]
)
def test_bad_usage(folder, command):
    told = ask(folder, *command)
    assert told.returncode == 2 and told.stderr.startswith("usage: ")


def test_a_python_that_is_none(folder):
    told = ask(folder, "test", COURSE_PYTHON="nowhere")
    assert told.returncode == 2 and "COURSE_PYTHON is nowhere" in told.stderr


# --- the real thing -----------------------------------------------------------------------------------------


def test_the_pins_are_pins():
    lines = (ROOT / "environment.txt").read_text(encoding="utf-8").splitlines()
    wanted = {re.match(r"#- ([\w-]+)", line)[1] for line in lines if line.startswith("#- ")}
    pins = [line for line in lines if line and not line.startswith("#")]
    names = [re.match(r"([a-z0-9-]+)==[\w.]+( ; .+)?$", line)[1] for line in pins]
    assert wanted <= set(names)
    assert names == sorted(names)
    (pybullet,) = [line for line in pins if line.startswith("pybullet")]
    assert pybullet.startswith("pybullet==3.2.7 ; python_full_version < '3.12'")


GROUPED = """import os, pathlib, pytest
@pytest.mark.xdist_group("one")
@pytest.mark.parametrize("k", range(8))
def test(k):
    pathlib.Path(os.environ["PYTEST_XDIST_WORKER"]).touch()
"""


def test_the_tests_of_a_group_run_in_one_process(tmp_path):
    (tmp_path / "test_grouped.py").write_text(GROUPED, encoding="utf-8")
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-n",
        "2",
        "--dist",
        "loadgroup",
        "-p",
        "no:cacheprovider",
    ]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "8 passed" in done.stdout, done.stdout + done.stderr
    assert len(list(tmp_path.glob("gw*"))) == 1  # and not two, as with pytest 9.2


@pytest.mark.slow
def test_a_fresh_clone_sets_itself_up_and_serves(tmp_path):
    """With the network or not at all: the whole way of a new student, but for the browser."""
    folder = tmp_path / "clone"
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(".*", "work", "build", "__pycache__"))
    told = subprocess.run(
        [sys.executable, "course.py", "test", "tests/test_course.py", "-q", "-k", "pins"],
        cwd=folder,
        env={**clean(), **{k: v for k, v in os.environ.items() if k.startswith("PIP_")}},
        capture_output=True,
        text=True,
        check=False,
    )
    if "There is no network" in told.stderr:
        pytest.skip("there is no network")
    assert told.returncode == 0, told.stdout + told.stderr
    assert "1 passed" in told.stdout
    log = folder / "log"
    with log.open("w") as output:
        server = subprocess.Popen(
            [sys.executable, "course.py", "lab", "--no-browser"],
            cwd=folder,
            env=clean(),
            stdout=output,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
        )
    try:
        deadline = time.monotonic() + 600
        while not (found := re.search(r"http://127\.0\.0\.1:\d+/\S+", log.read_text())):
            assert time.monotonic() < deadline and server.poll() is None, log.read_text()
            time.sleep(0.2)
        with urllib.request.urlopen(found.group()) as page:
            assert page.status == 200 and b"JupyterLab" in page.read()
    finally:
        server.terminate()
        server.wait(timeout=60)
