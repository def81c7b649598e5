"""From XML text to tokens, by the terminals of `grammars/innermodel.lark`.

In: a text. Out: tags, each as the list of its tokens, and single tokens between them. Inside a tag
other terminals count than outside of it; Lark's contextual lexer works them out, and they are kept
beside the grammar like the tables of the other languages, so that Lark itself is not loaded.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from robocomp_dsl.resources import GRAMMARS
from robocomp_dsl.syntax.lexer import Token
from robocomp_dsl.syntax.tables import fingerprint

LANGUAGE = "innermodel"
PARTS = frozenset(("ATTRIBUTE", "OPEN_VALUE", "BARE_VALUE", "NO_VALUE", "JUNK"))
ENDS = frozenset(("ENDED", "ENDED_EMPTY"))


class Scanner(NamedTuple):
    """One expression for each place; the group that matched names the terminal."""

    outside: re.Pattern[str]
    inside: re.Pattern[str]
    ignored: frozenset[str]


@cache
def load() -> Scanner:
    """The terminals of the grammar as it is now."""
    try:
        data = json.loads((GRAMMARS / "tables" / f"{LANGUAGE}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        data = {}
    if data.get("fingerprint") != fingerprint(LANGUAGE):
        from robocomp_dsl.syntax import tabulate  # noqa: PLC0415 - Lark only when it must be

        data = tabulate.tabulate_xml()
    outside, inside = re.compile(data["outside"]), re.compile(data["inside"])
    return Scanner(outside, inside, frozenset(data["ignored"]))


def tokens(text: str) -> Iterator[Token]:
    """The tokens of `text`, without those that mean nothing."""
    outside, inside, ignored = load()
    at, size, place = 0, len(text), outside
    while at < size:
        match = place.match(text, at)
        if match is None:  # the grammar has a terminal for every character
            raise ValueError(f"no terminal at offset {at}")
        kind, start, at = match.lastgroup or "", at, match.end()
        if kind in ignored:
            continue
        yield Token(kind, match[0], start, at)
        if kind == "OPEN":
            place = inside
        elif kind not in PARTS:
            place = outside


def items(text: str) -> Iterator[list[Token]]:
    """What the document consists of: `OPEN` with its parts and its end, or one other token."""
    tag: list[Token] = []
    for token in tokens(text):
        if tag and (token.kind in PARTS or token.kind in ENDS):
            tag.append(token)
            if token.kind in ENDS:
                yield tag
                tag = []
            continue
        if tag:
            yield tag
            tag = []
        if token.kind == "OPEN":
            tag = [token]
        else:
            yield [token]
    if tag:
        yield tag
