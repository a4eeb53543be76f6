"""Which values may cross between grader and student, and how: as plain JSON text, never a pickle.

None, bool, numbers, declared words, tuples (lists become tuples), dicts with text keys, arrays, sparse
arrays. Arrays travel as their bytes, so every float arrives exactly. inf and NaN arrive only where a check
declares them. From the grader to the student two more kinds may go: `Given` (a helper made by given.py) and
`Student` (one of the student's own functions), since a check may hand a callable to the function that it
tests.
"""

import base64
import json
import math
import sys
from dataclasses import dataclass

import numpy as np

LONGEST_TEXT = 8_000_000  # characters: far above any answer asked for, far below what hurts the grader
LONGEST_WORD = 200
DEEPEST = 30  # levels of tuples and dicts
ARRAY_TYPES = {"f8": np.dtype("<f8"), "i8": np.dtype("<i8"), "b1": np.dtype("|b1")}


class BadReply(ValueError):
    """The value, or the text, is not one of the declared kinds. `value` is what came, where it could be
    read."""

    value = None


@dataclass(frozen=True)
class Reply:
    """What a check lets come back, beyond numbers and arrays of finite numbers."""

    words: tuple = ()
    nonfinite: bool = False


class Given:
    """An argument `given.name(**parameters)`, made afresh in the worker for each call."""

    def __init__(self, name, **parameters):
        self.name, self.parameters = name, parameters

    def build(self, given):
        return getattr(given, self.name)(**self.parameters)


class Student:
    """An argument that is the student's own function of this name."""

    def __init__(self, name):
        self.name = name


def pack(value):
    """`value` as nested JSON data. Raises BadReply for what may not cross."""
    if value is None or isinstance(value, (bool, np.bool_)):
        return None if value is None else bool(value)
    if isinstance(value, (int, np.integer)):
        return _whole(int(value))
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else {"float": repr(float(value))}
    if isinstance(value, str):
        return {"word": value[:LONGEST_WORD]}
    if isinstance(value, (tuple, list)):
        return {"tuple": [pack(item) for item in value]}
    if isinstance(value, dict):
        if not all(isinstance(key, str) for key in value):
            raise BadReply("a dict whose keys are not all text cannot be checked")
        return {"dict": [[key, pack(item)] for key, item in value.items()]}
    if isinstance(value, np.ndarray):
        return _pack_array(value)
    if isinstance(value, Given):
        return {"given": value.name, "parameters": pack(value.parameters)}
    if isinstance(value, Student):
        return {"student": value.name}
    if _is_sparse(value):
        entries = value.tocoo()
        row, column = (np.asarray(index, dtype="i8") for index in (entries.row, entries.col))
        return {
            "sparse": [int(n) for n in entries.shape],
            "row": pack(row),
            "column": pack(column),
            "value": pack(np.asarray(entries.data, dtype=float)),
        }
    raise BadReply(
        f"a {type(value).__name__} cannot be checked: numbers, arrays, tuples, dicts, True, False or None can"
    )


def _whole(number):
    if abs(number) >= 2**63:  # such a number is no answer, and some operations on it would hurt the grader
        raise BadReply("the answer holds a whole number of more than 64 bits")
    return number


def _is_sparse(value):
    sparse = sys.modules.get("scipy.sparse")  # whoever made a sparse array has imported it already
    return sparse is not None and sparse.issparse(value)


def _pack_array(array):
    for name, kinds in (("b1", "b"), ("i8", "i"), ("f8", "fu")):
        if array.dtype.kind in kinds:
            data = np.ascontiguousarray(array, dtype=ARRAY_TYPES[name])
            return {
                "array": base64.b64encode(data.tobytes()).decode(),
                "type": name,
                "shape": list(array.shape),
            }
    raise BadReply(f"an array of type {array.dtype} cannot be checked: use real numbers")


def unpack(data, resolve=None, depth=0):
    """The value of nested JSON data. `resolve(data)` makes `given` and `student` arguments; without it none
    may come."""
    if depth > DEEPEST:  # what handles the value next, by recursion too, must not overflow
        raise BadReply(f"the answer is nested more than {DEEPEST} deep")
    if data is None or isinstance(data, (bool, float)):
        return data
    if isinstance(data, int):
        return _whole(data)
    if not isinstance(data, dict):
        raise BadReply("this is not how a value is written")
    if "float" in data:
        return float({"nan": "nan", "inf": "inf", "-inf": "-inf"}[data["float"]])
    if "word" in data:
        return str(data["word"])[:LONGEST_WORD]
    if "tuple" in data:
        return tuple(unpack(item, resolve, depth + 1) for item in data["tuple"])
    if "dict" in data:
        return {_key(key): unpack(item, resolve, depth + 1) for key, item in data["dict"]}
    if "array" in data:
        return _unpack_array(data)
    if "sparse" in data:
        return _unpack_sparse(data)
    if resolve is not None and ("given" in data or "student" in data):
        return resolve(data)
    raise BadReply("this is not how a value is written")


def as_argument(data):
    """For `unpack`, of cases that were saved: an argument as a check holds it, not yet built."""
    if "student" in data:
        return Student(data["student"])
    return Given(data["given"], **unpack(data["parameters"], as_argument))


def _key(key):
    if not isinstance(key, str) or len(key) > LONGEST_WORD:
        raise BadReply("the keys of a dict must be short words")
    return key.encode("utf-8", "replace").decode()  # half letters can be written to no file


def _unpack_array(data):
    kind, shape = ARRAY_TYPES[data["type"]], data["shape"]
    raw = base64.b64decode(data["array"], validate=True)
    if len(shape) > 8 or not all(type(n) is int and n >= 0 for n in shape):
        raise BadReply("an array's shape must be a few whole numbers")
    if math.prod(shape) * kind.itemsize != len(raw):
        raise BadReply("an array's shape does not fit its data")
    return np.frombuffer(raw, dtype=kind).reshape(shape).copy()  # a copy, so that it may be written to


def _unpack_sparse(data):
    import scipy.sparse

    shape, row, column, value = (
        tuple(data["sparse"]),
        *(_unpack_array(data[key]) for key in ("row", "column", "value")),
    )
    if len(shape) != 2 or not all(type(n) is int and 0 <= n < 2**31 for n in shape):
        raise BadReply("a sparse array's shape must be two whole numbers")
    return scipy.sparse.coo_array((value, (row, column)), shape=shape)


def encode(value):
    """`value` as one line of JSON text."""
    return json.dumps(pack(value), allow_nan=False)


def parse(text):
    """JSON text → nested data, or BadReply: too long, too deep, or not JSON at all."""
    if len(text) > LONGEST_TEXT:
        raise BadReply(f"the reply is too long: over {LONGEST_TEXT:,} characters")
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise BadReply(f"the reply cannot be read: {error}") from None


def _refuse_constant(name):
    raise ValueError(f"bare {name}")


def decode(text, reply=Reply()):
    """The value that a text stands for, if it is one that `reply` declares."""
    return admit(parse(text), reply)


def admit(data, reply=Reply()):
    """The value of nested JSON data that came from a student, if it is one that `reply` declares."""
    try:
        value = unpack(data)
    except BadReply:
        raise
    except (ValueError, TypeError, KeyError, IndexError, OverflowError, RecursionError, MemoryError) as error:
        raise BadReply(f"the reply cannot be read ({type(error).__name__})") from None
    try:
        _require_declared(value, reply)
    except BadReply as error:
        error.value = value  # it could be read: so the report can show it
        raise
    return value


def _require_declared(value, reply):
    if isinstance(value, str) and value not in reply.words:
        wanted = f"one of {', '.join(reply.words)}" if reply.words else "no text"
        raise BadReply(f"the answer holds the text {value!r}, where {wanted} is expected")
    if isinstance(value, (tuple, dict)):
        for item in value.values() if isinstance(value, dict) else value:
            _require_declared(item, reply)
    elif not reply.nonfinite and not isinstance(value, (str, type(None))):
        numbers = value.data if _is_sparse(value) else value
        if isinstance(numbers, int) or np.all(np.isfinite(numbers)):
            return
        kind = "NaN" if np.any(np.isnan(numbers)) else "inf"
        raise BadReply(f"the answer holds {kind}")
