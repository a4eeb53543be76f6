"""The benchmark: what it writes, and how it compares. No timing is asserted here: machines are busy."""

import json

import numpy as np
import pytest

from reference import bench, bench_methods, bench_report
from reference.peers import ENGINES


def row(method, seconds, error, engine=None, status="ok"):
    settings = {"engine": engine, "steps": 1, "dt": 1.0}
    return {
        "case": "flight",
        "method": method,
        "settings": settings,
        "cpu_s": seconds,
        "error": error,
        "status": status,
    }


ROWS = [
    row("splitting", 1e-5, 1e-1),
    row("splitting", 1e-4, 1e-3),
    row("rk4", 2e-4, None, status="diverged"),
    row("pymunk", 1e-5, 5e-1, "pymunk"),
    row("pymunk", 4e-5, 1e-1, "pymunk"),
    row("pymunk", 4e-3, 1e-3, "pymunk"),
    row("pymunk", 4e-2, 1e-4, "pymunk"),
]


def test_comparison_takes_our_time_at_the_engines_error():
    compared = bench_report.comparison(ROWS)
    assert [entry[0] for entry in compared] == ["pymunk"] * 3  # half a scale off is no answer
    np.testing.assert_allclose([entry[1] for entry in compared], [1e-1, 1e-3, 1e-4])
    np.testing.assert_allclose([entry[3] for entry in compared], [0.25, 0.025, np.inf])
    text = bench_report.summary(ROWS)
    assert "0.25 at 1e-01" in text and "inf at 1e-04" in text


def test_table_shows_what_broke_down():
    lines = bench_report.table("flight", ROWS).splitlines()
    assert "—" in lines[4] and lines[4].endswith("diverged")


def test_quick_run_writes_table_lines_and_plots(tmp_path, capsys):
    bench.main(["planar_flight", "--quick", "--out", str(tmp_path)])
    printed = capsys.readouterr().out
    rows = [json.loads(line) for line in (tmp_path / "bench.jsonl").read_text(encoding="utf-8").splitlines()]
    assert all(set(row) == {"case", "method", "settings", "cpu_s", "error", "status"} for row in rows)
    assert {row["case"] for row in rows} == {"planar_flight"}
    methods = {row["method"] for row in rows}
    assert {"splitting", "rk4"} <= methods
    assert ("pymunk" in methods) == ENGINES["pymunk"].available
    assert all(row["cpu_s"] > 0 for row in rows if row["status"] == "ok")
    assert min(row["error"] for row in rows if row["method"] == "splitting") < 1e-14
    assert (tmp_path / "bench.txt").read_text(encoding="utf-8").splitlines()[0] in printed
    assert (tmp_path / "planar_flight.png").stat().st_size > 10_000


def test_missing_engine_is_said_and_left_out(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("reference.peers.engine.importlib.util.find_spec", lambda name: None)
    bench.main(["planar_flight", "--quick", "--out", str(tmp_path)])
    assert "pymunk is not installed here" in capsys.readouterr().out
    assert "pymunk" not in (tmp_path / "bench.jsonl").read_text(encoding="utf-8")


def test_cases_by_name_or_label_and_unknown_ones(capsys):
    assert bench.chosen_labels([]) == list(bench_methods.CONTESTS)
    assert bench.chosen_labels(["spring"]) == ["spring/2d", "spring/3d"]
    assert bench.chosen_labels(["spring/2d", "heavy_top"]) == ["spring/2d", "heavy_top"]
    with pytest.raises(SystemExit):
        bench.main(["spiral"])
    assert "case must be one of free_fall/2d" in capsys.readouterr().err


@pytest.mark.parametrize("label", list(bench_methods.CONTESTS))
def test_every_contest_has_engines_of_its_kind(label):
    methods = bench_methods.methods_of(label)
    engines = {method.engine for method in methods} - {None}
    dimension = methods[0].case.scene.dimension
    assert engines == {e.name for e in ENGINES.values() if e.available and e.dimension == dimension}
    assert len({method.name for method in methods}) == len(methods)


def test_a_ladder_ends_and_notes_what_the_engine_refuses():
    for method in bench_methods.methods_of("torque_free_top"):
        if method.name in ("splitting", "pybullet"):
            rows = bench_methods.ladder(method, 1e-3)
            assert rows[-1][2] == "ok"
            assert (method.engine is None) or rows[0][2].startswith("refused: pybullet can turn")
