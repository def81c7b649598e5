"""Places in texts as the protocol counts them: lines from 0, columns in code units.

In: a `Source` and a place of one kind. Out: the same place of the other kind. Nothing else in the
project knows of code units; everywhere else a place is an offset in characters. A process serves
one client, so what is agreed with it on the size of the units holds for all places.
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
"""Characters above this take two UTF-16 code units."""

_SIZES: dict[str, Callable[[str], int]] = {
    PositionEncodingKind.Utf8: lambda text: len(text.encode("utf-8", "surrogatepass")),
    PositionEncodingKind.Utf16: lambda text: len(text) + sum(ord(one) > _ASTRAL for one in text),
    PositionEncodingKind.Utf32: len,
}
"""How many units a text takes, by what was agreed on."""

_agreed: list[Callable[[str], int]] = [_SIZES[PositionEncodingKind.Utf16]]
_starts: WeakKeyDictionary[Source, Sequence[int]] = WeakKeyDictionary()


class WrongPosition(ValueError):
    """A client asked about a line that the text does not have."""


def agree(encoding: str) -> None:
    """Count columns in units of `encoding` from now on; of an unknown one in UTF-16."""
    _agreed[:] = [_SIZES.get(encoding, _SIZES[PositionEncodingKind.Utf16])]


def offset_at(source: Source, position: Position) -> int:
    """The offset of `position`; a column behind the end of its line means that end.

    Raises `WrongPosition` for a line that is not there.
    """
    starts = _line_starts(source)
    if position.line >= len(starts):
        raise WrongPosition(
            f"there is no line {position.line} (from 0) in `{source.path.name}`, "
            f"which has {len(starts)}"
        )
    start, end = _line(source, position.line)
    return start + _characters(source.text[start:end], position.character)


def edit_offset(source: Source, position: Position) -> int:
    """As `offset_at` for an edit, which must always be applied: behind the text is its end."""
    if position.line >= len(_line_starts(source)):
        return len(source.text)
    return offset_at(source, position)


def position_at(source: Source, offset: int) -> Position:
    """The position of the character at `offset`."""
    starts = _line_starts(source)
    line = bisect_right(starts, offset) - 1
    before = source.text[starts[line] : offset]
    return Position(line, _units(before))


def range_of(span: Span) -> Range:
    """The range that `span` covers."""
    return Range(position_at(span.source, span.start), position_at(span.source, span.end))


def span_of(source: Source, place: Range) -> Span:
    """The characters in a range, whichever end of it comes first. Raises `WrongPosition`."""
    start, end = offset_at(source, place.start), offset_at(source, place.end)
    return source.span(min(start, end), max(start, end))


def length_of(span: Span) -> int:
    """How many code units `span` covers."""
    return _units(span.text)


def _line_starts(source: Source) -> Sequence[int]:
    """As `Source.line_starts`; but to the protocol a lone carriage return ends a line, too."""
    if "\r" not in source.text:
        return source.line_starts
    kept = _starts.get(source)
    if kept is None:
        if _LONE_RETURN.search(source.text):
            kept = [0, *(match.end() for match in _LINE_END.finditer(source.text))]
        else:
            kept = source.line_starts
        _starts[source] = kept
    return kept


def _line(source: Source, number: int) -> tuple[int, int]:
    """Where line `number` (from 0) starts and ends, without its line end."""
    starts = _line_starts(source)
    start = starts[number]
    end = starts[number + 1] if number + 1 < len(starts) else len(source.text)
    while end > start and source.text[end - 1] in "\r\n":
        end -= 1
    return start, end


def _characters(line: str, units: int) -> int:
    """How many characters of `line` take `units` code units; a part of one counts as none."""
    if line.isascii():
        return min(units, len(line))
    size = _agreed[0]
    for number, character in enumerate(line):
        units -= size(character)
        if units < 0:
            return number
    return len(line)


def _units(text: str) -> int:
    if text.isascii():
        return len(text)
    return _agreed[0](text)
