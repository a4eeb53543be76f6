"""Every unit's exercise: what must earn nothing earns nothing, right solutions earn all, and each mistake
loses what it should and no more. Written for all units at once: a new unit's folder is tested as soon as it
is there."""

import dataclasses
import importlib.util
import inspect
import itertools
import math
import re

import numpy as np
import pytest
import scipy.sparse
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

import exercises
from exercises.grader.cells import read_cells
from exercises.grader.marking import mark, mark_all
from exercises.grader.replies import Student, encode
from exercises.grader.report import report
from exercises.grader.shell import check_cells
from exercises.grader.student import StudentProcess
from exercises.grader.worker import Worker
from tests.exercises.exercise_support import UNITS, Submission

SEEDS_FAST, SEEDS_MORE, SEEDS_ALL = range(6), range(60), range(200)
MARGIN = 10  # right solutions stay this factor below each tolerance, mistakes above it

each_unit = pytest.mark.parametrize("unit", UNITS, ids=lambda unit: unit.slug)
each_mistake = pytest.mark.parametrize(
    "unit, mistake",
    [(unit, mistake) for unit in UNITS for mistake in unit.mistakes],
    ids=lambda value: value.path.stem if hasattr(value, "path") else value.slug,
)


def failed(unit, ask, seed=2):
    return {result.check.name for result in mark_all(unit.checks, ask, seed) if not result.passed}


@each_unit
def test_a_unit_is_whole(unit):
    assert 5 <= len(unit.checks) <= 8 and sum(check.points for check in unit.checks) in (20, 100)
    assert len(unit.solutions) >= 2 and len(unit.mistakes) >= 5
    assert len({check.name for check in unit.checks}) == len(unit.checks)
    for check in unit.checks:
        assert (
            check.visible
            and check.hidden(np.random.default_rng(0))
            and check.why
            and check.hint
            and check.causes
        )
        assert any(check.name == mistake.loses[0] for mistake in unit.mistakes), (
            f"no mistake is aimed at {check.name}"
        )


@each_unit
def test_sections_to_read_are_on_the_page(unit):
    page = exercises.FOLDER.parent / "lectures" / f"{unit.slug}.md"
    text = page.read_text(encoding="utf-8")
    headings = set(re.findall(r"^#+ +(?:\d+\. +)?(.+?)(?: +\(S[^)]*\))? *$", text, re.M))
    assert {check.section for check in unit.checks} <= headings


@each_unit
def test_right_solutions_earn_all_where_the_reference_is_absent(unit):
    for path in unit.solutions:
        results, troubles = check_cells(unit.slug, read_cells(path), path.parent, show=lambda text: None)
        assert not troubles and all(result.passed for result in results), path.name


@each_unit
def test_the_reference_is_absent_where_solutions_run(unit, tmp_path):
    cells = [
        "from reference.integrators import rk4\nimport reference, pymunk, pybullet\nchecked = 1",
        "reference.simulate(None)",
        "rk4(1)",
        "pymunk.Space()",
    ]
    process = StudentProcess(unit.slug, cells, tmp_path)
    process.close()
    assert [number for number, _ in process.troubles] == [2, 3, 4]
    assert all("Absent" in trouble for _, trouble in process.troubles)


@each_unit
def test_the_starter_runs_and_earns_nothing(unit):
    results, troubles = check_cells(unit.slug, read_cells(unit.starter), unit.folder, show=lambda text: None)
    assert not troubles
    assert [result.check.name for result in results if result.passed] == []
    assert all("still to be written" in report(result, "page") for result in results)


def alike(value, number, square):
    """As `value`, but every number is `number`, and a square array is `square` of its size."""
    if isinstance(value, tuple):
        return tuple(alike(item, number, square) for item in value)
    if isinstance(value, dict):
        return {key: alike(item, number, square) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        is_square = value.ndim == 2 and value.shape[0] == value.shape[1]
        return square(len(value)) if is_square else np.full(value.shape, number)
    return number if isinstance(value, (int, float)) else value


def submissions_without_thought(unit):
    """Functions that give back zeros, ones and identity matrices, infinities, NaN, or one of their own
    arguments."""
    right = unit.submission(unit.solutions[0]).names
    calls = [call for check in unit.checks for case in check.visible for call in check.calls_of(case)]
    asked = {call.function for call in calls} | {
        argument.name for call in calls for argument in call.arguments if isinstance(argument, Student)
    }
    fills = {
        "zeros": (0.0, lambda n: np.zeros((n, n))),
        "identity": (1.0, np.eye),
        "inf": (math.inf, lambda n: np.full((n, n), math.inf)),
        "nan": (math.nan, lambda n: np.full((n, n), math.nan)),
    }
    for label, fill in fills.items():
        yield label, {name: lambda *a, f=right[name], fill=fill: alike(f(*a), *fill) for name in asked}
    most = max(len(inspect.signature(right[name]).parameters) for name in asked)
    for position in range(most):
        yield f"argument {position}", {name: lambda *a, i=position: a[min(i, len(a) - 1)] for name in asked}


@each_unit
def test_submissions_without_thought_earn_nothing(unit):
    for label, names in submissions_without_thought(unit):
        results = mark_all(unit.checks, Submission(unit.slug, names))
        assert [result.check.name for result in results if result.passed] == [], label
        for result in results:
            report(result, "page")


ODD = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.floats(),
        st.integers(-5, 5),
        arrays(
            st.sampled_from(["f8", "i8", "?"]), array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=6)
        ),
        st.builds(lambda n: scipy.sparse.coo_array((n, 2**30)), st.integers(1, 2**30)),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4).map(tuple), st.dictionaries(st.sampled_from("ab"), inner, max_size=2)
    ),
)


@each_unit
@settings(max_examples=100, deadline=None, derandomize=True)
@given(answer=ODD)
def test_no_answer_is_too_odd_for_a_judge(unit, answer):
    class Anything(dict):
        def get(self, name):
            return lambda *arguments: answer

    for check in unit.checks:
        quick = dataclasses.replace(check, visible=check.visible[:1], hidden=lambda stream: [])
        report(mark(quick, Worker(Anything(), exercises.part(unit.slug, "given")).answer), "page")


@each_mistake
def test_a_mistake_loses_its_check_and_what_follows(unit, mistake):
    assert failed(unit, unit.mistaken(mistake)) == set(mistake.loses)


@each_mistake
def test_the_report_of_a_mistake_tells_it(unit, mistake):
    assert mistake.says and mistake.says[0][0] == mistake.loses[0]
    texts = {
        result.check.name: " ".join(report(result, "the page").split())
        for result in mark_all(unit.checks, unit.mistaken(mistake))
    }
    for name, words in mistake.says:
        assert words in texts[name].partition("likely cause")[2], texts[name]
        rows = ("case", "call", "expected", "got", "tolerance", "why that tolerance", "the page, section")
        for row in rows:
            assert row in texts[name], texts[name]


def worst_ratio(check, ask, seed):
    return max(outcome.verdict.ratio for outcome in mark(check, ask, seed).outcomes)


def require_margins(unit, seeds):
    right = [(path.name, unit.submission(path)) for path in unit.solutions]
    for check, seed in itertools.product(unit.checks, seeds):
        for name, ask in right:
            ratio = worst_ratio(check, ask, seed)
            assert ratio <= 1 / MARGIN, (
                f"{name} is at {ratio:.2g} of the tolerance of {check.name}, seed {seed}"
            )
        for mistake in unit.mistakes:
            if check.name == mistake.loses[0]:
                ratio = worst_ratio(check, unit.mistaken(mistake), seed)
                assert ratio >= MARGIN, f"{mistake.path.name} is at {ratio:.2g} of {check.name}, seed {seed}"


@each_unit
def test_tolerances_stand_clear_of_right_and_wrong(unit):
    require_margins(unit, SEEDS_FAST)


@pytest.mark.slow
@each_unit
def test_tolerances_stand_clear_of_right_and_wrong_over_60_seeds(unit):
    require_margins(unit, SEEDS_MORE)


@pytest.mark.study
@each_unit
def test_tolerances_stand_clear_of_right_and_wrong_over_200_seeds(unit):
    require_margins(unit, SEEDS_ALL)


@each_unit
def test_mistakes_lose_the_same_whatever_the_seed(unit):
    for mistake in unit.mistakes[::4]:
        for seed in (0, 1):
            assert failed(unit, unit.mistaken(mistake), seed) == set(mistake.loses), (mistake.path.name, seed)


def engines_of(unit):
    return exercises.part(unit.slug, "engines").ENGINES if (unit.folder / "engines.py").is_file() else ()


each_engine = pytest.mark.parametrize(
    "unit, oracle",
    [(unit, oracle) for unit in UNITS for oracle in engines_of(unit)],
    ids=lambda value: value.path.stem if hasattr(value, "path") else value.slug,
)


@each_engine
def test_the_live_engine_says_what_was_recorded(unit, oracle, tmp_path):
    if importlib.util.find_spec(oracle.engine) is None:
        pytest.skip(
            f"{oracle.engine} is not installed here: the recording of {oracle.recording['version']} serves"
        )
    from exercises.grader.judges import difference

    assert len(oracle.inputs()) == len(oracle.recording["cases"])
    for i, values in enumerate(oracle.inputs()):
        live, recorded = oracle.run(**values), oracle.recorded(oracle.key(values))
        assert difference(recorded, live)[0] < 1e-11, f"case {i}"


@pytest.mark.parametrize(
    "unit, oracle",
    [(unit, oracle) for unit in UNITS for oracle in engines_of(unit) if oracle.model],
    ids=lambda value: value.path.stem if hasattr(value, "path") else value.slug,
)
def test_the_formula_says_what_the_engine_says(unit, oracle):
    """Of what is not recorded, where the engine is not installed: on the recordings and on hidden cases."""
    from exercises.grader.judges import difference

    for values in oracle.pool:
        assert difference(oracle.recorded(oracle.key(values)), oracle.model(values))[0] < 1e-11
    if importlib.util.find_spec(oracle.engine) is not None:
        drawn = [case.values for check in unit.checks for seed in SEEDS_FAST for case in check.cases(seed)]
        asked = [values for values in drawn if set(values) == set(oracle.pool[0])]
        assert asked
        for values in asked:
            assert difference(oracle.run(**values), oracle.model(values))[0] < 1e-11


@each_unit
def test_to_know_the_recordings_earns_nothing(unit):
    """The open repository holds them: a table of all recorded answers passes no check of an engine."""
    for check in unit.checks:
        if check.source is None:
            continue
        known = {encode(values): oracle for oracle in engines_of(unit) for values in oracle.pool}

        def by_heart(*arguments, check=check, known=known):
            names = check.visible[0].values
            values = dict(zip(names, arguments, strict=True))
            oracle = known.get(encode(values))
            return 0.0 if oracle is None else oracle.recorded(oracle.key(values))

        result = mark(check, Submission(unit.slug, {check.function or check.name: by_heart}))
        assert not result.passed
        if check.calls is None:  # the table was asked for what it knows
            assert all(one.verdict.passed for one in result.outcomes if not one.case.hidden)


@each_engine
def test_a_recording_says_where_it_is_from(unit, oracle):
    recording = oracle.recording
    assert recording["engine"] == oracle.engine and recording["settings"] and recording["platform"]
    pins = exercises.FOLDER.parent / "environment.txt"
    if pins.is_file():
        pinned = re.search(rf"^{oracle.engine}==([\w.]+)", pins.read_text(encoding="utf-8"), re.M)
        assert pinned and pinned.group(1) == recording["version"], "re-record: exercises.grader.recordings"


@each_unit
def test_recordings_give_the_same_score(unit, monkeypatch):
    live = failed(unit, unit.mistaken(unit.mistakes[0]))
    monkeypatch.setenv("EXERCISES_ENGINES", "recorded")
    assert failed(unit, unit.mistaken(unit.mistakes[0])) == live
    for path in unit.solutions:
        assert failed(unit, unit.submission(path)) == set()
    assert all("recording of" in oracle.source() for oracle in engines_of(unit))


@each_unit
def test_given_runs_without_the_reference_and_the_engines(unit):
    source = (unit.folder / "given.py").read_text(encoding="utf-8")
    imported = re.findall(r"^\s*(?:import|from) (\w+)", source, re.M)
    assert set(imported) <= {"math", "numpy", "scipy", "matplotlib"}
