"""What a notebook's code looks like once names, spacing and comments are taken away: a set of numbers.

This runs in the sandbox, without the student's code, under its limits: to split a student's text into tokens
is to parse it. Two notebooks that share most of their numbers share most of their code.
"""

import hashlib
import io
import keyword
import tokenize

WINDOW = 12  # tokens that must agree in a row
MOST = 1500  # numbers kept of a notebook: the smallest, so that two notebooks keep the same ones
LONGEST_CELL = 200_000


def of_cells(cells, extra, metadata=()):
    """`cells` and `extra["starter"]` are lists of cells' sources → the numbers, and hints."""
    own = _shingles(cells) - _shingles(extra["starter"])
    return {"numbers": sorted(own)[:MOST], "hints": _hints(metadata)}


def _shingles(cells):
    found = set()
    for cell in cells:
        tokens = _tokens(cell[:LONGEST_CELL])
        for start in range(len(tokens) - WINDOW + 1):
            window = "\0".join(tokens[start : start + WINDOW])
            found.add(int.from_bytes(hashlib.blake2b(window.encode(errors="replace"), digest_size=6).digest()))
    return found


def _tokens(cell):
    """Keywords, signs and numbers as they are; names all alike, so that renaming hides nothing."""
    tokens = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(cell).readline):
            if token.type == tokenize.NAME:
                tokens.append(token.string if keyword.iskeyword(token.string) else "name")
            elif token.type in (tokenize.OP, tokenize.NUMBER):
                tokens.append(token.string)
    except (tokenize.TokenError, SyntaxError, ValueError, RecursionError):
        pass  # what came before the fault counts
    return tokens


def _hints(metadata):
    """What nbgrader's metadata say of the notebook: never trusted, only shown to the instructor."""
    try:
        marks = [about.get("nbgrader") for about in metadata]
        names = [str(mark["grade_id"])[:60] for mark in marks if mark and mark.get("grade")]
    except (KeyError, TypeError, AttributeError):
        return []
    return names[:40]
