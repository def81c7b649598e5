"""Scanner of InnerModel and SCXML files.

In: a well-formed text. Out: tokens. A tag has several tokens: its name with the `<`, its
attributes, its end. They do not include spaces around the `=` of an attribute or in a closing tag.
"""

from __future__ import annotations

import re

from robocomp_dsl.format.tokens import FormatToken, make

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


def scan_xml(text: str) -> list[FormatToken]:
    """The tokens of `text`."""
    tokens: list[FormatToken] = []
    pattern, at, end_of_text = _BETWEEN, 0, len(text.rstrip())
    while at < end_of_text and (match := pattern.match(text, at, end_of_text)):
        kind = match.lastgroup or ""
        written = match[kind].rstrip()
        start = match.end() - len(match[kind])
        token = make(kind, text, start, start + len(written), at)
        if kind == "ATTRIBUTE" and not _TIGHT.match(token.text):
            token.text = _EQUALS.sub("=", token.text, count=1)
        elif kind == "CLOSE":
            token.text = _NAME.sub("", token.text)
        elif kind == "OPEN":
            pattern = _INSIDE
        elif kind in ("ENDED", "EMPTY"):
            pattern = _BETWEEN
        tokens.append(token)
        at = token.end
    return tokens
