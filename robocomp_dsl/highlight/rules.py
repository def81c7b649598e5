"""How a text of a language is coloured: a small machine of contexts, the same for all editors.

In: the words of a language. Out: contexts of rules. The first rule that matches wins; it gives
styles, and pushes a context or goes back to the one before. The expressions keep to what Python,
Oniguruma and PCRE read alike, and none but that of a context spans lines.

A statement is a context of its own, so a keyword is one only where it begins a statement, or behind
the keyword that it belongs to; elsewhere it is a name, as for the parser.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from robocomp_dsl.highlight.table import Statement, Words

NAME = r"[A-Za-z_]\w*"
_NUMBER = r"0[xX][0-9a-fA-F]+|[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_BEHIND = {"name": "[A-Za-z_]", "string": '"', "number": r"[-+.\d]"}
_IN_BRACES = r"\{[\w\s,]*\}"
PLAIN = "plain"


@dataclass(frozen=True, slots=True)
class Rule:
    """What to do where `pattern` matches; `styles` are those of its groups, or of all of it."""

    pattern: str
    styles: tuple[str, ...] = ()
    push: str = ""
    pop: bool = False


@dataclass(frozen=True, slots=True)
class Context:
    """Rules, and the style of what none of them matches."""

    rules: tuple[Rule, ...]
    style: str = ""


def contexts(words: Words) -> dict[str, Context]:
    """The contexts of a language by name; `root` is where a text begins."""
    statements = {one.word: _statement(words, one) for one in words.statements}
    starts = [_start(words, one) for one in words.statements]
    first = "field" if words.language == "pdsl" else ""
    plain = Rule(NAME, (first,), PLAIN) if first else Rule(rf"(?={NAME}|[\[:])", (), PLAIN)
    root = (*_COMMENTS, *starts, plain, *_LITERALS, Rule("[{};,]", ("punctuation",)))
    return {
        "root": Context(root),
        "comment": Context((Rule(r"\*/", ("comment",), pop=True),), "comment"),
        "doc": Context((Rule(r"\*/", ("doc",), pop=True),), "doc"),
        PLAIN: _statement(words, Statement(PLAIN, False, False, words.plain, ())),
        **statements,
    }


_COMMENTS = (
    Rule(r"/\*\*(?![*/<])", ("doc",), "doc"),
    Rule(r"///(?![/<]).*", ("doc",)),
    Rule(r"/\*", ("comment",), "comment"),
    Rule(r"//.*", ("comment",)),
    Rule(r"#.*", ("comment",)),
)
_LITERALS = (
    Rule(r'"(?:[^"\\\n]|\\.)*"?', ("string",)),
    Rule(rf"\b(?:{_NUMBER})\b|[+-](?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|\.\d+", ("number",)),
)


def _start(words: Words, one: Statement) -> Rule:
    """The rule for the first word of a statement."""
    style = "legacy" if one.legacy else "declaration" if one.opens else "keyword"
    begin = rf"\b({one.word})\b" + _ahead(words.keywords[one.word])
    if one.opens and "name" in words.keywords[one.word] and one.word != "connect":
        return Rule(_case(words, rf"{begin}(?:(\s+)({NAME}))?"), (style, "", "name"), one.word)
    return Rule(_case(words, begin), (style,), one.word)


def _statement(words: Words, one: Statement) -> Context:
    """What stands behind the first word, up to `;` or a brace."""
    braces = rf"(?=\}}|\{{(?!{_IN_BRACES[2:]}))" if words.language == "pdsl" else "(?=[{}])"
    rules = [
        *_COMMENTS,
        Rule(";", ("punctuation",), pop=True),
        Rule(braces, pop=True),
        *([Rule(_IN_BRACES, ("value",))] if words.language == "pdsl" else []),
        *_brackets(words),
        *_durations(words),
        _LITERALS[0],
        *_listed(words, one.values, "value"),
        *(Rule(_inner(words, word), ("modifier",)) for word in one.inner),
        *_listed(words, words.truth, "truth"),
        *_types(words),
        _LITERALS[1],
        *([Rule(rf"{NAME}(?=\s*\()", ("function",))] if words.language == "idsl" else []),
        Rule(NAME, ("text",)),
        Rule(r"->|=>|::|[=:<>+.-]", ("operator",)),
        Rule(r"[(),\[\]]", ("punctuation",)),
    ]
    return Context(tuple(rules))


def _inner(words: Words, word: str) -> str:
    """A keyword behind the first."""
    return _case(words, rf"(?<![.\w]){word}(?![.\w])" + _ahead(words.keywords[word]))


def _types(words: Words) -> Iterable[Rule]:
    """Built-in types; in IDSL only where a name or another type follows."""
    ahead = r"(?=\s+[A-Za-z_]|\s*[<>,)]|\s*$)" if words.language == "idsl" else r"(?![.\w])"
    if words.types:
        yield Rule(_case(words, rf"(?<![.\w])(?:{'|'.join(words.types)})\b{ahead}"), ("type",))


def _brackets(words: Words) -> Iterable[Rule]:
    """Patterns, numbers of groups, and units."""
    if words.patterns:
        yield Rule(rf"\[\s*(?:{'|'.join(words.patterns)})\s*\]", ("pattern",))
    if words.units:
        yield Rule(r"\[[\d\s:]*\]", ("number",))
        yield Rule(r"\[[^\[\]\n]*\]", ("unit",))


def _durations(words: Words) -> Iterable[Rule]:
    if words.durations:
        units = "|".join(sorted(words.durations, key=len, reverse=True))
        yield Rule(_case(words, rf"\b(\d+\.?\d*\s*)({units})\b"), ("number", "unit"))


def _listed(words: Words, listed: Iterable[str], style: str) -> Iterable[Rule]:
    longest = sorted(map(re.escape, listed), key=len, reverse=True)
    if longest:
        yield Rule(_case(words, rf"(?<![.\w])(?:{'|'.join(longest)})(?![.\w])"), (style,))


def _case(words: Words, pattern: str) -> str:
    return f"(?i){pattern}" if words.any_case else pattern


def _ahead(behind: Iterable[str]) -> str:
    """What must follow a keyword on its line, if anything does."""
    chars = "|".join(sorted(_BEHIND.get(one, re.escape(one)) for one in behind))
    return rf"(?=\s*(?:{chars}|/[/*]|$))"
