"""Bytes and texts captured from YARP 3.5, for the readers and writers of Bottles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.codec.bottle.binary_reader import read_binary, read_stream
from robocomp_dsl.runtime.codec.bottle.binary_writer import write_binary
from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3, PROFILE_4
from robocomp_dsl.runtime.codec.bottle.text_reader import Continuation, read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import (
    FALSE,
    TRUE,
    Dict,
    Float32,
    Int8,
    Int16,
    Int64,
    Vocab64,
    identical,
    vocab,
)

CAPTURED: dict[str, str] = {
    "": "00 01 00 00 00 00 00 00",
    "5": "01 01 00 00 01 00 00 00 05 00 00 00",
    "1.5 2.5": "0a 01 00 00 02 00 00 00 00 00 00 00 00 00 f8 3f 00 00 00 00 00 00 04 40",
    "a b": "04 01 00 00 02 00 00 00 01 00 00 00 61 01 00 00 00 62",
    "[set] [pos]": "09 01 00 00 02 00 00 00 73 65 74 00 70 6f 73 00",
    "{1 2 3}": "0c 01 00 00 01 00 00 00 03 00 00 00 01 02 03",
    "()": "00 01 00 00 01 00 00 00 00 01 00 00 00 00 00 00",
    "(1 2)": "00 01 00 00 01 00 00 00 01 01 00 00 02 00 00 00 01 00 00 00 02 00 00 00",
    "3000000000": "11 01 00 00 01 00 00 00 00 5e d0 b2 00 00 00 00",
    "true false": "09 01 00 00 02 00 00 00 31 00 00 00 00 00 00 00",
    "[ok] (1 2.5)": (
        "00 01 00 00 02 00 00 00 09 00 00 00 6f 6b 00 00 00 01 00 00 02 00 00 00"
        " 01 00 00 00 01 00 00 00 0a 00 00 00 00 00 00 00 00 00 04 40"
    ),
    '1 2.5 "hello world" [set] {1 2 255} (3 4) (a 5) true': (
        "00 01 00 00 08 00 00 00 01 00 00 00 01 00 00 00 0a 00 00 00 00 00 00 00 00 00 04 40"
        " 04 00 00 00 0b 00 00 00 68 65 6c 6c 6f 20 77 6f 72 6c 64 09 00 00 00 73 65 74 00"
        " 0c 00 00 00 03 00 00 00 01 02 ff 01 01 00 00 02 00 00 00 03 00 00 00 04 00 00 00"
        " 00 01 00 00 02 00 00 00 04 00 00 00 01 00 00 00 61 01 00 00 00 05 00 00 00"
        " 09 00 00 00 31 00 00 00"
    ),
}
VALUES: list[tuple[list[Any], str]] = [
    ([Int8(-5)], "20 01 00 00 01 00 00 00 fb"),
    ([Int16(300)], "40 01 00 00 01 00 00 00 2c 01"),
    ([Float32(1.5)], "80 01 00 00 01 00 00 00 00 00 c0 3f"),
    (
        [Dict([["k", 7], ["s", "x"]])],
        "00 01 00 00 01 00 00 00 00 03 00 00 00 01 00 00 02 00 00 00"
        " 00 01 00 00 02 00 00 00 04 00 00 00 01 00 00 00 6b 01 00 00 00 07 00 00 00"
        " 04 01 00 00 02 00 00 00 01 00 00 00 73 01 00 00 00 78",
    ),
]


@pytest.mark.parametrize("text", CAPTURED)
def test_text_and_binary_are_those_of_yarp(text: str) -> None:
    data = bytes.fromhex(CAPTURED[text])
    assert write_binary(read_text(text)) == data
    assert write_text(read_binary(data, PROFILE_3)) == text


@pytest.mark.parametrize(("bottle", "data"), VALUES)
def test_write_binary_of_widths_and_dictionaries(bottle: list[Any], data: str) -> None:
    assert write_binary(bottle) == bytes.fromhex(data)
    again = read_binary(bytes.fromhex(data), PROFILE_3)
    assert write_binary(again) == bytes.fromhex(data)


def test_write_binary_of_vector_is_that_of_yarp_sig() -> None:
    data = bytes.fromhex(CAPTURED["1.5 2.5"])
    assert write_binary(np.array([1.5, 2.5])) == data
    read = read_binary(data, PROFILE_3)
    assert isinstance(read, np.ndarray)
    assert read.tolist() == [1.5, 2.5]


def test_read_binary_accepts_lists_that_are_not_specialised() -> None:
    data = bytes.fromhex("00 01 00 00 02 00 00 00 01 00 00 00 05 00 00 00 01 00 00 00 06 00 00 00")
    assert read_binary(data, PROFILE_3) == [5, 6]


def test_profiles_differ_in_tags_of_floats() -> None:
    both = [Float32(1.5), 2.5]
    assert write_binary(both, PROFILE_4)[8:12] == bytes([10, 0, 0, 0])
    assert write_binary(both, PROFILE_4)[16:20] == bytes([20, 0, 0, 0])
    assert identical(read_binary(write_binary(both, PROFILE_4), PROFILE_4), both)
    assert write_binary([Vocab64(1)], PROFILE_4)[:4] == bytes([18, 1, 0, 0])


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("3 +3 0x10", [3, 3, 16]),
        ("1,2\t3", [1, 2, 3]),
        ("0xFFFFFFFF", [Int64(4294967295)]),
        ("0x123456789", ["0x123456789"]),
        ("99999999999999999999", [Int64(2**63 - 1)]),
        ("-" + "9" * 5000, [Int64(-(2**63))]),
        ("1.5 .5 5. 1e3", [1.5, 0.5, 5.0, 1000.0]),
        ("inf -inf nan 1e400", [math.inf, -math.inf, math.nan, math.inf]),
        ("- +", [0, 0]),
        ("1.2.3", ["1.2.3"]),
        (r'"a\"b\\\n\r\q"', ['a"b\\\n\rq']),
        ("[abc] [abcdef]", [vocab("abc"), vocab("abcd")]),
        ("[]", [FALSE]),
        ("[a b]", [FALSE, "b]"]),
        ('true false "true"', [TRUE, FALSE, "true"]),
        ("null", [vocab("null")]),
        ("{1 2 255 256 -1}", [bytes([1, 2, 255, 0, 255])]),
        ('1 "open', [1]),
        ("<yarp::os::Bottle>", ["<yarp::os::Bottle>"]),
        ("(a (b)) c", [["a", ["b"]], "c"]),
        ('"a)b" (")")', ["a)b", [")"]]),
        ("/port", ["/port"]),
    ],
)
def test_read_text_as_yarp_does(text: str, values: list[Any]) -> None:
    assert identical(read_text(text), values)


def test_read_text_of_long_vocabs_in_yarp_4() -> None:
    (value,) = read_text("[abcdefghij]", 4)
    assert isinstance(value, Vocab64)
    assert value.text == "abcdefgh"


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ([3, 1000.0, 0.5], "3 1000.0 0.5"),
        (["abc", "a.b-c_1", "/port", "a/b", "x y", "5", "", "true"], None),
        (['a"b\\\n\r\0\t'], '"a\\"b\\\\\\n\\r\\0\t"'),
        ([Dict([["k", 7]])], "((k 7))"),
        ([vocab("[a]")], str(int(vocab("[a]")))),
    ],
)
def test_write_text_as_yarp_does(values: list[Any], text: str | None) -> None:
    written = write_text(values)
    assert written == (text or 'abc a.b-c_1 "/port" "a/b" "x y" "5" "" "true"')


def test_continuation_of_text_over_lines() -> None:
    open_list = Continuation()
    assert [open_list.feed(line) for line in ("(1 2", "3)")] == [True, False]
    assert Continuation().feed("1 2 \\")
    assert Continuation().feed('"open')
    assert not Continuation().feed(r'"(" [a]')


def test_read_stream_stops_at_the_end_of_the_bottle() -> None:
    data = bytes.fromhex(CAPTURED["[ok] (1 2.5)"])
    stream = iter(data + b"rest")
    bottle, size = read_stream(lambda n: bytes(next(stream) for _ in range(n)), PROFILE_3)
    assert (write_text(bottle), size) == ("[ok] (1 2.5)", len(data))
    assert bytes(stream) == b"rest"
