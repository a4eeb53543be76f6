"""Where compiled code is kept on disk, so that a loop is compiled once and not in each run.

Numba alone looks only at the file a function stands in. It doesn't notice that a helper in *another* module
was edited, and would go on serving the old answer. Here the code of a module lies in a folder named by a hash
of all it was made from: the module, the modules of the package it imports, those they import, and so on.
To edit a file therefore drops the code of just the modules that build on it; and a copy of the course brings
its code along, since no path is part of the name.

What stands outside the package, in a notebook or a test, isn't kept: a notebook's cells have no file to ask.

Serves every slide from S4 and S9 on; lectures/02_equation_of_motion.md.
"""

import functools
import hashlib
import os
import re
import shutil
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
_KEPT = 4  # folders a module; older ones are deleted, a few are kept for other Pythons and other branches

_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+(\.*)([\w.]*)[ \t]+import[ \t]+(\([^)]*\)|[^\n#]*)|import[ \t]+([\w., \t]+))",
    re.MULTILINE,
)
_TUPLE = re.compile(r"^class \w+\(NamedTuple\):\n(?:[ \t]+.*\n|\n)*", re.MULTILINE)


class Sources:
    """The sources of a package as they are on disk now."""

    def __init__(self, package):
        self.name = package.name
        self.text = {}  # "reference.lcp.lemke" → what the file says
        self.is_package = set()
        for path in sorted(package.rglob("*.py")):
            parts = (package.name, *path.relative_to(package).with_suffix("").parts)
            if parts[-1] == "__init__":
                parts = parts[:-1]
                self.is_package.add(".".join(parts))
            self.text[".".join(parts)] = path.read_text(encoding="utf-8")
        # Kernels are handed tuples whose fields another module names, so those count for every module
        tuples = "".join(found for text in self.text.values() for found in _TUPLE.findall(text))
        self._common = hashlib.sha256((sys.version + tuples).encode())
        self._behind = {}

    def imported(self, module):
        """The modules of the package that a module names in its imports."""
        found = set()
        for dots, base, names, plain in _IMPORT.findall(self.text[module]):
            if plain:
                found.update(name.split()[0] for name in plain.split(",") if name.strip())
                continue
            if dots:
                up = len(dots) - (module in self.is_package)
                base = ".".join(filter(None, (module.rsplit(".", up)[0] if up else module, base)))
            for name in re.findall(r"\w+", names):
                found.add(f"{base}.{name}" if f"{base}.{name}" in self.text else base)
        return found & self.text.keys()

    def behind(self, module):
        """All modules that what a module computes may depend on, itself among them."""
        if module not in self._behind:
            seen, new = set(), {module}
            while new:
                seen |= new
                new = set().union(*map(self.imported, new)) - seen
            self._behind[module] = seen
        return self._behind[module]

    def hash(self, modules):
        """16 hex digits for all that lies behind these modules, for the Python, and for Numba's version."""
        digest = self._common.copy()
        digest.update(getattr(sys.modules.get("numba"), "__version__", "").encode())
        for name in sorted(set().union(*map(self.behind, modules))):
            digest.update(f"{name}\0{self.text[name]}\0".encode())
        return digest.hexdigest()[:16]


@functools.cache
def sources(package=PACKAGE):
    """The package's sources, read once: what is edited while Python runs isn't what was imported."""
    return Sources(package)


@functools.cache
def code_folder(*modules, package=PACKAGE):
    """The folder for code compiled from these modules, named by the first; None where none can be kept."""
    known = sources(package)
    if not all(module in known.text for module in modules):
        return None
    name = modules[0].partition(".")[2] or known.name
    folder = package / "__pycache__" / "compiled" / f"{name}-{known.hash(modules)}"
    try:
        if not folder.exists():
            folder.mkdir(parents=True, exist_ok=True)
            _clear_old(folder.parent, name)
        os.utime(folder)
    except OSError:
        return None
    return folder if os.access(folder, os.W_OK) else None


def _clear_old(folder, name):
    others = sorted(folder.glob(f"{name}-*"), key=lambda path: path.stat().st_mtime, reverse=True)
    for old in others[_KEPT:]:
        shutil.rmtree(old, ignore_errors=True)


class Place:
    """What Numba asks where a function's code is kept (``numba.core.caching``, "locator")."""

    folder = None  # set while a function is being declared

    def __init__(self, function):
        self._folder, self._line = str(Place.folder), function.__code__.co_firstlineno

    @classmethod
    def from_function(cls, function, file):
        """Numba's way to ask for one."""
        return cls(function)

    def ensure_cache_path(self):
        """Make the folder, should it be gone."""
        os.makedirs(self._folder, exist_ok=True)

    def get_cache_path(self):
        """The folder."""
        return self._folder

    def get_source_stamp(self):
        """Nothing to add: the folder's name says what the sources say."""
        return ""

    def get_disambiguator(self):
        """What tells functions of one name apart."""
        return str(self._line)
