"""Drift: what a notebook arrives at is what the package holds, in the same surroundings."""

from pathlib import PurePosixPath

import pytest

from tests.house import notebooks, sample
from tests.house.drift import drift_faults, tag_faults
from tests.house.sample import (
    BODIES,
    BODIES_CELL,
    INTEGRATORS,
    LESSON,
    STEP_CELL,
    code,
    edit,
    lesson,
    write_notebook,
)
from tests.house.tree import ROOT, tracked


def identify(file):
    return file.as_posix()


@pytest.mark.parametrize("file", tracked(ROOT, ".ipynb"), ids=identify)
def test_no_drift(file):
    assert drift_faults(ROOT, file) == []


@pytest.mark.parametrize("file", notebooks.teaching(ROOT), ids=identify)
def test_lesson_arrives_at_the_reference(file):
    assert tag_faults(ROOT, file) == []


# --- the rules themselves -----------------------------------------------------------------------------------


@pytest.fixture
def root(tmp_path):
    return sample.plant(tmp_path)


def faults(root):
    return drift_faults(root, PurePosixPath(LESSON)) + tag_faults(root, PurePosixPath(LESSON))


def test_a_good_tree_has_no_drift(root):
    assert faults(root) == []


# a change of the package, which the notebook does not follow
PACKAGE = {
    "operator": (INTEGRATORS, "position + dt * velocity", "position - dt * velocity"),
    "renamed variable": (INTEGRATORS, "    velocity = velocity + dt", "    speed = velocity + dt"),
    "renamed argument": (INTEGRATORS, "mass, dt=0.1", "weight, dt=0.1"),
    "default": (INTEGRATORS, "dt=0.1", "dt=0.2"),
    "order of arguments": (INTEGRATORS, "position, velocity, force", "velocity, position, force"),
    "constant in the body": (INTEGRATORS, "return position", "return 2 * position"),
    "type of a constant": (INTEGRATORS, "dt=0.1", "dt=1"),
    "an added line": (INTEGRATORS, "    return position +", "    position = position\n    return position +"),
    "function gone": (INTEGRATORS, "def step", "def stride"),
    "helper from elsewhere": (
        INTEGRATORS,
        "from .bodies import accelerate",
        "from math import hypot as accelerate",
    ),
    "helper renamed": (INTEGRATORS, "import accelerate", "import fall as accelerate"),
    "module under the name": (BODIES, "import numpy as np", "import math as np"),
}


@pytest.mark.parametrize("fault", PACKAGE)
def test_finds_a_change_of_the_package(root, fault):
    name, old, new = PACKAGE[fault]
    edit(root, name, old, new)
    assert any("ref:" in line for line in faults(root))


# a change of the notebook: cells to replace or to add (at their index), and what must be said
TAGGED, HELPER = 9, 3


def changed(index, *new):
    cells = lesson()
    cells[index : index + 1] = new
    return cells


def added(index, *new):
    cells = lesson()
    cells[index:index] = new
    return cells


def tagged(words, tag="ref:integrators.step"):
    return changed(TAGGED, code(words, tag))


NOTEBOOK = {
    "operator": (
        tagged(STEP_CELL.replace("position + dt", "position - dt")),
        "differs from reference.integrators.step",
    ),
    "keyword only": (tagged(STEP_CELL.replace("mass, dt", "mass, *, dt")), "differs from"),
    "generator for function": (tagged(STEP_CELL.replace("return", "yield")), "differs from"),
    "missing": (tagged("x = 1"), "does not define step"),
    "another name": (tagged(STEP_CELL.replace("def step", "def stride")), "does not define step"),
    "tag of nothing": (tagged(STEP_CELL, "ref:integrators.stride"), "names nothing that reference/ defines"),
    "tag of no module": (tagged(STEP_CELL, "ref:integrate.step"), "names nothing that reference/ defines"),
    "tag of a module": (
        tagged(STEP_CELL, "ref:reference.integrators"),
        "names nothing that reference/ defines",
    ),
    "tag with a blank": (tagged(STEP_CELL, "ref: integrators.step"), "must read ref:module.function"),
    "tag misspelt": (tagged(STEP_CELL, "Ref-integrators.step"), "must read ref:module.function"),
    "tag on text": (
        changed(TAGGED, {**sample.text("x"), "metadata": {"tags": ["ref:integrators.step"]}}),
        "does not define",
    ),
    "helper redefined below": (
        added(TAGGED + 1, code("def accelerate(f, m):\n    return m / f")),
        "uses accelerate, which in cell 11",
    ),
    "helper redefined above": (
        added(TAGGED, code("def accelerate(f, m):\n    return m / f")),
        "uses accelerate, which in cell 10",
    ),
    "helper assigned": (added(TAGGED + 1, code("accelerate = max")), "uses accelerate"),
    "helper as loop variable": (
        added(TAGGED + 1, code("for accelerate in []:\n    pass")),
        "uses accelerate",
    ),
    "helper deleted": (added(TAGGED + 1, code("del accelerate")), "uses accelerate"),
    "helper made global": (
        added(TAGGED + 1, code("def f():\n    global accelerate\n    accelerate = 1")),
        "uses accelerate",
    ),
    "helper in a walrus": (added(TAGGED + 1, code("[accelerate := 1 for _ in [1]]")), "uses accelerate"),
    "helper in a with": (
        added(TAGGED + 1, code("with open('x') as (accelerate, _):\n    pass")),
        "uses accelerate",
    ),
    "helper by branch": (
        added(TAGGED + 1, code("if True:\n    def accelerate():\n        pass")),
        "uses accelerate",
    ),
    "helper from another module": (
        added(TAGGED + 1, code("from math import hypot as accelerate")),
        "uses accelerate",
    ),
    "helper untagged": (changed(HELPER, code(BODIES_CELL)), "uses accelerate, which in cell 4"),
    "helper gone": (changed(HELPER, code("x = 1")), "uses accelerate, which the notebook never binds"),
    "library under its name": (added(HELPER, code("np = 1")), "uses np"),
    "Python's own name": (None, "uses sum, which in cell 13 is not Python's own sum"),
    "function redefined below": (
        added(TAGGED + 1, code("def step(x, v):\n    return x, v")),
        "uses step, which in cell 11",
    ),
    "star import": (changed(1, code("import numpy as np\nfrom math import *")), "star import"),
    "stowaway": (tagged(STEP_CELL + "\n\nx = step(0, 1, 0, 1)"), "holds more than its tags name"),
    "patch": (added(3, code("import reference.bodies\nreference.bodies.GRAVITY = 1")), "changes the package"),
    "no tag": ([{**cell, "metadata": {}} for cell in lesson()], "no cell is tagged"),
    "last version untagged": (changed(TAGGED, code(STEP_CELL)), "the last version of step is not tagged"),
}


@pytest.mark.parametrize("fault", NOTEBOOK)
def test_finds_a_change_of_the_notebook(root, fault):
    cells, words = NOTEBOOK[fault]
    if fault == "Python's own name":
        energy = "def energy(velocity, mass, *, half=0.5):\n    return half * mass * sum(velocity * velocity)"
        cells = added(TAGGED + 1, code(energy, "ref:integrators.energy"))
        write_notebook(root / LESSON, cells)
        assert faults(root) == []
        cells[TAGGED + 3 : TAGGED + 3] = [code("sum = 3")]
    write_notebook(root / LESSON, cells)
    found = faults(root)
    assert any(words in line for line in found), found


@pytest.mark.parametrize(
    "binding",
    [
        "from reference.bodies import accelerate",
        "from reference import bodies\nfrom reference.bodies import accelerate as accelerate",
        "from reference.integrators import accelerate",  # the same object, by way of another module
    ],
)
def test_the_package_s_own_object_is_no_drift(root, binding):
    cells = changed(1, code("import numpy as np\n" + binding))
    cells[HELPER] = code("x = 1")
    write_notebook(root / LESSON, cells)
    assert faults(root) == []


def test_a_constant_of_the_package(root):
    fall = code("def fall(velocity, dt):\n    return velocity - GRAVITY * dt", "ref:bodies.fall")
    write_notebook(root / LESSON, added(HELPER, fall))
    assert "GRAVITY, which the notebook never binds" in "".join(faults(root))
    write_notebook(root / LESSON, added(HELPER, code("GRAVITY = 9.81"), fall))
    assert "uses GRAVITY, which in cell 4" in "".join(faults(root))
    write_notebook(root / LESSON, added(HELPER, code("GRAVITY = 9.8", "ref:bodies.GRAVITY"), fall))
    assert "differs from reference.bodies.GRAVITY" in "".join(faults(root))
    write_notebook(root / LESSON, added(HELPER, code("GRAVITY: float = 9.81", "ref:bodies.GRAVITY"), fall))
    assert faults(root) == []


def test_a_tag_by_the_package_s_front_door(root):
    """`ref:module.f` where the module passes on what another defines is followed to the definition."""
    (root / "reference/simulators").mkdir()
    (root / "reference/simulators/__init__.py").write_text(
        '"""All."""\nfrom reference.integrators import step\n'
    )
    write_notebook(root / LESSON, tagged(STEP_CELL, "ref:simulators.step"))
    assert drift_faults(root, PurePosixPath(LESSON)) == []
    edit(root, INTEGRATORS, "dt=0.1", "dt=0.3")
    assert "differs from reference.integrators.step" in "".join(drift_faults(root, PurePosixPath(LESSON)))


def test_a_listed_package_lists_its_modules(root):
    (root / "reference/lcp").mkdir()
    (root / "reference/lcp/__init__.py").write_text('"""All."""\nfrom .lemke import pivot\n')
    (root / "reference/lcp/lemke.py").write_text("def pivot():\n    return 1\n")
    edit(root, sample.PAGE, "[bodies, integrators]", "[bodies, integrators, lcp]")
    words = "def pivot():\n    return 1"
    write_notebook(root / LESSON, added(TAGGED, code(words, "ref:lcp.pivot")))
    assert faults(root) == []
    write_notebook(root / LESSON, added(TAGGED, code(words)))
    assert "the last version of pivot is not tagged (reference.lcp.lemke.pivot)" in "".join(faults(root))


def test_names_inside_are_no_globals(root):
    """Arguments, local and comprehension variables, inner functions may be called what they like."""
    words = "def walk(x):\n    def f(np):\n        return np\n    return [f(accelerate) for accelerate in x]"
    with open(root / BODIES, "a") as file:
        file.write('\n\n@compiled\ndef walk(x: "array"):\n    """Docs."""\n' + words.split("\n", 1)[1] + "\n")
    write_notebook(root / LESSON, added(TAGGED + 1, code(words, "ref:bodies.walk"), code("f = 1\nx = 2")))
    assert faults(root) == []


def test_a_tag_of_a_module_that_the_page_does_not_list(root):
    edit(root, sample.PAGE, "[bodies, integrators]", "[integrators]")
    assert any("does not list" in line for line in tag_faults(root, PurePosixPath(LESSON)))
