"""A decoder of Ice's messages returns a value or raises `MalformedMessage`, for any bytes."""

from __future__ import annotations

import random
import tracemalloc
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.ice import codec, wire
from robocomp_dsl.runtime.codec.ice.read import read
from tests.runtime.random_schemas import array_of, enumeration, slice_types, struct_of, values

NESTED = struct_of([rt.BYTE, rt.STRING])
COLOUR = enumeration([3, 7])
HUE = enumeration([3, 700])
POINT = struct_of([rt.FLOAT, rt.BOOL])
TINTED = struct_of([HUE, rt.BYTE])
EVERYTHING = rt.Operation(
    "go",
    inputs=[
        ("flag", rt.BOOL),
        ("colour", COLOUR),
        ("hue", HUE),
        ("text", rt.STRING),
        ("nested", NESTED),
        ("doubles", rt.Array(rt.DOUBLE)),
        ("flags", rt.Array(rt.BOOL)),
        ("list", rt.Sequence(NESTED)),
        ("points", array_of(POINT)),
        ("tinted", array_of(TINTED)),
        ("by_name", rt.Dictionary(rt.STRING, rt.Array(rt.SHORT))),
    ],
    throws=(),
)
ARGUMENTS = (
    *(True, COLOUR(7), HUE(700), "text", NESTED(1, "é"), [1.0, 2.0], [True, False]),
    *([NESTED(2, ""), NESTED(3, "x")], [POINT(0.5, True), POINT(1.5, False)]),
    *([TINTED(HUE(3), 1)], {"a": [1, 2], "": []}),
)
MUTATIONS = 120_000


class Broken(rt.DeclaredError, type_id="Test::Broken"):
    what: rt.String = ""
    codes: rt.Int32Array = rt.default()


def outcome(decode: Callable[[bytes], Any], data: bytes) -> Any:
    try:
        return decode(data)
    except rt.MalformedMessage as error:
        found = error
    except codec.UnknownException:
        return None
    assert 0 <= found.offset <= len(data)
    assert "malformed message" in str(found)
    return None


def mutated(message: bytes, source: random.Random) -> bytes:
    """The message with some bytes changed, removed or added; often with the right total size."""
    data = bytearray(message)
    for _ in range(source.randint(1, 4)):
        at = source.randrange(6, len(data) + 1) if len(data) >= 6 else 0
        kind = source.random()
        if kind < 0.5 and at < len(data):
            data[at] = source.choice((0, 1, 2, 127, 128, 254, 255, source.randrange(256)))
        elif kind < 0.65:
            data[at : at + source.randint(0, 4)] = source.randbytes(source.randint(0, 4))
        elif kind < 0.75:
            del data[at:]
        elif kind < 0.85:
            data[at : at + 1] = b"\xff" + source.choice((2**31 - 1, 2**24, 2**32 - 1)).to_bytes(
                4, "little"
            )
        elif kind < 0.9:
            data[source.randrange(6)] = source.randrange(256)
    if source.random() < 0.9:
        data[:4] = len(data).to_bytes(4, "little")
    return bytes(data)


def test_ice_decoder_survives_mutated_messages() -> None:
    source = random.Random(12)
    request = codec.request_encoder(EVERYTHING)(ARGUMENTS)
    error = codec.error_encoder((Broken,), "Test")(Broken("text", [1, 2, 3]))  # type: ignore[arg-type]
    decode = codec.request_decoder(EVERYTHING)
    decode_error = codec.error_decoder((Broken,), "Test")
    accepted = 0
    for _ in range(MUTATIONS * 3 // 4):
        accepted += outcome(decode, mutated(request, source)) is not None
    for _ in range(MUTATIONS // 4):
        outcome(decode_error, mutated(error, source))
    assert 0 < accepted < MUTATIONS / 2


@settings(max_examples=200)
@given(st.data())
def test_ice_decoder_and_read_agree_on_mutated_messages(data: st.DataObject) -> None:
    type_ = data.draw(slice_types)
    operation = rt.Operation("go", inputs=[("a", type_)])
    encode, decode = codec.request_encoder(operation), codec.request_decoder(operation)
    message = encode((data.draw(values(type_)),))
    message = mutated(message, data.draw(st.randoms(use_true_random=False)))
    fast = outcome(decode, message)
    slow = outcome(lambda m: read(operation.inputs, "tuple", (0,), m), message)
    assert (fast is None) == (slow is None)
    if fast is not None:
        assert encode(fast) == encode(slow)


CASES: list[tuple[str, Any, str, str, int, str]] = [
    ("truncated int", rt.INT, "0102", "a", 6, "4 bytes expected, 2 left"),
    ("huge text", rt.STRING, "ff ffffff7f 61", "a", 6, "2147483647 elements claimed"),
    ("negative size", rt.STRING, "ff ffffffff 61", "a", 7, "-1 is no size"),
    ("text not UTF-8", rt.STRING, "02 61ff", "a", 8, "not UTF-8"),
    ("array short by one", rt.Array(rt.INT), "02 00000000", "a", 6, "2 elements claimed"),
    ("no bool", rt.BOOL, "02", "a", 6, "2 is no bool"),
    ("no bool in an array", rt.Array(rt.BOOL), "02 0105", "a[1]", 8, "5 is no bool"),
    ("no such enumerator", COLOUR, "04", "a", 6, "4 is no value of Enum"),
    ("no such large enumerator", HUE, "ff 00000001", "a", 6, "16777216 is no value of Enum"),
    ("no bool in a row", array_of(POINT), "01 00000000 02", "a[0].f1", 11, "2 is no bool"),
    ("in a list", rt.Sequence(NESTED), "01 01 05", "a[0].f1", 8, "5 elements claimed"),
    ("value of a dictionary", rt.Dictionary(rt.BYTE, rt.BOOL), "01 0107", "a[0].value", 8, "7 is"),
    ("bytes behind", rt.BYTE, "0102", "", 7, "1 bytes more than the message has"),
]


@pytest.mark.parametrize(
    ("type_", "data", "path", "offset", "reason"),
    [case[1:] for case in CASES],
    ids=[case[0] for case in CASES],
)
def test_ice_malformed_message_names_field_offset_and_reason(
    type_: Any, data: str, path: str, offset: int, reason: str
) -> None:
    decode = codec.request_decoder(rt.Operation("go", inputs=[("a", type_)]))
    with pytest.raises(rt.MalformedMessage) as caught:
        decode(wire.encapsulation(bytes.fromhex(data)))
    assert (caught.value.path, caught.value.offset) == (path, offset)
    assert reason in caught.value.reason


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "0 bytes, shorter than the header of 6"),
        (b"\7\0\0\0\1\1", "7 bytes announced, 6 arrived"),
        (b"\7\0\0\0\1\0\1", "encoding 1.0 of Ice, only 1.1 is supported"),
    ],
)
def test_ice_decoder_rejects_bad_header(data: bytes, reason: str) -> None:
    with pytest.raises(rt.MalformedMessage, match=reason):
        codec.request_decoder(rt.Operation("go", inputs=[("a", rt.BYTE)]))(data)


@pytest.mark.parametrize(
    "type_",
    [
        rt.STRING,
        rt.Array(rt.DOUBLE),
        rt.Sequence(rt.STRING),
        rt.Sequence(struct_of([])),
        rt.Dictionary(rt.INT, rt.INT),
        array_of(struct_of([rt.FLOAT, rt.FLOAT])),
        array_of(POINT),
    ],
)
def test_ice_decoder_allocates_nothing_for_claimed_size(type_: Any) -> None:
    decode = codec.request_decoder(rt.Operation("go", inputs=[("a", type_)]))
    message = wire.encapsulation(wire.size_bytes(2**31 - 1) + bytes(64))
    outcome(decode, message)
    tracemalloc.start()
    try:
        assert outcome(decode, message) is None
        assert tracemalloc.get_traced_memory()[1] < 100_000
    finally:
        tracemalloc.stop()
