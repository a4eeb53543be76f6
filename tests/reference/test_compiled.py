"""Compiled and plain give the same; the cache is used, and never serves what was edited."""

import importlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from reference import code_cache, compiled

ROOT = Path(compiled.__file__).parent.parent
needs_numba = pytest.mark.skipif(compiled.numba is None, reason="Numba is not installed: everything is plain")

RUNS = """
import json, sys
import independent, numpy as np
from reference import simulate
from reference.compiled import COMPILED
from reference.integrators import INTEGRATORS
results = {"compiled": COMPILED}
for name in INTEGRATORS:
    for make in (independent.busy_scene, independent.planar_scene):
        scene = make()
        scene.spring(0, 1, 2, damping=1.5, length=1)
        scene.drag(0, 0.4, 0.3)
        run = simulate(scene, 0.2, 0.02, integrator=name)
        parts = run.position, run.orientation, run.velocity, run.angular_velocity
        results[name + make.__name__] = np.concatenate([part.ravel() for part in parts]).tolist()
json.dump(results, sys.stdout)
"""


def python(code, root=ROOT, **environment):
    """What a fresh interpreter prints."""
    path = os.pathsep.join([str(root), str(ROOT / "tests")])
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=root,
        env={**os.environ, "PYTHONPATH": path, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@needs_numba
def test_every_integrator_gives_the_same_compiled_and_plain():
    compiled_runs, plain_runs = (json.loads(python(RUNS, REFERENCE_COMPILED=switch)) for switch in "10")
    assert compiled_runs.pop("compiled") and not plain_runs.pop("compiled")
    for name, expected in plain_runs.items():
        scale = max(map(abs, expected))
        worst = max(abs(a - b) for a, b in zip(compiled_runs[name], expected, strict=True))
        assert worst <= 1e-12 * scale, name


SMALL = """
import numpy as np
from reference import Point, Scene, Simulation
scene = Scene(gravity=(0, -1))
scene.add(Point(), mass=2)
simulation = Simulation(scene, 0.1, integrator="explicit_euler")
simulation.step()
stats = simulation._family.run.stats
print(simulation.state.velocity[0, 1], sum(stats.cache_hits.values()), sum(stats.cache_misses.values()))
"""


@needs_numba
@pytest.mark.slow
def test_the_cache_hits_and_an_edited_helper_is_never_served_stale(tmp_path):
    shutil.copytree(ROOT / "reference", tmp_path / "reference", ignore=shutil.ignore_patterns("__pycache__"))
    assert python(SMALL, tmp_path).split() == ["-0.1", "0", "1"]
    assert python(SMALL, tmp_path).split() == ["-0.1", "1", "0"]
    helper = tmp_path / "reference" / "forces.py"  # `run`, which was cached, is in another module
    before = helper.read_text(encoding="utf-8")
    edited = before.replace("system.mass[i] * system.gravity[k]", "3 * system.mass[i] * system.gravity[k]")
    assert edited != before
    helper.write_text(edited, encoding="utf-8")
    times = helper.stat()
    os.utime(helper, (times.st_atime, times.st_mtime - 1000))  # older than the cache: time stamps don't help
    assert float(python(SMALL, tmp_path).split()[0]) == pytest.approx(-0.3)


def test_old_code_is_cleared(tmp_path):
    package = tmp_path / "reference"
    package.mkdir()
    for k in range(7):
        (package / "loops.py").write_text(f"# {k}")
        code_cache.sources.cache_clear()
        folder = code_cache.code_folder.__wrapped__("reference.loops", package=package)
        os.utime(folder, (k, k))
    code_cache.sources.cache_clear()
    kept = {path.name for path in folder.parent.glob("loops-*")}
    assert folder.name in kept and len(kept) <= 5


def test_without_a_place_to_write_no_code_is_kept(tmp_path):
    package = tmp_path / "reference"
    package.mkdir()
    (package / "loops.py").write_text("")
    (package / "__pycache__").write_text("a file in the way")
    assert code_cache.code_folder.__wrapped__("reference.loops", package=package) is None


def test_what_stands_outside_the_package_is_not_kept():
    assert code_cache.code_folder("__main__") is None
    assert code_cache.code_folder("reference.forces", "__main__") is None


PARTS = {
    "__init__": "from .top import top\n",
    "top": "from .parts.loop import loop as turn\nfrom .parts import (\n    other,\n)\n",
    "parts/__init__": "from .unused import unused\n",
    "parts/loop": "from . import helper\nfrom ..common import Pair\n",
    "parts/helper": "import numpy as np\n\ndef late():\n    from ..common import Pair\n",
    "parts/other": "import parts_of.common, os\n",
    "parts/unused": "",
    "common": "",
    "alone": "",
    "tuples": "class Pair(NamedTuple):\n    a: int\n\n    b: int\n\n\ndef f():\n    pass\n",
}


def written(folder, **changed):
    """The sources of a small package, some of its modules changed."""
    for name, text in (PARTS | changed).items():
        file = folder / "parts_of" / f"{name}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return code_cache.Sources(folder / "parts_of")


def test_what_lies_behind_a_module(tmp_path):
    known = written(tmp_path)
    names = {name.removeprefix("parts_of.") for name in known.behind("parts_of.top")}
    assert names == {"top", "parts.loop", "parts.other", "parts.helper", "common"}
    assert known.behind("parts_of.alone") == {"parts_of.alone"}
    assert "parts_of.parts.unused" in known.behind("parts_of.parts")  # a package stands for what it imports


def test_an_edit_drops_the_code_of_what_builds_on_it_and_no_other(tmp_path):
    def hashes(**changed):
        known = written(tmp_path, **changed)
        return known.hash(["parts_of.top"]), known.hash(["parts_of.alone"])

    top, alone = hashes()
    assert hashes() == (top, alone)
    for module in ("parts/helper", "common", "top"):
        changed = hashes(**{module: PARTS[module] + "# edited\n"})
        assert changed[0] != top and changed[1] == alone
    changed = hashes(tuples=PARTS["tuples"] + "# no field\n")
    assert changed == (top, alone)
    changed = hashes(tuples=PARTS["tuples"].replace("    b", "    c"))
    assert changed[0] != top and changed[1] != alone  # a tuple's fields reach kernels that never name it


@needs_numba
@pytest.mark.slow
def test_a_copy_of_the_package_brings_its_code_along(tmp_path):
    first = tmp_path / "here" / "reference"
    shutil.copytree(ROOT / "reference", first, ignore=shutil.ignore_patterns("__pycache__"))
    assert python(SMALL, first.parent).split() == ["-0.1", "0", "1"]
    shutil.copytree(first, tmp_path / "there" / "reference")
    assert python(SMALL, tmp_path / "there").split() == ["-0.1", "1", "0"]


def test_bind_of_plain_functions_is_a_partial():
    def apply(f, x):
        return f(x) + 1

    assert compiled.bind(apply, abs)(-3) == 4


CALLS_NUMPY = """import numpy as np

from reference.compiled import compiled

@compiled
def thrice(f, x):
    y = np.zeros(3)
    for i in range(3):
        y[i] = f(x)
    return np.sum(y)

@compiled
def twice(x):
    return 2 * x
"""


@needs_numba
def test_bind_takes_functions_that_call_numpy_and_still_sees_edits(tmp_path, monkeypatch):
    """Python compiles np.zeros in another way beside ``import numpy as np`` than in a function read alone."""
    file = tmp_path / "calls_numpy.py"
    file.write_text(CALLS_NUMPY)
    monkeypatch.syspath_prepend(tmp_path)
    module = importlib.import_module("calls_numpy")
    assert compiled.bind(module.thrice, module.twice)(4.0) == 24
    for edited in (CALLS_NUMPY.replace("np.zeros", "np.ones"), "# one line more\n" + CALLS_NUMPY):
        file.write_text(edited)
        compiled._bind_compiled.cache_clear()
        with pytest.raises(RuntimeError, match="restart Python"):
            compiled.bind(module.thrice, module.twice)


@needs_numba
def test_what_was_bound_before_counts_among_the_sources():
    """Else an edit of cone_newton would not reach the compiled steps, to which they are bound."""
    from reference.lcp.contact_sweeps import sweep_contacts
    from reference.simulators.flight import push
    from reference.simulators.lifting import raise_apart
    from reference.simulators.solving import newton_in_cones

    bound = compiled.bind(sweep_contacts, compiled.bind(raise_apart, compiled.bind(push, newton_in_cones)))
    assert set(bound.made_from) == {
        "reference.lcp.contact_sweeps",
        "reference.simulators.lifting",
        "reference.simulators.flight",
        "reference.simulators.solving",
    }


@needs_numba
def test_bind_keeps_the_line_for_tracebacks():
    from reference.forces import external_force
    from reference.integrators import rk4

    bound = compiled.bind(rk4, external_force)
    assert bound.py_func.__code__.co_firstlineno >= rk4.py_func.__code__.co_firstlineno
    assert bound is compiled.bind(rk4, external_force)


def test_the_course_runs_without_numba():
    hidden = "import sys; sys.modules['numba'] = None\n"
    assert python(hidden + SMALL.split("stats =")[0] + "print(simulation.state.velocity[0, 1])").split() == [
        "-0.1"
    ]


@needs_numba
def test_bind_refuses_a_file_that_was_edited_since_its_import(tmp_path):
    shutil.copytree(ROOT / "reference", tmp_path / "reference", ignore=shutil.ignore_patterns("__pycache__"))
    edit = """
import pathlib, reference.compiled as compiled
from reference.forces import external_force
from reference.integrators import rk4, symplectic_euler
file = pathlib.Path(rk4.py_func.__code__.co_filename)
text = file.read_text(encoding="utf-8")
file.write_text(text.replace("for stage in range(4)", "for stage in range(3)"), encoding="utf-8")
compiled.bind(symplectic_euler, external_force)
try:
    compiled.bind(rk4, external_force)
except RuntimeError as error:
    print("restart Python" in str(error))
"""
    assert python(edit, tmp_path).strip() == "True"
