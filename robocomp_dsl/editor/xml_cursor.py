"""Where in an InnerModel text the user is about to type.

In: a text and an offset. Out: an `XmlCursor`. Only what stands before the cursor counts, except for
the attributes that the tag has already.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from robocomp_dsl.source import Source

_PART = re.compile(
    r"""<!--.*?(?:-->|\Z)|<!\[CDATA\[.*?(?:\]\]>|\Z)|<\?.*?(?:\?>|\Z)"""
    r"""|</\s*(?P<closed>[\w:.-]*)[^<>]*(?P<done>>?)"""
    r"""|<(?P<tag>[A-Za-z_][\w:.-]*|(?=\Z))(?P<rest>(?:[^<>"']|"[^"<]*"|'[^'<]*')*)(?P<end>>)?""",
    re.DOTALL,
)
_VALUE = re.compile(r"""([A-Za-z_][\w:.-]*)\s*=\s*(["'])([^"'<>]*)\Z""")
_WORD = re.compile(r"[A-Za-z_][\w:.-]*\Z")
_ATTRIBUTE = re.compile(r"""([A-Za-z_][\w:.-]*)\s*=\s*["']""")


class Place(StrEnum):
    """What can be typed."""

    CONTENT = "content"
    TAG = "tag"
    CLOSING = "closing"
    ATTRIBUTE = "attribute"
    VALUE = "value"


@dataclass(frozen=True, slots=True)
class XmlCursor:
    """`start` is where the word begins that is being typed, `around` the open tags from outside in.

    `tag` and `attribute` are those that the cursor is in, `written` the attributes of the tag.
    """

    path: Path
    source: Source
    offset: int
    start: int
    place: Place
    around: tuple[str, ...]
    tag: str = ""
    attribute: str = ""
    written: frozenset[str] = frozenset()


def xml_cursor_at(path: Path, source: Source, offset: int) -> XmlCursor | None:
    """The cursor at `offset`; None where nothing of InnerModel can stand, as in a comment."""
    before = source.text[:offset]
    around: list[str] = []
    for part in _PART.finditer(before):
        at_end = part.end() == offset
        if part["tag"] is not None:
            if not part["end"] and "<" not in before[part.end() :]:
                return _in_tag(path, source, offset, part, tuple(around))
            if part["end"] and not part["rest"].endswith("/"):
                around.append(part["tag"])
        elif part["closed"] is not None:
            if at_end and not part["done"]:
                start = part.start("closed")
                return XmlCursor(path, source, offset, start, Place.CLOSING, tuple(around))
            _close(around, part["closed"])
        elif at_end and not part[0].endswith(">"):
            return None
    word = _WORD.search(before)
    start = word.start() if word else offset
    return XmlCursor(path, source, offset, start, Place.CONTENT, tuple(around))


def _close(around: list[str], name: str) -> None:
    """Forget the innermost open tag called `name` and those in it."""
    names = [one.lower() for one in around]
    if name.lower() in names:
        del around[len(names) - 1 - names[::-1].index(name.lower()) :]


def _in_tag(
    path: Path, source: Source, offset: int, part: re.Match[str], around: tuple[str, ...]
) -> XmlCursor | None:
    tag, before = part["tag"], source.text[:offset]
    inside = before[part.end("tag") :]
    if not inside:
        start = part.start("tag")
        return XmlCursor(path, source, offset, start, Place.TAG, around, tag)
    value = _VALUE.search(inside)
    behind = source.text[offset:]
    ends = [at for at in (behind.find(">"), behind.find("<")) if at >= 0]
    written = frozenset(_ATTRIBUTE.findall(inside + behind[: min(ends, default=len(behind))]))
    if value:
        start = part.end("tag") + value.start(3)
        return XmlCursor(path, source, offset, start, Place.VALUE, around, tag, value[1], written)
    word = _WORD.search(inside)
    start = part.end("tag") + (word.start() if word else len(inside))
    if not source.text[start - 1].isspace():
        return None
    return XmlCursor(path, source, offset, start, Place.ATTRIBUTE, around, tag, "", written)
