"""Ruff, the order of the modules, sizes, docstrings, and words and paths that have no place here."""

import shutil
import subprocess

import pytest

from tests.house import sample, style
from tests.house.sample import BODIES, INTEGRATORS, LESSON, PAGE, edit
from tests.house.tree import ROOT

RULES = {
    "order of modules": style.order_faults,
    "rings of imports": style.cycle_faults,
    "sizes": style.size_faults,
    "docstrings": style.docstring_faults,
    "words and paths": style.word_faults,
    "layout": style.layout_faults,
    "ruff": style.ruff_faults,
    "commands": style.command_faults,
}


@pytest.mark.parametrize("rule", RULES)
def test_this_repository(rule):
    assert RULES[rule](ROOT) == []


def test_there_is_something_to_test():
    assert len(style.imports(ROOT)) > 5
    assert {"lab", "test"} <= {name for name, _ in style.commands(ROOT)}


# --- the rules themselves -----------------------------------------------------------------------------------


@pytest.fixture
def root(tmp_path):
    return sample.plant(tmp_path)


def configure(root):
    """The repository's own settings of ruff, in the small tree."""
    if (ROOT / "pyproject.toml").exists():
        shutil.copy(ROOT / "pyproject.toml", root)


@pytest.mark.parametrize("rule", RULES)
def test_a_good_tree_has_no_faults(root, rule):
    configure(root)
    assert RULES[rule](root) == []


LONG = "def long():\n    '''Long.'''\n" + "    x = 1\n" * 60
HEAD = '"""Bodies as arrays.'
NUMPY = "import numpy as np\n"
PLANTED = {
    "import from below": (
        "order of modules",
        BODIES,
        NUMPY,
        "from . import view\n",
        "imports reference.view",
    ),
    "import inside a function": (
        "order of modules",
        BODIES,
        "    return np",
        "    from reference.lcp import x\n    return np",
        "reference.lcp",
    ),
    "import of the front door": (
        "order of modules",
        BODIES,
        NUMPY,
        "from reference import simulate\n",
        "front door",
    ),
    "ring": (
        "rings of imports",
        BODIES,
        NUMPY,
        "from .integrators import step\n",
        "imports in a ring: reference.",
    ),
    "long function": ("sizes", BODIES, NUMPY, LONG, "long has 62 lines"),
    "long module": ("sizes", BODIES, NUMPY, "\n" * 260, "lines, at most 260"),
    "function without docstring": (
        "docstrings",
        BODIES,
        '    """Acceleration of a body."""\n',
        "",
        "accelerate has no docstring",
    ),
    "method without docstring": (
        "docstrings",
        BODIES,
        NUMPY,
        "class A:\n    '''A.'''\n    def f(self): 1\n",
        "A.f has no docstring",
    ),
    "module without docstring": ("docstrings", BODIES, HEAD, 'x = """', "the module has no docstring"),
    "path": (
        "words and paths",
        PAGE,
        "Slides S4",
        "See /" + "root/notes. Slides S4",
        ":10: a path of one machine",
    ),
    "home": ("words and paths", LESSON, "Predict.", "See /" + "home/me/notes", "a path of one machine"),
    "registry": (
        "words and paths",
        "README.md",
        "# C",
        "From py" + "pi.org\n\n# C",
        "README.md:1: names the registry",
    ),
    "unfinished": ("words and paths", BODIES, HEAD, HEAD + " TO" + "DO", "said to be unfinished"),
    "unused import": ("ruff", INTEGRATORS, "from .bodies", "import os\nfrom .bodies", "F401"),
    "unused import in a notebook": ("ruff", LESSON, "import numpy as np", "import os, numpy as np", "F401"),
    "line too long": ("ruff", INTEGRATORS, "Integrators. ", "Integrators. " + "x" * 100, "E501"),
    "no such command": (
        "commands",
        "README.md",
        "lab --port",
        "play --port",
        "'course.py play' is no command",
    ),
    "command in a page": (
        "commands",
        PAGE,
        "Slides S4",
        "`py course.py play`. Slides S4",
        "'course.py play' is no command",
    ),
    "no such option": ("commands", "README.md", "--port", "--ship", "no option --ship"),
}


@pytest.mark.parametrize("fault", PLANTED)
def test_finds(root, fault):
    rule, name, old, new, words = PLANTED[fault]
    configure(root)
    edit(root, name, old, new)
    for needed in ("view", "lcp"):
        (root / f"reference/{needed}.py").write_text('"""There."""\n')
    found = RULES[rule](root)
    assert any(words in line for line in found), found


def test_finds_a_module_without_a_place(root):
    (root / "reference/helpers.py").write_text("")
    assert any("has no place in the order" in line for line in style.order_faults(root))


def test_finds_a_stray_file_at_the_top(root):
    (root / "notes.txt").write_text("")
    assert style.layout_faults(root) == ["notes.txt: has no place at the top"]


@pytest.mark.parametrize(
    "name",
    [
        "tests/test_x.py",
        "exercises/02_equation_of_motion/solutions/a.py",
        "course.py",
        "reference/peers/x.py",
    ],
)
def test_ruff_leaves_no_folder_out(root, name):
    configure(root)
    (root / name).parent.mkdir(parents=True, exist_ok=True)
    (root / name).write_text("import os\n")
    assert any(f"{name}:1: F401" in line for line in style.ruff_faults(root))


@pytest.mark.parametrize("host", style.HOSTS)
def test_finds_every_registry(root, host):
    (root / "environment.txt").write_text(f"# from https://{host}/simple\n")
    assert any("environment.txt:1: names the registry" in line for line in style.word_faults(root))


def test_finds_this_machine_s_own_registry(root, monkeypatch):
    monkeypatch.setenv("PIP_INDEX_URL", "https://mirror.example.org/simple")
    (root / "environment.txt").write_text("# from mirror.example.org\n")
    assert any("names the registry mirror.example.org" in line for line in style.word_faults(root))


def test_what_git_ignores_is_not_judged(root):
    (root / ".gitignore").write_text("work/\n")
    (root / "work").mkdir()
    (root / "work/mine.py").write_text("import os\n")
    subprocess.run(["git", "init", "-q"], cwd=root, check=True)
    assert style.layout_faults(root) == []
    (root / ".gitignore").write_text("")
    assert style.layout_faults(root) == ["work: has no place at the top"]


@pytest.mark.parametrize("name", ["reference/__pycache__/a.nbi", "notebooks/.ipynb_checkpoints/a.ipynb"])
def test_finds_what_a_tool_made(root, name):
    subprocess.run(["git", "init", "-q"], cwd=root, check=True)
    (root / name).parent.mkdir()
    (root / name).write_text("")
    assert [line.split(":")[0] for line in style.layout_faults(root)] == [name]


def test_finds_a_big_file(root):
    (root / "lectures/film.svg").write_bytes(b"x" * 1_000_001)
    assert style.layout_faults(root) == ["lectures/film.svg: more than 1 MB"]
