"""The benchmark: what it writes, and how it compares. No timing is asserted here: machines are busy."""

import json

import numpy as np
import pytest

from reference import bench, bench_growth, bench_lcp, bench_methods, bench_report
from reference.bench_contact import CONTACTS, ContactContest
from reference.bench_contests import CONTESTS, Contest
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
    text = "\n".join(bench_report.comparison_of("flight", ROWS))
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
    assert bench.chosen_labels([])[: len(CONTESTS) + len(CONTACTS)] == [*CONTESTS, *CONTACTS]
    assert {*bench_growth.GROWTHS, *bench_lcp.LCP_STUDIES} <= set(bench.chosen_labels([]))
    assert bench.chosen_labels(["spring"]) == ["spring/2d", "spring/3d"]
    assert bench.chosen_labels(["spring/2d", "heavy_top"]) == ["spring/2d", "heavy_top"]
    with pytest.raises(SystemExit):
        bench.main(["spiral"])
    assert "case must be one of free_fall/2d" in capsys.readouterr().err


@pytest.mark.parametrize("label", list(CONTESTS))
def test_every_contest_has_engines_of_its_kind(label):
    contest = CONTESTS[label]
    methods = contest.methods()
    engines = {method.engine for method in methods} - {None}
    dimension = methods[0].case.scene.dimension
    fit = {e.name for e in ENGINES.values() if contest.both or e.dimension == dimension}
    assert engines == {name for name in fit if ENGINES[name].available}
    assert all(ENGINES[m.engine].dimension == m.case.scene.dimension for m in methods if m.engine)
    assert len({method.name for method in methods}) == len(methods)


def test_a_ladder_ends_and_notes_what_the_engine_refuses():
    for method in CONTESTS["torque_free_top"].methods():
        if method.name in ("splitting", "pybullet"):
            rows = bench_methods.ladder(method, 1e-3)
            assert rows[-1][2] == "ok"
            assert (method.engine is None) or rows[0][2].startswith("refused: pybullet can turn")


def test_both_engines_meet_in_one_contest():
    engines = {"pymunk": ({"error_bias": 0.0},), "pybullet": ({},)}
    contest = Contest("both", "double_pendulum", {"duration": 0.5}, (), engines, both=True)
    rows = contest.measure(2e-3, 1, lambda message: None)
    for engine in {method.engine for method in contest.methods()}:
        errors = [r["error"] for r in rows if r["settings"]["engine"] == engine and r["status"] == "ok"]
        assert errors[-1] < 0.05 and errors[-1] < errors[0]


def growing(seconds):
    rows = []
    for n, time in seconds.items():
        rows.append(row("rk4 tree", time, None))
        rows[-1]["settings"]["n"] = n
    return rows


def test_growth_is_a_power():
    rows = growing({10: 5e-6, 100: 2e-5, 1000: 2e-4, 3000: 6e-4, 10_000: 2e-3})
    assert bench_report.power(rows) == pytest.approx(1.0)
    assert bench_report.power(growing({10: 1e-6, 100: 1e-4})) == pytest.approx(2.0)
    assert np.isnan(bench_report.power(rows[:1]))
    text = bench_report.growth_table("links", rows)
    assert "n=10000" in text and "2000.0   n^1.00" in text


def test_growth_stops_where_it_is_slow_or_refused(tmp_path):
    engines = {"pymunk": ({},), "pybullet": ({},)}
    growth = bench_growth.Growth("links", "chain", {"dimension": 2}, (2, 40, 160, 200), (), engines)
    rows = growth.measure(1.0, 1, lambda message: None)
    sizes = {e: [r["settings"]["n"] for r in rows if r["settings"]["engine"] == e] for e in ENGINES}
    if ENGINES["pymunk"].available:
        assert sizes["pymunk"] == [2, 40, 160, 200]
        assert all(r["cpu_s"] > 0 for r in rows if r["settings"]["engine"] == "pymunk")
        short = growth.measure(0.0, 1, lambda message: None)
        assert {r["settings"]["n"] for r in short} == {2}
    if ENGINES["pybullet"].available:
        assert sizes["pybullet"] == [2, 40, 160]
        assert "refused: pybullet's trees hold up to 127 links" in growth.table(rows)
    growth.plot(rows, tmp_path / "links.png")
    assert (tmp_path / "links.png").stat().st_size > 10_000


@pytest.mark.slow
def test_a_contact_contest_has_a_point_for_each_setting(tmp_path):
    engines = {"pymunk": ({"rate": 60}, {"rate": 600, "slop": 1e-4}), "pybullet": ({"rate": 240},)}
    contest = ContactContest("slide", "slope", {"share": 0.5, "duration": 0.5}, engines=engines)
    rows = contest.measure(1e-3, 1, lambda message: None)
    expected = 1 + sum(len(engines[name]) for name, engine in ENGINES.items() if engine.available)
    assert len(rows) == expected and all(one["cpu_s"] > 0 for one in rows)
    assert rows[0]["method"] == "velocity_lcp 60 Hz" and rows[0]["error"] < 1e-9
    assert all(one["error"] < 0.3 for one in rows)
    assert "CPU ms/s" in contest.table(rows) and "pymunk 600 Hz slop 0.0001" in contest.table(rows)
    contest.plot(rows, tmp_path / "slide.png")
    assert (tmp_path / "slide.png").stat().st_size > 10_000
