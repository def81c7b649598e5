"""`sensor_msgs::Image` as `yarp::sig::Image`, and other types of ROS in a Bottle."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.bottle.binary_reader import read_binary
from robocomp_dsl.runtime.codec.bottle.binary_writer import write_binary
from robocomp_dsl.runtime.codec.bottle.from_bottle import value_converter
from robocomp_dsl.runtime.codec.bottle.layout import Layout
from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3
from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.codec.bottle.to_bottle import item_converter
from robocomp_dsl.runtime.codec.bottle.values import vocab
from robocomp_dsl.runtime.data.errors import EncodeError
from robocomp_dsl.runtime.data.schema import schema_of
from robocomp_dsl.runtime.errors import MalformedMessage
from tests.middleware.yarp.sensor_messages import Image, image_of

to_items, from_items = item_converter(Image), value_converter(Image)
CAPTURED_HEAD = (
    "00 01 00 00 04 00 00 00 09 00 00 00 6d 61 74 00 09 00 00 00 72 67 62 00 01 01 00 00 05 00 00"
    " 00 03 00 00 00 20 00 00 00 08 00 00 00 03 00 00 00 02 00 00 00 0c 00 00 00 20 00 00 00"
)
"""Of an RGB image of 3 x 2 pixels, from YARP 3.5."""


def test_image_has_the_bytes_of_yarp() -> None:
    image = image_of("rgb8", 3, 2, step=16)
    data = write_binary(to_items(image))
    assert data == bytes.fromhex(CAPTURED_HEAD) + image.data.tobytes()
    assert from_items(read_binary(data, PROFILE_3)) == image


@pytest.mark.parametrize(
    ("image", "code", "quantum"),
    [
        (image_of("rgb8", 8, 2, step=24), "rgb", 8),
        (image_of("rgb8", 5, 2, step=15), "rgb", 1),
        (image_of("bgra8", 3, 2, step=12), "bgra", 1),
        (image_of("mono8", 5, 2, step=8), "mono", 8),
        (image_of("bayer_rggb8", 6, 2, step=16), "rggb", 16),
        (image_of("bgra8", 3, 2, step=100), "bgra", 100),
        (image_of("32FC1", 2, 1, step=8), "dec", 8),
        (image_of("mono16", 0, 0, step=0), "mo16", 8),
    ],
)
def test_image_keeps_its_rows(image: Image, code: str, quantum: int) -> None:
    items = to_items(image)
    assert items[1] == vocab(code)
    assert items[2][2] == quantum
    assert np.shares_memory(np.frombuffer(items[3], np.uint8), image.data) or not len(image.data)
    assert from_items(items) == image


def test_image_without_a_step_has_close_rows() -> None:
    image = image_of("mono8", 5, 2, step=5)
    image.step = 0
    assert from_items(to_items(image)).step == 5


def test_image_of_long_padded_rows_is_moved() -> None:
    image = image_of("mono8", 2, 2, step=40_000)
    items = to_items(image)
    assert list(items[2]) == [1, 16, 8, 2, 2]
    assert bytes(items[3]) == b"\0\1" + bytes(6) + bytes([40_000 % 251, 40_001 % 251]) + bytes(6)


def test_image_of_the_other_byte_order_is_swapped() -> None:
    image = Image(encoding="mono16", width=2, height=2, step=6, is_bigendian=1)
    image.data = np.frombuffer(b"\1\2\3\4__\5\6\7\x08__", np.uint8)
    received = from_items(to_items(image))
    pixels = received.data.reshape(2, received.step)[:, :4].tobytes()
    assert (pixels, received.is_bigendian) == (b"\2\1\4\3\6\5\x08\7", 0)


def test_image_from_bottom_to_top_is_turned() -> None:
    items = to_items(image_of("mono8", 4, 2, step=4))
    items[2][2] |= 1 << 16
    assert from_items(items).data.tolist() == [4, 5, 6, 7, 0, 1, 2, 3]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"encoding": "yuv422"}, r"encoding: YARP has no pixels of the encoding `yuv422`; it has"),
        ({"step": 7}, r"step: is 7, but 4 pixels have 8 bytes"),
        ({"data": b"x"}, r"data: 2 rows of 8 bytes have 16 bytes, not 1"),
        ({"data": "x"}, r"data: takes a "),
        ({"width": -1}, r"width: is -1"),
        ({"height": 1 << 31}, r"height: 2147483648 does not fit into an int"),
    ],
)
def test_image_that_yarp_cannot_have(changes: dict[str, Any], message: str) -> None:
    image = image_of("mono16", 4, 2, step=8)
    for name, value in changes.items():
        setattr(image, name, value)
    with pytest.raises(EncodeError, match=message):
        to_items(image)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[mat] [yuva] (1 8 8 8 1) {1 2 3 4 5 6 7 8}", "a YARP image of `yuva`; known: mono, mo16"),
        ("[mat] mono (1 8 8 8 1) {1 2 3 4 5 6 7 8}", "a YARP image of `mono`; known: mono"),
        ("[mat] (1) (1 8 8 8 1) {1 2 3 4 5 6 7 8}", "a YARP image of"),
        ("[mat] [mono] (1 8 8 8) {1 2 3 4 5 6 7 8}", "a YARP image has five numbers"),
        ("[mat] [mono] (1 8 8 x 1) {1 2 3 4 5 6 7 8}", "a YARP image has five numbers"),
        ("[mat] [mono] (1 8 8 8 1) (1 2)", "a YARP image has five numbers"),
        ("[mat] [mono] (1 8 8 9 1) {1 2 3 4 5 6 7 8}", "has 8 bytes; it should have 16"),
        ("[mat] [mono] (1 8 8 8 -1) {1 2 3 4 5 6 7 8}", "it should have -8"),
        ("[mat] [mono] (3 8 8 8 1) {1 2 3 4 5 6 7 8}", "8 x 1 pixels of 3 bytes"),
    ],
)
def test_malformed_images_are_reported(text: str, message: str) -> None:
    with pytest.raises(MalformedMessage, match=message):
        from_items(read_text(text))


def test_image_in_the_layout_of_its_fields() -> None:
    image = image_of("mono8", 4, 2, step=4)
    items = item_converter(Image, Layout.FIELDS)(image)
    assert items[3] == "mono8"
    assert from_items(items) == image


class Unsigned(rt.Struct):
    small: rt.UInt16Array = rt.default()
    middle: rt.UInt32Array = rt.default()
    large: rt.UInt64Array = rt.default()
    octets: rt.OctetArray = rt.default()
    signed: rt.Int8Array = rt.default()
    small_signed: rt.Int8 = 0
    flags: rt.BoolArray = rt.default()


def test_unsigned_arrays_are_wider_in_a_bottle() -> None:
    value = Unsigned([65535], [4294967295], [1 << 40], b"\xff", [-128], -5, [True, False])
    data = write_binary(item_converter(Unsigned)(value))
    received = value_converter(Unsigned)(read_binary(data, PROFILE_3))
    assert received == Unsigned(
        np.array([65535], np.uint16),
        np.array([4294967295], np.uint32),
        np.array([1 << 40], np.uint64),
        np.array([255], np.uint8),
        np.array([-128], np.int8),
        -5,
        np.array([True, False]),
    )


def test_uint64_has_the_bits_of_an_int64_in_a_bottle() -> None:
    items = item_converter(Unsigned)(Unsigned(large=[1 << 63, (1 << 64) - 1]))
    assert items[2].tolist() == [-(1 << 63), -1]
    received = value_converter(Unsigned)(read_binary(write_binary(items), PROFILE_3))
    assert received.large.tolist() == [1 << 63, (1 << 64) - 1]
    written = value_converter(rt.UINT64)
    assert (written(-1), written((1 << 64) - 1)) == ((1 << 64) - 1,) * 2
    with pytest.raises(MalformedMessage, match="does not fit"):
        written(1 << 64)


class Limited(rt.Struct):
    four: rt.Annotated[rt.Float64Array, rt.Length(4)] = rt.default()
    names: rt.Annotated[list[rt.String], rt.MaxLength(1)] = rt.default()


def test_lengths_are_checked_in_a_bottle() -> None:
    assert schema_of(Limited) is Limited
    with pytest.raises(EncodeError, match="four: has 1 value, it needs 4"):
        item_converter(Limited)(Limited([1.0]))
    with pytest.raises(EncodeError, match="names: has 2 values, at most 1"):
        item_converter(Limited)(Limited(names=["a", "b"]))
    with pytest.raises(MalformedMessage, match="has 1 value, it needs 4"):
        value_converter(Limited)(read_text("(1.0) ()"))
    with pytest.raises(MalformedMessage, match="has 2 values, at most 1"):
        value_converter(Limited)(read_text("(1.0 2.0 3.0 4.0) (a b)"))
