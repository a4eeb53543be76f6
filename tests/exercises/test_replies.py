"""Which values cross the pipe, and that they arrive as they were sent."""

import contextlib
import json
import math

import numpy as np
import pytest
import scipy.sparse
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from exercises.grader.replies import LONGEST_TEXT, BadReply, Reply, decode, encode, pack, unpack

ANYTHING = Reply(words=("solved", "ray"), nonfinite=True)
NUMBERS = st.one_of(st.integers(1 - 2**63, 2**63 - 1), st.floats(allow_nan=False))
LEAVES = st.one_of(st.none(), st.booleans(), NUMBERS, st.sampled_from(["solved", "ray"]))
VALUES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4).map(tuple), st.dictionaries(st.text(max_size=5), inner, max_size=4)
    ),
)
ARRAYS = st.one_of(
    *[
        arrays(kind, array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4))
        for kind in ("f8", "i8", "?")
    ]
)


@given(VALUES)
def test_values_arrive_exactly(value):
    assert decode(encode(value), ANYTHING) == value


@given(ARRAYS)
def test_arrays_arrive_bit_for_bit(array):
    back = decode(encode(array), ANYTHING)
    assert back.shape == array.shape and back.dtype == array.dtype and back.tobytes() == array.tobytes()
    assert back.flags.writeable


@given(st.floats())
def test_one_line_of_strict_json(number):
    text = encode((number, np.array([number])))
    assert "\n" not in text and "NaN" not in text and "Infinity" not in text
    assert json.loads(text)


@pytest.mark.parametrize(
    "given_value, received",
    [(np.float32(0.5), 0.5), (np.int16(3), 3), (np.bool_(True), True), ([1, [2, 3]], (1, (2, 3)))],
)
def test_relatives_arrive_as_the_plain_kind(given_value, received):
    back = decode(encode(given_value))
    assert back == received and type(back) is type(received)


def test_other_arrays_arrive_as_plain_ones():
    for array in (
        np.arange(6, dtype="f4").reshape(2, 3).T,
        np.arange(3, dtype=">i2"),
        np.ma.array([1.0, 2.0]),
    ):
        back = decode(encode(array))
        assert type(back) is np.ndarray and np.array_equal(back, array)


def test_sparse_arrays():
    dense = np.array([[0, 2.5, 0], [1, 0, -3]])
    for form in (scipy.sparse.coo_array, scipy.sparse.csr_array, scipy.sparse.csc_matrix):
        back = decode(encode(form(dense)))
        assert scipy.sparse.issparse(back) and np.array_equal(back.toarray(), dense)


@pytest.mark.parametrize(
    "value",
    [
        1j,
        {1, 2},
        {1: 2},
        object(),
        np.array(["a"]),
        np.array([None]),
        np.array([1j]),
        lambda: 0,
        b"bytes",
        (1, object()),
    ],
)
def test_other_kinds_are_refused(value):
    with pytest.raises(BadReply):
        encode(value)


@pytest.mark.parametrize(
    "value, told",
    [(math.nan, "NaN"), (math.inf, "inf"), (np.array([1, math.nan]), "NaN"), ((1, {"a": -math.inf}), "inf")],
)
def test_not_finite_only_where_declared(value, told):
    with pytest.raises(BadReply, match=told):
        decode(encode(value))
    decode(encode(value), Reply(nonfinite=True))


def test_words_only_where_declared():
    assert decode(encode("ray"), Reply(words=("ray",))) == "ray"
    with pytest.raises(BadReply, match="one of solved, ray"):
        decode(encode(("Ray",)), Reply(words=("solved", "ray")))
    with pytest.raises(BadReply, match="no text"):
        decode(encode("ray"))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[1, 2]",
        '{"x": 1}',
        "NaN",
        "Infinity",
        '{"float": "1"}',
        '{"tuple": 3}',
        '{"dict": [[1]]}',
        "9" * 5000,
        '{"array": "AAAA", "type": "f8", "shape": [1]}',
        '{"array": "", "type": "O", "shape": [0]}',
        '{"array": "", "type": "f8", "shape": [-1]}',
        '{"array": "", "type": "f8", "shape": [0, 99999999999999999999]}',
        '{"array": "", "type": "f8", "shape": [true]}',
        '{"array": 5, "type": "f8", "shape": [1]}',
        '{"sparse": [2, 2], "row": 1, "column": 1, "value": 1}',
        '{"sparse": [9999999999999, 2], "row": {"tuple": []}, "column": {"tuple": []}, "value": null}',
        "[" * 100_000,
        '{"tuple": [' * 100_000,
        '{"given": "euler", "parameters": {}}',
        '{"student": "march"}',
        "1" * (LONGEST_TEXT + 1),
    ],
)
def test_texts_that_are_no_reply_are_refused(text):
    with pytest.raises(BadReply):
        decode(text)


@settings(max_examples=300)
@given(
    st.recursive(
        st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=4)),
        lambda inner: st.one_of(
            st.lists(inner, max_size=3),
            st.dictionaries(
                st.sampled_from(
                    [
                        "float",
                        "word",
                        "tuple",
                        "dict",
                        "array",
                        "type",
                        "shape",
                        "sparse",
                        "row",
                        "column",
                        "value",
                    ]
                ),
                inner,
                max_size=4,
            ),
        ),
    )
)
def test_nothing_but_bad_reply_is_raised(data):
    with contextlib.suppress(BadReply):
        decode(json.dumps(data), ANYTHING)


def test_arrays_share_nothing():
    data = pack(np.zeros(2))
    first, second = unpack(data), unpack(data)
    first[0] = 1
    assert second[0] == 0
