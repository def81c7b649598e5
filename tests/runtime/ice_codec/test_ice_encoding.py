"""The bytes of Ice's messages, and the types of decoded values."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.ice import codec, wire
from robocomp_dsl.runtime.codec.ice.read import read
from tests.runtime.random_schemas import array_of, enumeration, slice_types, struct_of, values

EMPTY = struct_of([])
POINT = struct_of([rt.FLOAT, rt.FLOAT])
ODD = struct_of([rt.BYTE, rt.DOUBLE])
SMALL = enumeration([1, 254])
LARGE = enumeration([1, 255, 70_000])
MEASURED = struct_of([SMALL, rt.SHORT])
TAGGED = struct_of([LARGE, rt.BOOL])

# type, value, bytes behind the header (written by hand from the rules of encoding 1.1)
CASES: list[tuple[str, Any, Any, str]] = [
    ("bool", rt.BOOL, True, "01"),
    ("byte", rt.BYTE, 255, "ff"),
    ("short", rt.SHORT, -2, "feff"),
    ("int", rt.INT, -2, "feffffff"),
    ("long", rt.LONG, -2, "feffffffffffffff"),
    ("float", rt.FLOAT, 1.5, "0000c03f"),
    ("double", rt.DOUBLE, 1.5, "000000000000f83f"),
    ("string", rt.STRING, "hé", "03 68c3a9"),
    ("empty string", rt.STRING, "", "00"),
    ("long string", rt.STRING, 255 * "a", "ff ff000000" + 255 * "61"),
    ("enum of one byte", SMALL, SMALL(254), "fe"),
    ("enum of several bytes", LARGE, LARGE(70_000), "ff 70110100"),
    ("small value of such an enum", LARGE, LARGE(1), "01"),
    ("empty struct", EMPTY, EMPTY(), "00"),
    ("bytes", rt.Array(rt.BYTE), b"\1\2", "02 0102"),
    ("bools", rt.Array(rt.BOOL), [True, False], "02 0100"),
    ("doubles", rt.Array(rt.DOUBLE), [1.5], "01 000000000000f83f"),
    ("strings", rt.Sequence(rt.STRING), ["a", ""], "02 0161 00"),
    ("unsigned number of ROS", rt.UINT32, 2**32 - 1, "ffffffff"),
    ("small number of ROS", rt.INT8, -2, "fe"),
    ("fixed array of ROS", rt.Array(rt.UINT16, size=2), [1, 65535], "02 0100 ffff"),
    ("fixed list of ROS", rt.Sequence(rt.STRING, size=1), ["a"], "01 0161"),
    ("bounded string of ROS", replace(rt.STRING, bound=2), "ab", "02 6162"),
    ("enums", rt.Sequence(LARGE), [LARGE(255), LARGE(1)], "02 ff ff000000 01"),
    ("dictionary", rt.Dictionary(rt.BYTE, rt.INT), {7: 1}, "01 07 01000000"),
    ("points", array_of(POINT), [POINT(0.0, 1.5)], "01 00000000 0000c03f"),
    ("no padding", array_of(ODD), [ODD(1, 0.0), ODD(2, 0.0)], "02 01" + 16 * "0" + "02" + 16 * "0"),
    ("enums in rows", array_of(MEASURED), [MEASURED(SMALL(254), 2)], "01 fe 0200"),
    ("large enums in rows", array_of(TAGGED), [TAGGED(LARGE(255), True)], "01 ff ff000000 01"),
]


def operation(*inputs: Any, outputs: Any = (), throws: Any = ()) -> rt.Operation:
    return rt.Operation("go", inputs=[(f"a{i}", t) for i, t in enumerate(inputs)], outputs=outputs)


def encoded(type_: Any, value: Any) -> bytes:
    return codec.request_encoder(operation(type_))((value,))


def decoded(type_: Any, message: bytes) -> Any:
    return codec.request_decoder(operation(type_))(message)[0]


@pytest.mark.parametrize(
    ("type_", "value", "expected"), [case[1:] for case in CASES], ids=[case[0] for case in CASES]
)
def test_ice_encoder_produces_expected_bytes(type_: Any, value: Any, expected: str) -> None:
    message = wire.encapsulation(bytes.fromhex(expected))
    assert encoded(type_, value) == message
    assert encoded(type_, decoded(type_, message)) == message
    assert int.from_bytes(message[:4], "little") == len(message)


@settings(max_examples=150)
@given(st.data())
def test_ice_decoder_returns_what_was_encoded(data: st.DataObject) -> None:
    inputs = data.draw(st.lists(slice_types, max_size=4))
    going = operation(*inputs)
    arguments = tuple(data.draw(values(type_, nan=False)) for type_ in inputs)
    message = codec.request_encoder(going)(arguments)
    result = codec.request_decoder(going)(message)
    assert codec.request_encoder(going)(result) == message
    order = tuple(range(len(inputs)))
    assert codec.request_encoder(going)(read(going.inputs, "tuple", order, message)) == message


def test_ice_decoder_returns_aligned_read_only_arrays() -> None:
    array = decoded(rt.Array(rt.DOUBLE), encoded(rt.Array(rt.DOUBLE), [1.0, 2.5]))
    assert array.dtype == np.float64
    assert array.tolist() == [1.0, 2.5]
    assert array.flags.aligned
    assert not array.flags.writeable
    rows = decoded(array_of(ODD), encoded(array_of(ODD), [ODD(1, 0.5)]))
    assert rows.column("f1").tolist() == [0.5]
    with pytest.raises(ValueError, match="read-only"):
        rows.column("f1")[0] = 1


def test_ice_encoder_accepts_strided_arrays() -> None:
    whole = np.arange(6, dtype=np.int32)
    assert decoded(rt.Array(rt.INT), encoded(rt.Array(rt.INT), whole[::2])).tolist() == [0, 2, 4]
    points = array_of(POINT)([POINT(1.0, 2.0), POINT(3.0, 4.0), POINT(5.0, 6.0)])
    assert decoded(array_of(POINT), encoded(array_of(POINT), points[::2]))[1] == POINT(5.0, 6.0)


def test_ice_reply_has_outputs_before_result() -> None:
    both = rt.Operation("go", returns=rt.BYTE, outputs={"b": rt.SHORT, "c": rt.BYTE})
    message = codec.reply_encoder(both)((1, 2, 3))
    assert message[6:].hex() == "0200" + "03" + "01"
    assert codec.reply_decoder(both)(message) == (1, 2, 3)


@pytest.mark.parametrize(
    ("reply", "value"),
    [
        (rt.Operation("go"), None),
        (rt.Operation("go", returns=rt.INT), 5),
        (rt.Operation("go", outputs={"b": rt.STRING}), "x"),
        (rt.Operation("go", outputs={"b": rt.STRING, "c": rt.INT}), ("x", 1)),
    ],
)
def test_ice_reply_has_python_form_of_result(reply: rt.Operation, value: Any) -> None:
    assert codec.reply_decoder(reply)(codec.reply_encoder(reply)(value)) == value


@pytest.mark.parametrize(
    ("type_", "value", "message"),
    [
        (rt.INT, "x", "a0: takes an integer"),
        (rt.BYTE, 256, "a0: 256 does not fit"),
        (rt.STRING, "\ud800", "a0: the character"),
        (struct_of([rt.STRING]), struct_of([rt.INT])(5), r"a0.f0: takes a text"),
        (rt.Array(rt.INT), [1.5], r"a0\[0\]: 1.5 does not fit"),
        (enumeration([-1, 2]), -1, "Ice has no negative enumerators"),
        (rt.Sequence(enumeration([-1, 2, 300])), [-1], "Ice has no negative enumerators"),
        (SMALL, 3, "a0: takes a Enum"),
    ],
)
def test_ice_encoder_names_invalid_value(type_: Any, value: Any, message: str) -> None:
    with pytest.raises(rt.EncodeError, match=message):
        encoded(type_, value)


class Broken(rt.DeclaredError, type_id="RoboCompStore::Broken"):
    code: rt.Int = 0
    what: rt.String = ""


class Gone(rt.DeclaredError):
    """Written by hand, so without a type id, and without fields."""


def test_ice_exception_is_one_slice_with_its_type_id() -> None:
    encode = codec.error_encoder((Gone, Broken), "RoboCompOther")
    decode = codec.error_decoder((Gone, Broken), "RoboCompOther")
    name = b"::RoboCompStore::Broken"
    assert encode(Broken(7, "x")) == wire.encapsulation(
        b"\x20" + bytes([len(name)]) + name + b"\7\0\0\0\1x"
    )
    for error in (Broken(7, "by zero"), Gone()):
        assert decode(encode(error)) == error
    assert b"::RoboCompOther::Gone" in encode(Gone())
    with pytest.raises(rt.EncodeError, match="Late is not declared"):
        encode(type("Late", (rt.DeclaredError,), {"__annotations__": {}})())


def test_ice_exception_of_derived_type_is_read_as_its_base() -> None:
    def slice_of(name: bytes, body: bytes, flags: int) -> bytes:
        size = (len(body) + 4).to_bytes(4, "little")
        return bytes([flags, len(name)]) + name + size + body

    derived = slice_of(b"::A::Derived", b"\5", 0x10)
    base = slice_of(b"::RoboCompStore::Broken", b"\7\0\0\0\1x", 0x30)
    decode = codec.error_decoder((Broken,), "A")
    assert decode(wire.encapsulation(derived + base)) == Broken(7, "x")
    with pytest.raises(codec.UnknownException, match="::A::Derived"):
        decode(wire.encapsulation(derived + slice_of(b"::A::Base", b"", 0x30)))
