"""Source texts and spans: what every stage points at when it speaks of the user's files.

In: a path and its text. Out: `Source` (immutable text that can turn an offset into a line and a
column) and `Span` (a range of characters in one source). Lines and columns count from 1 and
columns count characters; they are computed only when somebody looks. A `Piece` lets the spans of
an unchanged part of a text move along when the text around it changes in an editor.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import cached_property
from pathlib import Path
from typing import Any

from robocomp_dsl.record import Record

MAX_BYTES = 4 * 1024 * 1024
"""Larger inputs are refused: no description of a component comes near it."""


_LINE_END = re.compile(r"\r\n?|\n")
_LONE_RETURN = re.compile(r"\r(?!\n)")
_DECLARED = re.compile(r"""\A(\s*<\?xml\b[^>]*?\sencoding\s*=\s*)(["'])([A-Za-z][\w.-]*)\2""")
_POINTER = re.compile(rb"(version https://git-lfs\.)|[./]*/?\.git/annex/objects/\S+\s*\Z")
_LEGACY = {
    "iso-8859-1": "iso-8859-1",
    "latin-1": "iso-8859-1",
    "latin1": "iso-8859-1",
    "iso-8859-15": "iso-8859-15",
    "windows-1252": "cp1252",
    "cp1252": "cp1252",
}


class UnreadableSource(Exception):
    """The file cannot be used as a text; the message says why, in words for the user."""


class Source(Record):
    """One text as the user wrote it; `path` is how the user named it.

    `memory` is for texts that are edited: all texts of one file share it, and a parser keeps there
    what it can use again for the next one. None means that the text is read once.
    """

    path: Path
    text: str
    memory: dict[str, Any] | None = None
    shift = 0
    __slots__ = ("__dict__", "__weakref__")  # for `line_starts`, and editors keep more beside it

    @classmethod
    def read(cls, path: Path) -> Source:
        """The file at `path`, decoded by `decode`.

        Raises `UnreadableSource` when it is missing, a folder, too large or not a text.
        """
        try:
            with path.open("rb") as stream:
                data = stream.read(MAX_BYTES + 1)
        except FileNotFoundError:
            raise UnreadableSource("there is no such file") from None
        except IsADirectoryError:
            raise UnreadableSource("this is a folder, not a file") from None
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise UnreadableSource(f"the file cannot be read: {reason}") from None
        return cls(path, decode(data))

    @property
    def source(self) -> Source:
        """Itself: a text is a place that never moves."""
        return self

    @cached_property
    def line_starts(self) -> list[int]:
        """Offset of the first character of every line."""
        if _LONE_RETURN.search(self.text):  # as old Macs ended lines, and editors still show them
            return [0, *(one.end() for one in _LINE_END.finditer(self.text))]
        starts = [0]
        find = self.text.find
        at = find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return starts

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column, both from 1, of the character at `offset`."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line(self, number: int) -> str:
        """Text of line `number` (from 1) without its line end."""
        start = self.line_starts[number - 1]
        end = self.line_starts[number] if number < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")

    def span(self, start: int, end: int) -> Span:
        """The range [start, end) of this source."""
        return Span(self, start, end)

    @property
    def whole(self) -> Span:
        """An empty span at the very start, for findings about the file as such."""
        return Span(self, 0, 0)


class Piece:
    """A part of a text that stays the same while the text around it is edited.

    `shift` is how far it has moved since it was read; the parser sets both when the text changes.
    """

    __slots__ = ("shift", "source")

    def __init__(self, source: Source) -> None:
        self.source = source
        self.shift = 0


class Span:
    """The characters [start, end) of a source; they move with the piece they were read in."""

    __slots__ = ("_end", "_place", "_start")
    __match_args__ = ("source", "start", "end")

    def __init__(self, place: Source | Piece, start: int, end: int) -> None:
        """`start` and `end` count from where the text of `place` begins, without its shift."""
        self._place = place
        self._start = start
        self._end = end

    @property
    def source(self) -> Source:
        """The text."""
        return self._place.source

    @property
    def start(self) -> int:
        """Offset of the first character."""
        return self._start + self._place.shift

    @property
    def end(self) -> int:
        """Offset behind the last character."""
        return self._end + self._place.shift

    @property
    def text(self) -> str:
        """The characters themselves."""
        return self.source.text[self.start : self.end]

    @property
    def begin(self) -> tuple[int, int]:
        """Line and column of the first character, from 1."""
        return self.source.position(self.start)

    @property
    def finish(self) -> tuple[int, int]:
        """Line and column just behind the last character, from 1."""
        return self.source.position(self.end)

    def to(self, other: Span) -> Span:
        """From the start of this span to the end of `other`."""
        return self.part(self.start, max(self.end, other.end))

    def part(self, start: int, end: int) -> Span:
        """The characters [start, end) of the source; they move as this span does."""
        shift = self._place.shift
        return Span(self._place, start - shift, end - shift)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Span):
            return NotImplemented
        mine, theirs = (self.source, self.start, self.end), (other.source, other.start, other.end)
        return mine == theirs

    def __hash__(self) -> int:
        return hash((self.source, self.start, self.end))

    def __repr__(self) -> str:
        return f"Span({self.source.path.name}, {self.start}, {self.end})"


def decode(data: bytes) -> str:
    """`data` as text: UTF-8, or what an XML declaration says; a BOM is dropped.

    Raises `UnreadableSource` for what no editor would show as a text.
    """
    if len(data) > MAX_BYTES:
        raise UnreadableSource(f"the file is larger than {MAX_BYTES // 1024 // 1024} MB")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise UnreadableSource("the text is UTF-16; save it as UTF-8")
    if b"\0" in data:
        raise UnreadableSource("this is a binary file, not a text")
    if found := _POINTER.match(data):
        tool = "Git LFS" if found[1] else "git-annex"
        raise UnreadableSource(f"this is only a pointer of {tool}; the file itself is not here")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        declared = _DECLARED.match(data[:200].decode("ascii", "replace"))
        name = _LEGACY.get(declared[3].lower()) if declared else None
        if name is None:
            line = data.count(b"\n", 0, error.start) + 1
            raise UnreadableSource(
                f"the text is not UTF-8: byte 0x{data[error.start]:02x} in line {line}; "
                "save it as UTF-8"
            ) from None
        return data.decode(name, "replace")


def declared_as_utf8(text: str) -> str:
    """`text` with `UTF-8` in its XML declaration, if it has one that names another encoding."""
    declared = _DECLARED.match(text)
    if declared is None or declared[3].lower() not in _LEGACY:
        return text
    return text[: declared.start(3)] + "UTF-8" + text[declared.end(3) :]
