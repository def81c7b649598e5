"""The parse tables of a language, built by Lark and stored as JSON beside the grammar.

In: the name of a grammar. Out: `Tables` for the parser. `python -m
robocomp_dsl.syntax.grammar.build_tables` writes the tables in `grammars/tables/` with the checksum
of their grammar. While the checksum matches, Lark is not imported, which halves the start-up time;
after a change of the grammar the tables are built in memory.
"""

from __future__ import annotations

import json
import re
from functools import cache
from typing import Any, NamedTuple

from robocomp_dsl.record import Record
from robocomp_dsl.resources import GRAMMARS
from robocomp_dsl.syntax.grammar.grammar_file import fingerprint


class Pick(NamedTuple):
    """A child passed to the builder: symbol number `symbol`, or None for an absent `[x]` (-1).

    `terminal` is the name of the terminal if the child is one. A `spliced` child is replaced by its
    own children.
    """

    symbol: int
    terminal: str
    spliced: bool


class Rule(NamedTuple):
    """The action of a reduction.

    `method` of the builder is called with the picked children. Without a method, a rule that
    `unwraps` returns its only child; any other rule passes its children to the rule above.
    """

    origin: str
    length: int
    method: str
    unwraps: bool
    picks: list[Pick]


class Tables(Record):
    """The parse tables of one language.

    `actions[state][terminal]` is the next state of a shift, or -1 - (the rule to reduce by).
    `item_states` are the states in which an item of a block may start. `keywords` maps keywords
    (lower case if `any_case`) to terminals; `keyword_terminals` is the set of these terminals.
    `terminal_texts` maps terminals with a fixed text to that text.
    """

    language: str
    actions: list[dict[str, int]]
    gotos: list[dict[str, int]]
    rules: list[Rule]
    accept: int
    item_states: frozenset[int]
    keywords: dict[str, str]
    keyword_terminals: frozenset[str]
    terminal_texts: dict[str, str]
    punctuation: dict[str, str]
    any_case: bool
    scanner: re.Pattern[str]


def name_action(row: dict[str, int], keyword: str) -> int | None:
    """The action for a keyword that the state does not accept: that of a name, if accepted.

    The name of a type is not read as a name where the statement could also end: there it begins the
    next parameter.
    """
    action = row.get("ID")
    if action is not None and keyword.endswith("_TYPE") and action >= 0 <= row.get("_SEMI", -1):
        return None
    return action


@cache
def load(language: str) -> Tables:
    """Load the tables of the grammar `language`; state 0 is the start state."""
    path = GRAMMARS / "tables" / f"{language}.json"
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        data = {}
    if data.get("fingerprint") != fingerprint(language):
        from robocomp_dsl.syntax.grammar import build_tables  # noqa: PLC0415 - Lark

        data = build_tables.build_tables(language)
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
        item_states=frozenset(
            state for state, row in enumerate(gotos) if any(n.endswith("_item") for n in row)
        ),
        keywords=data["keywords"],
        keyword_terminals=frozenset(data["keywords"].values()),
        terminal_texts=data["texts"],
        punctuation={text: kind for kind, text in data["texts"].items() if not text[0].isalpha()},
        any_case=data["any_case"],
        scanner=re.compile(data["scanner"], re.MULTILINE),
    )
