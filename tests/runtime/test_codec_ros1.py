"""The wire format of ROS 1: the bytes are those of rosbags, and invalid ones are reported."""

from __future__ import annotations

import contextlib
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.decoder import decoder_function
from robocomp_dsl.runtime.codec.encoder import encoder_function
from robocomp_dsl.runtime.codec.read import read
from robocomp_dsl.runtime.codec.wire_profile import ROS1
from robocomp_dsl.runtime.errors import MalformedMessage
from tests.middleware.ros2.ros_messages import Header, LaserScan, Time
from tests.runtime.random_schemas import messages
from tests.runtime.test_codec_peer import Peer


class Nothing(rt.Struct):
    pass


class Several(rt.Struct):
    items: list[Nothing] = rt.default()


class Image(rt.Struct):
    name: rt.String = ""
    data: rt.UInt8Array = rt.default()


def encode_ros1(message: rt.Struct, *, omits_seq: bool = False) -> bytes:
    encode = encoder_function((("", type(message)),), "one", wire=ROS1, omits_seq=omits_seq)
    return bytes(encode(message))


def decode_ros1(type_: Any, data: Any) -> Any:
    return decoder_function((("", type_),), "one", ROS1)(data)


@settings(max_examples=100)
@given(messages())
def test_ros1_encoder_matches_rosbags_in_both_directions(message: rt.Struct) -> None:
    peer, type_ = Peer(type(message)), type(message)
    theirs = bytes(peer.store.serialize_ros1(peer.value(peer.name, type_, message), peer.name))
    assert encode_ros1(message) == theirs
    assert encode_ros1(decode_ros1(type_, theirs)) == theirs
    assert encode_ros1(decode_ros1(type_, memoryview(theirs))) == theirs
    assert encode_ros1(read((("", type_),), "one", theirs, ROS1)) == theirs


@settings(max_examples=100)
@given(messages(), st.data())
def test_ros1_decoder_rejects_truncated_messages(message: rt.Struct, data: st.DataObject) -> None:
    encoded = encode_ros1(message)
    if encoded:
        size = data.draw(st.integers(0, len(encoded) - 1))
        with pytest.raises(MalformedMessage):
            decode_ros1(type(message), encoded[:size])
    with pytest.raises(MalformedMessage):
        decode_ros1(type(message), encoded + b"\0")


@settings(max_examples=100)
@given(messages(), st.binary(max_size=64))
def test_ros1_decoder_of_garbage_decodes_or_raises_malformed(
    message: rt.Struct, garbage: bytes
) -> None:
    with contextlib.suppress(MalformedMessage):
        decode_ros1(type(message), garbage)


def test_ros1_header_has_a_counter_that_the_sender_may_add() -> None:
    scan = LaserScan(Header(Time(1, 2), "laser"), ranges=[1.0, 2.0])
    whole = encode_ros1(scan)
    assert whole[:12] == bytes(4) + b"\1\0\0\0\2\0\0\0"
    assert encode_ros1(scan, omits_seq=True) == whole[4:]
    assert decode_ros1(LaserScan, b"\7\0\0\0" + whole[4:]) == scan


def test_ros1_decoder_locates_the_field() -> None:
    whole = bytearray(encode_ros1(LaserScan(Header(frame_id="ab"))))
    whole[12:16] = b"\xff\xff\xff\xff"
    with pytest.raises(MalformedMessage) as raised:
        decode_ros1(LaserScan, bytes(whole))
    assert raised.value.path == "header.frame_id"


def test_ros1_sequence_of_empty_structs_does_not_hang() -> None:
    encoded = encode_ros1(Several([Nothing(), Nothing()]))
    assert encoded == b"\2\0\0\0"
    assert decode_ros1(Several, encoded).items == [Nothing(), Nothing()]
    with pytest.raises(MalformedMessage, match="4294967295 elements"):
        decode_ros1(Several, b"\xff\xff\xff\xff")


def test_ros1_decoder_returns_arrays_as_views() -> None:
    data = encode_ros1(Image("x", np.arange(256, dtype=np.uint8)))
    array = decode_ros1(Image, data).data
    assert np.shares_memory(array, np.frombuffer(data, np.uint8))
