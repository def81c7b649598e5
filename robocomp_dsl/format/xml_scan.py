"""The pieces of an InnerModel or SCXML text.

In: a text that the parser found well-formed. Out: pieces. A tag is several: its name with the `<`,
its attributes, its end. Blanks around the `=` of an attribute and in a closing tag are no part.
"""

from __future__ import annotations

import re

from robocomp_dsl.format.pieces import Piece, make

_BETWEEN = re.compile(
    r"""\s*(?:(?P<BLOCK><!--[\s\S]*?-->)|(?P<INSTRUCTION><\?[\s\S]*?(?:\?>|\Z))"""
    r"""|(?P<CDATA><!\[CDATA\[[\s\S]*?\]\]>)|(?P<DOCTYPE><![A-Za-z](?:[^<>\[]|\[[^\]]*\])*>?)"""
    r"""|(?P<CLOSE></[^<>]*>)|(?P<OPEN><[A-Za-z_][\w:.-]*)|(?P<TEXT>[^<\s][^<]*)|(?P<OTHER>\S))"""
)
_INSIDE = re.compile(
    r"""\s*(?:(?P<BLOCK><!--[\s\S]*?-->)|(?P<INSTRUCTION><\?[\s\S]*?(?:\?>|\Z))"""
    r"""|(?P<ATTRIBUTE>[A-Za-z_][\w:.-]*\s*=\s*(?:"[^"<]*"|'[^'<]*'))"""
    r"""|(?P<ENDED>>)|(?P<EMPTY>/>)|(?P<OTHER>[^\s<>/]+|\S))"""
)
_TIGHT = re.compile(r"[^\s=]+=\S")
_EQUALS = re.compile(r"\s*=\s*")
_NAME = re.compile(r"\s+")


def scan_xml(text: str) -> list[Piece]:
    """The pieces of `text`."""
    pieces: list[Piece] = []
    pattern, at, end_of_text = _BETWEEN, 0, len(text.rstrip())
    while at < end_of_text and (match := pattern.match(text, at, end_of_text)):
        kind = match.lastgroup or ""
        written = match[kind].rstrip()
        start = match.end() - len(match[kind])
        one = make(kind, text, start, start + len(written), at)
        if kind == "ATTRIBUTE" and not _TIGHT.match(one.text):
            one.text = _EQUALS.sub("=", one.text, count=1)
        elif kind == "CLOSE":
            one.text = _NAME.sub("", one.text)
        elif kind == "OPEN":
            pattern = _INSIDE
        elif kind in ("ENDED", "EMPTY"):
            pattern = _BETWEEN
        pieces.append(one)
        at = one.end
    return pieces
