"""What a notebook's code looks like once names, spacing and comments are taken away: a set of numbers.

This runs in the sandbox, without the student's code, under its limits: to split a student's text into tokens
is to parse it. Two notebooks that share most of their numbers share most of their code.
"""

import hashlib
import io
import json
import keyword
import tokenize

WINDOW = 12  # tokens that must agree in a row
MOST = 1500  # numbers kept of a notebook: the smallest, so that two notebooks keep the same ones
LONGEST_CELL = 200_000


def of_cells(cells, extra):
    """`cells` and `extra["starter"]` are lists of cells' sources → the numbers, and hints."""
    own = _shingles(cells) - _shingles(extra["starter"])
    return {"numbers": sorted(own)[:MOST], "hints": _hints(extra["notebook"])}


def _shingles(cells):
    found = set()
    for cell in cells:
        tokens = _tokens(cell[:LONGEST_CELL])
        for start in range(len(tokens) - WINDOW + 1):
            window = "\0".join(tokens[start : start + WINDOW])
            found.add(
                int.from_bytes(hashlib.blake2b(window.encode(errors="replace"), digest_size=6).digest())
            )
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


def _hints(text):
    """Names of graded cells, as nbgrader's metadata tell them: never trusted, only shown."""
    try:
        marks = [cell.get("metadata", {}).get("nbgrader") for cell in json.loads(text)["cells"]]
        names = [str(mark["grade_id"])[:60] for mark in marks if mark and mark.get("grade")]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return []
    return names[:40]
