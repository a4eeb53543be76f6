# ruff: noqa: NPY002 (the old global generator is one of the things tested)
"""The student's side: fresh copies, fixed generators, and errors that stay inside one call."""

import dataclasses
import json
import math
import random
import types

import numpy as np
import pytest

from exercises.grader import absent
from exercises.grader.check import Call, Case, Check
from exercises.grader.judges import equal, on_answer
from exercises.grader.marking import Failure, mark, mark_all
from exercises.grader.replies import Given, Reply, Student
from exercises.grader.report import report
from exercises.grader.worker import Worker
from tests.exercises.exercise_support import UNITS

NUMBERS = Reply()
GIVEN = types.SimpleNamespace(line=lambda slope: lambda x: slope * x, counter=lambda: iter(range(100)))


def check_of(function, expected=1.0, calls=None, reply=NUMBERS, cases=2, **values):
    return Check(
        name="f",
        title="a test",
        points=5,
        visible=tuple(Case(f"case {i}", values) for i in range(cases)),
        hidden=lambda stream: [],
        judge=equal(lambda v: expected, 1e-9),
        why="rounding",
        form="a number",
        section="none",
        calls=calls,
        reply=reply,
        hint="nothing known",
    )


def result_of(function, *arguments, **options):
    names = {"f": function, "g": lambda x: x + 1} if function else {}
    check = check_of(function, calls=lambda v: [Call("f", arguments)], **options)
    return mark(check, Worker(names, GIVEN).answer)


def test_a_right_function_earns_the_points():
    assert result_of(lambda x: x / 2, 2.0).earned == 5


def test_one_wrong_case_earns_nothing():
    calls = iter([1.0, 2.0])
    assert result_of(lambda: next(calls)).earned == 0


def test_each_call_has_fresh_copies():
    def spoil(mapping):
        mapping["a"] = mapping.get("a", 0) + 1
        return mapping["a"]

    assert result_of(spoil, {"a": 0}, cases=5).passed


def add(y, other):
    y += 1
    return 1.0


def add_inside(pair):
    pair[1]["a"][:] = math.nan
    return 1.0


def sort(y):
    y.sort()
    return 1.0


def step_of(g, y):
    g(y, 0.0)
    return 1.0


def leave(y, pair):
    y = y + 1
    y += 1
    pair = (pair[0].copy(), *pair[1:])
    pair[0][:] = 0
    return 1.0


@pytest.mark.parametrize(
    "function, arguments, words",
    [
        (add, (np.zeros(2), 0.0), "f changes its argument `y` in place"),
        (add_inside, ((1, {"a": np.zeros(2)}),), "f changes its argument `pair` in place"),
        (sort, (np.array([2, 1]),), "f changes its argument `y` in place"),
        (step_of, (Student("g"), np.zeros(2)), "f (or g, which it uses) changes its argument `y` in place"),
        (lambda *all: add(*all), (np.zeros(2), 0.0), "f changes its argument `all` in place"),
    ],
)
def test_changing_an_array_that_was_handed_in_is_refused_and_told(function, arguments, words):
    check = check_of(None, calls=lambda v: [Call("f", arguments)])
    names = {"f": function, "g": add, "np": np, "absent": absent._Use("reference.rk4")}
    result = mark(check, Worker(names, GIVEN).answer)
    assert result.earned == 0 and result.outcomes[0].verdict.got.kind == "in place"
    text = " ".join(report(result, "page").split())
    assert words in text and "expected 1" in text and "makes a new one" in text


def test_new_arrays_may_be_changed():
    assert result_of(leave, np.array([1.0, math.nan]), (np.zeros(2), math.inf)).passed


def test_nan_is_shown_beside_what_was_expected():
    text = report(result_of(lambda: np.array([1.0, math.nan]), expected=np.array([1.0, 2.0])), "page")
    assert "[1. 2.]" in text and "nan]" in text and "0/0" in text and "not there" not in text


def test_a_check_is_told_which_of_those_before_it_fail():
    first = dataclasses.replace(check_of(None, calls=lambda v: [Call("g", ())]), name="g")
    second = dataclasses.replace(check_of(None, calls=lambda v: [Call("f", ())]), after=("g",))
    worker = Worker({"f": lambda: 3.0, "g": lambda: 2.0}, GIVEN)
    assert "g fails its own check" in report(mark_all([first, second], worker.answer)[1], "page")
    worker.namespace["g"] = lambda: 1.0
    assert "nothing known" in report(mark_all([first, second], worker.answer)[1], "page")


def test_the_calls_that_the_verdict_is_about_are_shown():
    check = check_of(None, calls=lambda v: [Call("f", (1.0,)), Call("f", (2.0,))])
    check = dataclasses.replace(check, judge=on_answer(1, check.judge))
    text = report(mark(check, Worker({"f": lambda x: x}, GIVEN).answer), "page")
    assert "f(2.0)" in text and "f(1.0)" not in text


def test_given_arguments_are_made_afresh():
    assert result_of(lambda line: line(0.5), Given("line", slope=2.0)).passed
    assert result_of(lambda counter: next(counter) + 1.0, Given("counter"), cases=3).passed


def test_the_students_own_function_as_an_argument():
    assert result_of(lambda g: g(0.0), Student("g")).passed


def test_given_inside_containers():
    assert result_of(lambda pair: pair[0](pair[1]), (Given("line", slope=0.5), 2.0)).passed


def test_random_generators_are_set_anew_and_put_back():
    random.seed(5)
    np.random.seed(5)
    before = random.random(), np.random.rand()
    random.seed(5)
    np.random.seed(5)
    drawn = []

    def draw():
        drawn.append((random.random(), np.random.rand()))
        return 1.0

    assert result_of(draw, cases=1).passed and result_of(draw, cases=1).passed
    assert drawn[0] == drawn[1]
    assert before == (random.random(), np.random.rand())


def raises():
    raise ZeroDivisionError("by\x1b[31m nothing")


def exits():
    raise SystemExit(0)


class Sly(Exception):
    def __str__(self):
        raise RuntimeError("no text")


def sly():
    raise Sly


def endless():
    return endless()


@pytest.mark.parametrize(
    "function, kind",
    [
        (raises, "ZeroDivisionError"),
        (exits, "SystemExit"),
        (sly, "Sly"),
        (endless, "RecursionError"),
        (None, "answer"),
        (lambda x: x, "TypeError"),
        (lambda: object(), "answer"),
        (lambda: math.nan, "answer"),
        (lambda: "solved", "answer"),
        (lambda: 10**400, "answer"),
    ],
)
def test_what_brings_no_answer_fails_and_is_told(function, kind):
    result = result_of(function)
    failure = result.outcomes[0].verdict.got
    assert not result.passed and isinstance(failure, Failure) and failure.kind == kind
    assert "likely cause" in report(result, "page")


def test_an_error_in_one_call_spares_the_others():
    calls = iter([raises, lambda: 1.0])
    result = result_of(lambda: next(calls)())
    assert [outcome.verdict.passed for outcome in result.outcomes] == [False, True]


def test_a_traceback_holds_the_students_lines_only():
    failure = result_of(raises).outcomes[0].verdict.got
    assert (
        len(failure.lines) == 1
        and "raise ZeroDivisionError" in failure.lines[0]
        and "in raises" in failure.lines[0]
    )


def test_stop_ends_the_check():
    def stop():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        result_of(stop)


def test_printing_is_kept_and_told(capsys):
    def noisy():
        print("x is 7")
        return 2.0

    text = report(result_of(noisy), "page")
    assert "x is 7" in text and capsys.readouterr().out == ""


def test_none_is_told_as_unwritten():
    assert "still to be written" in report(result_of(lambda: None), "page")


def test_inf_where_declared():
    assert result_of(lambda: math.inf, expected=math.inf, reply=Reply(nonfinite=True)).passed
    assert not result_of(lambda: math.nan, expected=math.inf, reply=Reply(nonfinite=True)).passed


@pytest.mark.parametrize(
    "text",
    [
        "",
        "null",
        "[]",
        "{}",
        '{"replies": []}',
        '{"replies": [1, 2]}',
        '{"replies": [{"value": 1.0}]}',
        '{"replies": [{}, {}]}',
        '{"replies": [{"error": 3}, {"error": {}}]}',
        '{"replies": {"a": 1, "b": 2}}',
        "[" * 100_000,
    ],
)
def test_a_worker_that_sends_rubbish_earns_nothing(text):
    result = mark(check_of(None, calls=lambda v: [Call("f", ())]), lambda request: text)
    assert result.earned == 0 and len(result.outcomes) == 2
    report(result, "page")


def test_each_check_draws_its_own_hidden_cases():
    def hidden(stream):
        return [Case("drawn", {"x": float(stream.uniform())})]

    one, other = (
        Check(name, "t", 1, (), hidden, equal(lambda v: v["x"], 0), "", "", "") for name in ("one", "other")
    )
    assert one.cases(3)[0].values == one.cases(3)[0].values != other.cases(3)[0].values
    assert one.cases(3)[0].values != one.cases(4)[0].values and one.cases(3)[0].hidden


def test_all_calls_go_in_one_message():
    messages = []

    def ask(text):
        messages.append(text)
        return Worker({"f": lambda: 1.0}, GIVEN).answer(text)

    assert mark(check_of(None, calls=lambda v: [Call("f", ())], cases=7), ask).passed
    assert len(messages) == 1 and len(json.loads(messages[0])["calls"]) == 7


def test_hidden_cases_are_asked_apart_and_not_at_all_of_one_who_does_not_answer():
    check = UNITS[0].checks[1]
    asked = []

    def answering(text):
        asked.append(json.loads(text))
        return json.dumps({"replies": [{"value": 0.0}] * len(asked[-1]["calls"])})

    def gone(text):
        answering(text)
        failure = {"error": {"kind": "no answer", "message": "it ended", "lines": []}}
        return json.dumps({"replies": [failure] * len(asked[-1]["calls"])})

    mark(check, answering)
    assert [len(one["calls"]) for one in asked] == [
        len(check.visible),
        len(check.cases(2)) - len(check.visible),
    ]
    assert [one.get("more") for one in asked] == [True, None]
    asked.clear()
    result = mark(check, gone)
    assert len(asked) == 1 and len(result.outcomes) == len(check.cases(2))
    assert all(one.verdict.got.message == "it ended" for one in result.outcomes)
