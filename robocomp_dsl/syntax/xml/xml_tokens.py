"""The XML lexer, with the terminals of `grammars/innermodel.lark`.

In: a text. Out: tags, each as a list of tokens, and single tokens between them. Inside a tag other
terminals apply than outside. They are computed by Lark's contextual lexer and stored beside the
grammar like the tables of the other languages, so Lark itself is not imported.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from robocomp_dsl.resources import GRAMMARS
from robocomp_dsl.syntax.grammar.grammar_file import fingerprint
from robocomp_dsl.syntax.grammar.lexer import Token

LANGUAGE = "innermodel"
TAG_PARTS = frozenset(("ATTRIBUTE", "OPEN_VALUE", "BARE_VALUE", "NO_VALUE", "JUNK"))
TAG_ENDS = frozenset(("ENDED", "ENDED_EMPTY"))


class Scanner(NamedTuple):
    """One regular expression outside and one inside tags; the matching group is the terminal."""

    outside: re.Pattern[str]
    inside: re.Pattern[str]
    ignored: frozenset[str]


@cache
def load_scanner() -> Scanner:
    """Load the terminals of the grammar."""
    try:
        data = json.loads((GRAMMARS / "tables" / f"{LANGUAGE}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        data = {}
    if data.get("fingerprint") != fingerprint(LANGUAGE):
        from robocomp_dsl.syntax.grammar import build_tables  # noqa: PLC0415 - Lark

        data = build_tables.build_xml_tables()
    outside, inside = re.compile(data["outside"]), re.compile(data["inside"])
    return Scanner(outside, inside, frozenset(data["ignored"]))


def tokens(text: str) -> Iterator[Token]:
    """The tokens of `text` without ignored ones."""
    outside, inside, ignored = load_scanner()
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
        elif kind not in TAG_PARTS:
            place = outside


def group_tags(text: str) -> Iterator[list[Token]]:
    """The tokens of the document in groups: a whole tag, or one other token."""
    tag: list[Token] = []
    for token in tokens(text):
        if tag and (token.kind in TAG_PARTS or token.kind in TAG_ENDS):
            tag.append(token)
            if token.kind in TAG_ENDS:
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
