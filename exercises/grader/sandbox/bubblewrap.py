"""The command line of bubblewrap: new namespaces of every kind, and a root folder that holds the allow-list
only."""

import os
import shutil
from pathlib import Path

from exercises.grader.sandbox.survey import DEVICES, INTERPRETER, OURS, ROOT, SYSTEM

COURSE = "/course"
SCRATCH = "/student/course/work"  # as deep as a real one, for cells that look for folders above
# The parent's, for making a worker's scratch folder and for taking another user; a worker drops them.
CAPABILITIES = ("SYS_ADMIN", "SETUID", "SETGID", "SETPCAP", "KILL", "DAC_READ_SEARCH")


def available():
    return shutil.which("bwrap", path=os.environ.get("PATH", "") + ":/usr/bin:/bin")


def command(program, survey):
    """`program` (a list), run by bwrap."""
    spaces = ["--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try"]
    if os.getuid() == 0:
        capabilities = ["--cap-drop", "ALL", *_pairs("--cap-add", (f"CAP_{name}" for name in CAPABILITIES))]
    else:
        spaces.append("--unshare-user")
        capabilities = ["--cap-drop", "ALL", "--cap-add", "CAP_SYS_ADMIN", "--cap-add", "CAP_SETPCAP"]
    return [
        available(), *spaces, *capabilities, "--die-with-parent", "--new-session", "--as-pid-1",
        *_links(), *_binds(survey), "--tmpfs", SCRATCH, "--chdir", "/", "--remount-ro", "/", "--", *program,
    ]  # fmt: skip


def _binds(survey):
    """Single files and folders, read-only. The library's folder whole, with what is not of it covered."""
    arguments = []
    library = {os.path.dirname(entry) for entry in survey.library}
    for folder in sorted(library):
        arguments += ["--ro-bind", folder, folder]
        for name in sorted({entry.name for entry in Path(folder).iterdir() if entry.is_dir()}):
            if os.path.join(folder, name) not in survey.library:
                arguments += [
                    "--tmpfs",
                    os.path.join(folder, name),
                    "--remount-ro",
                    os.path.join(folder, name),
                ]
    for path in (INTERPRETER, *survey.tools, *survey.system, *SYSTEM):
        arguments += ["--ro-bind-try", path, path]
    for path in DEVICES:
        arguments += ["--dev-bind-try", path, path]
    for name in OURS:
        arguments += ["--ro-bind-try", str(ROOT / name), f"{COURSE}/{name}"]
    return arguments


def _links():
    """/lib and its like, where they are links into /usr."""
    arguments = []
    for name in ("/lib", "/lib64", "/lib32", "/bin"):
        if os.path.islink(name):
            arguments += ["--symlink", os.readlink(name), name]
    return arguments


def _pairs(option, values):
    return [item for value in values for item in (option, value)]
