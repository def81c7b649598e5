"""Positions of the Language Server Protocol: lines from 0, columns in code units.

In: a `Source` and an offset or a protocol position. Out: the same place in the other form. Every
other module of the project uses offsets in characters. The client and the server agree on the
encoding of columns once, so each session holds one `PositionCodec`.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Sequence
from weakref import WeakKeyDictionary

from lsprotocol.types import Position, PositionEncodingKind, Range

from robocomp_dsl.source import Source, Span

_LINE_END = re.compile(r"\r\n?|\n")
_LONE_RETURN = re.compile(r"\r(?!\n)")
_ASTRAL = 0xFFFF
"""Characters above this code point take two UTF-16 code units."""

_UNIT_COUNTERS: dict[str, Callable[[str], int]] = {
    PositionEncodingKind.Utf8: lambda text: len(text.encode("utf-8", "surrogatepass")),
    PositionEncodingKind.Utf16: lambda text: len(text) + sum(ord(c) > _ASTRAL for c in text),
    PositionEncodingKind.Utf32: len,
}
"""Number of code units of a string, by encoding."""


class InvalidPosition(ValueError):
    """The client sent a line number that the document does not have."""


class PositionCodec:
    """Converts between offsets and positions in one encoding (UTF-16 if it is unknown)."""

    def __init__(self, encoding: str = PositionEncodingKind.Utf16) -> None:
        utf16 = _UNIT_COUNTERS[PositionEncodingKind.Utf16]
        self._count_units = _UNIT_COUNTERS.get(encoding, utf16)
        self._line_starts: WeakKeyDictionary[Source, Sequence[int]] = WeakKeyDictionary()

    def offset_at(self, source: Source, position: Position) -> int:
        """The offset of `position`; a column after the end of its line means that end.

        Raises `InvalidPosition` for a line that the source does not have.
        """
        starts = self._starts_of(source)
        if position.line >= len(starts):
            raise InvalidPosition(
                f"there is no line {position.line} (from 0) in `{source.path.name}`, "
                f"which has {len(starts)}"
            )
        start, end = _line_bounds(source, starts, position.line)
        return start + self._characters(source.text[start:end], position.character)

    def edit_offset(self, source: Source, position: Position) -> int:
        """As `offset_at`, but a line after the last one means the end of the source.

        An edit must always be applied.
        """
        if position.line >= len(self._starts_of(source)):
            return len(source.text)
        return self.offset_at(source, position)

    def position_at(self, source: Source, offset: int) -> Position:
        """The position of the character at `offset`."""
        starts = self._starts_of(source)
        line = bisect_right(starts, offset) - 1
        return Position(line, self._units(source.text[starts[line] : offset]))

    def range_of(self, span: Span) -> Range:
        """The range that `span` covers."""
        start = self.position_at(span.source, span.start)
        return Range(start, self.position_at(span.source, span.end))

    def span_of(self, source: Source, selection: Range) -> Span:
        """The characters in a range; its two ends may be in any order. Raises `InvalidPosition`."""
        start = self.offset_at(source, selection.start)
        end = self.offset_at(source, selection.end)
        return source.span(min(start, end), max(start, end))

    def length_of(self, span: Span) -> int:
        """The number of code units that `span` covers."""
        return self._units(span.text)

    def _starts_of(self, source: Source) -> Sequence[int]:
        """As `Source.line_starts`, but a lone carriage return ends a line, as in the protocol."""
        if "\r" not in source.text:
            return source.line_starts
        cached = self._line_starts.get(source)
        if cached is None:
            if _LONE_RETURN.search(source.text):
                cached = [0, *(match.end() for match in _LINE_END.finditer(source.text))]
            else:
                cached = source.line_starts
            self._line_starts[source] = cached
        return cached

    def _characters(self, line: str, units: int) -> int:
        """How many whole characters of `line` fit into `units` code units."""
        if line.isascii():
            return min(units, len(line))
        for number, character in enumerate(line):
            units -= self._count_units(character)
            if units < 0:
                return number
        return len(line)

    def _units(self, text: str) -> int:
        return len(text) if text.isascii() else self._count_units(text)


def _line_bounds(source: Source, starts: Sequence[int], number: int) -> tuple[int, int]:
    """Where line `number` (from 0) starts and ends, without its line end."""
    start = starts[number]
    end = starts[number + 1] if number + 1 < len(starts) else len(source.text)
    while end > start and source.text[end - 1] in "\r\n":
        end -= 1
    return start, end
