"""Numba's cache on disk, switched off: `njit(cache=True)` and its like compile, and neither write nor read.

Its files are pickles, which run code when they are read, and a cell's code has no file to be kept beside.
"""

import importlib.machinery
import sys

MODULE = "numba.core.caching"


class _Finder:
    """Finds the module of caches as usual, and changes it once it is loaded, before others take from it."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        if name != MODULE:
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path, target)
        if spec is not None:
            run = spec.loader.exec_module

            def run_and_change(module):
                run(module)
                _change(module)

            spec.loader.exec_module = run_and_change
        return spec


def _change(module):
    """Each kind of cache is the one that holds nothing."""
    nothing = module.NullCache

    def no_cache(*arguments, **options):
        return nothing()

    module.FunctionCache, module.make_library_cache = no_cache, lambda prefix: no_cache


def off():
    """From now on, in this process, nothing is cached: called before Numba is first imported."""
    if MODULE in sys.modules:
        raise RuntimeError("Numba is already there, with its cache")
    sys.meta_path.insert(0, _Finder)
