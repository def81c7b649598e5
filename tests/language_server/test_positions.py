"""`PositionCodec`: columns in code units, in both directions; an emoji takes two UTF-16 units."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol.types import Position, Range

from robocomp_dsl.language_server.positions import InvalidPosition, PositionCodec
from robocomp_dsl.source import Source

CODEC = PositionCodec()
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


def source_of(text: str) -> Source:
    return Source(Path("x.idsl"), text)


@pytest.mark.parametrize(("text", "offset", "line", "column"), TABLE)
def test_position_codec_converts_both_ways(text: str, offset: int, line: int, column: int) -> None:
    assert CODEC.position_at(source_of(text), offset) == Position(line, column)
    assert CODEC.offset_at(source_of(text), Position(line, column)) == offset


@pytest.mark.parametrize(
    ("column", "offset"), [(1, 1), (2, 1), (3, 2), (99, 3)], ids=["a", "half a pair", "🤖", "end"]
)
def test_offset_at_column_inside_character_or_after_line(column: int, offset: int) -> None:
    assert CODEC.offset_at(source_of("a🤖b\nc"), Position(0, column)) == offset


def test_offset_at_missing_line_raises_invalid_position() -> None:
    with pytest.raises(InvalidPosition, match=r"no line 2 .* `x.idsl`, which has 2"):
        CODEC.offset_at(source_of("a\nb"), Position(2, 0))
    assert CODEC.edit_offset(source_of("a\nb"), Position(2, 0)) == 3


def test_position_codec_converts_spans_and_reversed_ranges() -> None:
    source = source_of("a🤖b\ncd")
    span = source.span(1, 5)
    assert CODEC.range_of(span) == Range(Position(0, 1), Position(1, 1))
    assert CODEC.length_of(source.span(0, 3)) == 4
    reversed_range = Range(Position(1, 1), Position(0, 1))
    assert CODEC.span_of(source, reversed_range) == span


@given(st.text(alphabet="a🤖é\n\r", max_size=30), st.data())
def test_position_codec_round_trip_of_every_offset(text: str, data: st.DataObject) -> None:
    source = source_of(text)
    offset = data.draw(st.integers(0, len(text)))
    assert CODEC.offset_at(source, CODEC.position_at(source, offset)) in (
        offset,
        offset - 1 if text[offset - 1 : offset + 1] == "\r\n" else offset,
    )


@pytest.mark.parametrize(
    ("encoding", "column", "length"),
    [("utf-8", 6, 6), ("utf-16", 3, 3), ("utf-32", 2, 2), ("utf-7", 3, 3)],
)
def test_position_codec_counts_units_of_its_encoding(
    encoding: str, column: int, length: int
) -> None:
    source, codec = source_of("é🤖b"), PositionCodec(encoding)
    assert codec.position_at(source, 2) == Position(0, column)
    assert codec.offset_at(source, Position(0, column)) == 2
    assert codec.offset_at(source, Position(0, column - 1)) == 1
    assert codec.length_of(source.span(0, 2)) == length
