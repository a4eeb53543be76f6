#!/usr/bin/env python3
"""Sets the course up and runs its commands; `python3 course.py` alone tells which there are.

Only the standard library is used here, and no syntax newer than Python 3.6, so that an old Python can still
say what is missing. All other packages live in .venv, which is made from environment.txt on first use.
"""

import argparse
import contextlib
import datetime
import hashlib
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

OLDEST, NEWEST = (3, 11), (3, 14)       # for these, every pin but pybullet has a wheel
GIGABYTES = 1.5                         # what .venv needs while it is made

ROOT = Path(__file__).resolve().parent
VENV, WORK, BUILD = ROOT / ".venv", ROOT / "work", ROOT / "build"
PINS, LOG, RECORD = ROOT / "environment.txt", BUILD / "setup.log", WORK / ".course" / "record.json"
WINDOWS = os.name == "nt"
VENV_PYTHON = VENV / ("Scripts/python.exe" if WINDOWS else "bin/python")
STAMP = VENV / "course.stamp"           # empty while .venv is being made; the last thing written
ME = "py course.py" if WINDOWS else "python3 course.py"
LATER = {"book": "the web book"}


class Trouble(Exception):
    """Something that a person can mend. Its text says how, in one sentence."""


# --- What can go wrong while setting up, and the remedy ---------------------------------------------------

REMEDIES = (    # a pattern in pip's log or in the system's error; what to tell
    (r"Errno 28\b|No space left|not enough space|quota exceeded",
     "The disk is full: free {gigabytes} GB, then run the same command again."),
    (r"ensurepip",
     "This Python cannot make environments: {install}, then run the same command again."),
    (r"Errno (1|13|30)\b|Permission denied|Access is denied|Read-only file system",
     "Something here may not be written ({line}): close what uses this folder, or move the course to a "
     "folder of your own, then run the same command again."),
    (r"CERTIFICATE_VERIFY_FAILED|SSLError",
     "The package index could not be trusted, as behind some companies' proxies: use another network, "
     "{offline}."),
    (r"NewConnectionError|NameResolutionError|TimeoutError|ConnectTimeout|ProxyError|ConnectionReset"
     r"|getaddrinfo|Failed to establish|name resolution|Network is unreachable|Connection aborted",
     "There is no network, or the package index does not answer: connect and run the same command again, "
     "{offline}."),
    (r"No matching distribution found for (?P<package>\S+)",
     "{package} is not to be had ready-made for this system and Python: use a 64-bit Python {supported}, or, "
     "with --wheels, fill the folder with this Python's own pip."),
)
FETCH = "pip download --no-deps -d DIR -r environment.txt"
OFFLINE = f"or use --wheels DIR with packages fetched elsewhere ({FETCH})"


def remedy(text):
    """What to tell about an error; None if this program does not know it."""
    for pattern, sentence in REMEDIES:
        found = re.search(pattern, text, re.IGNORECASE)
        if found:
            line = text[text.rfind("\n", 0, found.start()) + 1:].split("\n")[0].strip()
            return sentence.format(line=line[:150], gigabytes=GIGABYTES, install=install_advice(),
                                   offline=OFFLINE, supported=supported(), **found.groupdict())
    return None


def supported():
    return f"{OLDEST[0]}.{OLDEST[1]} to {NEWEST[0]}.{NEWEST[1]}"


def install_advice(venv_of=None):
    """How this system installs a suitable Python, or on Debian the part that a Python lacks for our use."""
    if WINDOWS:
        return "winget install Python.Python.3.12"
    if sys.platform == "darwin":
        return "brew install python@3.12 (or take the installer from python.org)"
    try:
        system = Path("/etc/os-release").read_text(encoding="utf-8").lower()
    except OSError:
        system = ""
    debian = "python3 python3-venv (where that is too old: python3.11 python3.11-venv)"
    if venv_of:
        debian = f"python{venv_of}-venv"
    families = {"debian|ubuntu": "sudo apt install " + debian,
                "fedora|rhel": "sudo dnf install python3.12", "arch": "sudo pacman -S python",
                "suse": "sudo zypper install python312"}
    for family, command in families.items():
        if re.search(rf"^id(_like)?=.*\b({family})\b", system, re.MULTILINE):
            return command
    return "install Python 3.12 with its venv module, from your system's packages or python.org"


# --- A suitable Python ------------------------------------------------------------------------------------

PROBE = ("import sys, importlib.util as u; print(*sys.version_info[:2], int(all(map(u.find_spec, "
         "('venv', 'ensurepip')))), int(sys.maxsize > 2**32 and sys.implementation.name == 'cpython'))")


def find_python():
    """The command of a Python that can make .venv. Each is run, since a name on PATH may be an empty shim."""
    without_venv = None
    for command in candidates():
        major, minor, makes_venv, usable = probe(command)
        if usable and OLDEST <= (major, minor) <= NEWEST:
            if makes_venv:
                return command
            without_venv = without_venv or f"{major}.{minor}"
    if without_venv:
        raise Trouble(f"Python {without_venv} is here, but not its part that makes environments, venv: "
                      f"{install_advice(without_venv)}, then run the same command again.")
    this = ".".join(map(str, sys.version_info[:3]))
    raise Trouble(f"The course needs Python {supported()}, 64 bit; this is Python {this}, and no suitable "
                  f"one was found on PATH: {install_advice()}, then run the same command again.")


def candidates():
    """The Python that runs this file, or that its virtual environment is of; then all that can be found."""
    yield [getattr(sys, "_base_executable", None) or sys.executable]
    versions = [f"{OLDEST[0]}.{minor}" for minor in range(OLDEST[1], NEWEST[1] + 1)]
    if WINDOWS:
        for version in versions:
            yield ["py", "-" + version]
    for name in ["python" + version for version in [*versions, "3", ""]]:
        for folder in filter(None, os.environ.get("PATH", "").split(os.pathsep)):
            file = shutil.which(name, path=folder)
            if file:
                yield [file]


def probe(command):
    """(major, minor, can make environments, is a 64-bit CPython); all 0 for what does not run."""
    try:
        answer = subprocess.run([*command, "-c", PROBE], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                stdin=subprocess.DEVNULL, env=environment(), timeout=30, check=True)
        major, minor, makes_venv, usable = (int(word) for word in answer.stdout.split())
        return major, minor, makes_venv, usable
    except (OSError, ValueError, subprocess.SubprocessError):
        return 0, 0, 0, 0


# --- The environment --------------------------------------------------------------------------------------

def course_python(wheels=None):
    """The Python that has the course's packages, installed first if they are missing, old or half made.

    COURSE_PYTHON in the environment names another Python that has them already: nothing is set up then.
    """
    chosen = os.environ.get("COURSE_PYTHON")
    if chosen:
        if probe([chosen])[0] == 0:
            raise Trouble(f"COURSE_PYTHON is {chosen}, which is no Python that runs.")
        return chosen
    if not is_ready():
        with alone():
            if not is_ready():      # another set-up may have ended while we waited for it
                make_environment(find_python(), wheels)
    return str(VENV_PYTHON)


def is_ready():
    try:
        return STAMP.read_text(encoding="utf-8") == stamp()
    except OSError:
        return False


def stamp():
    """What .venv was made from. Its Python is run: an upgrade of the system can leave .venv without one."""
    major, minor, *_ = probe([str(VENV_PYTHON)])
    return f"{hashlib.sha256(PINS.read_bytes()).hexdigest()} Python {major}.{minor}\n"


@contextlib.contextmanager
def alone():
    """Waits until no other set-up runs here. The system frees the lock when its holders end or are killed."""
    BUILD.mkdir(exist_ok=True)
    with open(str(BUILD / "setup.lock"), "w") as lock:
        os.set_inheritable(lock.fileno(), True)     # pip holds it too, since it may outlive us
        if not locked(lock):
            print("Another set-up is at work in this folder; waiting for it to end ...", flush=True)
            while not locked(lock):
                time.sleep(0.5)
        yield


def locked(file):
    try:
        if WINDOWS:
            import msvcrt
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl
            fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        pass                        # a file system without locks: go on without
    return True


def make_environment(python, wheels=None):
    """Makes .venv anew. What an interrupted set-up left is thrown away: no half-written package stays."""
    if wheels and not Path(wheels).is_dir():
        raise Trouble(f"--wheels {wheels}: there is no such folder.")
    print(f"Setting up {VENV}, once; it takes a minute or two.", flush=True)
    clear_environment()
    if shutil.disk_usage(str(ROOT)).free < GIGABYTES * 1e9:
        raise OSError(28, "No space left on device")
    VENV.mkdir()
    STAMP.touch()
    LOG.write_bytes(b"")
    logged([*python, "-m", "venv", str(VENV)], lambda log: "Making the environment")
    where = [str(VENV_PYTHON), "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    packages = Path(subprocess.check_output(where, env=environment()).decode("utf-8").strip())
    # `import reference` from any folder and in any editor; a relative path, so that the course can be moved
    (packages / "course.pth").write_text(os.path.relpath(str(ROOT), str(packages)) + "\n", encoding="utf-8")
    install(packages, wheels)
    STAMP.write_text(stamp(), encoding="utf-8")
    print("All packages are installed. To start afresh, delete the folder .venv.", flush=True)


def clear_environment():
    """Removes .venv if it is ours; one that somebody made for another purpose is set aside."""
    if STAMP.exists() and not VENV.is_symlink():
        shutil.rmtree(str(VENV))
    elif os.path.lexists(str(VENV)):
        aside = VENV.with_name(".venv-set-aside-" + now())
        VENV.rename(aside)
        print(f"There was a .venv that this program did not make; it is now {aside.name}.", flush=True)


def install(packages, wheels=None):
    """Installs the pins, compiling none. All dependencies are among them, so pip need not look for any."""
    source = ["--no-index", "--find-links", str(Path(wheels).resolve())] if wheels else []
    before = len(list(packages.glob("*.dist-info")))
    pins = len(re.findall(r"^[^#\s]", PINS.read_text(encoding="utf-8"), re.MULTILINE))

    def progress(log):
        total = pins - log.count("Ignoring ")       # those of other systems and Pythons
        fetched = len(re.findall(r"^(?:Collecting|Processing) ", log, re.MULTILINE))
        if not fetched:
            return "Looking for packages"
        if "Installing collected packages" in log:
            verb, done = "Installing", len(list(packages.glob("*.dist-info"))) - before
        else:
            verb, done = "Fetching", fetched
        return f"{verb} packages: {max(0, min(done, total))} of {total}"

    quiet = ["--no-input", "--disable-pip-version-check", "--progress-bar", "off"]
    logged([str(VENV_PYTHON), "-m", "pip", "install", "--no-deps", "--only-binary", ":all:", "--no-compile",
            *quiet, *source, "-r", str(PINS)], progress)


def logged(command, progress):
    """Runs a command with its output in the log, shows how far it is, and explains a failure."""
    with open(str(LOG), "ab") as log:
        start = log.tell()
        child = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                 cwd=str(ROOT), env=environment(PIP_USER="0"), close_fds=False)
    shown, ended = "", False
    try:
        while not ended:
            time.sleep(0.2)
            ended = child.poll() is not None
            text = LOG.read_bytes()[start:].decode("utf-8", "replace")
            shown = show(progress(text), shown, ended)
    finally:
        if not ended:
            child.kill()
            child.wait()
    if child.returncode:
        tail = "\n".join(text.strip().split("\n")[-8:])
        raise Trouble(remedy(text) or f"Setting up failed, and the end of {LOG} says why; the same command "
                      f"starts afresh.\n{tail}")


def show(line, shown, last):
    """Shows progress: a line that renews itself on a terminal, elsewhere a line each ten packages."""
    if sys.stdout.isatty():
        print("\r" + line.ljust(len(shown)), end="\n" if last else "", flush=True)
        return line
    tens, tens_shown = (re.sub(r"\d of", " of", words) for words in (line, shown))
    if tens != tens_shown or (last and line != shown):
        print(line, flush=True)
        return line
    return shown


# --- Running programs in the environment ------------------------------------------------------------------

THREADS = {name + "_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "BLIS", "VECLIB_MAXIMUM")}
SIDE_BY_SIDE = ("-n", "auto", "--maxprocesses", "4", "--dist", "loadgroup")     # tests, on several processors
# Without bytecode, which pip is told to leave to the first use, each process would compile what it imports.
UNWANTED = ("PYTHONHOME", "PYTHONSTARTUP", "PYTHONDONTWRITEBYTECODE", "__PYVENV_LAUNCHER__", "JUPYTER_PATH",
            "JUPYTER_CONFIG_PATH", "JUPYTERLAB_DIR", "JUPYTERLAB_SETTINGS_DIR", "JUPYTERLAB_WORKSPACES_DIR")


def environment(**changes):
    """A child's environment. A PYTHONPATH set by other software would bring in another Python's packages."""
    kept = {key: value for key, value in os.environ.items() if key not in UNWANTED}
    return dict(kept, PYTHONPATH=str(ROOT), PYTHONUTF8="1", **changes)


def run(python, arguments, **changes):
    """Runs the environment's Python in the course's folder, and returns its exit code."""
    path = os.path.dirname(python) + os.pathsep + os.environ.get("PATH", "")
    child = subprocess.Popen([python, *arguments], cwd=str(ROOT), env=environment(PATH=path, **changes))
    signal.signal(signal.SIGTERM, lambda *_: child.terminate())
    while True:
        try:
            return child.wait()
        except KeyboardInterrupt:
            pass                    # the child got Ctrl-C too, and how it ends is its own affair


# --- The student's copies ---------------------------------------------------------------------------------

def originals():
    """What work/ has copies of: notebooks, exercises, and the pages that they link to."""
    files = [*ROOT.glob("notebooks/[0-9]*.ipynb"), *ROOT.glob("exercises/[0-9]*/[0-9]*.ipynb"),
             *ROOT.glob("lectures/*.md"), *ROOT.glob("lectures/figures/*.*")]
    return sorted(file.relative_to(ROOT).as_posix() for file in files)


def units(folder=""):
    return sorted({Path(name).stem for name in originals() if re.match(folder + r".*\.ipynb$", name)})


def unit_named(text, folder=""):
    """The unit that 2, 02 or 02_equation_of_motion names."""
    for unit in units(folder):
        if text == unit or (text.isdigit() and int(text) == int(unit.split("_")[0])):
            return unit
    raise Trouble(f"There is no unit '{text}', nor a file of that name. The units here: "
                  f"{', '.join(units(folder))}.")


def fingerprint(file):
    """Of what a student writes in a notebook; running it changes outputs and counts, but not this."""
    content = file.read_bytes()
    with contextlib.suppress(ValueError, KeyError, TypeError):
        cells = json.loads(content.decode("utf-8"))["cells"]
        content = json.dumps([(cell["cell_type"], "".join(cell["source"])) for cell in cells]).encode("utf-8")
    return hashlib.sha256(content).hexdigest()


def read_record():
    """For each copy the fingerprint of the original that it was made from; for each unit its best result."""
    try:
        return json.loads(RECORD.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {"copies": {}, "checks": {}}


def write_record(record):
    write(RECORD, (json.dumps(record, indent=1) + "\n").encode("utf-8"))


def write(file, content):
    """Writes all of the file or nothing of it, whatever happens meanwhile."""
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(file.name + ".part")
    part.write_bytes(content)
    os.replace(str(part), str(file))


def write_beside(file, label, content):
    """Writes to a name that is not taken: lesson.label.ipynb, lesson.label-2.ipynb, ...; returns it."""
    for number in itertools.count(1):
        suffix = "" if number == 1 else f"-{number}"
        name = file.with_name(f"{file.stem}.{label}{suffix}{file.suffix}")
        with contextlib.suppress(FileExistsError), open(str(name), "xb") as new:
            new.write(content)
            return name


def now():
    return datetime.datetime.now().strftime("%Y-%m-%d-%H%M%S")


def make_copies():
    """Copies what work/ lacks; returns those originals of which the student's copy is an older version."""
    record, newer = read_record(), []
    for name in originals():
        original = fingerprint(ROOT / name)
        if not (WORK / name).exists():
            write(WORK / name, (ROOT / name).read_bytes())
            record["copies"][name] = original
        elif original not in (record["copies"].get(name), fingerprint(WORK / name)):
            newer.append(name)
    write_record(record)
    link_modules()
    return newer


def link_modules():
    """Lets the links from pages to modules lead somewhere within work/. Nothing else needs this."""
    link = WORK / "reference"
    if not os.path.lexists(str(link)):
        with contextlib.suppress(OSError):
            if WINDOWS:
                import _winapi
                _winapi.CreateJunction(str(ROOT / "reference"), str(link))
            else:
                link.symlink_to(Path("..") / "reference")


# --- The commands -----------------------------------------------------------------------------------------

def lab(options, _):
    python = course_python(options.wheels)
    newer = make_copies()
    if newer:
        print(f"There are new versions of {len(newer)} files in work/; to get them: {ME} update")
    settle_jupyter()
    compiled = run(python, ["-m", "reference"])     # compiles the loops, where that was not done yet
    if compiled < 0 or compiled > 127:
        return compiled                             # interrupted: what was asked for is to stop
    first = next((name for name in originals() if name.startswith("notebooks/")), None)
    command = ["-m", "jupyterlab", str(WORK), "--ServerApp.log_level=ERROR", "--LabApp.log_level=ERROR",
               "--LabApp.default_url=/lab" + (f"/tree/{first}" if first else ""),
               # one kernel, the environment's, whatever a notebook or the user's own Jupyter say
               "--KernelSpecManager.allowed_kernelspecs={'python3'}",
               "--MultiKernelManager.default_kernel_name=python3",
               "--KernelManager.transport_encryption=auto",     # else kernels warn about listeners
               # nothing asks the network
               "--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
               "--LabApp.extension_manager=readonly"]
    if options.port is not None:
        command.append(f"--ServerApp.port={options.port}")
    if options.no_browser:
        command.append("--ServerApp.open_browser=False")
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        command.append("--allow-root")
    print("JupyterLab starts; your copies are in work/. To stop it, press Ctrl-C here, twice.", flush=True)
    private = WORK / ".jupyter"     # settings, kernels and start-up files of other Jupyters stay out
    return run(python, command, JUPYTER_PREFER_ENV_PATH="1", JUPYTER_CONFIG_DIR=str(private),
               JUPYTER_DATA_DIR=str(private / "data"), IPYTHONDIR=str(private / "ipython"))


def settle_jupyter():
    """JupyterLab's first settings, then the student's own: no news, no extensions, pages open as pages."""
    off = ["@jupyterlab/apputils-extension:announcements", "@jupyterlab/extensionmanager-extension:plugin"]
    own = "lab/user-settings/@jupyterlab/{}.jupyterlab-settings".format
    settings = {"labconfig/page_config.json": {"disabledExtensions": dict.fromkeys(off, True)},
                own("docmanager-extension/plugin"): {"defaultViewers": {"markdown": "Markdown Preview"}},
                # the default kernel, not a question, where a notebook asks for one that is not here
                own("notebook-extension/tracker"): {"autoStartDefaultKernel": True}}
    for name, content in settings.items():
        if not (WORK / ".jupyter" / name).exists():
            write(WORK / ".jupyter" / name, json.dumps(content).encode("utf-8"))


def test(options, rest):
    """An option given twice counts as it is given last: `-n 0` runs one test after the other."""
    arguments = ["-m", "pytest", *SIDE_BY_SIDE, *rest]
    return run(course_python(options.wheels), arguments, MPLBACKEND="Agg", **THREADS)


def bench(options, rest):
    return run(course_python(options.wheels), ["-m", "reference.bench", *rest], MPLBACKEND="Agg", **THREADS)


def classroom(options, rest):
    """grade, collect, release: an instructor's commands, which exercises/grader/classroom/ does."""
    if not (ROOT / "exercises/grader/classroom").is_dir():
        raise Trouble(f"This is the students' copy of the course; '{options.command}' is in the "
                      "instructor's.")
    return run(course_python(options.wheels), ["-m", "exercises.grader.classroom", options.command, *rest],
               COURSE_FROM=os.getcwd(), MPLBACKEND="Agg", **THREADS)


def check(options, _):
    if options.target is None:
        return show_checks()
    unit, file = unit_and_file(options.target, options.unit)
    python = course_python(options.wheels)
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "result.json"
        code = run(python, ["-m", "exercises.grader.shell", "--unit", unit, "--json", str(answer), str(file)])
        if answer.exists() and file == own_copy(unit):
            keep_result(unit, json.loads(answer.read_text(encoding="utf-8")))
    return code


def own_copy(unit):
    return WORK / "exercises" / unit / f"{unit}.ipynb"


def unit_and_file(target, unit=None):
    """What to check. A unit means the copy in work/. A file's name or a folder tells its unit, or --unit."""
    file = Path(target).resolve()
    if file.is_file():
        choices = units("exercises/")
        numbers = {choice.split("_")[0] for choice in choices}
        told = [word.split("_")[0] for word in reversed(file.parts) if word.split("_")[0] in numbers]
        if not unit and not told:
            raise Trouble(f"Which unit is {target} of? Add --unit and one of {', '.join(choices)}.")
        return unit_named(unit or told[0], "exercises/"), file
    unit = unit_named(target, "exercises/")
    if not own_copy(unit).exists():
        raise Trouble(f"Your copy of {unit} is not in work/ yet: {ME} lab makes it.")
    return unit, own_copy(unit)


def keep_result(unit, result):
    """Keeps the best result of a unit, on this machine only."""
    record = read_record()
    best = record["checks"].get(unit, {})
    if result["earned"] >= best.get("earned", 0) or result["possible"] != best["possible"]:
        record["checks"][unit] = dict(result, when=now()[:10])
        write_record(record)


def show_checks():
    checks = read_record()["checks"]
    for unit in units("exercises/"):
        best = checks.get(unit)
        state = "not checked yet"
        if best:
            state = "done, " if best["earned"] == best["possible"] else ""
            state += f"{best['earned']} of {best['possible']} points, {best['when']}"
        print(f"{unit:30} {state}")
    print(f"\n'{ME} check UNIT' checks your copy. This list stays on your machine.")
    return 0


def reset(options, _):
    unit, record = unit_named(options.unit), read_record()
    for name in originals():
        file = WORK / name
        if file.stem == unit and file.suffix == ".ipynb":
            if file.exists() and file.read_bytes() != (ROOT / name).read_bytes():
                aside = write_beside(file, "old-" + now(), file.read_bytes())
                print(f"Your old copy is now {aside.relative_to(ROOT).as_posix()}")
            write(file, (ROOT / name).read_bytes())
            record["copies"][name] = fingerprint(ROOT / name)
            print(f"Fresh: work/{name}")
    write_record(record)
    return 0


def update(_, __):
    newer = make_copies()
    record = read_record()
    for name in newer:
        file, content = WORK / name, (ROOT / name).read_bytes()
        if fingerprint(file) == record["copies"].get(name):
            write(file, content)
            print(f"New version, as you had not edited the old one: work/{name}")
        else:
            beside = write_beside(file, "new-" + now()[:10], content)
            print(f"You have edited work/{name}: the new version stands beside it, {beside.name}")
        record["copies"][name] = fingerprint(ROOT / name)
    write_record(record)
    print("work/ has the newest version of everything.")
    return 0


def later(options, _):
    raise Trouble(f"'{ME} {options.command}' ({LATER[options.command]}) is not part of the course yet.")


def overview(parser):
    parser.print_help()
    state = "set up" if is_ready() else "not set up yet; lab, test, check, bench and grade do that first"
    print(f"\nUnits here: {', '.join(units())}. The environment is {state}.")
    return 0


def make_parser():
    parser = argparse.ArgumentParser(
        prog=ME, formatter_class=argparse.RawDescriptionHelpFormatter,
        description=f"A course on simulating rigid bodies and continua. To begin:\n\n    {ME} lab",
        epilog=f"UNIT is a number or a name: 2, 02, 02_equation_of_motion. More: {ME} COMMAND --help")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", title="commands")

    def command(name, function, summary, more="", usage=None):
        added = commands.add_parser(name, help=summary, usage=usage and f"{ME} {name} {usage}",
                                    description=f"{summary[0].upper()}{summary[1:]}. {more}")
        added.set_defaults(function=function, passes_on=usage is not None)
        if function in (lab, test, check, bench, classroom):
            added.add_argument("--wheels", metavar="DIR", help="set up without network, from packages in "
                               f"DIR, which this fills: {FETCH}")
        return added

    added = command("lab", lab, "open JupyterLab on work/, your own copies of notebooks and exercises",
                    "Sets up on first use. Your copies are never written over.")
    added.add_argument("--no-browser", action="store_true", help="only serve, and print the address to open")
    added.add_argument("--port", type=int, help="serve on this port, or the next free one (default 8888)")
    command("test", test, "run all tests", "Sets up on first use. Runs on up to four processors. All other "
            "arguments go to pytest: -m slow, -k NAME, -n 0 (one test after the other, with all they print), "
            "...", usage="[--wheels DIR] [PYTEST ARGUMENTS ...]")
    added = command("check", check, "check your exercise; alone: show which units are done",
                    "Exit code: 0 all checks pass, 1 some fail, 2 it could not be checked.")
    added.add_argument("target", nargs="?", metavar="UNIT|PATH", help="a unit (your copy in work/) or a file")
    added.add_argument("--unit", help="which unit a file is of, if its name does not tell")
    added = command("reset", reset, "put a fresh copy of a unit in work/; the old one is set aside, dated")
    added.add_argument("unit", metavar="UNIT")
    command("update", update, "bring new versions into work/, beside those copies that you have edited")
    command("bench", bench, "speed against error: a table, JSON lines and plots in build/bench",
            "Without CASE: all cases.",
            usage="[--wheels DIR] [CASE ...] [--out DIR] [--quick] [--scheduler ADDRESS]")
    command("grade", classroom, "grade a class: FOLDER/submitted/<student>/<unit>/*.ipynb",
            "Writes scores.csv, feedback/ and instructor/ beside submitted/, or to --out. After an "
            "interruption the same command goes on where it stopped. More: lectures/instructors.md.",
            usage="[--wheels DIR] FOLDER [--out DIR] [--unit UNIT] [--seed N] [--jobs N] "
                  "[--scheduler ADDRESS] [--regrade] [--allow-lower] [--anonymous] [--canvas CSV] "
                  "[--moodle CSV] [--exercises DIR] [--unsafe-no-sandbox]")
    command("collect", classroom, "unpack a download from Canvas or Moodle into submitted/<student>/<unit>/",
            usage="[--wheels DIR] ZIP [--out FOLDER] [--unit UNIT] [--exercises DIR]")
    command("release", classroom, "make the students' copy: no solutions, oracles, generators or seeds",
            "Writes release/<unit>/ as nbgrader hands it out, and course.zip.",
            usage="[--wheels DIR] [--out DIR] [--exercises DIR]")
    for name, what in LATER.items():
        command(name, later, what + " (not part of the course yet)", usage="...")
    return parser


def main(arguments=None):
    parser = make_parser()
    options, rest = parser.parse_known_args(arguments)
    if options.command is None and not rest:
        return overview(parser)
    if options.command is None or (rest and not options.passes_on):
        parser.error(f"unknown: {' '.join(rest)}")
    return options.function(options, rest)


def guarded_main():
    """main(), with a sentence instead of a traceback for what a person can mend."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")    # a console that cannot show a letter must not stop us
    try:
        return main()
    except Trouble as trouble:
        print(trouble, file=sys.stderr)
    except BrokenPipeError:         # as after `| head`: nobody reads on
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        if remedy(str(error)) is None:
            raise
        print(remedy(str(error)), file=sys.stderr)
    except KeyboardInterrupt:
        print("\nInterrupted. The same command begins again where that is needed.", file=sys.stderr)
        return 130
    return 2


if __name__ == "__main__":
    sys.exit(guarded_main())
