"""Round trips of any Bottle, and invalid bytes: only `MalformedMessage`, and bounded memory."""

from __future__ import annotations

import tracemalloc
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from robocomp_dsl.runtime.codec.bottle.binary_reader import read_binary
from robocomp_dsl.runtime.codec.bottle.binary_writer import write_binary
from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3, PROFILE_4, Profile
from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import (
    MAX_DEPTH,
    Dict,
    Float32,
    Int8,
    Int16,
    Int64,
    Vocab,
    Vocab64,
    identical,
)
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage


def _integers(bits: int) -> st.SearchStrategy[int]:
    return st.integers(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


_scalars = st.one_of(
    _integers(32),
    _integers(8).map(Int8),
    _integers(16).map(Int16),
    _integers(64).map(Int64),
    _integers(32).map(Vocab),
    st.floats(width=32).map(Float32),
    st.floats(),
    st.text(max_size=8),
    st.binary(max_size=8),
)
_bottles: st.SearchStrategy[list[Any]] = st.lists(
    st.recursive(
        _scalars,
        lambda inner: st.one_of(st.lists(inner, max_size=4), st.lists(inner, max_size=3).map(Dict)),
        max_leaves=12,
    ),
    max_size=5,
)
_plain = st.lists(
    st.recursive(
        st.one_of(
            _integers(32),
            st.floats(),
            st.text(st.characters(exclude_categories=["Cs"]), max_size=8),
            st.binary(max_size=8),
            st.sampled_from([Vocab(0), Vocab(0x31), Vocab(0x6B6F)]),
        ),
        lambda inner: st.lists(inner, max_size=4),
        max_leaves=12,
    ),
    max_size=5,
)


def _listed(value: Any) -> Any:
    """Arrays as lists with the types of their items."""
    if isinstance(value, np.ndarray):
        types: dict[str, Any] = {"i1": Int8, "i2": Int16, "i8": Int64, "f4": Float32}
        kind = types.get(value.dtype.str[1:], lambda item: item)
        return [kind(item) for item in value.tolist()]
    if isinstance(value, list):
        return type(value)(map(_listed, value))
    return value


@pytest.mark.parametrize("profile", [PROFILE_3, PROFILE_4], ids=["3", "4"])
@given(bottle=_bottles)
def test_binary_round_trip(profile: Profile, bottle: list[Any]) -> None:
    data = write_binary(bottle, profile)
    again = read_binary(data, profile)
    assert identical(_listed(again), bottle)
    assert write_binary(again, profile) == data


@given(_plain)
def test_text_round_trip(bottle: list[Any]) -> None:
    assert identical(read_text(write_text(bottle)), bottle)


@given(st.text(st.sampled_from('ab1.-+e"\\()[]{}, \n0x'), max_size=40))
@example("(" * 10_000)
@example('"\\')
def test_read_text_of_any_text_ends(text: str) -> None:
    bottle = read_text(text)
    write_binary(bottle)
    assert isinstance(write_text(bottle), str)


@given(st.binary(max_size=64), st.booleans())
def test_read_binary_of_any_bytes_is_malformed_or_a_bottle(data: bytes, starts: bool) -> None:
    data = (b"\x00\x01\x00\x00" if starts else b"") + data
    try:
        bottle = read_binary(data, PROFILE_3)
    except MalformedMessage:
        return
    assert identical(_listed(read_binary(write_binary(bottle), PROFILE_3)), _listed(bottle))


@given(_bottles, st.data())
def test_read_binary_of_changed_bytes_is_malformed_or_a_bottle(
    bottle: list[Any], data: st.DataObject
) -> None:
    message = bytearray(write_binary(bottle))
    at = data.draw(st.integers(0, len(message) - 1))
    message[at] = data.draw(st.integers(0, 255))
    del message[data.draw(st.integers(0, len(message))) :]
    try:
        read_binary(bytes(message), PROFILE_3)
    except MalformedMessage:
        return


@pytest.mark.parametrize("tag", [256, 257, 260, 266, 268, 288, 768])
def test_read_binary_trusts_no_count(tag: int) -> None:
    data = tag.to_bytes(4, "little") + (2**31 - 1).to_bytes(4, "little") + b"\x04\0\0\0" * 100
    tracemalloc.start()
    try:
        with pytest.raises(MalformedMessage):
            read_binary(data, PROFILE_3)
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
    finally:
        tracemalloc.stop()


def test_read_binary_refuses_deep_nesting() -> None:
    one_inside = b"\x00\x01\x00\x00\x01\x00\x00\x00"
    deepest = one_inside * (MAX_DEPTH - 1) + b"\x00\x01\x00\x00\x00\x00\x00\x00"
    assert len(read_binary(deepest, PROFILE_3)) == 1
    with pytest.raises(MalformedMessage, match="nested more than 64 deep"):
        read_binary(one_inside * 100_000, PROFILE_3)
    with pytest.raises(MalformedMessage, match="nested more than 64 deep"):
        read_text("(" * 100 + ")" * 100)


def test_write_binary_refuses_what_no_bottle_contains() -> None:
    nested: list[Any] = []
    nested.append(nested)
    for bottle in (nested, [object()], [2**70], [Int8(300)], [np.zeros((2, 2))]):
        with pytest.raises(EncodeError):
            write_binary(bottle)
    with pytest.raises(EncodeError, match="YARP 3 has no Vocab64"):
        write_binary([Vocab64(1)])
