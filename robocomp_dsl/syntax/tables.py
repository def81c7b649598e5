"""The parse tables of a language: made from its grammar by Lark, kept beside it as JSON.

In: the name of a grammar. Out: `Tables`, ready for the parser. The tables in `grammars/tables/` are
rewritten by `python -m robocomp_dsl.syntax.tabulate` and carry the checksum of the grammar they
were made from. As long as it fits, Lark is not even imported, which halves the start-up time; after
a change of the grammar the tables are made in memory. They are data, so reading them is safe.
"""

from __future__ import annotations

import json
import re
from functools import cache
from typing import Any, NamedTuple
from zlib import crc32

from robocomp_dsl.record import Record
from robocomp_dsl.resources import GRAMMARS

SHARED = GRAMMARS / "terminals.lark"
END = "$END"


class Pick(NamedTuple):
    """A child that the builder gets: number `symbol` of the rule, or None for an absent `[x]` (-1).

    `terminal` names the terminal that the child is, if it is one; the children of a child that is
    `spliced` take its place.
    """

    symbol: int
    terminal: str
    spliced: bool


class Rule(NamedTuple):
    """What a reduction does.

    `method` of the builder is called with the picked children. Without a method, a rule that
    `unwraps` passes its only child on, and any other hands all of them to the rule above.
    """

    origin: str
    length: int
    method: str
    unwraps: bool
    picks: list[Pick]


class Tables(Record):
    """A language as the parser needs it.

    `actions[state][terminal]` is the next state of a shift, or -1 - (the rule to reduce by).
    `restarts` are the states in which an item of a block may start. `keywords` maps words (lower
    case where `any_case`) to terminals, which are `words`; `texts` maps terminals that are always
    written alike to that text.
    """

    language: str
    actions: list[dict[str, int]]
    gotos: list[dict[str, int]]
    rules: list[Rule]
    accept: int
    restarts: frozenset[int]
    keywords: dict[str, str]
    words: frozenset[str]
    texts: dict[str, str]
    signs: dict[str, str]
    any_case: bool
    scanner: re.Pattern[str]


def name_action(row: dict[str, int], keyword: str) -> int | None:
    """What to do with a keyword that has no place of its own here: read it as a name, if one fits.

    A type is not read as a name where the statement could end as well: there it says that the next
    parameter has begun.
    """
    action = row.get("ID")
    if action is not None and keyword.endswith("_TYPE") and action >= 0 <= row.get("_SEMI", -1):
        return None
    return action


def fingerprint(language: str) -> int:
    """Checksum of everything that the tables of `language` are made from."""
    grammar = GRAMMARS / f"{language}.lark"
    return crc32(grammar.read_bytes(), crc32(SHARED.read_bytes()))


@cache
def load(language: str) -> Tables:
    """The tables of the grammar called `language`, in a state numbered 0 at the start."""
    kept = GRAMMARS / "tables" / f"{language}.json"
    try:
        data = json.loads(kept.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        data = {}
    if data.get("fingerprint") != fingerprint(language):
        from robocomp_dsl.syntax import tabulate  # noqa: PLC0415 - Lark only when it must be

        data = tabulate.tabulate(language)
    return _tables(data)


def _tables(data: dict[str, Any]) -> Tables:
    rules = [
        Rule(origin, length, method, unwraps, [Pick(*pick) for pick in picks])
        for origin, length, method, unwraps, picks in data["rules"]
    ]
    gotos: list[dict[str, int]] = data["gotos"]
    return Tables(
        language=data["language"],
        actions=data["actions"],
        gotos=gotos,
        rules=rules,
        accept=data["accept"],
        restarts=frozenset(
            state for state, row in enumerate(gotos) if any(n.endswith("_item") for n in row)
        ),
        keywords=data["keywords"],
        words=frozenset(data["keywords"].values()),
        texts=data["texts"],
        signs={text: kind for kind, text in data["texts"].items() if not text[0].isalpha()},
        any_case=data["any_case"],
        scanner=re.compile(data["scanner"], re.MULTILINE),
    )
