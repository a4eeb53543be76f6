"""Numba's cache on disk, switched off: `njit(cache=True)` compiles, and neither writes nor reads a file.

Its files are pickles, which run code when they are read, and a cell's code has no file to be kept beside.
"""

import importlib.machinery
import sys

MODULE = "numba.core.dispatcher"


class _Finder:
    """Finds Numba's dispatcher as usual, and changes it once it is loaded."""

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
    module.Dispatcher.enable_caching = lambda self: None


def off():
    """From now on, in this process, nothing is cached."""
    if MODULE in sys.modules:
        _change(sys.modules[MODULE])
    else:
        sys.meta_path.insert(0, _Finder)
