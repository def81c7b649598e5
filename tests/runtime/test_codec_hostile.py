"""A decoder returns a value or raises `MalformedMessage`, for any bytes."""

from __future__ import annotations

import tracemalloc
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec import codec
from robocomp_dsl.runtime.codec.read import read
from tests.runtime.random_schemas import array_of, enumeration, messages, struct_of

HEADER = b"\0\1\0\0"
relaxed = settings(max_examples=200)

NESTED = struct_of([rt.BYTE, rt.STRING])
COLOUR = enumeration([3, 7])
POINT = struct_of([rt.FLOAT, rt.BOOL])
EVERYTHING = struct_of(
    [
        rt.BOOL,
        COLOUR,
        rt.STRING,
        NESTED,
        rt.Array(rt.DOUBLE),
        rt.Array(rt.BOOL),
        rt.Sequence(NESTED),
        array_of(POINT),
        rt.Dictionary(rt.STRING, rt.Array(rt.SHORT)),
    ]
)


def outcome(type_: type[Any], data: bytes | memoryview) -> Any:
    try:
        return codec.decode(type_, data)
    except rt.MalformedMessage as error:
        found = error
    assert 0 <= found.offset <= len(data)
    assert "malformed message" in str(found)
    return None


@relaxed
@given(st.binary(max_size=200))
def test_decode_survives_random_bytes(data: bytes) -> None:
    for kind in (b"", HEADER, b"\0\0\0\0", b"\0\1\0\3"):
        outcome(EVERYTHING, kind + data)


@st.composite
def damaged(draw: st.DrawFn) -> tuple[Any, bytes]:
    """A random message, some bytes of it changed, added or cut off."""
    message = draw(messages())
    data = bytearray(codec.encode(message))
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(data) - 1)) if data else 0
        match draw(st.sampled_from(("set", "bit", "cut", "grow", "count"))):
            case "set":
                data[at : at + 1] = bytes([draw(st.integers(0, 255))])
            case "bit" if data:
                data[at] ^= 1 << draw(st.integers(0, 7))
            case "cut":
                del data[at:]
            case "grow":
                data += draw(st.binary(min_size=1, max_size=9))
            case "count":
                data[at : at + 4] = draw(st.sampled_from((2**32 - 1, 2**31, 2**16))).to_bytes(
                    4, "little"
                )
    return message, bytes(data)


@relaxed
@given(damaged())
def test_decode_and_read_agree_on_damaged_messages(case: tuple[Any, bytes]) -> None:
    message, data = case
    type_ = type(message)
    fast = outcome(type_, data)
    assert (fast is None) == (outcome(type_, memoryview(data)) is None)
    try:
        slow = read((("", type_),), "one", data)
    except rt.MalformedMessage:
        slow = None
    assert (fast is None) == (slow is None)
    if fast is not None:
        assert codec.encode(fast) == codec.encode(slow)


@relaxed
@given(messages(), st.data())
def test_decode_rejects_truncated_message(message: Any, data: st.DataObject) -> None:
    whole = codec.encode(message)
    cut = data.draw(st.integers(0, len(whole) - 1))
    with pytest.raises(rt.MalformedMessage):
        codec.decode(type(message), whole[:cut])


COUNT = b"\xff\xff\xff\xff"
ONE = b"\1\0\0\0"
LITTLE = bytes.fromhex

# type, bytes after the header, field, offset, reason
CASES: list[tuple[str, Any, bytes, str, int, str]] = [
    ("truncated int", rt.INT, b"\1\2", "f0", 4, "4 bytes expected, 2 left"),
    ("truncated double", rt.DOUBLE, b"", "f0", 4, "8 bytes expected, 0 left"),
    ("huge text", rt.STRING, COUNT + b"abc", "f0", 8, "4294967295 bytes expected, 3 left"),
    ("text without NUL", rt.STRING, b"\2\0\0\0ab", "f0", 9, "does not end with NUL"),
    ("text not UTF-8", rt.STRING, b"\3\0\0\0a\xff\0", "f0", 9, "not UTF-8"),
    ("huge array", rt.Array(rt.DOUBLE), COUNT + bytes(16), "f0", 4, "4294967295 elements claimed"),
    ("array short by one", rt.Array(rt.INT), b"\2\0\0\0" + bytes(4), "f0", 4, "4 bytes left"),
    ("huge list", rt.Sequence(rt.STRING), COUNT + bytes(9), "f0", 4, "9 bytes left"),
    ("huge list of empty structs", rt.Sequence(struct_of([])), COUNT, "f0", 4, "0 bytes left"),
    ("huge struct array", array_of(POINT), COUNT + bytes(9), "f0", 4, "9 bytes left"),
    ("huge dictionary", rt.Dictionary(rt.INT, rt.INT), COUNT, "f0", 4, "0 bytes left"),
    ("no bool", rt.BOOL, b"\2", "f0", 4, "2 is no bool"),
    ("no bool in an array", rt.Array(rt.BOOL), b"\2\0\0\0\1\5", "f0[1]", 9, "5 is no bool"),
    ("no such enumerator", COLOUR, b"\4\0\0\0", "f0", 4, "4 is no value of Enum"),
    ("no bool in a row", array_of(POINT), ONE + bytes(4) + b"\2", "f0[0].f1", 12, "2 is no bool"),
    (
        "no such enumerator in a row",
        array_of(struct_of([rt.BYTE, COLOUR])),
        b"\2\0\0\0" + LITTLE("00000000 03000000 00000000 08000000"),
        "f0[1].f1",
        20,
        "8 is no value of Enum",
    ),
    ("in a list", rt.Sequence(NESTED), ONE + b"\1\0\0\0" + COUNT, "f0[0].f1", 16, "bytes expected"),
    (
        "value of a dictionary",
        rt.Dictionary(rt.INT, rt.BOOL),
        ONE + ONE + b"\7",
        "f0[0].value",
        12,
        "7 is no bool",
    ),
    ("bytes behind", rt.INT, bytes(5), "", 8, "1 bytes more than the message has"),
]


@pytest.mark.parametrize(
    ("type_", "data", "path", "offset", "reason"),
    [case[1:] for case in CASES],
    ids=[case[0] for case in CASES],
)
def test_malformed_message_names_field_offset_and_reason(
    type_: Any, data: bytes, path: str, offset: int, reason: str
) -> None:
    with pytest.raises(rt.MalformedMessage) as caught:
        codec.decode(struct_of([type_]), HEADER + data)
    assert (caught.value.path, caught.value.offset) == (path, offset)
    assert reason in caught.value.reason


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "0 bytes, shorter than the header of 4"),
        (b"\0\1\0", "3 bytes, shorter than the header of 4"),
        (b"\0\7\0\0" + bytes(4), "encoding 0007 is not CDR"),
        (b"\0\2\0\0" + bytes(4), "encoding 0002 is not CDR"),
        (b"\0\1\0\3", "3 bytes of padding announced"),
    ],
)
def test_decode_rejects_bad_header(data: bytes, reason: str) -> None:
    with pytest.raises(rt.MalformedMessage, match=reason):
        codec.decode(struct_of([rt.INT]), data)


def test_decode_skips_padding_announced_in_header() -> None:
    text = struct_of([rt.STRING])
    assert codec.decode(text, b"\0\1\0\2\2\0\0\0a\0\xaa\xbb") == text("a")


def test_decode_reads_zero_length_string_as_empty() -> None:
    pair = struct_of([rt.STRING, rt.BYTE])
    assert codec.decode(pair, HEADER + b"\0\0\0\0\5") == pair("", 5)


@pytest.mark.parametrize(
    "type_",
    [
        rt.STRING,
        rt.Array(rt.DOUBLE),
        rt.Sequence(rt.STRING),
        rt.Sequence(struct_of([])),
        array_of(struct_of([rt.FLOAT, rt.FLOAT])),
        array_of(POINT),
        array_of(struct_of([rt.BYTE, rt.DOUBLE])),
    ],
)
@pytest.mark.parametrize("count", [2**32 - 1, 2**31, 2**24])
def test_decode_allocates_nothing_for_claimed_length(type_: Any, count: int) -> None:
    message, cls = HEADER + count.to_bytes(4, "little") + bytes(64), struct_of([type_])
    outcome(cls, message)  # compiles
    tracemalloc.start()
    try:
        assert outcome(cls, message) is None
        assert tracemalloc.get_traced_memory()[1] < 100_000
    finally:
        tracemalloc.stop()
