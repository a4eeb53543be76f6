"""The studies of LCP solvers: what they measure is what the solvers say, and labels lead to them."""

import numpy as np
import pytest

from reference.bench import STUDIES, chosen_labels
from reference.bench_lcp import LCP_STUDIES, LcpStudy
from reference.bench_sweeps import SweepStudy
from reference.cases.lcp_lattice import lattice
from reference.cases.lcp_problems import LCP_PROBLEMS
from reference.cases.lcp_recorded import SCENES, as_lcp, record, recorded
from reference.lcp import SOLVERS


def silent(message):
    pass


def test_labels():
    assert set(chosen_labels(["lcp"])) == set(LCP_STUDIES) and "lcp/stack/1000" in STUDIES
    assert chosen_labels(["lcp/sweeps"]) == ["lcp/sweeps"]


def test_a_study(tmp_path):
    study = LcpStudy("lcp/stack/5", LCP_PROBLEMS["column"], {"n": 5})
    rows = study.measure(0.005, 1, silent)
    known = LCP_PROBLEMS["column"](5)
    assert {row["method"] for row in rows} <= set(SOLVERS) and all(row["cpu_s"] > 0 for row in rows)
    for row in rows:
        if row["method"] in ("gauss_seidel", "sor"):
            again = SOLVERS[row["method"]](known.problem, **row["settings"])
            assert row["error"] == known.error(again.lam) and row["residual"] == again.residual
            assert row["status"] == again.status and row["iterations"] == again.iterations
    last = [row for row in rows if row["method"] == "sor"][-1]
    assert last["status"] == "solved" and last["error"] < 1e-8
    assert "sor" in study.table(rows) and "solved" in study.table(rows)
    study.plot(rows, tmp_path / "study.png")
    assert (tmp_path / "study.png").stat().st_size > 10_000 and study.summary(rows) == []


def test_who_is_overtaxed():
    few, many = LcpStudy("", None).solvers(100), LcpStudy("", None).solvers(10_000)
    assert {"jacobi", "sor", "block_gauss_seidel"} <= set(many) <= set(few)
    assert "lemke" not in many


def test_sweeps_are_counted(tmp_path):
    study = SweepStudy("lcp/sweeps", "lcp", 40, sweeps=20)
    rows = study.measure(1, 1, silent)
    assert all(np.isclose(row["rate"], 120 * 20 / row["cpu_s"]) for row in rows)
    assert "million rows a second" in study.table(rows)
    study.plot(rows, tmp_path / "sweeps.png")
    assert (tmp_path / "sweeps.png").stat().st_size > 5_000


@pytest.mark.parametrize("factored", [False, True])
def test_the_lattice_looks_like_contact(factored):
    known = lattice(300, seed=2, factored=factored)
    problem = known.problem
    assert problem.n == 900 and problem.residual(known.answer) < 1e-12
    A = problem.A.tosparse() if factored else problem.A
    assert 15 < A.nnz / 900 < 33 and abs(A - A.T).max() < 1e-12
    assert np.linalg.eigvalsh(A.toarray()).min() > 0.9
    rubbing = lattice(30, frictionless=False)
    assert rubbing.answer is None and list(np.flatnonzero(rubbing.problem.terms.normal < 0)[:3]) == [0, 3, 6]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(SCENES))
def test_recorded_problems_are_what_the_step_solved(name):
    """The step itself solves for the exact cone, by another method, to 1e-10: in the plane that is the same
    law, and its w must be that of all our solvers that say they have solved it to 1e-10, times about 10.
    """
    scene, time, _ = SCENES[name]
    run = record(scene(), time)
    problem, w = as_lcp(*run.asked)
    known, size = recorded(name), np.abs(problem.b).max()
    assert np.array_equal(known.problem.A, problem.A) and np.array_equal(known.problem.b, problem.b)
    solved = 0
    for method in ("lemke", "dantzig", "min_map_newton", "fischer_newton"):
        solution = SOLVERS[method](problem, max_iterations=1000)
        if solution.solved:
            assert np.abs(solution.w - w(run.after)).max() <= 1e-9 * size
            assert known.error(solution.lam) <= 1e-8
            solved += 1
    assert solved >= (1 if name == "heap" else 2)  # there the others stay at 1e-7, Gauss–Seidel too
