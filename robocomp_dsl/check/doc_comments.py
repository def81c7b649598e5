"""The documentation of an item: the doc comment before it, or the comment behind it on its line.

In: an item of a tree, with the doc comment that the parser found before it. Out: its documentation
without the commands of Doxygen.

    float x;   // in the frame of the base
    float y;   ///< the same
"""

from __future__ import annotations

import re
from typing import Protocol

from robocomp_dsl.source import Span

_LANGUAGES = (".idsl", ".pdsl")
"""Definitions of ROS, YARP and Thrift have rules of their own for comments."""
_BEHIND = re.compile(
    r"[ \t]*[;,]?[ \t]*(?://[/!]?<?[ \t]*(?P<line>[^\r\n]*)"
    r"|/\*[*!]?<?[ \t]*(?P<block>[^\r\n]*?)\*/[ \t]*(?:\r?\n|\Z))"
)
_LINE_ENDS = ("", "\n", "\r")
_CODE = re.compile(r"[;{}]\s*\Z|\A\W*\Z")
"""A comment that is code, or a line of signs."""
_TITLE = re.compile(
    r"^[ \t]*[@\\](?:struct|class|interface|enum|exception|file|fn|var|namespace|typedef|def|page"
    r"|addtogroup|defgroup|ingroup|author|date|version|copyright)\b[^\n]*\n?",
    re.MULTILINE,
)
_BRIEF = re.compile(r"[@\\](?:brief|short|details)\b[ \t]*")
_PARAMETER = re.compile(
    r"^[ \t]*[@\\]t?param(?:\[[\w, ]*\])?[ \t]+(\w+)[ \t]*[-:]?[ \t]*", re.MULTILINE
)
_SECTIONS = (
    (re.compile(r"^[ \t]*[@\\](?:returns?|result)\b[ \t]*", re.MULTILINE), "Returns "),
    (re.compile(r"^[ \t]*[@\\](?:throws?|exception)\b[ \t]*", re.MULTILINE), "Raises "),
    (re.compile(r"^[ \t]*[@\\](?:note|remarks?)\b[ \t]*", re.MULTILINE), "Note: "),
    (re.compile(r"^[ \t]*[@\\](?:warning|attention)\b[ \t]*", re.MULTILINE), "Warning: "),
    (re.compile(r"^[ \t]*[@\\](?:sa|see)\b[ \t]*", re.MULTILINE), "See "),
)


class DocumentedNode(Protocol):
    """An item of a tree; `doc` is the doc comment before it."""

    @property
    def span(self) -> Span:
        """Where the item is."""

    @property
    def doc(self) -> str:
        """The doc comment."""


def documentation_of(node: DocumentedNode) -> str:
    """The documentation of an item."""
    span = node.span
    source = span.source
    if source.suffix not in _LANGUAGES:
        return plain(node.doc)
    text = source.text
    if not node.doc and text[span.end : span.end + 1] in _LINE_ENDS:
        return ""
    before = _without_comment_of_previous(node.doc, text, span.start)
    return plain(before or _behind(text, span.end))


def plain(doc: str) -> str:
    """A doc comment without the commands of Doxygen; lists of parameters become lists."""
    if "@" not in doc and "\\" not in doc:
        return doc
    doc = _BRIEF.sub("", _TITLE.sub("", doc))
    doc = _PARAMETER.sub(r"- `\1`: ", doc)
    for command, words in _SECTIONS:
        doc = command.sub(words, doc)
    return doc.strip()


def _behind(text: str, end: int) -> str:
    """The comment behind an item that ends at `end`, if it is documentation."""
    found = _BEHIND.match(text, end)
    comment = (found["line"] or found["block"] or "").strip() if found else ""
    return "" if _CODE.search(comment) else comment


def _line_start(text: str) -> int:
    """Where the last line starts."""
    return max(text.rfind("\n"), text.rfind("\r")) + 1


def _without_comment_of_previous(doc: str, text: str, start: int) -> str:
    """`doc` without a comment `///` that is behind the previous item."""
    if not doc:
        return ""
    before = text[max(start - 10_000, 0) : start].rstrip()
    line = before[_line_start(before) :]
    while line.lstrip().startswith("///"):
        before = before[: max(_line_start(before) - 1, 0)]
        line = before[_line_start(before) :]
    code, mark, _ = line.partition("///")
    if mark and code.strip() and not code.rstrip().endswith("{"):
        return doc.partition("\n")[2]
    return doc
