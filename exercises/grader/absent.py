"""Stands in for all packages but a few: an exercise is solved with the standard library, NumPy, SciPy, Numba
and Matplotlib, without the reference and without the engines that judge.

`import reference` in a student's cell goes through, so that the cell's other lines run, but using anything of
it raises. So a notebook that leans on them fails in the shell as it will in class, and says why. What only
shows things (IPython.display) may be used, and does nothing.
"""

import importlib.abc
import importlib.machinery
import math
import sys
import types

TOOLS = ("numpy", "scipy", "numba", "matplotlib")
NEEDED_BY_TOOLS = (
    "llvmlite", "mpl_toolkits", "pylab", "PIL", "contourpy", "kiwisolver", "cycler", "dateutil", "six",
    "pyparsing", "packaging", "fontTools",
)  # fmt: skip
PRESENT = {*sys.stdlib_module_names, "exercises", *TOOLS, *NEEDED_BY_TOOLS}
HIDDEN = (
    "reference",
    "pymunk",
    "pybullet",
    "pybullet_data",
    "pybullet_utils",
    "IPython",
)  # if already imported
INERT = (
    "IPython", "ipywidgets", "ipympl", "matplotlib_inline", "tqdm", "google", "seaborn", "plotly", "bokeh",
    "rich", "tabulate", "termcolor", "colorama", "icecream", "nest_asyncio", "line_profiler",
    "memory_profiler",
)  # fmt: skip


class Absent(ImportError):
    """Something of an absent package was used."""


class _Use:
    """Any name of an absent package. It may be imported and passed on; used, it raises."""

    def __init__(self, name):
        object.__setattr__(self, "_name", name)

    def _raise(self, *arguments, **options):
        raise Absent(
            f"{self._name} is not there while an exercise is checked: use your own functions and `given`"
        )

    __call__ = __getitem__ = __iter__ = __len__ = __float__ = __int__ = __index__ = __bool__ = __array__ = (
        _raise
    )
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __matmul__ = __rmatmul__ = __truediv__ = (
        _raise
    )
    __enter__ = __exit__ = __setattr__ = _raise

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        self._raise()


class _Inert:
    """Any name of a package that only shows things. Whatever is done with it, nothing happens."""

    def __call__(self, *arguments, **options):
        return (
            arguments[0] if arguments else self
        )  # tqdm(range(9)) is range(9), and a decorator changes nothing

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __enter__(self):
        return self

    def __exit__(self, *trouble):
        return False

    def __iter__(self):
        return iter(())

    def __format__(self, form):
        return ""

    def __float__(self):
        return math.nan

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = (
        lambda self, other: self
    )


INERT_THING = _Inert()
shell = INERT_THING  # what get_ipython() gives; cells.py puts its own here


class _Module(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        if self.__name__.split(".")[0] in INERT:
            known = {"get_ipython": lambda: shell, "trange": range}
            return known.get(name, INERT_THING)
        return _Use(f"{self.__name__}.{name}")


class _Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    def __init__(self, strict):
        self.strict = strict

    def find_spec(self, name, path=None, target=None):
        top = name.split(".")[0]
        if top in PRESENT:
            return None
        if top not in (*HIDDEN, *INERT) and _asked_by_a_library():
            if self.strict:  # it may be seen there, and yet not be read
                raise ModuleNotFoundError(f"No module named {name!r}", name=name)
            return None
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec):
        return _Module(spec.name)

    def exec_module(self, module):
        if module.__name__ == "IPython":
            module.version_info = (9, 0, 0)  # Matplotlib looks


def _asked_by_a_library():
    """Libraries look for packages that they can do without, and must learn that those are not there."""
    frame = sys._getframe(2)
    while frame is not None and frame.f_code.co_filename.startswith("<frozen importlib"):
        frame = frame.f_back
    return frame is not None and str(frame.f_globals.get("__name__")).split(".")[0] in PRESENT


def hide(strict=False):
    """From now on, in this process, all other packages are absent; if `strict`, for libraries too."""
    for name in [name for name in sys.modules if name.split(".")[0] in HIDDEN]:
        del sys.modules[name]
    sys.meta_path.insert(0, _Finder(strict))
