"""What a student reads: plain text, the same in a notebook and in the shell."""

import textwrap

import numpy as np

from exercises.grader.marking import NOT_RAISED, Failure
from exercises.grader.replies import Given, Student

WIDTH, INDENT = 100, 24


def report(result, page):
    """The report of one check, as text. `page` is the unit's lecture page, for what to read."""
    check, failing = result.check, [outcome for outcome in result.outcomes if not outcome.verdict.passed]
    if not failing:
        source = f"; {check.source()}" if check.source else ""
        points = f"{check.points} of {check.points} points"
        return f"passed  {check.name}: {points} ({len(result.outcomes)} cases{source})"
    first = failing[0]
    if all(outcome.verdict.got is None for outcome in failing):
        return "\n".join(_unwritten(check, page))
    count = f"{len(failing)} of {len(result.outcomes)} cases fail, here is the first"
    lines = [f"FAILED  {check.name}: 0 of {check.points} points; {count}."]
    lines += _row("asked for", check.title)
    lines += _row("case", first.case.label)
    lines += [line for call in calls_to_show(first) for line in _row("call", write_call(call))]
    lines += _what_came(first)
    lines += _row("why that tolerance", check.why)
    if check.source:
        lines += _row("expected comes from", check.source())
    if first.printed:
        lines += _row("it printed", first.printed)
    lines += _row("likely cause", likely_cause(result))
    lines += _row("read", f'{page}, section "{check.section}"')
    return "\n".join(lines)


def calls_to_show(outcome):
    """The calls that the verdict is about: pasted into a cell, they show the failure."""
    return [outcome.calls[number] for number in outcome.verdict.calls if number < len(outcome.calls)]


def _unwritten(check, page):
    return [
        f"to do   {check.name}: 0 of {check.points} points; it returns None.",
        *_row("asked for", f"{check.title}: {check.form}"),
        *_row("likely cause", "The function is still to be written, or its `return` is missing."),
        *_row("read", f'{page}, section "{check.section}"'),
    ]


def _what_came(outcome):
    verdict = outcome.verdict
    if isinstance(verdict.got, Failure):
        failure = verdict.got
        rows = [] if verdict.expected is None else _row("expected", write(verdict.expected))
        rows += _row("got", words_of(failure))
        if failure.value is not None:
            rows += _row("", write(failure.value))
        return rows + [line for text in failure.lines for line in _row("", text)]
    rows = _row("expected", write(verdict.expected)) + _row("got", write(verdict.got))
    if verdict.complaint:
        rows += _row("", verdict.complaint)
    else:
        rows += _row("error", f"{verdict.error:.3g}{verdict.measure and ', ' + verdict.measure}")
    rows += _row("tolerance", f"{verdict.tolerance:.3g}")
    return rows


def words_of(failure):
    """A Failure in one line."""
    raised = failure.kind not in NOT_RAISED
    return f"{failure.kind}: {failure.message}" if raised else failure.message


def likely_cause(result):
    """The first cause that looks like every failing case; else what the check says for want of a better."""
    check = result.check
    failing = [outcome for outcome in result.outcomes if not outcome.verdict.passed]
    if isinstance(failing[0].verdict.got, Failure):
        failure = failing[0].verdict.got
        alike = [one for one in failing if getattr(one.verdict.got, "message", None) == failure.message]
        known = _known_cause(check, alike) if failure.value is not None else None
        return known or _built_on(result) or _cause_of_failure(failure, check)
    failing = [outcome for outcome in failing if not isinstance(outcome.verdict.got, Failure)]
    if failing[0].verdict.complaint:
        return f"The answer is not of the kind asked for. It must be {check.form}."
    return _built_on(result) or _known_cause(check, failing) or check.hint


def _built_on(result):
    """Where checks before this one fail, on whose functions it builds: those first."""
    if not result.broken:
        return None
    name, broken = result.check.function or result.check.name, " and ".join(result.broken)
    if len(result.broken) == 1:
        return f"{broken} fails its own check, and {name} builds on it: mend that first."
    return f"{broken} fail their own checks, and {name} builds on them: mend those first."


def _known_cause(check, failing):
    for cause in check.causes:
        if all(_matches(cause, outcome) for outcome in failing):
            return cause.text
    return None


def _matches(cause, outcome):
    try:
        return bool(cause.matches(outcome.case.values, outcome.verdict))
    except Exception:
        return False  # an answer so odd that this cause's test cannot even look at it


def _cause_of_failure(failure, check):
    if failure.kind == "answer" and failure.value is None:
        return f"The function is not there, or its answer is not {check.form}."
    if failure.kind == "answer" and "NaN" in failure.message:
        return (
            "nan (not a number) comes of 0/0, of inf − inf, or of the root of a negative number. Is "
            "something divided by a length that is 0 here? Write the formula without that division."
        )
    if failure.kind == "answer" and "inf" in failure.message.split():
        return "inf comes of a division by 0, or of numbers that grow without bound."
    if failure.kind == "answer":
        return f"The answer is not {check.form}."
    if failure.kind == "in place":
        return (
            "On an array, `+=`, `-=`, `*=` and `y[0] = …` write into the very array that the caller holds. "
            "`y = y + …` makes a new one, and so does y.copy()."
        )
    if failure.kind == "no answer":
        return "A loop that does not end, or far too many steps."
    if failure.kind == "NameError":
        return "A name that is not defined: a slip in spelling, or a cell that was not run."
    if "NoneType" in failure.message:
        return (
            "Something is None: a function that this one uses is still to be written, or lacks its `return`."
        )
    if failure.kind == "TypeError" and "argument" in failure.message:
        return "The function must take the arguments of the starter, in that order."
    return "The error is raised in your own lines above; call the function by hand with the arguments shown."


def _row(name, text):
    """One line of the report, or several: the text's own lines are kept, long ones are wrapped."""
    lines = [
        piece
        for line in str(text).splitlines() or [""]
        for piece in textwrap.wrap(line, WIDTH - INDENT, break_long_words=False, break_on_hyphens=False)
        or [""]
    ]
    return [f"    {name if i == 0 else '':<{INDENT - 4}}{line}" for i, line in enumerate(lines[:12])]


def write(value):
    """A value, to eight figures, as a student reads it."""
    if isinstance(value, np.ndarray):
        if value.size == 0:
            return f"an array of shape {value.shape}, which holds nothing"
        text = np.array2string(value, precision=8, threshold=40, edgeitems=4, max_line_width=WIDTH - INDENT)
        if text.count("\n") < 9:
            return text
        return f"an array of shape {value.shape} that begins {write(value.ravel()[:6])}"
    if isinstance(value, (float, np.floating)):
        return f"{value:.9g}"
    if isinstance(value, tuple):
        return "(" + ", ".join(write(item) for item in value) + ")"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key!r}: {write(item)}" for key, item in value.items()) + "}"
    if hasattr(value, "toarray"):
        return f"a sparse array of shape {value.shape}"
    return value if isinstance(value, str) else repr(value)


def write_call(call):
    """A call that can be pasted into a cell."""
    return f"{call.function}({', '.join(write_argument(argument) for argument in call.arguments)})"


def write_argument(value):
    if isinstance(value, np.ndarray):
        return f"np.array({_list(value.tolist())})"
    if isinstance(value, Student):
        return value.name
    if isinstance(value, Given):
        parameters = ", ".join(f"{name}={write_argument(item)}" for name, item in value.parameters.items())
        return f"given.{value.name}({parameters})"
    if isinstance(value, (tuple, list)):
        items = ", ".join(write_argument(item) for item in value)
        return f"({items},)" if len(value) == 1 else f"({items})"
    return repr(value.item() if isinstance(value, np.generic) else value)


def _list(items):
    return "[" + ", ".join(_list(item) if isinstance(item, list) else f"{item!r}" for item in items) + "]"


def total(results):
    """The last line: points of all checks."""
    earned, possible = (
        sum(result.earned for result in results),
        sum(result.check.points for result in results),
    )
    return f"{earned} of {possible} points"
