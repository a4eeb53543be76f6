"""Reading what lies on the grader's disk: a student's file, as bytes and no more, and our own helpers."""

import functools
import marshal
import os
import stat

from exercises.grader.sandbox.preload import names_tools


def contents(source, longest):
    """(bytes, "notebook" or "script") of a path or of bytes. No link is followed, nothing but a file is
    read."""
    if isinstance(source, bytes):
        data, form = source, "notebook"
    else:
        number = os.open(source, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
        with os.fdopen(number, "rb") as file:
            if not stat.S_ISREG(os.fstat(number).st_mode):
                raise ValueError("it is not a file")
            data = file.read(longest + 1)
        form = "notebook" if str(source).endswith(".ipynb") else "script"
    if len(data) > longest:
        raise ValueError(f"it has more than {longest:,} bytes")
    return data, form


@functools.cache
def compiled(given):
    """The code of a unit's helpers, ours and not a student's: compiled here once instead of in each worker.
    And whether they import one of the large tools as soon as they are there."""
    code = compile(given.read_bytes(), "given.py", "exec")
    return marshal.dumps(code), names_tools(" ".join(code.co_names).encode())
