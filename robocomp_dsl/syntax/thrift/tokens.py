"""The tokens of a Thrift definition with their comments.

In: a text. Out: tokens. `doc` is the `/** … */` comment before a token, `behind` any comment that
follows it on the same line, if no other token does. The language:
https://thrift.apache.org/docs/idl
"""

from __future__ import annotations

import re

from robocomp_dsl.record import Record
from robocomp_dsl.source import Source, Span

WORD, NUMBER, TEXT, SIGN, END = "word", "number", "text", "sign", "end"

_TOKEN = re.compile(
    r"""(?P<blank>\s+)
    |(?P<comment>(?://|\#)[^\n]*|/\*(?:.*?\*/|.*\Z))
    |(?P<word>[A-Za-z_][\w.]*)
    |(?P<number>[+-]?(?:0[xX][0-9a-fA-F]+|(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?))
    |(?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
    |(?P<sign>.)""",
    re.VERBOSE | re.DOTALL | re.ASCII,
)
_STARS = re.compile(r"^[ \t]*\*?[ \t]?", re.MULTILINE)


class ThriftToken(Record):
    """A word, number, text in quotes or sign; `is_first`: it is the first of its line."""

    kind: str
    text: str
    span: Span
    doc: str
    is_first: bool


class TokenList(Record):
    """The tokens, the last of which has the kind `END`, and the comments behind some of them.

    The keys of `behind` are the ends of tokens. `open_comment` is the start of a comment without
    end.
    """

    tokens: tuple[ThriftToken, ...]
    behind: dict[int, str]
    open_comment: Span | None


def tokenize(source: Source) -> TokenList:
    """The tokens of a definition."""
    tokens: list[ThriftToken] = []
    behind: dict[int, str] = {}
    doc, last_end, is_first = "", 0, True
    open_comment: Span | None = None
    for found in _TOKEN.finditer(source.text):
        kind, text = found.lastgroup or SIGN, found.group()
        if kind == "blank":
            is_first = is_first or "\n" in text
        elif kind == "comment":
            if text.startswith("/*") and (len(text) < 4 or not text.endswith("*/")):
                open_comment = source.span(found.start(), found.start() + 2)
            if not is_first:
                earlier = behind.get(last_end)
                behind[last_end] = f"{earlier}\n{_plain(text)}" if earlier else _plain(text)
            elif text.startswith("/**"):
                doc = _plain(text)
            is_first = is_first or "\n" in text
        else:
            if not is_first:
                behind.pop(last_end, None)  # a comment between two tokens of a line
            span = source.span(found.start(), found.end())
            tokens.append(ThriftToken(kind, text, span, doc, is_first))
            doc, last_end, is_first = "", found.end(), False
    size = len(source.text)
    tokens.append(ThriftToken(END, "", source.span(size, size), "", is_first=True))
    return TokenList(tuple(tokens), behind, open_comment)


def _plain(comment: str) -> str:
    """The text of a comment without its signs."""
    if not comment.startswith("/*"):
        return comment.lstrip("/#").lstrip("!<").strip()
    inside = comment.removesuffix("*/").lstrip("/*").lstrip("!<")
    return _STARS.sub("", inside).strip()
