"""Scanner of the languages with braces.

In: a text, the name of its language, and the offsets at which the parser inserted a missing `;`.
Out: tokens; a missing `;` is an empty token of kind `_SEMI`, so that its statement ends there.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from robocomp_dsl.format.tokens import FormatToken, make
from robocomp_dsl.syntax.grammar.tables import load

_KINDS = {
    "DOC_BLOCK": "BLOCK",
    "BLOCK_COMMENT": "BLOCK",
    "DOC_LINE": "LINE",
    "LINE_COMMENT": "LINE",
    "HASH_LINES": "LINE",
}
_HASH_LINE = re.compile(r"#[^\r\n]*")
_BLANK = re.compile(r"\s+")


def scan(text: str, language: str, missing: Collection[int] = ()) -> list[FormatToken]:
    """The tokens of `text`; `missing` are the offsets of missing `;`."""
    tokens: list[FormatToken] = []
    previous_end = 0
    for match in load(language).scanner.finditer(text, 0, len(text.rstrip())):
        group = match.lastgroup or ""
        kind, end = _KINDS.get(group, group), match.end()
        start = end - len(match[group])
        if group == "HASH_LINES":
            for line in _HASH_LINE.finditer(text, start, end):
                tokens.append(make(kind, text, line.start(), line.end(), previous_end))
                previous_end = line.end()
            continue
        token = make(kind, text, start, end, previous_end)
        if group == "_SEMI":
            token.text = _BLANK.sub("", token.text)
        elif group == "BRACKETED":
            token.text = f"[{token.text[1:-1].strip()}]"
        tokens.append(token)
        previous_end = end
        if end in missing:
            tokens.append(FormatToken("_SEMI", "", end, end, 0))
    return tokens
