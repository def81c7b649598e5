"""Extracts the keywords of each language and their contexts from the grammars.

In: the Lark grammars, and the vocabularies of the checks. Out: plain data, stored as
`grammars/words.json`; `robocomp_dsl.highlight.table` explains its parts.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

from lark import Lark
from lark.grammar import Symbol, Terminal

from robocomp_dsl.check.ddsl.qos import PRIORITIES
from robocomp_dsl.check.idsl.units import KNOWN
from robocomp_dsl.model.types import PRIMITIVES
from robocomp_dsl.runtime.middleware.registry import BUILT_IN
from robocomp_dsl.syntax.grammar.build_tables import LANGUAGES as NAMES
from robocomp_dsl.syntax.grammar.build_tables import build_tables, lark_parser
from robocomp_dsl.syntax.languages.bdsl import POLICIES as HUB_POLICIES
from robocomp_dsl.syntax.languages.builder import TIME_UNITS
from robocomp_dsl.syntax.languages.cdsl_settings import LANGUAGES, OPTIONS, WIDGETS
from robocomp_dsl.syntax.languages.ddsl_instances import POLICIES
from robocomp_dsl.syntax.languages.idsl_operations import PATTERNS

VALUES = {
    "language": LANGUAGES,
    "gui": ("Qt", *WIDGETS),
    "middleware": tuple(sorted(BUILT_IN)),
    "options": OPTIONS,
    "policy": HUB_POLICIES,
    "priority": PRIORITIES,
    "restart": POLICIES,
}
"""The values that checks accept after a keyword where the grammar has only a name."""

_TRUTH = {
    "idsl": ("false", "true"),
    "pdsl": ("false", "true"),
    "ddsl": ("false", "true"),
    "bdsl": ("counter", "false", "now", "true"),
}
_DURATIONS = {
    "ddsl": tuple(TIME_UNITS),
    "smdsl": tuple(TIME_UNITS),
    "bdsl": (*TIME_UNITS, "Hz"),
}
_FIELD_WORDS = "_field_word"
"""The rule of a grammar that lists keywords which are names of fields before `=`, `.` and `[`."""

_BEHIND_FIELDS = frozenset(("EQUAL", "DOT", "BRACKETED"))
_FOLLOWING = {
    "ID": "name",
    "STRING": "string",
    "NUMBER": "number",
    "UNSIGNED": "digit",
    "LBRACE": "{",
    "LESSTHAN": "<",
    "LPAR": "(",
    "BRACKETED": "[",
    "COMMA": ",",
    "_SEMI": ";",
    "COLON": ":",
    "MINUS": "-",
    "EQUAL": "=",
}
Start = tuple[str, tuple[Symbol, ...], bool]


class Grammar:
    """The rules of one language, with queries for statements."""

    def __init__(self, language: str) -> None:
        outputs: Lark = lark_parser(language)
        tables = build_tables(language)
        self.any_case: bool = tables["any_case"]
        self.terminals: dict[str, str] = {t: w for w, t in self._spelling(outputs, tables).items()}
        self._actions: list[dict[str, int]] = tables["actions"]
        self._rules: dict[str, list[tuple[tuple[Symbol, ...], str]]] = defaultdict(list)
        for rule in outputs.rules:
            self._rules[rule.origin.name].append((tuple(rule.expansion), rule.alias or ""))

    @staticmethod
    def _spelling(outputs: Lark, tables: dict[str, Any]) -> dict[str, str]:
        """The keywords as spelled in the grammar, by the names of their terminals."""
        known = set(tables["keywords"].values())
        return {t.pattern.value: t.name for t in outputs.terminals if t.name in known}

    def statements(self) -> dict[str, tuple[set[str], bool, bool]]:
        """By the first keyword (or none): the keywords after it, whether a block opens, legacy."""
        found: dict[str, tuple[set[str], bool, bool]] = {}
        items = [name for name in self._rules if name.endswith("_item")]
        for name in items:
            for first, rest, legacy in self._starts(name, (), False, ()):
                words, opens, old = found.get(first, (set(), False, True))
                words = words | self._reached(rest)
                opens = opens or any(symbol.name == "LBRACE" for symbol in rest)
                found[first] = (words, opens, old and legacy)
        return found

    def following(self, terminal: str) -> list[str]:
        """What may follow a keyword: `name`, `string`, `number` or punctuation."""
        after = {row[terminal] for row in self._actions if row.get(terminal, -1) >= 0}
        kinds = {kind for state in after for kind in self._actions[state]}
        if any(terminal == symbols[0].name for symbols, _ in self._rules.get(_FIELD_WORDS, ())):
            kinds = {"UNSIGNED" if kind == "NUMBER" else kind for kind in kinds - _BEHIND_FIELDS}
        kinds = {"ID" if kind in self.terminals else kind for kind in kinds}
        return sorted(_FOLLOWING[kind] for kind in kinds if kind in _FOLLOWING)

    def _starts(
        self, name: str, rest: tuple[Symbol, ...], legacy: bool, seen: tuple[str, ...]
    ) -> Iterator[Start]:
        if name in seen or name == _FIELD_WORDS:
            return
        for expansion, alias in self._rules[name]:
            old = legacy or (alias or name).startswith(("ignored_", "no_gui", "OLD_"))
            if not expansion:
                continue
            first, behind = expansion[0], (*expansion[1:], *rest)
            if not isinstance(first, Terminal):
                yield from self._starts(first.name, behind, old, (*seen, name))
            elif first.name in self.terminals:
                yield first.name, behind, old or first.name.startswith("OLD_")
            elif first.name in ("ID", "BRACKETED", "COLON"):
                yield "", behind, old

    def _reached(self, symbols: Sequence[Symbol]) -> set[str]:
        """The keywords of an expansion, up to the items of a block."""
        words: set[str] = set()
        seen: set[str] = set()
        todo = list(symbols)
        while todo:
            name = todo.pop().name
            if name in self.terminals:
                words.add(name)
            if name in seen or name.endswith("_item") or name == _FIELD_WORDS:
                continue
            seen.add(name)
            todo += [symbol for expansion, _ in self._rules.get(name, ()) for symbol in expansion]
        return words


def words(language: str) -> dict[str, Any]:
    """The table of one language."""
    grammar = Grammar(language)
    found = grammar.statements()
    plain = found.pop("", (set(), False, False))
    spelt = grammar.terminals
    types = [spelt[name] for name in spelt if name.endswith("_TYPE")]
    if language in ("idsl", "bdsl"):
        types = [*PRIMITIVES, *(["void"] if language == "idsl" else [])]
    return {
        "any_case": grammar.any_case,
        "keywords": {spelt[t]: grammar.following(t) for t in sorted(spelt, key=spelt.__getitem__)},
        "statements": {
            spelt[terminal]: {
                "opens": opens,
                "legacy": legacy,
                "inner": sorted(spelt[item] for item in inner),
                "values": list(VALUES.get(spelt[terminal], ())),
            }
            for terminal, (inner, opens, legacy) in sorted(found.items(), key=lambda i: spelt[i[0]])
        },
        "plain": sorted(spelt[item] for item in plain[0] if spelt[item] not in types),
        "types": sorted(types),
        "truth": list(_TRUTH.get(language, ())),
        "patterns": list(PATTERNS) if language == "idsl" else [],
        "durations": list(_DURATIONS.get(language, ())),
        "units": sorted(KNOWN) if language in ("idsl", "pdsl", "bdsl") else [],
    }


def table() -> dict[str, Any]:
    """The tables of all languages."""
    return {language: words(language) for language in NAMES}
