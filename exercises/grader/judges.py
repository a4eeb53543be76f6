"""When is an answer right? A judge is a function of (values of the case, answers of its calls) → Verdict.

Every judge reduces an answer to one number, its error, beside the tolerance: so the tests of an exercise can
measure how far right solutions stay below it and mistakes above. NaN is never within a tolerance.

Most judges can say what they know of a case as data, `judge.data(values)`: that is what the students' bundle
holds in place of an oracle, and released.py makes judges of it again.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from exercises.grader.replies import pack

MOST_KNOWN = 1000  # answers of one oracle that are kept


@dataclass(frozen=True)
class Verdict:
    error: float
    tolerance: float
    expected: object
    got: object
    complaint: str = ""  # what is wrong with the kind of answer: shape, type, missing
    measure: str = ""  # what the error is relative to
    calls: tuple = (0,)  # numbers of the calls that it is about

    @property
    def passed(self):
        return bool(self.error <= self.tolerance)  # False for NaN

    @property
    def ratio(self):
        """Error over tolerance: at most 1 passes."""
        if self.error == 0:
            return 0.0
        return self.error / self.tolerance if self.tolerance > 0 else math.inf


def difference(expected, got, floor=1.0):
    """(error, complaint) between two answers: the largest difference over the largest expected number, at
    least `floor`."""
    if got is None and expected is not None:
        return math.inf, "the function returned None"
    if isinstance(expected, dict):
        if not isinstance(got, dict) or set(got) != set(expected):
            return math.inf, f"a dict with the keys {', '.join(expected)} is expected, not {kind_of(got)}"
        return _worst((key, *difference(expected[key], got[key], floor)) for key in expected)
    if isinstance(expected, tuple):
        if (
            not isinstance(got, tuple)
            and not (isinstance(got, np.ndarray) and got.ndim)
            or len(got) != len(expected)
        ):
            return math.inf, f"{len(expected)} values are expected, not {kind_of(got)}"
        pairs = enumerate(zip(expected, got, strict=True))
        return _worst((f"value {i + 1}", *difference(e, g, floor)) for i, (e, g) in pairs)
    if expected is None or isinstance(expected, (str, bool)):
        same = type(got) is type(expected) and got == expected
        return (0.0, "") if same else (math.inf, "" if isinstance(got, str) else f"this is {kind_of(got)}")
    return _difference_of_numbers(expected, got, floor)


def _worst(parts):
    name, error, complaint = max(parts, key=lambda part: math.inf if math.isnan(part[1]) else part[1])
    return error, f"{name}: {complaint}" if complaint else ""


def _difference_of_numbers(expected, got, floor):
    expected = _as_numbers(expected)
    if hasattr(got, "toarray") and got.shape != expected.shape:  # before it is made dense: it may be huge
        return math.inf, f"{kind_of(expected)} is expected, not {kind_of(got)}"
    got_array = _as_numbers(got)
    if expected.size == 0 or got_array is None or got_array.shape != expected.shape:
        return math.inf, f"{kind_of(expected)} is expected, not {kind_of(got)}"
    finite = np.isfinite(expected)  # where inf or NaN is expected, it must come, and nowhere else
    same = (got_array == expected) | (np.isnan(got_array) & np.isnan(expected))
    if not np.all(same[~finite]):
        return math.inf, ""
    if not np.all(np.isfinite(got_array[finite])):
        return math.inf, ""
    if not np.any(finite):
        return 0.0, ""
    scale = max(floor, np.max(np.abs(expected[finite])))
    return float(np.max(np.abs(got_array[finite] - expected[finite])) / scale), ""


def _as_numbers(value):
    """A float array, or None: text, True and False are no numbers, and rows of different length no array."""
    if hasattr(value, "toarray"):
        value = value.toarray()
    try:
        array = np.asarray(value)
    except ValueError:
        return None
    return array.astype(float) if array.dtype.kind in "iuf" else None


def kind_of(value):
    """What sort of thing an answer is, for a student."""
    if value is None or isinstance(value, (bool, str)):
        return repr(value)
    if isinstance(value, dict):
        return f"a dict with the keys {', '.join(value)}"
    if isinstance(value, tuple):
        return f"a tuple of {len(value)}" if _as_numbers(value) is None else f"{len(value)} values"
    shape = np.shape(value) if not hasattr(value, "toarray") else value.shape
    return "a number" if shape == () else f"an array of shape {shape}"


def _once(oracle):
    """An oracle that works each case out once, not again for every submission. A case is known by its very
    `values`, which are kept, so that no other case can come to have their place."""
    known = {}
    if getattr(oracle, "remembers", False):
        return oracle

    def remembered(values):
        if id(values) not in known:
            if len(known) == MOST_KNOWN:
                del known[next(iter(known))]
            known[id(values)] = values, oracle(values)
        return known[id(values)][1]

    return remembered


def _relative_to(floor):
    return f"relative to the largest number expected, or to {floor:g} where that is larger"


def _as_data(kind, oracle, tolerance, floor):
    """`data` of a judge that compares with an oracle's answer."""
    return lambda values: {
        "kind": kind,
        "expected": pack(oracle(values)),
        "tolerance": tolerance,
        "floor": floor,
    }


def equal(oracle, tolerance, floor=1.0):
    """The answer is `oracle(values)`, to a tolerance relative to its largest number, taken as at least
    `floor`."""

    oracle = _once(oracle)

    def judge(values, answers):
        expected, (got,) = oracle(values), answers
        error, complaint = difference(expected, got, floor)
        return Verdict(error, tolerance, expected, got, complaint, _relative_to(floor))

    judge.data = _as_data("equal", oracle, tolerance, floor)
    return judge


def word(oracle):
    """The answer is exactly the word (or True, False, None) that the oracle says."""
    return equal(oracle, 0.0)


def up_to_sign(oracle, tolerance, floor=1.0):
    """As `equal`, but −x is as good as x: quaternions, eigenvectors, normals of no side."""

    oracle = _once(oracle)

    def judge(values, answers):
        expected, (got,) = oracle(values), answers
        both = [(sign * expected, *difference(sign * expected, got, floor)) for sign in (1, -1)]
        nearer, error, complaint = min(both, key=lambda item: item[1])
        return Verdict(error, tolerance, nearer, got, complaint, _relative_to(floor))

    judge.data = _as_data("up_to_sign", oracle, tolerance, floor)
    return judge


def unordered(oracle, tolerance, floor=1.0):
    """As `equal`, but the rows may come in any order. Each expected row takes the nearest of the rows left
    over."""

    oracle = _once(oracle)

    def judge(values, answers):
        expected, (got,) = np.asarray(oracle(values), dtype=float), answers
        rows = _as_numbers(got)
        if rows is None or rows.shape != expected.shape or not np.all(np.isfinite(rows)):
            return Verdict(
                math.inf, tolerance, expected, got, f"{kind_of(expected)} is expected, not {kind_of(got)}"
            )
        left, order = list(range(len(rows))), []
        for row in expected:
            order.append(left.pop(int(np.argmin([np.max(np.abs(rows[i] - row)) for i in left]))))
        error, complaint = difference(expected, rows[order], floor)
        return Verdict(error, tolerance, expected, got, complaint, _relative_to(floor))

    judge.data = _as_data("unordered", oracle, tolerance, floor)
    return judge


def bound(measure, limit, what):
    """`measure(values, answer)` is at most `limit`. `what` names the measured thing in the report."""

    def judge(values, answers):
        try:
            error = float(measure(values, answers[0]))
        except (TypeError, ValueError, IndexError, KeyError):
            return Verdict(
                math.inf, limit, f"{what} at most {limit:g}", answers[0], f"this is {kind_of(answers[0])}"
            )
        return Verdict(error, limit, f"{what} at most {limit:g}", error)

    return judge


def fitted_order(errors, order, tolerance):
    """The method's errors fall like dt to the power `order`.

    `errors(values, answers)` → (three step sizes, each half of the one before; the three errors). From two of
    them the order is p + c·dt, so 2 p(dt/2) − p(dt) is free of that c: a sharp measure at steps that are not
    yet tiny.
    """

    def judge(values, answers):
        expected = f"order {order}"
        try:
            steps, sizes = errors(values, answers)
            (first, second), (a, b, c) = (steps[0] / steps[1], steps[1] / steps[2]), sizes
        except (TypeError, ValueError, IndexError):
            return Verdict(math.inf, tolerance, expected, answers[-1], f"this is {kind_of(answers[-1])}")
        if not all(math.isfinite(size) and size > 0 for size in sizes):
            return Verdict(
                math.inf, tolerance, expected, f"errors {a:.2g}, {b:.2g}, {c:.2g}: no order to be seen"
            )
        fitted = 2 * math.log(b / c) / math.log(second) - math.log(a / b) / math.log(first)
        words = f"order {fitted:.2f} (errors {a:.2g}, {b:.2g}, {c:.2g} as dt is halved)"
        return Verdict(abs(fitted - order), tolerance, expected, words)

    return judge


def order_of_runs(exact, steps, order, tolerance, first=0):
    """`fitted_order` of whole runs of `steps` steps each, which are the answers from number `first` on.

    `exact(values)` → (duration, the exact states at equally spaced times that all runs share, the start's
    first).
    """

    exact = _once(exact)

    def errors(values, answers):
        duration, states = exact(values)
        runs, sizes = [np.asarray(run, dtype=float) for run in answers[first:]], []
        for run, n in zip(runs, steps, strict=True):
            if run.shape != (n + 1, *states.shape[1:]):
                raise ValueError("a run has not steps + 1 rows")
            sizes.append(np.max(np.abs(run[:: n // (len(states) - 1)] - states)))
        return [duration / n for n in steps], sizes

    def data(values):
        duration, states = exact(values)
        settings = {"steps": list(steps), "order": order, "tolerance": tolerance, "first": first}
        return {"kind": "order_of_runs", "duration": duration, "states": pack(states), **settings}

    fitted = fitted_order(errors, order, tolerance)

    def judge(values, answers):
        return replace(fitted(values, answers), calls=tuple(range(first, first + len(steps))))

    judge.data = data
    return judge


def an_array(judge):
    """The answer must be an array, and `judge` be content: for what other functions go on to use as one."""

    def of_an_array(values, answers):
        verdict = judge(values, answers)
        if not isinstance(answers[0], tuple) or not isinstance(verdict.expected, np.ndarray):
            return verdict
        asked = f"an array of shape {verdict.expected.shape} is asked for"
        complaint = f"this is a list (or a tuple); {asked}: np.array(…) makes one of it"
        return replace(verdict, error=math.inf, complaint=complaint)

    of_an_array.data = lambda values: {"kind": "an_array", "judge": data_of(judge, values)}
    return of_an_array


def on_answer(number, judge):
    """A judge that looks at one of several calls' answers only."""

    def on_one(values, answers):
        return replace(judge(values, [answers[number]]), calls=(number,))

    on_one.data = lambda values: {"kind": "on_answer", "number": number, "judge": data_of(judge, values)}
    return on_one


def all_of(*judges):
    """All judges must agree; the worst verdict is the one told."""

    def worst(values, answers):
        return max((judge(values, answers) for judge in judges), key=_badness)

    worst.data = lambda values: {"kind": "all_of", "judges": [data_of(judge, values) for judge in judges]}
    return worst


def data_of(judge, values):
    """What a judge knows of a case, as data; None where it is a computation that no data can stand for."""
    return judge.data(values) if hasattr(judge, "data") else None


def _badness(verdict):
    return math.inf if math.isnan(verdict.ratio) else verdict.ratio
