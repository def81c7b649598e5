"""The pieces of a text in one of the languages with braces.

In: a text, the name of its language, and where a `;` is missing that the parser understood. Out:
pieces; a missing `;` is one of the kind `_SEMI` without text, so that its statement ends there.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from robocomp_dsl.format.pieces import Piece, make
from robocomp_dsl.syntax.tables import load

_KINDS = {
    "DOC_BLOCK": "BLOCK",
    "BLOCK_COMMENT": "BLOCK",
    "DOC_LINE": "LINE",
    "LINE_COMMENT": "LINE",
    "HASH_LINES": "LINE",
}
_HASH_LINE = re.compile(r"#[^\r\n]*")
_BLANK = re.compile(r"\s+")


def scan(text: str, language: str, missing: Collection[int] = ()) -> list[Piece]:
    """The pieces of `text`; `missing` are the offsets at which a `;` is meant."""
    pieces: list[Piece] = []
    behind = 0
    for match in load(language).scanner.finditer(text, 0, len(text.rstrip())):
        group = match.lastgroup or ""
        kind, end = _KINDS.get(group, group), match.end()
        start = end - len(match[group])
        if group == "HASH_LINES":
            for line in _HASH_LINE.finditer(text, start, end):
                pieces.append(make(kind, text, line.start(), line.end(), behind))
                behind = line.end()
            continue
        one = make(kind, text, start, end, behind)
        if group == "_SEMI":
            one.text = _BLANK.sub("", one.text)
        elif group == "BRACKETED":
            one.text = f"[{one.text[1:-1].strip()}]"
        pieces.append(one)
        behind = end
        if end in missing:
            pieces.append(Piece("_SEMI", "", end, end, 0))
    return pieces
