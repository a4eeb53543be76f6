"""What a notebook's code looks like once names, spacing and comments are taken away: a set of numbers.

This runs in the sandbox, without the student's code, under its limits: to split a student's text into tokens
is to parse it. Two notebooks that share most of their numbers share most of their code.
"""

import io
import json
import keyword
import tokenize
import zlib

WINDOW = 12  # tokens that must agree in a row
MOST = 1500  # numbers kept of a notebook: the smallest, so that two notebooks keep the same ones
LONGEST_CELL = 200_000
LARGEST_FOR_HINTS = 1_000_000  # bytes of a notebook
PRIME, BASE = 2**61 - 1, 0x5DEECE66D1234567  # of a rolling hash: each number follows from the one before


def of_cells(cells, file, starter):
    """`cells` are the cells' sources, `file` the notebook's bytes, `starter` our own starter's numbers → the
    cells' numbers, and hints."""
    own = shingles(cells).difference(starter)
    return {"numbers": sorted(own)[:MOST], "hints": _hints(file) if len(file) <= LARGEST_FOR_HINTS else []}


def shingles(cells):
    """A number for each WINDOW tokens in a row."""
    found, oldest = set(), pow(BASE, WINDOW, PRIME)
    for cell in cells:
        codes = [zlib.crc32(token.encode(errors="replace")) for token in _tokens(cell[:LONGEST_CELL])]
        value = 0
        for place, code in enumerate(codes):
            value = (value * BASE + code) % PRIME
            if place >= WINDOW:
                value = (value - codes[place - WINDOW] * oldest) % PRIME
            if place >= WINDOW - 1:
                found.add(value)
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


def _hints(file):
    """Names of graded cells, as nbgrader's metadata tell them: never trusted, only shown."""
    try:
        marks = [cell.get("metadata", {}).get("nbgrader") for cell in json.loads(file)["cells"]]
        names = [str(mark["grade_id"])[:60] for mark in marks if mark and mark.get("grade")]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return []
    return names[:40]
