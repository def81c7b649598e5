"""The completion context of a position in an XML file.

In: a text and an offset. Out: an `XmlContext`. The text after the cursor matters only for the
existing attributes of the tag.
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


class PositionKind(StrEnum):
    """What may be inserted at the position."""

    CONTENT = "content"
    TAG = "tag"
    CLOSING = "closing"
    ATTRIBUTE = "attribute"
    VALUE = "value"


@dataclass(frozen=True, slots=True)
class XmlContext:
    """`start` is the offset of the word at the cursor; `open_tags` are ordered from the outermost.

    `tag` and `attribute` are those at the cursor; `existing_attributes` belong to the tag.
    """

    path: Path
    source: Source
    offset: int
    start: int
    position_kind: PositionKind
    open_tags: tuple[str, ...]
    tag: str = ""
    attribute: str = ""
    existing_attributes: frozenset[str] = frozenset()


def xml_context_at(path: Path, source: Source, offset: int) -> XmlContext | None:
    """The context at `offset`; None if nothing can be completed, as in a comment."""
    before = source.text[:offset]
    open_tags: list[str] = []
    for part in _PART.finditer(before):
        at_end = part.end() == offset
        if part["tag"] is not None:
            if not part["end"] and "<" not in before[part.end() :]:
                return _in_tag(path, source, offset, part, tuple(open_tags))
            if part["end"] and not part["rest"].endswith("/"):
                open_tags.append(part["tag"])
        elif part["closed"] is not None:
            if at_end and not part["done"]:
                start = part.start("closed")
                kind = PositionKind.CLOSING
                return XmlContext(path, source, offset, start, kind, tuple(open_tags))
            _close(open_tags, part["closed"])
        elif at_end and not part[0].endswith(">"):
            return None
    word = _WORD.search(before)
    start = word.start() if word else offset
    return XmlContext(path, source, offset, start, PositionKind.CONTENT, tuple(open_tags))


def _close(open_tags: list[str], name: str) -> None:
    """Remove the innermost open tag `name` and the tags nested in it."""
    names = [tag.lower() for tag in open_tags]
    if name.lower() in names:
        del open_tags[len(names) - 1 - names[::-1].index(name.lower()) :]


def _in_tag(
    path: Path, source: Source, offset: int, part: re.Match[str], open_tags: tuple[str, ...]
) -> XmlContext | None:
    tag, before = part["tag"], source.text[:offset]
    inside = before[part.end("tag") :]
    if not inside:
        start = part.start("tag")
        return XmlContext(path, source, offset, start, PositionKind.TAG, open_tags, tag)
    value = _VALUE.search(inside)
    after = source.text[offset:]
    ends = [end for end in (after.find(">"), after.find("<")) if end >= 0]
    existing = frozenset(_ATTRIBUTE.findall(inside + after[: min(ends, default=len(after))]))
    if value:
        start = part.end("tag") + value.start(3)
        kind = PositionKind.VALUE
        return XmlContext(path, source, offset, start, kind, open_tags, tag, value[1], existing)
    word = _WORD.search(inside)
    start = part.end("tag") + (word.start() if word else len(inside))
    if not source.text[start - 1].isspace():
        return None
    kind = PositionKind.ATTRIBUTE
    return XmlContext(path, source, offset, start, kind, open_tags, tag, "", existing)
