"""Which files a student's tools need: the allow-list, as paths of this machine.

A throwaway process loads all that the parent will load, runs nothing of a student's, and tells which
libraries the system mapped for it: so no folder of the system's needs to be opened as a whole.
"""

import functools
import importlib.util
import json
import os
import subprocess
import sys
import sysconfig
from dataclasses import dataclass
from pathlib import Path

from exercises.grader import absent, ipython

ROOT = Path(__file__).resolve().parents[3]
INTERPRETER = str(Path(getattr(sys, "_base_executable", None) or sys.executable).resolve())
NOT_OF_THE_LIBRARY = {"site-packages", "dist-packages", "test", "idlelib", "ensurepip", "turtledemo"}
OURS = (
    "exercises/__init__.py",
    *(f"exercises/grader/{name}.py" for name in ("__init__", "absent", "cells", "ipython", "numba_cache")),
    *(
        f"exercises/grader/{name}.py"
        for name in ("replies", "state", "worker", "classroom/__init__", "classroom/fingerprint")
    ),
    *(
        f"exercises/grader/sandbox/{name}.py"
        for name in ("__init__", "canary", "confine", "inside", "kernel")
    ),
    *(
        f"exercises/grader/sandbox/{name}.py"
        for name in ("landlock", "limits", "parent", "preload", "seccomp")
    ),
    "exercises/grader/sandbox/syscalls.py",
)
SYSTEM = ("/etc/ld.so.cache", "/etc/localtime", "/usr/share/zoneinfo", "/proc/cpuinfo", "/proc/meminfo")
DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")

_TELL = """
import json, os, sys
sys.path += json.loads(sys.argv[1])
from exercises.grader.sandbox import preload
def size():
    return int(open("/proc/self/statm").read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
preload.bring(preload.MODULES)
sizes = [size()]
preload.load()
sizes.append(size())
mapped = {line.split(None, 5)[5].strip() for line in open("/proc/self/maps") if "/" in line}
print(json.dumps([sorted(mapped), sizes]))
"""


@dataclass(frozen=True)
class Survey:
    path: tuple  # what is added to sys.path, beside the course's folder
    library: tuple  # entries of the standard library's folders
    listable: tuple  # folders in which names may be looked up
    tools: tuple  # packages
    system: tuple  # shared libraries and their other names
    loaded: tuple  # bytes of addresses in use once all is loaded, without the large tools and with them

    @property
    def readable(self):
        return [INTERPRETER, *self.library, *self.tools, *self.system, *SYSTEM, *DEVICES]


def environment(scratch):
    """The parent's whole environment."""
    threads = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "BLIS")}
    return {
        **threads, "NUMBA_NUM_THREADS": "4", "NUMBA_THREADING_LAYER": "workqueue", "MPLBACKEND": "Agg",
        "HOME": scratch, "TMPDIR": scratch, "MPLCONFIGDIR": scratch, "PATH": "/usr/bin:/bin",
        "LANG": "C.UTF-8", "PYTHONUTF8": "1", "TZ": "UTC",
    }  # fmt: skip


def command(code_or_module, *arguments, options=("-B",)):
    """The interpreter itself, not a virtual environment's link to it: no site, no user's folders, and with -B
    no bytecode written."""
    return [INTERPRETER, "-I", "-S", *options, "-X", "utf8", *code_or_module, *arguments]


_told = []  # what another process of the same grader has found


def take(known):
    """Spares this process the survey: `known` was made by another one, on this machine, in this run."""
    _told[:] = [known]


@functools.cache
def survey():
    if _told:
        return _told[0]
    tools = _tools()
    path = tuple(dict.fromkeys(str(Path(tool).parent) for tool in tools))
    done = subprocess.run(  # it writes bytecode, where it may, of all that the parents are to load
        command(("-c", _TELL), json.dumps([str(ROOT), *path]), options=()),
        capture_output=True, text=True, env=environment("/nonexistent"), cwd="/", timeout=120, check=False,
    )  # fmt: skip
    if done.returncode != 0:
        raise OSError(f"Python with its tools does not start as the sandbox needs it: {done.stderr[-500:]}")
    mapped, loaded = json.loads(done.stdout.splitlines()[-1])
    folders = _library_folders()
    library = [str(entry) for folder in folders for entry in _entries(folder)]
    known = (*library, *tools)
    system = [name for file in mapped if not file.startswith(tuple(known)) for name in _names_of(file)]
    system += _starters()
    tools += [str(file) for file in ipython.files().values()]
    return Survey(
        path, tuple(library), (*map(str, folders), *path), tuple(tools), tuple(system), tuple(loaded)
    )


def _tools():
    """Folders and files of the packages that students may use, and their `.libs`."""
    found = []
    for name in (*absent.TOOLS, *absent.NEEDED_BY_TOOLS):
        spec = importlib.util.find_spec(name)
        if spec is None or spec.origin is None and not spec.submodule_search_locations:
            continue
        places = [str(place) for place in spec.submodule_search_locations or ()] or [spec.origin]
        for place in map(Path, places):
            found.append(str(place))
            for alias in (name, "pillow"):
                libraries = place.parent / f"{alias}.libs"
                if libraries.is_dir():
                    found.append(str(libraries))
    return list(dict.fromkeys(found))


def _library_folders():
    names = ("stdlib", "platstdlib")
    folders = [Path(sysconfig.get_path(name, vars={"base": sys.base_prefix})) for name in names]
    bases = [Path(os.__file__).parent, *folders]
    return list(dict.fromkeys(base.resolve() for base in bases if base.is_dir()))


def _entries(folder):
    return [entry for entry in sorted(folder.iterdir()) if entry.name not in NOT_OF_THE_LIBRARY]


def _starters():
    """What the system starts programs by: it stands in each program under a fixed name."""
    names = [
        entry
        for folder in ("/lib64", "/lib")
        if os.path.isdir(folder)
        for entry in Path(folder).glob("ld-*.so*")
    ]
    return [str(entry.parent.resolve() / entry.name) for entry in names]


def _names_of(file):
    """The file, and the links beside it that lead to it: libraries are looked up by those names."""
    file = Path(file)
    if not file.is_file():
        return []
    stem = file.name.split(".so")[0]
    links = [
        entry for entry in file.parent.glob(f"{stem}*.so*") if entry.is_symlink() and entry.resolve() == file
    ]
    return [str(file), *map(str, links)]
