"""``python -m reference`` compiles once, and knows that it did."""

import subprocess
import sys

import numpy as np
import pytest

from reference import Simulation, compiled
from reference import __main__ as main
from reference.simulators import velocity_lcp


@pytest.mark.skipif(not compiled.COMPILED, reason="Numba is not there, or switched off: nothing is compiled")
def test_compiles_once(tmp_path, monkeypatch):
    done = []
    monkeypatch.setattr(main, "code_folder", lambda module: tmp_path)
    monkeypatch.setattr(main, "Simulation", lambda *_, integrator="other": done.append(integrator) or Step())
    main.main()
    others = ["other"] * 3  # a joint, and contact in the plane and in space
    assert sorted(done) == sorted([*main.INTEGRATORS, *others]) and (tmp_path / "complete").exists()
    main.main()
    assert len(done) == len(main.INTEGRATORS) + 3


class Step:
    def advance(self, duration):
        pass


@pytest.mark.parametrize("d", [2, 3])
def test_its_contact_has_impacts_and_overlaps(d, monkeypatch):
    """Or the loops for them would not be compiled: the scene must make them happen."""
    strikes, strike = [], velocity_lcp.strike

    def noted(*arguments):
        strikes.append(strike(*arguments))
        return strikes[-1]

    monkeypatch.setattr(velocity_lcp, "strike", noted)
    sim = Simulation(main.bouncing_boxes(d), 0.1)
    sim.advance(0.4)
    assert any(hit.any() for hit in strikes)
    np.testing.assert_allclose(sim.state.position[2:, -1], [0.5, 1.5], atol=1e-8)  # 0.1 m each were lifted


def test_does_nothing_without_numba():
    hide = "import sys; sys.modules['numba'] = None"
    code = f"{hide}; import runpy; runpy.run_module('reference', run_name='__main__')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == done.stderr == ""
