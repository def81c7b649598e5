"""Builds parse tables from the Lark grammars.

In: the name of a grammar. Out: the data that `tables.load` reads. The command `python -m
robocomp_dsl.syntax.grammar.build_tables` writes it to `grammars/tables`. States are numbered in
breadth-first order over sorted symbols, so the output is reproducible.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator
from typing import Any

from lark import Lark
from lark.grammar import Rule, Terminal
from lark.lexer import PatternStr, TerminalDef
from lark.parsers.lalr_analysis import Shift

from robocomp_dsl.resources import GRAMMARS
from robocomp_dsl.syntax.grammar.grammar_file import END, fingerprint

LANGUAGES = ("idsl", "cdsl", "pdsl", "ddsl", "smdsl", "bdsl")
XML = "innermodel"
START = "start"
_WORD = re.compile(r"[A-Za-z_]\w*")

# The scanner also matches merge conflict markers, malformed strings and comments (to report them
# well), and punctuation, which differs between the languages.
_FIRST = {"MERGE_MARK": r"^(?:<{7}|\|{7}|={7}|>{7})(?=[ \r\n]|\Z)[^\n]*"}
_LAST = {
    "SIGN": r"->|=>|::|&&|\|\||[!-/:-@\[-`{-~]",
    "STRAY": r"\S",
}
_COMPARISONS = ("==", "!=", "<=", ">=")
"""Punctuation of the languages that compare values; `vector<int>=` is no comparison in others."""
_MISSPELT = {
    "OTHER_QUOTES": r"'[^'\n]*'|[“”„][^“”„\n]*[“”]",
    "OPEN_STRING": r'"[^"\n]*?(?=\s*[;,]?\s*$)',
    "OPEN_COMMENT": r"/\*",
}


def lark_parser(language: str) -> Lark:
    """Lark's own parser of the grammar, the reference in the tests."""
    return Lark(
        (GRAMMARS / f"{language}.lark").read_text(encoding="utf-8"),
        parser="lalr",
        lexer="contextual",
        maybe_placeholders=True,
        import_paths=[str(GRAMMARS)],
    )


def build_tables(language: str) -> dict[str, Any]:
    """The tables of one grammar as JSON-compatible data."""
    grammar = lark_parser(language)
    table = grammar.parser.parser._parse_table
    rules = {rule: number for number, rule in enumerate(grammar.rules)}
    order = _numbering(table.states, table.start_states[START])
    actions: list[dict[str, int]] = []
    gotos: list[dict[str, int]] = []
    for state in order:
        row = sorted(table.states[state].items())
        shifts = {s: order[to] for s, (act, to) in row if act is Shift}
        reduces = {s: -1 - rules[rule] for s, (act, rule) in row if act is not Shift}
        actions.append({s: to for s, to in shifts.items() if _is_terminal(s)} | reduces)
        gotos.append({s: to for s, to in shifts.items() if not _is_terminal(s)})
    _skip_unit_rules(actions, gotos, grammar.rules)
    keywords = {t.pattern.value: t for t in grammar.terminals if _is_keyword(t)}
    any_case = all("i" in t.pattern.flags for t in keywords.values())
    return {
        "language": language,
        "fingerprint": fingerprint(language),
        "accept": order[table.end_states[START]],
        "any_case": any_case,
        "keywords": {w.lower() if any_case else w: t.name for w, t in keywords.items()},
        "texts": {t.name: t.pattern.value for t in grammar.terminals if _is_text(t)}
        | {"_SEMI": ";"},
        "scanner": _scanner(grammar.terminals),
        "rules": [_rule(rule) for rule in grammar.rules],
        "actions": actions,
        "gotos": gotos,
    }


def _skip_unit_rules(
    actions: list[dict[str, int]], gotos: list[dict[str, int]], rules: list[Rule]
) -> None:
    """Lead a goto past each state that can only replace its symbol by another one.

    `?type: qualified` has no action besides: whatever follows, the state after `qualified` becomes
    the state after `type`. A quarter of all reductions are of this kind.
    """
    following = {
        state: rules[-1 - next(iter(numbers))].origin.name
        for state, row in enumerate(actions)
        if len(numbers := set(row.values())) == 1
        and max(numbers) < 0
        and _keeps_value(rules[-1 - min(numbers)])
    }
    for row in gotos:
        for symbol in row:
            while row[symbol] in following:
                row[symbol] = row[following[row[symbol]]]


def _keeps_value(rule: Rule) -> bool:
    """Whether the value of its only symbol is that of the rule."""
    _, length, method, unwraps, picks = _rule(rule)
    return length == 1 and not method and (unwraps or picks == [[0, "", True]])


def _is_terminal(symbol: str) -> bool:
    return symbol == END or not symbol.lstrip("_")[0].islower()


def _is_text(terminal: TerminalDef) -> bool:
    return isinstance(terminal.pattern, PatternStr)


def _is_keyword(terminal: TerminalDef) -> bool:
    return _is_text(terminal) and bool(_WORD.fullmatch(terminal.pattern.value))


def _numbering(states: dict[int, dict[str, Any]], start: int) -> dict[int, int]:
    """Lark's state number to our state number, breadth first; the start is 0."""
    order = {start: 0}
    todo = [start]
    for state in todo:
        for _, (action, to) in sorted(states[state].items(), key=lambda item: item[0]):
            if action is Shift and to not in order:
                order[to] = len(order)
                todo.append(to)
    return order


def _scanner(own: Collection[TerminalDef]) -> str:
    """One regular expression for the tokens of a language; the matching group is the terminal.

    Compiling it takes as long as parsing two hundred lines, so all languages share it, except one
    that defines a terminal of `terminals.lark` itself, or compares values.
    """
    shared = (GRAMMARS / "terminals.lark").read_text(encoding="utf-8")
    names = [name for name in re.findall(r"^(\w+)[.\d]*:", shared, re.MULTILINE) if name != "WS"]
    used = f"%import .terminals ({', '.join(names)})\nstart: ({' | '.join(names)})*"
    terminals = Lark(used, parser="lalr", import_paths=[str(GRAMMARS)]).terminals
    ranked = sorted(terminals, key=lambda terminal: -terminal.priority)
    tokens = {t.name: t.pattern.to_regexp() for t in ranked}
    tokens |= {t.name: t.pattern.to_regexp() for t in own if t.name in tokens}
    groups = _FIRST | tokens | _MISSPELT | _LAST
    written = {terminal.pattern.value for terminal in own if _is_text(terminal)}
    if written.issuperset(_COMPARISONS):
        groups["SIGN"] = "|".join((*_COMPARISONS, groups["SIGN"]))
    return r"\s*(?:" + "|".join(f"(?P<{name}>{regexp})" for name, regexp in groups.items()) + ")"


def _rule(rule: Rule) -> list[Any]:
    picks = list(_picks(rule))
    inline = rule.origin.name.startswith("_")
    unwraps = bool(
        rule.options.expand1 and not rule.alias and len(picks) == 1 and not any(picks[0][1:])
    )
    method = "" if inline or unwraps else rule.alias or rule.origin.name
    return [rule.origin.name, len(rule.expansion), method, unwraps, picks]


def _picks(rule: Rule) -> Iterator[list[Any]]:
    """The children of a rule without filtered-out terminals; None for an absent `[x]`."""
    absent = rule.options.empty_indices or (False,) * len(rule.expansion)
    index = 0
    for empty in absent:
        if empty:
            yield [-1, "", False]
            continue
        symbol = rule.expansion[index]
        if isinstance(symbol, Terminal):
            if not symbol.filter_out:
                yield [index, symbol.name, False]
        else:
            yield [index, "", symbol.name.startswith("_")]
        index += 1


def build_xml_tables() -> dict[str, Any]:
    """The terminals of the XML grammar outside and inside tags: see `xml_tokens`."""
    grammar = lark_parser(XML)
    contextual: Any = grammar.parser.lexer
    table = grammar.parser.parser._parse_table
    outside = table.start_states[START]
    inside = table.states[outside]["OPEN"][1]
    return {
        "language": XML,
        "fingerprint": fingerprint(XML),
        "outside": _alternatives(contextual.lexers[outside].terminals),
        "inside": _alternatives(contextual.lexers[inside].terminals),
        "ignored": sorted(grammar.ignore_tokens),
    }


def _alternatives(terminals: list[TerminalDef]) -> str:
    """One regular expression for terminals, in the order in which Lark tries them."""
    return "|".join(
        f"(?P<{terminal.name}>{terminal.pattern.to_regexp()})" for terminal in terminals
    )


def main() -> None:
    """Write the tables of all grammars."""
    folder = GRAMMARS / "tables"
    folder.mkdir(exist_ok=True)
    all_tables = {language: build_tables(language) for language in LANGUAGES} | {
        XML: build_xml_tables()
    }
    for language, tables in all_tables.items():
        text = json.dumps(tables, indent=None, separators=(",", ":"))
        (folder / f"{language}.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
