"""A grader's own folder among the temporary ones. It goes with the grader, or when a later one starts."""

import contextlib
import fcntl
import os
import shutil
import stat
import tempfile
import time
from pathlib import Path

PREFIX, LOCK = "grader-", "in-use"


def make():
    """(folder, open lock). While the lock is open the folder is in use."""
    sweep()
    folder = Path(tempfile.mkdtemp(prefix=PREFIX))
    folder.chmod(0o755)
    lock = open(folder / LOCK, "w")  # noqa: SIM115 (open as long as the folder is needed)
    fcntl.flock(lock, fcntl.LOCK_EX)
    return folder, lock


def sweep(age=60.0):
    """Removes what graders left that were killed; none so new that its lock may not be set yet."""
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with contextlib.suppress(OSError):
            told = folder.lstat()
            if (
                not stat.S_ISDIR(told.st_mode)
                or told.st_uid != os.getuid()
                or time.time() - told.st_mtime < age
            ):
                continue
            with open(folder / LOCK) as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
