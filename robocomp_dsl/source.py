"""Source texts and spans: how every stage refers to a position in the user's files.

In: a path and its text. Out: `Source` (immutable text that converts an offset to a line and a
column) and `Span` (a range of characters in one source). Lines and columns count from 1, and
columns count characters; they are computed on demand. A `TextRegion` moves the spans of an
unchanged part of a text when the text before it is edited.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import cached_property
from pathlib import Path
from typing import Any

from robocomp_dsl.record import Record
from robocomp_dsl.regular_file import open_regular

MAX_BYTES = 4 * 1024 * 1024
"""Larger inputs are rejected; real descriptions are far smaller."""


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
    """The file cannot be read as text; the message tells the user why."""


class Source(Record):
    """One text as the user wrote it; `path` is the path that the user gave.

    `parse_cache` is for texts that are edited: all versions of one file share it, and the parser
    stores there what it can reuse for the next version. None: the text is parsed once.
    """

    path: Path
    text: str
    parse_cache: dict[str, Any] | None = None
    offset = 0
    __slots__ = (
        "__dict__",
        "__weakref__",
    )  # for `line_starts`, `suffix` and for data of the editor

    @classmethod
    def read(cls, path: Path) -> Source:
        """Read the file at `path` and decode it with `decode`.

        Raises `UnreadableSource` if it is missing, a folder, too large or not a text file.
        """
        return cls(path, decode(read_source_bytes(path)))

    @property
    def source(self) -> Source:
        """The source itself, so that `Source` and `TextRegion` have the same interface."""
        return self

    @cached_property
    def suffix(self) -> str:
        """The suffix of the path in lower case, with the dot."""
        return self.path.suffix.lower()

    @cached_property
    def line_starts(self) -> list[int]:
        """Offset of the first character of every line."""
        if _LONE_RETURN.search(self.text):  # line ends of classic Mac OS
            return [0, *(line_end.end() for line_end in _LINE_END.finditer(self.text))]
        starts = [0]
        find = self.text.find
        line_end = find("\n")
        while line_end >= 0:
            starts.append(line_end + 1)
            line_end = find("\n", line_end + 1)
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

    def span_at(self, line: int, column: int = 0, width: int = 0) -> Span:
        """`width` characters at `line` and `column`, which count from 1.

        Without a column, the line without its blanks; without a line, `file_span`. What is after
        the end of the text becomes an empty span there.
        """
        size = len(self.text)
        if not 0 < line <= len(self.line_starts):
            return self.span(size, size) if line > 0 else self.file_span
        start = self.line_starts[line - 1]
        if not column:
            text = self.line(line)
            start += len(text) - len(text.lstrip())
            return self.span(start, start + len(text.strip()))
        start = min(start + column - 1, size)
        return self.span(start, min(start + width, size))

    @property
    def file_span(self) -> Span:
        """An empty span at offset 0, for diagnostics about the file as a whole."""
        return Span(self, 0, 0)


class TextRegion:
    """A part of a text that stays the same while the text around it is edited.

    `offset` is how many characters it has moved since it was parsed. The incremental parser sets
    `source` and `offset` when the text changes.
    """

    __slots__ = ("offset", "source")

    def __init__(self, source: Source) -> None:
        self.source = source
        self.offset = 0


class Span:
    """The characters [start, end) of a source; a span moves with the region it was parsed in."""

    __slots__ = ("_end", "_region", "_start")
    __match_args__ = ("source", "start", "end")

    def __init__(self, region: Source | TextRegion, start: int, end: int) -> None:
        """`start` and `end` are offsets in the text before `region` moved."""
        self._region = region
        self._start = start
        self._end = end

    @property
    def source(self) -> Source:
        """The text."""
        return self._region.source

    @property
    def start(self) -> int:
        """Offset of the first character."""
        return self._start + self._region.offset

    @property
    def end(self) -> int:
        """Offset after the last character."""
        return self._end + self._region.offset

    @property
    def text(self) -> str:
        """The characters themselves."""
        return self.source.text[self.start : self.end]

    @property
    def start_position(self) -> tuple[int, int]:
        """Line and column of the first character, from 1."""
        return self.source.position(self.start)

    @property
    def end_position(self) -> tuple[int, int]:
        """Line and column after the last character, from 1."""
        return self.source.position(self.end)

    def cover(self, other: Span) -> Span:
        """From the start of this span to the end of `other`."""
        return self.subspan(self.start, max(self.end, other.end))

    def subspan(self, start: int, end: int) -> Span:
        """The characters [start, end) of the source, in the same region."""
        offset = self._region.offset
        return Span(self._region, start - offset, end - offset)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Span):
            return NotImplemented
        own, others = (self.source, self.start, self.end), (other.source, other.start, other.end)
        return own == others

    def __hash__(self) -> int:
        return hash((self.source, self.start, self.end))

    def __repr__(self) -> str:
        return f"Span({self.source.path.name}, {self.start}, {self.end})"


def read_source_bytes(path: Path) -> bytes:
    """The content of the file at `path`, or its first `MAX_BYTES` and one byte.

    Raises `UnreadableSource` if it is missing, a folder or no regular file.
    """
    try:
        with open_regular(path) as stream:
            return stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise UnreadableSource("the file does not exist") from None
    except IsADirectoryError:
        raise UnreadableSource("this is a folder, not a file") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UnreadableSource(f"the file cannot be read: {reason}") from None


def decode(data: bytes) -> str:
    """Decode `data` as UTF-8, or as the XML declaration says; a BOM is removed.

    Raises `UnreadableSource` if it is too large, binary or in another encoding.
    """
    return decode_with_encoding(data)[0]


def decode_with_encoding(data: bytes) -> tuple[str, str]:
    """As `decode`, with the name of the encoding: `utf-8-sig` if there is a BOM."""
    if len(data) > MAX_BYTES:
        raise UnreadableSource(f"the file is larger than {MAX_BYTES // 1024 // 1024} MB")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise UnreadableSource("the file is UTF-16; save it as UTF-8")
    if b"\0" in data:
        raise UnreadableSource("this is a binary file, not a text file")
    if pointer := _POINTER.match(data):
        tool = "Git LFS" if pointer[1] else "git-annex"
        raise UnreadableSource(f"this is a {tool} pointer; the file content was not downloaded")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        declared = _DECLARED.match(data[:200].decode("ascii", "replace"))
        name = _LEGACY.get(declared[3].lower()) if declared else None
        if name is None:
            line = data.count(b"\n", 0, error.start) + 1
            raise UnreadableSource(
                f"the file is not UTF-8: byte 0x{data[error.start]:02x} in line {line}; "
                "save it as UTF-8"
            ) from None
        return data.decode(name, "replace"), name
    return text, "utf-8-sig" if data.startswith(b"\xef\xbb\xbf") else "utf-8"


def declare_utf8(text: str) -> str:
    """`text` with `UTF-8` in its XML declaration, if that names another encoding."""
    declared = _DECLARED.match(text)
    if declared is None or declared[3].lower() not in _LEGACY:
        return text
    return text[: declared.start(3)] + "UTF-8" + text[declared.end(3) :]
