"""What a parent loads before its first fork, so that a worker starts in milliseconds.

What is loaded is copied (in part) for each fork. So there are two kinds of parent, and a submission that
names none of the large tools is not made to carry them.
"""

import builtins
import contextlib
import gc
import importlib
import random
import sys

MODULES = (
    "exercises", "exercises.grader.replies", "exercises.grader.cells", "exercises.grader.worker",
    "exercises.grader.sandbox.inside", "exercises.grader.sandbox.confine", "exercises.grader.sandbox.canary",
    "numpy", "numpy.random", "numpy.polynomial", "numpy.fft",
    "asyncio", "dataclasses", "typing", "functools", "itertools", "collections", "fractions", "decimal",
    "statistics", "time", "timeit", "copy", "pprint", "lzma", "bz2", "zlib",
    "ctypes", "concurrent.futures", "threading", "subprocess",
)  # fmt: skip
TOOLS = (
    "numpy.testing", "unittest",
    "scipy", "scipy.linalg", "scipy.sparse", "scipy.sparse.linalg", "scipy.integrate", "scipy.optimize",
    "scipy.spatial.transform", "scipy.interpolate", "scipy.special",
    "numba", "numba.np.ufunc.parallel", "matplotlib", "matplotlib.pyplot",
    "ssl", "sqlite3", "multiprocessing", "curses", "readline", "uuid",
)  # fmt: skip
WORDS = (b"scipy", b"numba", b"matplotlib", b"pylab", b"mpl_toolkits", b"testing", b"unittest")


def names_tools(data):
    """Do these bytes name one of the large tools? Where they hide it, its import only takes longer."""
    return any(word in data for word in WORDS)


def load(tools=True):
    """Imports all that is there. A tool that this machine lacks is missing to its students, too."""
    from exercises.grader import absent, ipython, numba_cache
    from exercises.grader.sandbox import TASKS

    numba_cache.off()
    bring((*MODULES, *(task.partition(":")[0] for task in TASKS.values())))
    if tools:
        bring(TOOLS)
    ipython.find()
    _quiet_backend()
    _interactive_names()
    absent.hide(strict=True)
    import exercises

    exercises.silent = True


def bring(names):
    for name in names:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)


def settle():
    """Last before the first fork: what is there now stays as it is, so that forks share its memory."""
    import numpy as np

    random.seed(0)
    np.random.seed(0)  # noqa: NPY002 (students may use the old one)
    gc.collect()
    gc.freeze()


def _quiet_backend():
    """A student's choice of a window to draw in must not raise where there is no screen."""
    if "matplotlib.pyplot" in sys.modules:
        matplotlib, pyplot = sys.modules["matplotlib"], sys.modules["matplotlib.pyplot"]
        pyplot.switch_backend("agg")
        matplotlib.use = lambda *arguments, **options: None
        pyplot.switch_backend = lambda *arguments, **options: None


def _interactive_names():
    """`help`, `exit` and `quit`, which Python's -S leaves out."""
    import _sitebuiltins

    builtins.help = _sitebuiltins._Helper()
    for name in ("exit", "quit"):
        setattr(builtins, name, _sitebuiltins.Quitter(name, "Ctrl-D"))
