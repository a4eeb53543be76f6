"""A student's words, made fit for a terminal or a page."""

import re
from dataclasses import dataclass

# Terminals' sequences, control characters but tab and line feed, marks that turn the direction, lone
# surrogates.
UNPRINTABLE = re.compile(
    r"\x1b\[[0-9;?]*[ -/]*[@-~]|\x1b."
    r"|[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff]"
)


@dataclass(frozen=True)
class Trouble:
    """Cell `number` (from 1), which begins with `title`, raised; or was left out, but for its definitions."""

    number: int
    title: str
    text: str
    skipped: bool


def clean(text, most=500):
    """Text of a student's, fit for a terminal or a page: no control characters, not too long."""
    return UNPRINTABLE.sub("", str(text)[: 4 * most])[:most]
