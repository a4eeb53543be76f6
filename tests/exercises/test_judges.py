"""Every judge passes what is right, and can fail: on a wrong number, NaN, a wrong shape, a wrong kind."""

import json
import math

import numpy as np
import pytest
import scipy.sparse
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from exercises.grader.check import Call, Case, Check
from exercises.grader.judges import (
    all_of,
    an_array,
    bound,
    difference,
    equal,
    fitted_order,
    on_answer,
    order_of_runs,
    unordered,
    up_to_sign,
    word,
)
from exercises.grader.marking import mark
from exercises.grader.replies import pack
from exercises.grader.report import report

ROWS = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])


def judged(judge, *answers):
    return judge({}, list(answers))


def always(value):
    return lambda values: value


@pytest.mark.parametrize(
    "expected",
    [
        2.5,
        3,
        np.array([1.0, 2.0]),
        (1.0, np.array([2.0, 3.0])),
        {"a": 1.0, "b": np.zeros(2)},
        None,
        True,
        "solved",
        math.inf,
        np.array([1.0, math.inf]),
        np.array([math.nan, 1.0]),
        scipy.sparse.coo_array(np.eye(2)),
    ],
)
def test_equal_passes_the_same(expected):
    assert judged(equal(always(expected), 1e-12), expected).passed


@pytest.mark.parametrize(
    "expected, got",
    [
        (2.5, 2.6),
        (2.5, math.nan),
        (2.5, None),
        (2.5, "2.5"),
        (2.5, True),
        (2.5, np.array([2.5])),
        (2.5, (2.5,)),
        (1.0, True),
        (math.inf, 1e300),
        (math.inf, -math.inf),
        (math.nan, 0.0),
        (0.0, math.inf),
        (np.array([1.0, 2.0]), np.array([1.0, math.nan])),
        (np.array([1.0, 2.0]), np.array([[1.0, 2.0]])),
        (np.array([1.0, 2.0]), 1.0),
        (np.array([1.0, 1.0]), 1.0),
        (np.array([1.0, math.inf]), np.array([1.0, 5.0])),
        (np.array([math.nan, 1.0]), np.array([0.0, 1.0])),
        (np.zeros(2), np.zeros(3)),
        (np.zeros(2), (0.0, (0.0, 0.0))),
        ((1.0, 2.0), (1.0, 2.5)),
        ((1.0, 2.0), (1.0,)),
        ((1.0, 2.0), 1.0),
        ((1.0, np.ones(2)), (1.0, np.array([1, math.nan]))),
        ((1.0, 2.0), (math.nan, 2.0)),
        ((1.0, 2.0), {"a": 1.0, "b": 2.0}),
        ((1.0, 2.0), "ab"),
        ({"a": 1.0}, {"a": 2.0}),
        ({"a": 1.0}, {"b": 1.0}),
        ({"a": 1.0}, {"a": 1.0, "b": 1.0}),
        ({"a": 1.0}, 1.0),
        (None, 0.0),
        (True, 1.0),
        (True, False),
        (False, None),
        ("solved", "ray"),
        ("solved", None),
        ("1", 1.0),
        (scipy.sparse.coo_array(np.eye(2)), scipy.sparse.coo_array(2 * np.eye(2))),
        (scipy.sparse.coo_array(np.eye(2)), scipy.sparse.coo_array(np.eye(3))),
    ],
)
def test_equal_fails_the_rest(expected, got):
    assert not judged(equal(always(expected), 1e-3), got).passed


def test_equal_is_generous_with_containers_of_numbers():
    assert judged(equal(always(np.array([1.0, 2.0])), 1e-12), (1, 2.0)).passed
    assert judged(equal(always((1.0, 2.0)), 1e-12), np.array([1.0, 2.0])).passed
    assert judged(equal(always(np.eye(2)), 1e-12), scipy.sparse.coo_array(np.eye(2))).passed


def test_an_array_where_other_functions_go_on_to_use_it():
    judge = an_array(equal(always(np.eye(2)), 1e-12))
    assert judged(judge, np.eye(2)).passed and not judged(judge, 2 * np.eye(2)).passed
    verdict = judged(judge, (np.array([1.0, 0.0]), np.array([0.0, 1.0])))
    assert not verdict.passed and "is a list" in verdict.complaint and "shape (2, 2)" in verdict.complaint
    assert judged(an_array(equal(always((1.0, 2.0)), 1e-12)), (1.0, 2.0)).passed


@given(arrays("f8", 3, elements=st.floats(-1e3, 1e3)), st.floats(1e-6, 1e3))
def test_the_error_is_relative_to_the_largest_number_or_the_floor(expected, off):
    error, _ = difference(expected, expected + off, floor=2.0)
    assert error == pytest.approx(off / max(2.0, np.max(np.abs(expected))), rel=1e-6, abs=1e-12)


def test_a_complaint_names_what_is_wrong():
    assert "shape (3,)" in difference(np.zeros(3), np.zeros(2))[1]
    assert "None" in difference(np.zeros(3), None)[1]
    assert "value 2" in difference((1.0, np.zeros(2)), (1.0, 0.0))[1]


def test_word():
    assert judged(word(always("ray")), "ray").passed
    assert not judged(word(always("ray")), "solved").passed
    assert not judged(word(always("ray")), None).passed


def test_up_to_sign():
    judge = up_to_sign(always(np.array([0.6, -0.8])), 1e-9)
    assert judged(judge, np.array([0.6, -0.8])).passed and judged(judge, np.array([-0.6, 0.8])).passed
    for wrong in (np.array([0.6, 0.8]), np.array([math.nan, 0.8]), np.zeros(2), None, 0.6):
        assert not judged(judge, wrong).passed


@given(st.permutations([0, 1, 2]))
def test_unordered(order):
    judge = unordered(always(ROWS), 1e-9)
    assert judged(judge, ROWS[order]).passed
    assert not judged(judge, ROWS[[order[0], order[1], order[1]]]).passed  # one row twice, another not at all
    assert not judged(judge, ROWS[order] + 1e-3).passed


@pytest.mark.parametrize("wrong", [None, 1.0, ROWS[:2], np.full((3, 2), math.nan), "rows"])
def test_unordered_fails(wrong):
    assert not judged(unordered(always(ROWS), 1e-9), wrong).passed


def test_bound():
    judge = bound(lambda values, got: abs(got - 1.0), 1e-3, "drift")
    assert judged(judge, 1.0005).passed
    for wrong in (1.01, math.nan, math.inf, None, "1"):
        assert not judged(judge, wrong).passed


STEPS = [0.1, 0.05, 0.025]


def order_of(errors):
    return fitted_order(lambda values, answers: (STEPS, errors), 3, 0.08)({}, [None])


@pytest.mark.parametrize("order, passes", [(1, False), (2, False), (3, True), (4, False)])
def test_fitted_order(order, passes):
    assert order_of([2.0 * h**order * (1 + h) for h in STEPS]).passed == passes


@pytest.mark.parametrize(
    "errors", [[0, 0, 0], [1, 1, 1], [1e-3, 1e-4, math.nan], [math.inf, 1, 1], [-1, -1, -1]]
)
def test_no_order_where_errors_do_not_fall(errors):
    assert not order_of(errors).passed


def test_fitted_order_of_an_odd_answer():
    def errors(values, answers):
        raise ValueError("shape")

    verdict = fitted_order(errors, 3, 0.08)({}, [None])
    assert not verdict.passed and verdict.error == math.inf


def test_all_of_tells_the_worst():
    judge = all_of(on_answer(0, equal(always(1.0), 0.1)), on_answer(1, equal(always(2.0), 1e-6)))
    assert judged(judge, 1.05, 2.0).passed
    assert judged(judge, 1.05, 2.1).expected == 2.0
    assert judged(judge, 9.0, 2.0).expected == 1.0
    assert not judged(judge, 1.0, math.nan).passed


def test_an_answer_that_a_judge_stumbles_over_is_wrong_and_not_our_fault():
    """Errors of 1e-20 and 1e308, whose ratio is 0 in double precision, have no logarithm."""
    judge = order_of_runs(lambda values: (1.0, np.zeros((2, 1))), (1, 2, 4), 3, 0.1)
    runs = [np.zeros((n + 1, 1)) for n in (1, 2, 4)]
    for run, error in zip(runs, (1.0, 1e-20, 1e308), strict=True):
        run[-1] = error
    with pytest.raises(ValueError):
        judge({}, runs)
    check = Check(
        "order", "its order", 5, (Case("runs", {}),), lambda stream: [], judge, "", "", "",
        calls=lambda values: [Call("run", ())] * 3,
    )  # fmt: skip
    result = mark(check, lambda text: json.dumps({"replies": [{"value": pack(run)} for run in runs]}))
    assert result.earned == 0 and "too odd" in result.outcomes[0].verdict.complaint
    assert "too odd" in report(result, "page")
