"""The checks of the students' bundle: visible cases with their answers, read from a unit's checks.json.

No oracle is in it, and no generator of further cases. In class the same checks are made on other cases too.
"""

import json
import math

from exercises.grader.check import Call, Case, Cause, Check
from exercises.grader.judges import (
    Verdict,
    all_of,
    an_array,
    difference,
    equal,
    on_answer,
    order_of_runs,
    unordered,
    up_to_sign,
)
from exercises.grader.replies import Reply, as_argument, encode, pack, unpack

WORDS = ("name", "title", "points", "why", "form", "section", "function", "hint")


# --- an instructor's side: checks → data --------------------------------------------------------------------


def as_data(check):
    """All that a student may have of a check."""
    return {
        **{word: getattr(check, word) for word in WORDS},
        "reply": {"words": list(check.reply.words), "nonfinite": check.reply.nonfinite},
        "after": list(check.after),
        "source": check.source().removesuffix(", run live") if check.source else "",
        "cases": [_case_as_data(check, case) for case in check.visible],
    }


def _case_as_data(check, case):
    judge = check.judge.data(case.values) if hasattr(check.judge, "data") else None
    return {
        "label": case.label,
        "values": pack(case.values),
        "calls": [
            [call.function, [pack(argument) for argument in call.arguments]] for call in check.calls_of(case)
        ],
        "judge": judge,
        "causes": list(_causes_as_data(check, case)),
    }


def _causes_as_data(check, case):
    """What this case's answer would be with each known mistake."""
    for cause in check.causes:
        if cause.model is not None:
            yield [cause.text, pack(cause.model(case.values))]


# --- a student's side: data → checks ------------------------------------------------------------------------


def read(path):
    """The checks of a unit's checks.json."""
    return tuple(_check(data) for data in json.loads(path.read_text(encoding="utf-8"))["checks"])


def _check(data):
    of_case = {}
    for case in data["cases"]:
        values = _read(case["values"])
        of_case[encode(values)] = {
            **case,
            "values": values,
            "calls": [Call(function, tuple(map(_read, given))) for function, given in case["calls"]],
        }
    texts = dict.fromkeys(text for case in data["cases"] for text, _ in case["causes"])
    return Check(
        **{word: data[word] for word in WORDS},
        visible=tuple(Case(case["label"], case["values"]) for case in of_case.values()),
        hidden=lambda stream: [],
        judge=lambda values, answers: _judge(of_case[encode(values)]["judge"])(values, answers),
        calls=lambda values: of_case[encode(values)]["calls"],
        reply=Reply(tuple(data["reply"]["words"]), data["reply"]["nonfinite"]),
        after=tuple(data["after"]),
        causes=tuple(Cause(text, _looks_like(text, of_case)) for text in texts),
        source=lambda: _source(data["source"]),
    )


def _source(maker):
    """Where the expected values come from, in words."""
    return f"answers kept in this copy{maker and f', from {maker}'}; in class there are further cases"


def _looks_like(text, of_case):
    def matches(values, verdict):
        mistaken = [answer for cause, answer in of_case[encode(values)]["causes"] if cause == text]
        error, _ = difference(_read(mistaken[0]), verdict.got)
        return error <= max(1e-6, verdict.tolerance)

    return matches


def _judge(data):
    """The judge that says what `data` knows."""
    if data is None:
        return lambda values, answers: Verdict(0.0, math.inf, None, answers[0])  # judged in class only
    kind = data["kind"]
    if kind == "all_of":
        return all_of(*map(_judge, data["judges"]))
    if kind == "an_array":
        return an_array(_judge(data["judge"]))
    if kind == "on_answer":
        return on_answer(data["number"], _judge(data["judge"]))
    if kind == "order_of_runs":
        exact = data["duration"], _read(data["states"])
        return order_of_runs(lambda v: exact, data["steps"], data["order"], data["tolerance"], data["first"])
    expected = _read(data["expected"])
    judges = {"equal": equal, "up_to_sign": up_to_sign, "unordered": unordered}
    return judges[kind](lambda v: expected, data["tolerance"], data["floor"])


def _read(packed):
    return unpack(packed, as_argument)
