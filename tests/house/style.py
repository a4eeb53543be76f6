"""Style: order of the modules, size of what a reader meets, words and paths that have no place here."""

import ast
import functools
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

from . import tree

# DESIGN, section 2: each module imports only from its own line or those above. A name covers a package.
# Beside DESIGN's modules: inputs (what a user hands in), inertia (of a shape), declared (a scene's parts),
# layout (a scene as arrays), forces (f_e), the methods and the report of the bench.
LAYERS = (
    ("code_cache",),
    ("compiled", "inputs"),
    ("rotation", "inertia", "shapes", "joints", "declared", "scene"),
    ("bodies", "layout", "forces", "integrators"),
    (
        "collision",
        "contacts",
        "rows",
        "factored",
        "mechanism",
        "embedding",
        "equation",
        "multipliers",
        "choice",
    ),
    ("lcp",),
    ("correction",),
    ("trajectory",),
    ("simulators",),
    ("continuum",),
    (
        "cases",
        "peers",
        "measure",
        "bench",
        "bench_contact",
        "bench_contests",
        "bench_growth",
        "bench_lcp",
        "bench_methods",
        "bench_report",
        "bench_sweeps",
        "cluster",
        "view",
        "__main__",
    ),
)
LEVEL = {name: level for level, names in enumerate(LAYERS) for name in names}

TOP = {
    "README.md",
    "LICENSE",
    "course.py",
    "environment.txt",
    "pyproject.toml",
    ".gitignore",
    ".gitattributes",
}
TOP |= {".ci", "lectures", "notebooks", "reference", "exercises", "tests"}

MADE = {"__pycache__", ".ipynb_checkpoints", ".pytest_cache", ".ruff_cache", ".pyc", ".nbi", ".nbc"}

MODULE_LINES, FUNCTION_LINES = 260, 60  # "about 200" and "fits on a screen", with room for a docstring

# Cut by strokes, so that this file does not hold what it forbids.
HOSTS = "py/pi.org python/hosted.org crates/.io npm/js.org go/lang.org maven/.org deb./debian.org"
HOSTS = HOSTS.replace("/", "").split()
_UNFINISHED = "TO/DO|FIX/ME|X/XX|for/ now|place/holder|not/ implemented".replace("/", "")
UNFINISHED = re.compile(rf"\b({_UNFINISHED})\b", re.IGNORECASE)
MACHINE_PATH = re.compile(
    r"(?:^|[^A-Za-z0-9_.])(/(?:root|work|tmp/bash_jobs|farm)/|/(?:home|Users)/[a-z]\w*/|[A-Z]:\\Users\\)",
    re.MULTILINE,
)


# --- imports ------------------------------------------------------------------------------------------------


def imports(root):
    """module -> {module of reference that it imports: line}, whether at its top or inside a function."""
    files = {tree.module_name(f): f for f in tree.tracked(root, ".py") if f.parts[0] == "reference"}
    graph = {}
    for module, file in files.items():
        inside = module.split(".") if file.name == "__init__.py" else module.split(".")[:-1]
        graph[module] = {}
        for node in ast.walk(tree.parse(root, file)):
            for name in _imported(node, inside):
                while name and name not in files:
                    name = name.rpartition(".")[0]
                if name and name != module:
                    graph[module].setdefault(name, node.lineno)
    return graph


def _imported(node, inside):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        above = inside[: len(inside) - node.level + 1] if node.level else []
        base = ".".join([*above, *([node.module] if node.module else [])])
        return [f"{base}.{alias.name}" for alias in node.names]
    return []


def order_faults(root):
    """Imports against the order of DESIGN, section 2, and modules that have no place in it."""
    faults = []
    for module, imported in imports(root).items():
        if module == "reference":
            continue  # the package's front door may import all that it offers
        name = module.split(".")[1]
        if name not in LEVEL:
            faults.append(
                f"{module}: has no place in the order of modules (tests/house/style.py, after DESIGN)"
            )
            continue
        for other, line in imported.items():
            if other == "reference":
                faults.append(f"{module}:{line}: imports the package's front door, not a module above it")
            elif LEVEL.get(other.split(".")[1], -1) > LEVEL[name]:
                faults.append(f"{module}:{line}: imports {other}, which comes after it")
    return faults


def cycle_faults(root):
    """Modules that import one another in a ring."""
    graph, state, faults = imports(root), {}, []

    def visit(module, path):
        if state.get(module) == "done":
            return
        if module in path:
            faults.append("imports in a ring: " + " -> ".join([*path[path.index(module) :], module]))
            return
        for other in graph[module]:
            if not (module + ".").startswith(other + "."):  # a package is imported before what is in it
                visit(other, [*path, module])
        state[module] = "done"

    for module in graph:
        visit(module, [])
    return faults


# --- sizes and docstrings -----------------------------------------------------------------------------------


def size_faults(root):
    """Modules of the reference too long for a sitting, and functions anywhere too long for a glance."""
    faults = []
    for file in tree.tracked(root, ".py"):
        lines = len(tree.text(root, file).splitlines())
        if file.parts[0] == "reference" and lines > MODULE_LINES:
            faults.append(f"{file}: {lines} lines, at most {MODULE_LINES}")
        for node in ast.walk(tree.parse(root, file)):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                length = node.end_lineno - node.lineno + 1
                if length > FUNCTION_LINES:
                    faults.append(
                        f"{file}:{node.lineno}: {node.name} has {length} lines, at most {FUNCTION_LINES}"
                    )
    return faults


def docstring_faults(root):
    """Public modules, functions, classes and methods of the reference without a docstring."""
    faults = []
    for file in tree.tracked(root, ".py"):
        if file.parts[0] != "reference":
            continue
        body = tree.parse(root, file)
        faults += [] if ast.get_docstring(body) else [f"{file}: the module has no docstring"]
        for node, name in _public(body):
            if not ast.get_docstring(node):
                faults.append(f"{file}:{node.lineno}: {name} has no docstring")
    return faults


def _public(body, prefix=""):
    for node in body.body:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)) and node.name[0] != "_":
            yield node, prefix + node.name
            if isinstance(node, ast.ClassDef):
                yield from _public(node, node.name + ".")


# --- words --------------------------------------------------------------------------------------------------


def word_faults(root):
    """Paths of one machine, hosts of package registries, words for what was left unfinished."""
    hosts = [*HOSTS, *registry_hosts()]
    faults = []
    for file in tree.tracked(root):
        words = tree.text(root, file)
        if words is None:
            continue
        for found in MACHINE_PATH.finditer(words):
            faults.append(f"{_place(file, words, found.start(1))}: a path of one machine, {found.group(1)}")
        for host in hosts:
            if host in words:
                faults.append(f"{_place(file, words, words.index(host))}: names the registry {host}")
        if file.suffix in (".py", ".md", ".ipynb"):
            for found in UNFINISHED.finditer(words):
                faults.append(
                    f"{_place(file, words, found.start())}: said to be unfinished, {found.group()!r}"
                )
    return faults


def _place(file, words, start):
    return f"{file}:{words.count(chr(10), 0, start) + 1}"


def registry_hosts():
    """The hosts that this machine's own pip is pointed at, if any."""
    urls = [os.environ.get(name, "") for name in ("PIP_INDEX_URL", "PIP_EXTRA_INDEX_URL", "UV_INDEX_URL")]
    hosts = {urlsplit(url).hostname or "" for line in [*urls, *_pip_urls()] for url in line.split()}
    return sorted(host for host in hosts if "." in host and not host[0].isdigit())


@functools.cache
def _pip_urls():
    command = [sys.executable, "-m", "pip", "config", "list"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return re.findall(r"index-url='([^']+)'", done.stdout)


def layout_faults(root):
    """What stands at the top beyond DESIGN, section 1; and what a tool made, or is too big to be text."""
    files = tree.tracked(root)
    faults = sorted(
        {f"{file.parts[0]}: has no place at the top" for file in files if file.parts[0] not in TOP}
    )
    for file in files:
        if MADE & {*file.parts, file.suffix}:
            faults.append(f"{file}: made by a tool, not written: git must not track it")
        elif (Path(root) / file).stat().st_size > 1_000_000:
            faults.append(f"{file}: more than 1 MB")
    return faults


# --- tools --------------------------------------------------------------------------------------------------


def ruff_faults(root):
    """What `ruff check .` says, by this interpreter's ruff."""
    command = [
        sys.executable,
        "-m",
        "ruff",
        "check",
        "--no-cache",
        "--output-format=json",
        "--force-exclude",
        ".",
    ]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        return [f"ruff failed: {done.stderr.strip()}"]
    root = Path(root).resolve()
    faults = []
    for found in json.loads(done.stdout):
        file, cell = Path(found["filename"]).relative_to(root).as_posix(), found.get("cell")
        place = f"{file}:cell {cell}" if cell else file
        faults.append(f"{place}:{found['location']['row']}: {found['code']} {found['message']}")
    return faults


def commands(root):
    """Every `course.py …` that a page mentions: {(subcommand, options): file}."""
    found = {}
    for file in tree.tracked(root, ".md", ".ipynb"):
        words = tree.text(root, file) or ""
        for line in re.findall(r"\b(?:python3?|py)(?:\.exe)? +course\.py +([^`\n\\\"]*)", words):
            line = line.split("#")[0]
            name = re.match(r"[a-z]+", line)
            if name:
                options = re.findall(r"(?<!\S)\[?(--[a-z][\w-]*)", line)
                found.setdefault((name.group(), tuple(options)), file)
    return found


def command_faults(root):
    """Commands and options that a page promises and course.py does not have."""
    faults, helps = [], {}
    for (name, options), file in commands(root).items():
        if name not in helps:
            command = [sys.executable, "course.py", name, "--help"]
            helps[name] = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        if helps[name].returncode:
            faults.append(f"{file}: 'course.py {name}' is no command of course.py")
            continue
        for option in options:
            if option not in helps[name].stdout:
                faults.append(f"{file}: 'course.py {name}' has no option {option}")
    return faults
