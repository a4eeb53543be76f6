"""``python -m reference`` compiles once, and knows that it did."""

import subprocess
import sys

import pytest

from reference import __main__ as main
from reference import compiled


@pytest.mark.skipif(not compiled.COMPILED, reason="Numba is not there, or switched off: nothing is compiled")
def test_compiles_once(tmp_path, monkeypatch):
    done = []
    monkeypatch.setattr(main, "code_folder", lambda module: tmp_path)
    monkeypatch.setattr(main, "Simulation", lambda *_, integrator="joints": done.append(integrator) or Step())
    main.main()
    assert sorted(done) == sorted([*main.INTEGRATORS, "joints"]) and (tmp_path / "complete").exists()
    main.main()
    assert len(done) == len(main.INTEGRATORS) + 1


class Step:
    def step(self):
        pass


def test_does_nothing_without_numba():
    hide = "import sys; sys.modules['numba'] = None"
    code = f"{hide}; import runpy; runpy.run_module('reference', run_name='__main__')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == done.stderr == ""
