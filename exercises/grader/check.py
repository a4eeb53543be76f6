"""What a check is: data. Marking, notebook, shell and report all read the same one."""

import zlib
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from exercises.grader.replies import Reply, encode

SELF_STUDY_SEED = 2  # public: notebook and shell draw the same hidden cases, so they give the same points


class Unrecorded(Exception):
    """An oracle cannot answer here: its engine is not installed, and this input is not in the recording."""


@dataclass(frozen=True)
class Case:
    """One question, in words and as values by name. The values are of the kinds that replies.pack knows."""

    label: str
    values: dict
    hidden: bool = False


@dataclass(frozen=True)
class Call:
    """`function(*arguments)`, to be done by the worker."""

    function: str
    arguments: tuple


@dataclass(frozen=True)
class Cause:
    """A likely cause, told by `text` where `matches(values, verdict)` says that the failure looks like it."""

    text: str
    matches: Callable
    model: Callable = None  # model(values): what a student with this mistake would return, if known


@dataclass(frozen=True, eq=False)
class Check:
    """A check of one function, or of one property. All its cases pass, or it earns nothing."""

    name: str
    title: str  # what is checked, in a few words
    points: int
    visible: tuple  # cases that a student may see
    hidden: Callable  # hidden(random generator) -> list of cases
    judge: Callable  # judge(values, answers of the calls) -> Verdict
    why: str  # the reason of the tolerance
    form: str  # what the function returns, in words
    section: str  # heading on the unit's page to read
    function: str = ""  # the student's function; the check's name unless given
    calls: Callable = None  # calls(values) -> list of Call; one call with the values in order unless given
    causes: tuple = ()  # Cause, the first that matches is told
    hint: str = ""  # likely cause where none matches
    reply: Reply = field(default_factory=Reply)
    after: tuple = ()  # names of earlier checks, of functions that this one builds on
    source: Callable = None  # source() -> where the expected values come from, in words

    def cases(self, seed):
        """All cases for a seed. Each check has its own stream: a new one leaves the others' cases alone."""
        stream = np.random.default_rng([seed, zlib.crc32(self.name.encode())])
        return [*self.visible, *(Case(case.label, case.values, hidden=True) for case in self.hidden(stream))]

    def calls_of(self, case):
        if self.calls is not None:
            return self.calls(case.values)
        return [Call(self.function or self.name, tuple(case.values.values()))]


def remember(oracle):
    """An oracle that works each case out once: for a costly one, asked again for every submission."""
    known = {}

    def remembered(values):
        key = encode(values)
        if key not in known:
            known[key] = oracle(values)
        return known[key]

    return remembered


def cause(text, when):
    """A likely cause, known by a test of the verdict: `when(values, verdict)`."""
    return Cause(text, when)


def cause_like(text, model):
    """A likely cause, known by its answer: what a student with this mistake would return is `model(values)`.

    A case where the mistake does not show (its answer is the right one) neither speaks for it nor against it:
    only failing cases are looked at, and there the mistaken answer must be the one that came.
    """

    def matches(values, verdict):
        from exercises.grader.judges import difference

        error, _ = difference(model(values), verdict.got)
        return error <= max(1e-6, verdict.tolerance)

    return Cause(text, matches, model)
