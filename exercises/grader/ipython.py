"""IPython's translation of its own syntax (%magic, !command, name?) into Python, without the rest of IPython.

`find` notes where the two files of the translator are and loads them; `translate` uses them. They are loaded
by themselves, since the whole of IPython takes long to import, and is not there where an exercise is checked.
"""

import functools
import importlib.util
import sys
import types
from pathlib import Path

NEEDED = ("IPython.utils.tokenutil", "IPython.core.inputtransformer2")


def files():
    """{module's name: its file}, empty where IPython is not installed."""
    spec = importlib.util.find_spec("IPython")
    if spec is None or not spec.submodule_search_locations:
        return {}
    folder = Path(next(iter(spec.submodule_search_locations)))
    found = {name: folder.joinpath(*name.split(".")[1:]).with_suffix(".py") for name in NEEDED}
    return found if all(path.is_file() for path in found.values()) else {}


@functools.cache
def find():
    """The translator's module, or None where it cannot be had."""
    kept = {name: module for name, module in sys.modules.items() if name.split(".")[0] == "IPython"}
    if NEEDED[-1] in kept:
        return kept[NEEDED[-1]]
    try:
        return _load(files())
    except Exception:  # an IPython put together differently: then its syntax raises, as in plain Python
        return None
    finally:
        for name in [name for name in sys.modules if name.split(".")[0] == "IPython"]:
            del sys.modules[name]
        sys.modules.update(kept)


def _load(paths):
    if not paths:
        return None
    for name in ("IPython", "IPython.core", "IPython.utils"):
        package = types.ModuleType(name)
        package.__path__ = []
        sys.modules[name] = package
    for name, path in paths.items():
        spec = importlib.util.spec_from_file_location(name, path)
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        setattr(sys.modules[name.rpartition(".")[0]], name.rpartition(".")[2], module)
        spec.loader.exec_module(module)
    return module


def translate(source):
    """`source` as plain Python."""
    translator = find()
    return source if translator is None else translator.TransformerManager().transform_cell(source)
