"""Ask, judge, count points.

`ask` is any function from a request's text to a response's text: the worker in this process (notebook), in a
subprocess (shell), or in a sandbox (class).
"""

import json
import math
from dataclasses import dataclass, replace
from functools import lru_cache

from exercises.grader.check import SELF_STUDY_SEED
from exercises.grader.judges import Verdict
from exercises.grader.replies import BadReply, admit, pack, parse

LONGEST_WORDS, MOST_LINES = 600, 8
NOT_RAISED = ("answer", "no answer", "in place")  # kinds of Failure that are no exception of the student's


@dataclass(frozen=True)
class Failure:
    """A call that brought no answer: it raised, or returned what no check can take."""

    kind: str
    message: str
    lines: tuple = ()
    value: object = None  # what it returned, where that could be read


@dataclass(frozen=True)
class Outcome:
    case: object
    calls: list
    verdict: Verdict
    printed: str = ""


@dataclass(frozen=True)
class Result:
    check: object
    outcomes: list
    broken: tuple = ()  # names of the checks it builds on that fail

    @property
    def passed(self):
        return all(outcome.verdict.passed for outcome in self.outcomes)

    @property
    def earned(self):
        return self.check.points if self.passed else 0


def mark(check, ask, seed=SELF_STUDY_SEED):
    """The Result of one check. All calls of the visible cases go in one message, those of the hidden ones in
    another: a function that looks about it while a visible case is asked finds no hidden one to tell of."""
    outcomes, lost = [], None
    for asked, text in _questions(check, seed):
        outcomes += _outcomes(check, asked, text, ask, lost)
        lost = next((one.verdict.got for one in outcomes if _is_lost(one.verdict.got)), None)
    return Result(check, outcomes)


@lru_cache(512)
def _questions(check, seed):
    """The messages of a check, the same for all submissions: ([(case, its calls)], the message's text)."""
    cases = check.cases(seed)
    groups = [[one for one in cases if one.hidden == hidden] for hidden in (False, True)]
    asked = [[(case, check.calls_of(case)) for case in group] for group in groups]
    questions = []
    for number, group in enumerate(asked):
        request = [
            {"function": call.function, "arguments": [pack(argument) for argument in call.arguments]}
            for _, calls in group
            for call in calls
        ]
        more = {"more": True} if number == 0 and asked[1] else {}  # another message on this check follows
        questions.append((group, json.dumps({"calls": request, **more}, allow_nan=False)))
    return questions if asked[1] else questions[:1]


def _is_lost(got):
    return getattr(got, "kind", "") == "no answer"


def _outcomes(check, asked, text, ask, lost):
    """`lost`: the Failure of one who does not answer any more."""
    count = sum(len(calls) for _, calls in asked)
    answers = [(lost, "")] * count if lost else _read(ask(text), count, check.reply)
    outcomes = []
    for case, group in asked:
        mine, answers = answers[: len(group)], answers[len(group) :]
        outcomes.append(Outcome(case, group, _verdict(check, case, mine), "".join(text for _, text in mine)))
    return outcomes


def _verdict(check, case, answers):
    values = [value for value, _ in answers]
    failing = [number for number, value in enumerate(values) if isinstance(value, Failure)]
    if failing:
        failure = values[failing[0]]
        expected = _expected(check, case, [None if isinstance(one, Failure) else one for one in values])
        return Verdict(math.inf, 0.0, expected, failure, failure.message, calls=(failing[0],))
    try:
        return check.judge(case.values, values)
    except Exception:
        expected = _expected(check, case, [None] * len(values))
        if expected is None:  # the judge cannot say what is right either: that is our own fault
            raise
        return Verdict(math.inf, 0.0, expected, values[0], "an answer too odd to be judged")


def _expected(check, case, answers):
    """What was to come, where the judge can say so without (all) answers."""
    try:
        return check.judge(case.values, answers).expected
    except Exception:  # a judge that must see an answer, or an engine that is not there
        return None


def _read(text, count, reply):
    """[(value or Failure, what was printed)], one for each call, whatever the other side has sent."""
    try:
        replies = parse(text)["replies"]
        if len(replies) != count:
            raise BadReply(f"{len(replies)} replies came to {count} calls")
        return [(_value(entry, reply), _words(entry.get("printed", ""))) for entry in replies]
    except (BadReply, KeyError, TypeError, AttributeError, IndexError) as error:
        return [(Failure("answer", f"the response cannot be read: {_words(error)}"), "")] * count


def _value(entry, reply):
    if "error" in entry:
        error = entry["error"]
        lines = error["lines"] if isinstance(error["lines"], list) else []
        return Failure(
            _words(error["kind"]), _words(error["message"]), tuple(map(_words, lines[:MOST_LINES]))
        )
    try:
        return admit(entry["value"], reply)
    except BadReply as error:
        return Failure("answer", str(error), value=error.value)


def _words(value):
    """Text that came from the other side: not too long, and without half letters that no file can hold. Other
    things are only named: to write them out may overflow."""
    text = str(value) if isinstance(value, str | Exception) else type(value).__name__
    return text[:LONGEST_WORDS].encode("utf-8", "replace").decode()


def mark_in_turn(checks, ask, seed=SELF_STUDY_SEED):
    """The results one by one. One that fails knows which of the checks before it, that it builds on, fail."""
    failed = set()
    for check in checks:
        result = mark(check, ask, seed)
        if not result.passed:
            failed.add(check.name)
            result = replace(result, broken=tuple(name for name in check.after if name in failed))
        yield result


def mark_all(checks, ask, seed=SELF_STUDY_SEED):
    return list(mark_in_turn(checks, ask, seed))
