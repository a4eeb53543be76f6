"""The student's side: looks functions up by name, calls them, sends back what they return.

Request and response are one line of JSON text each:

    {"calls": [{"function": name, "arguments": [...]}, ...]}
    {"replies": [{"value": ...} or {"error": {"kind", "message", "lines"}}, ...]}      perhaps with "printed"

Each call has its own fresh copies of the arguments, since they are read from the text anew, and random
generators set to the same state: no call can spoil another. A function that writes into an array it was
handed is refused: here nothing comes of it, but in a run of the student's own it spoils what its caller
holds.
"""

import contextlib
import inspect
import io
import json
import random
import sys
import sysconfig
import traceback
import warnings
from pathlib import Path

import numpy as np

from exercises.grader.replies import BadReply, pack, unpack
from exercises.grader.state import put_back

OWN_FOLDER = str(Path(__file__).resolve().parent)
LIBRARIES = tuple(
    {str(Path(sysconfig.get_path(name)).resolve()) for name in ("stdlib", "purelib", "platlib")}
)
IN_PLACE = "in place"  # the kind of error of a call that changed its arguments
MOST_PRINTED = 400  # characters of what a function printed that go into a report


class Worker:
    """Answers requests about the functions in `namespace`, with `given` to make arguments."""

    def __init__(self, namespace, given):
        self.namespace, self.given = namespace, given

    def answer(self, text, last=False):
        """`last`: the process ends after it, so nothing need be put back."""
        calls = json.loads(text)["calls"]
        with contextlib.nullcontext() if last else put_back(self.namespace), _generators_put_back():
            return json.dumps(
                {"replies": [self._reply(call, i) for i, call in enumerate(calls)]}, allow_nan=False
            )

    def _reply(self, call, number):
        printed = io.StringIO()
        try:
            function = self._function(call["function"])
            arguments = [unpack(argument, self._resolve) for argument in call["arguments"]]
            random.seed(number)
            np.random.seed(number)  # noqa: NPY002 (students may use the old one)
            with _quiet(printed):
                reply = {"value": pack(function(*arguments))}
            changed = self._changed(call, arguments)
            if changed is not None:
                message = _told_in_place(
                    call["function"], _name_of(function, changed), self._helpers(function, arguments)
                )
                reply = {"error": {"kind": IN_PLACE, "message": message, "lines": []}}
        except KeyboardInterrupt:
            raise  # the student pressed Stop: that ends the check
        except BadReply as error:
            reply = {"error": {"kind": "answer", "message": str(error), "lines": []}}
        except BaseException as error:  # SystemExit too: exit() in a function ends that call alone
            reply = {"error": describe(error)}
        if printed.getvalue():
            reply["printed"] = printed.getvalue()[:MOST_PRINTED]
        return reply

    def _changed(self, call, arguments):
        """The position of the first argument of which an array is not as it was handed in, or None."""
        for position, (argument, data) in enumerate(zip(arguments, call["arguments"], strict=True)):
            if _may_change(data) and not _same_arrays(argument, unpack(data, self._resolve)):
                return position
        return None

    def _helpers(self, function, arguments):
        """Names of the student's other functions that this one uses or is handed: one of them may be the
        culprit."""
        own = {name: value for name, value in self.namespace.items() if _code_of(value) is not None}
        used = set(_names_in(_code_of(function)))
        return [
            name
            for name, value in own.items()
            if value is not function and (name in used or any(value is argument for argument in arguments))
        ]

    def _resolve(self, data):
        if "student" in data:
            return self._function(data["student"])
        return getattr(self.given, data["given"])(**unpack(data["parameters"], self._resolve))

    def _function(self, name):
        function = self.namespace.get(name)
        if not callable(function):
            state = (
                "is not defined" if function is None else f"is not a function but a {type(function).__name__}"
            )
            raise BadReply(f"{name} {state}: run (or mend) the cell that defines it")
        return function


def _may_change(data):
    """Is this an array, or does it hold one? Helpers of given.py are none of a student's to change."""
    if not isinstance(data, dict):
        return False
    return "array" in data or any(
        map(_may_change, data.get("tuple", [item for _, item in data.get("dict", [])]))
    )


def _same_arrays(after, before):
    if isinstance(before, np.ndarray):
        return np.array_equal(after, before, equal_nan=True)
    if isinstance(before, tuple):
        return all(_same_arrays(*pair) for pair in zip(after, before, strict=True))
    if isinstance(before, dict):
        return all(_same_arrays(after.get(key, item), item) for key, item in before.items())
    return True


def _code_of(function):
    """The code of a Python function, also of one that Numba has compiled; None of other things."""
    try:
        return getattr(getattr(function, "py_func", function), "__code__", None)
    except Exception:  # a name of an absent package raises, whatever is asked of it
        return None


def _names_in(code):
    """The names that a code uses, also in the functions that are defined inside it."""
    if code is not None:
        yield from code.co_names
        for constant in code.co_consts:
            if inspect.iscode(constant):
                yield from _names_in(constant)


def _name_of(function, position):
    try:
        return list(inspect.signature(getattr(function, "py_func", function)).parameters)[position]
    except (TypeError, ValueError, IndexError):  # it takes *arguments, or does not tell what it takes
        return f"number {position + 1}"


def _told_in_place(function, argument, helpers):
    who = f"{function} (or {', '.join(helpers[:4])}, which it uses)" if helpers else function
    name = argument if argument.isidentifier() else "x"
    return (
        f"{who} changes its argument `{argument}` in place (as `{name} += …` does): write "
        f"`{name} = {name} + …`, so that who calls it keeps their own {name}."
    )


@contextlib.contextmanager
def _quiet(printed):
    with warnings.catch_warnings(), contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        warnings.simplefilter("ignore")  # an overflow shows in the answer; its warning only floods the cell
        yield


@contextlib.contextmanager
def _generators_put_back():
    """The student's own random numbers go on after a check as if there had been none."""
    states = random.getstate(), np.random.get_state()  # noqa: NPY002
    try:
        yield
    finally:
        random.setstate(states[0])
        np.random.set_state(states[1])  # noqa: NPY002


def describe(error):
    """An exception as data: its kind, message, and the student's own lines that led to it (the last few)."""
    lines = []
    for frame in traceback.extract_tb(error.__traceback__):
        if not _is_ours(frame.filename):
            lines.append(f"in {frame.name}, line {frame.lineno}: {frame.line or ''}".rstrip(": "))
    if isinstance(error, SyntaxError) and error.text:
        lines.append(f"line {error.lineno}: {error.text.strip()}")
    try:
        message = str(error)
    except Exception:  # an exception class whose __str__ raises
        message = ""
    return {
        "kind": type(error).__name__[:80],
        "message": message[:500],
        "lines": [line[:200] for line in lines[-4:]],
    }


def _is_ours(filename):
    if filename.startswith("<frozen") or filename.startswith(OWN_FOLDER):
        return True
    return filename.startswith(LIBRARIES) or filename.startswith(sys.prefix)
