"""Scanner of the languages with braces.

In: a text, the name of its language, and the offsets at which the parser inserted a missing `;`.
Out: tokens; a missing `;` is an empty token of kind `_SEMI`, so that its statement ends there.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from robocomp_dsl.format.style import STYLES
from robocomp_dsl.format.tokens import FormatToken, make
from robocomp_dsl.syntax.grammar.tables import load

_KINDS = {
    "DOC_BLOCK": "BLOCK",
    "BLOCK_COMMENT": "BLOCK",
    "DOC_LINE": "LINE",
    "LINE_COMMENT": "LINE",
    "HASH_LINES": "LINE",
}
_OPERANDS = frozenset(("ID", "NUMBER", "STRING", "BRACKETED", "INDEX"))
_INDEX = re.compile(r"\[[\d\s:,]*\]")
_HASH_LINE = re.compile(r"#[^\r\n]*")
_BLANK = re.compile(r"\s+")


def scan(text: str, language: str, missing: Collection[int] = ()) -> list[FormatToken]:
    """The tokens of `text`; `missing` are the offsets of missing `;`."""
    tokens: list[FormatToken] = []
    operators = STYLES[language].operators
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
        if operators:
            token.kind = _kind_in_expression(token, tokens)
        tokens.append(token)
        previous_end = end
        if end in missing:
            tokens.append(FormatToken("_SEMI", "", end, end, 0))
    return tokens


def _kind_in_expression(token: FormatToken, tokens: list[FormatToken]) -> str:
    """`INDEX` for brackets with numbers, `UNARY` for a sign, else the kind of the token.

    A `-` is a sign if no operand precedes it, or the first word of a statement: `item -1;`.
    """
    if token.kind == "BRACKETED" and _INDEX.fullmatch(token.text):
        return "INDEX"
    if token.text != "-" or token.kind != "SIGN":
        return token.kind
    before = [earlier for earlier in tokens[-8:] if not earlier.is_comment]
    if not before or not (before[-1].kind in _OPERANDS or before[-1].text in (")", "}")):
        return "UNARY"
    if before[-1].text.lower() in ("when", "and"):
        return "UNARY"
    starts = len(before) < 2 or before[-2].kind == "_SEMI" or before[-2].text in ("{", "}")
    return "UNARY" if starts and before[-1].text.lower() == "item" else "SIGN"
