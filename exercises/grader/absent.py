"""Stands in for packages that an exercise is to be solved without: the reference, and the engines that judge.

`import reference` in a student's cell goes through, so that the cell's other lines run, but using anything of
it raises. So a notebook that leans on them fails in the shell as it will in class, and says why.
"""

import importlib.abc
import importlib.machinery
import sys
import types

PACKAGES = ("reference", "pymunk", "pybullet", "pybullet_data", "pybullet_utils")


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


class _Module(types.ModuleType):
    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _Use(f"{self.__name__}.{name}")


class _Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in PACKAGES:
            return importlib.machinery.ModuleSpec(name, self, is_package=True)
        return None

    def create_module(self, spec):
        return _Module(spec.name)

    def exec_module(self, module):
        pass


def hide():
    """From now on, in this process, the packages are absent."""
    for name in [name for name in sys.modules if name.split(".")[0] in PACKAGES]:
        del sys.modules[name]
    sys.meta_path.insert(0, _Finder())
