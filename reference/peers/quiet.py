"""Importing an engine without its greeting: pybullet writes to the terminal from C, past Python's streams.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import contextlib
import os
import sys


@contextlib.contextmanager
def silence():
    """Nothing reaches the terminal, not even from compiled code."""
    sys.stdout.flush()
    sys.stderr.flush()
    nowhere, kept = os.open(os.devnull, os.O_WRONLY), [(number, os.dup(number)) for number in (1, 2)]
    try:
        for number, _ in kept:
            os.dup2(nowhere, number)
        yield
    finally:
        for number, copy in kept:
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)
