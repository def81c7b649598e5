"""The bytes of messages, and the types of decoded values."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec import codec
from robocomp_dsl.runtime.codec.explain import explain
from robocomp_dsl.runtime.codec.read import read
from tests.runtime.random_schemas import array_of, enumeration, messages, struct_of

EMPTY = struct_of([])
POINT = struct_of([rt.FLOAT, rt.FLOAT])
ODD = struct_of([rt.BYTE, rt.DOUBLE])
TAIL = struct_of([rt.DOUBLE, rt.BYTE])
SHIFTED = struct_of([rt.SHORT, rt.INT, rt.SHORT])
NESTED = struct_of([rt.BYTE, ODD, rt.SHORT])
COLOUR = enumeration([1, -2])

# type, value, bytes behind the header (written by hand from the rules of CDR)
CASES: list[tuple[str, Any, Any, str]] = [
    ("bool", rt.BOOL, True, "01"),
    ("byte", rt.BYTE, 255, "ff"),
    ("short", rt.SHORT, -2, "feff"),
    ("int", rt.INT, -2, "feffffff"),
    ("long", rt.LONG, -2, "feffffffffffffff"),
    ("float", rt.FLOAT, 1.5, "0000c03f"),
    ("double", rt.DOUBLE, 1.5, "000000000000f83f"),
    ("string", rt.STRING, "hé", "04000000 68c3a900"),
    ("empty string", rt.STRING, "", "01000000 00"),
    ("enum", COLOUR, COLOUR(-2), "feffffff"),
    ("empty struct", EMPTY, EMPTY(), "00"),
    ("bytes", rt.Array(rt.BYTE), b"\1\2", "02000000 0102"),
    ("bools", rt.Array(rt.BOOL), [True, False], "02000000 0100"),
    ("doubles", rt.Array(rt.DOUBLE), [1.5], "01000000 00000000 000000000000f83f"),
    ("no doubles, no padding", rt.Array(rt.DOUBLE), [], "00000000"),
    ("strings", rt.Sequence(rt.STRING), ["a", ""], "02000000 02000000 6100 0000 01000000 00"),
    ("enums", rt.Sequence(COLOUR), [COLOUR(1)], "01000000 01000000"),
    ("dictionary", rt.Dictionary(rt.BYTE, rt.INT), {7: 1}, "01000000 07 000000 01000000"),
    ("points", array_of(POINT), [POINT(0.0, 1.5)], "01000000 00000000 0000c03f"),
    (
        "first element with other padding than the second",
        array_of(ODD),
        [ODD(1, 0.0), ODD(2, 0.0)],
        "02000000 01 000000" + 8 * "00" + "02" + 7 * "00" + 8 * "00",
    ),
    (
        "no padding behind the last",
        array_of(TAIL),
        [TAIL(0.0, 1), TAIL(0.0, 2)],
        "02000000 00000000" + 8 * "00" + "01" + 7 * "00" + 8 * "00" + "02",
    ),
    (
        "elements at unaligned offsets",
        array_of(SHIFTED),
        [SHIFTED(1, 2, 3), SHIFTED(4, 5, 6), SHIFTED(7, 8, 9)],
        "03000000 0100 0000 02000000 0300 0400 05000000 0600 0700 08000000 0900",
    ),
    (
        "nested structs have no alignment",
        array_of(NESTED),
        [NESTED(1, ODD(2, 0.0), 3)],
        "01000000 01 02 0000" + 8 * "00" + "0300",
    ),
]


@pytest.mark.parametrize(
    ("type_", "value", "expected"), [case[1:] for case in CASES], ids=[case[0] for case in CASES]
)
def test_encode_produces_expected_bytes(type_: Any, value: Any, expected: str) -> None:
    data = b"\0\1\0\0" + bytes.fromhex(expected)
    message = struct_of([type_])
    assert codec.encode(message(value)) == data
    decoded = codec.decode(message, data).f0
    if isinstance(value, bytes):
        value = list(value)
    assert list(decoded) == list(value) if isinstance(value, list) else decoded == value


relaxed = settings(max_examples=200)


@relaxed
@given(messages(nan=False))
def test_decode_inverts_encode(message: Any) -> None:
    data, type_ = codec.encode(message), type(message)
    assert codec.decode(type_, data) == message
    assert codec.decode(type_, bytearray(data)) == message
    assert codec.decode(type_, memoryview(data)) == message
    assert read((("", type_),), "one", data) == message


@relaxed
@given(messages(nan=False))
def test_explain_reports_unknown_error_for_valid_message(message: Any) -> None:
    error = explain((("", type(message)),), "one", message, OSError("unknown"))
    assert str(error) == "cannot be encoded: unknown"


# outputs, what a method returns, bytes behind the header
REPLIES: list[tuple[Any, Any, str]] = [
    ((), None, "00"),
    ((("", rt.INT),), 5, "05000000"),
    ((("x", rt.INT),), 5, "05000000"),
    ((("", rt.INT), ("x", rt.BYTE)), (5, 6), "05000000 06"),
]


@pytest.mark.parametrize(("outputs", "result", "expected"), REPLIES)
def test_encode_reply_produces_expected_bytes(outputs: Any, result: Any, expected: str) -> None:
    operation = rt.Operation("f", rt.Pattern.QUERY, outputs=outputs)
    data = operation.encode_reply(result)
    assert data[4:] == bytes.fromhex(expected)
    assert operation.decode_reply(data) == result


# inputs, arguments, bytes behind the header
REQUESTS: list[tuple[Any, Any, str]] = [
    ((), (), "00"),
    ((("a", rt.BYTE),), (5,), "05"),
    ((("a", rt.BYTE), ("b", rt.STRING), ("c", rt.BOOL)), (5, "", True), "05000000 01000000 00 01"),
]


@pytest.mark.parametrize(("inputs", "arguments", "expected"), REQUESTS)
def test_encode_request_produces_expected_bytes(inputs: Any, arguments: Any, expected: str) -> None:
    operation = rt.Operation("f", rt.Pattern.QUERY, inputs=inputs)
    data = operation.encode_request(arguments)
    assert data[4:] == bytes.fromhex(expected)
    assert operation.decode_request(data) == arguments


def test_declared_exceptions_survive_encode_and_decode() -> None:
    broken, late = struct_of([rt.STRING], rt.DeclaredError), struct_of([], rt.DeclaredError)
    operation = rt.Operation("f", rt.Pattern.QUERY, throws=(broken, late))
    for error in (broken("motor 3"), late()):
        assert operation.decode_error(operation.encode_error(error)) == error
    with pytest.raises(rt.EncodeError, match="not declared"):
        operation.encode_error(struct_of([], rt.DeclaredError)())
    with pytest.raises(rt.MalformedMessage, match="2 is no index of the exception"):
        operation.decode_error(b"\0\1\0\0\2\0\0\0")
    with pytest.raises(rt.MalformedMessage):
        operation.decode_error(b"")


@pytest.mark.parametrize("kind", [bytes, bytearray, memoryview])
def test_decoded_arrays_are_read_only_views(kind: Any) -> None:
    message = struct_of([rt.Array(rt.INT), array_of(POINT), array_of(ODD)])
    points, odd = [POINT(1.0, 2.0)], [ODD(1, 2.0)]
    decoded = codec.decode(message, kind(codec.encode(message([1, 2], points, odd))))
    assert decoded.f0.base is not None
    for array in (decoded.f0, decoded.f1.column("f0"), decoded.f2.column("f1")):
        assert not array.flags.writeable
    with pytest.raises(ValueError, match="copy"):
        decoded.f1[0].f0 = 5.0
    mine = decoded.f1.copy()
    mine[0].f0 = 5.0
    assert mine == [POINT(5.0, 2.0)]
    assert decoded.f1 == points


def test_encode_clears_padding_of_array_memory() -> None:
    rows = array_of(TAIL)([TAIL(1.0, 2), TAIL(3.0, 4)])
    expected = codec.encode(struct_of([array_of(TAIL)])(rows))
    dirty = np.asarray(rows).copy()
    raw = dirty.view(np.uint8).reshape(2, -1)
    raw[:, 9:] = 0xAA
    assert codec.encode(struct_of([array_of(TAIL)])(dirty)) == expected


def test_encode_accepts_strided_and_foreign_byte_order_arrays() -> None:
    message = struct_of([rt.Array(rt.INT), array_of(POINT)])
    points = array_of(POINT).from_columns(f0=np.arange(6), f1=0)
    message_in = message(np.arange(6, dtype=">i8")[::2], points[::2])
    decoded = codec.decode(message, codec.encode(message_in))
    assert decoded.f0.tolist() == [0, 2, 4]
    assert decoded.f1.column("f0").tolist() == [0, 2, 4]


def test_codec_limits_sequence_nesting_to_fifteen() -> None:
    type_: Any = rt.STRING
    value: Any = "x"
    for _ in range(15):
        type_, value = rt.Sequence(type_), [value]
    message = struct_of([type_])
    assert codec.decode(message, codec.encode(message(value))) == message(value)
    with pytest.raises(TypeError, match="more than 15 sequences"):
        codec.encode(struct_of([rt.Sequence(type_)])([value]))


def test_encode_packs_thousand_fields_without_gaps() -> None:
    message = struct_of([rt.SHORT] * 1000)
    assert codec.encode(message(*range(1000)))[4:] == struct.pack("<1000h", *range(1000))
