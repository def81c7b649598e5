"""UTF-16 columns, in both directions; the emoji take two units each."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol.types import Position, Range

from robocomp_dsl.editor.positions import (
    WrongPosition,
    agree,
    edit_offset,
    length_of,
    offset_at,
    position_at,
    range_of,
    span_of,
)
from robocomp_dsl.source import Source

TABLE = [
    # text, offset, line, column in UTF-16 units
    ("abc", 2, 0, 2),
    ("é\nñb", 3, 1, 1),
    ("a🤖b", 2, 0, 3),
    ("🤖🤖\n🤖x", 4, 1, 2),
    ("a\r\nb", 3, 1, 0),
    ("a\rb", 2, 1, 0),
    ("a\u2028b", 2, 0, 2),
    ("", 0, 0, 0),
    ("a\n", 2, 1, 0),
]


def source(text: str) -> Source:
    return Source(Path("x.idsl"), text)


@pytest.mark.parametrize(("text", "offset", "line", "column"), TABLE)
def test_both_ways(text: str, offset: int, line: int, column: int) -> None:
    assert position_at(source(text), offset) == Position(line, column)
    assert offset_at(source(text), Position(line, column)) == offset


@pytest.mark.parametrize(
    ("column", "offset"), [(1, 1), (2, 1), (3, 2), (99, 3)], ids=["a", "half a pair", "🤖", "end"]
)
def test_columns_that_are_no_character(column: int, offset: int) -> None:
    assert offset_at(source("a🤖b\nc"), Position(0, column)) == offset


def test_a_line_that_is_not_there() -> None:
    with pytest.raises(WrongPosition, match=r"no line 2 .* `x.idsl`, which has 2"):
        offset_at(source("a\nb"), Position(2, 0))
    assert edit_offset(source("a\nb"), Position(2, 0)) == 3


def test_spans() -> None:
    text = source("a🤖b\ncd")
    span = text.span(1, 5)
    assert range_of(span) == Range(Position(0, 1), Position(1, 1))
    assert length_of(text.span(0, 3)) == 4
    turned = Range(Position(1, 1), Position(0, 1))
    assert span_of(text, turned) == span


@given(st.text(alphabet="a🤖é\n\r", max_size=30), st.data())
def test_every_offset_comes_back(text: str, data: st.DataObject) -> None:
    made = source(text)
    offset = data.draw(st.integers(0, len(text)))
    assert offset_at(made, position_at(made, offset)) in (
        offset,
        offset - 1 if text[offset - 1 : offset + 1] == "\r\n" else offset,
    )


@pytest.mark.parametrize(
    ("encoding", "column", "length"), [("utf-8", 6, 6), ("utf-16", 3, 3), ("utf-32", 2, 2)]
)
def test_units_are_those_that_were_agreed_on(encoding: str, column: int, length: int) -> None:
    made = source("é🤖b")
    agree(encoding)
    try:
        assert position_at(made, 2) == Position(0, column)
        assert offset_at(made, Position(0, column)) == 2
        assert offset_at(made, Position(0, column - 1)) == 1
        assert length_of(made.span(0, 2)) == length
    finally:
        agree("utf-16")
