"""Values that do not fit their type are rejected with the name of the field."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec import codec
from tests.runtime.random_schemas import array_of, enumeration, struct_of

COLOUR = enumeration([1, 2])
INNER = struct_of([rt.BYTE, COLOUR])
ROW = struct_of([rt.SHORT, struct_of([rt.FLOAT, rt.BOOL]), COLOUR])
BAD_COLUMN = array_of(ROW).from_columns(f2=[1, 9])

# type, value, field, reason
CASES: list[tuple[str, Any, Any, str, str]] = [
    ("bool", rt.BOOL, "false", "f0", "takes True or False, not 'false' (str)"),
    ("byte", rt.BYTE, 256, "f0", "256 does not fit into a byte (0 to 255)"),
    ("negative byte", rt.BYTE, -1, "f0", "-1 does not fit into a byte (0 to 255)"),
    ("short", rt.SHORT, 2**15, "f0", "32768 does not fit into a short (-32768 to 32767)"),
    ("float for int", rt.INT, 1.5, "f0", "takes an integer (int), not 1.5 (float)"),
    ("long", rt.LONG, 2**63, "f0", "does not fit into a long"),
    ("float", rt.FLOAT, 1e39, "f0", "1e+39 does not fit into a float"),
    ("text for double", rt.DOUBLE, "1", "f0", "takes a number (double), not '1' (str)"),
    ("nothing for double", rt.DOUBLE, None, "f0", "not None (NoneType)"),
    ("huge int for double", rt.DOUBLE, 10**400, "f0", "int too large to convert to float"),
    ("bytes for string", rt.STRING, b"x", "f0", "takes a text, not b'x' (bytes)"),
    ("half a character", rt.STRING, "a\ud800", "f0", "at 1 cannot be sent as UTF-8"),
    ("enum", COLOUR, 3, "f0", "(E0, E1), not 3 (int)"),
    ("field of a struct", INNER, INNER(300, 1), "f0.f0", "300 does not fit"),
    ("another class", INNER, 5, "f0", "takes a Struct"),
    ("array", rt.Array(rt.BYTE), [1, 300], "f0[1]", "300 does not fit into uint8"),
    ("array of floats", rt.Array(rt.INT), [1.0, 2.5], "f0[1]", "2.5 does not fit into int32"),
    ("NaN in ints", rt.Array(rt.LONG), [1, float("nan")], "f0[1]", "nan does not fit into int64"),
    ("unsigned", rt.Array(rt.LONG), np.array([2**63], np.uint64), "f0[0]", "does not fit"),
    ("huge", rt.Array(rt.LONG), [0, 2**70], "f0[1]", "does not fit into int64"),
    ("too large a float", rt.Array(rt.FLOAT), [1e39], "f0[0]", "1e+39 does not fit into float32"),
    ("bools", rt.Array(rt.BOOL), [0, 2], "f0[1]", "2 does not fit into bool"),
    ("texts", rt.Array(rt.INT), ["a"], "f0[0]", "takes numbers (int32)"),
    ("mixed", rt.Array(rt.INT), [1, None], "f0[1]", "not None (NoneType)"),
    ("ragged", rt.Array(rt.INT), [[1], [1, 2]], "f0", "takes a sequence of int32"),
    ("scalar", rt.Array(rt.INT), 5, "f0", "takes a one-dimensional sequence of int32, not 5 (int)"),
    ("image", rt.Array(rt.BYTE), np.zeros((2, 3), np.uint8), "f0", "shape (2, 3); .ravel() makes"),
    ("text for list", rt.Sequence(rt.STRING), "abc", "f0", "takes a list, not 'abc' (str)"),
    ("no list", rt.Sequence(rt.STRING), 5, "f0", "takes a list, not 5 (int)"),
    ("in a list", rt.Sequence(rt.STRING), ["a", 5], "f0[1]", "takes a text, not 5 (int)"),
    ("dict", rt.Dictionary(rt.INT, rt.INT), [1], "f0", "takes a dict, not [1] (list)"),
    ("key", rt.Dictionary(rt.INT, rt.INT), {"a": 1}, "f0['a']", "takes an integer (int)"),
    ("value", rt.Dictionary(rt.INT, rt.INT), {4: "x"}, "f0[4]", "takes an integer (int)"),
    ("row", array_of(ROW), [ROW(1, None, 1)], "f0[0].f1.f0", "takes a Struct"),
    ("number in a row", array_of(INNER), [INNER(1, 1), INNER(300, 1)], "f0[1].f0", "300 does not"),
    ("enum in a row", array_of(INNER), [INNER(1, 5)], "f0[0].f1", "not 5 (int)"),
    ("enum in a column", array_of(ROW), BAD_COLUMN, "f0[1]", "has no such value"),
    ("no rows", array_of(ROW), 5, "f0", "takes a sequence of Struct"),
    ("other rows", array_of(ROW), np.zeros(1, [("a", "<i4")]), "f0", "takes the fields"),
]


@pytest.mark.parametrize(
    ("type_", "value", "path", "reason"),
    [case[1:] for case in CASES],
    ids=[case[0] for case in CASES],
)
def test_encode_rejects_invalid_value(type_: Any, value: Any, path: str, reason: str) -> None:
    with pytest.raises(rt.EncodeError) as caught:
        codec.encode(struct_of([type_])(value))
    assert caught.value.path == path
    assert reason in caught.value.reason
    assert isinstance(caught.value, ValueError)


# type, value, decoded value
ACCEPTED: list[tuple[str, Any, Any, Any]] = [
    ("numpy bool", rt.BOOL, np.True_, True),
    ("one", rt.BOOL, 1, True),
    ("numpy int", rt.SHORT, np.int64(5), 5),
    ("int for double", rt.DOUBLE, 5, 5.0),
    ("infinity", rt.FLOAT, float("inf"), float("inf")),
    ("int for enum", COLOUR, 2, COLOUR(2)),
    ("whole floats", rt.Array(rt.INT), np.zeros(2), [0, 0]),
    ("wider ints", rt.Array(rt.BYTE), np.array([1, 255], np.int64), [1, 255]),
    ("other byte order", rt.Array(rt.FLOAT), np.array([1.5], ">f8"), [1.5]),
    ("infinities", rt.Array(rt.FLOAT), [float("inf")], [float("inf")]),
    ("bools as bytes", rt.Array(rt.BYTE), [True, False], [1, 0]),
    ("bytearray", rt.Array(rt.BYTE), bytearray(b"\1\2"), [1, 2]),
    ("memoryview", rt.Array(rt.BYTE), memoryview(b"\1\2"), [1, 2]),
    ("range", rt.Array(rt.LONG), range(3), [0, 1, 2]),
    ("empty list", rt.Array(rt.BOOL), [], []),
    ("tuple", rt.Sequence(rt.STRING), ("a", "b"), ["a", "b"]),
    ("generator", rt.Sequence(rt.STRING), (c for c in "ab"), ["a", "b"]),
]


@pytest.mark.parametrize(
    ("type_", "value", "expected"),
    [case[1:] for case in ACCEPTED],
    ids=[case[0] for case in ACCEPTED],
)
def test_encode_accepts_compatible_value(type_: Any, value: Any, expected: Any) -> None:
    message = struct_of([type_])
    arrived = codec.decode(message, codec.encode(message(value))).f0
    assert arrived.tolist() == expected if isinstance(arrived, np.ndarray) else arrived == expected
    assert isinstance(arrived, np.ndarray) or type(arrived) is type(expected)


RESULTS: list[tuple[Any, Any, str, str]] = [
    ((), 5, "", "there is no result, so None and not 5 (int)"),
    ((("", rt.INT),), None, "", "takes an integer (int), not None"),
    ((("", rt.INT), ("x", rt.INT)), 5, "", "takes a tuple of (result, x), not 5 (int)"),
    ((("", rt.INT), ("x", rt.INT)), (1, 2, 3), "", "takes 2 values (result, x), not 3"),
    ((("", rt.INT), ("x", rt.INT)), ("a", 1), "result", "takes an integer (int)"),
    ((("", rt.INT), ("x", rt.INT)), (1, "a"), "x", "takes an integer (int)"),
]


@pytest.mark.parametrize(("outputs", "result", "path", "reason"), RESULTS)
def test_encode_reply_rejects_invalid_result(
    outputs: Any, result: Any, path: str, reason: str
) -> None:
    with pytest.raises(rt.EncodeError) as caught:
        rt.Operation("f", rt.Pattern.QUERY, outputs=outputs).encode_reply(result)
    assert caught.value.path == path
    assert reason in caught.value.reason
