"""Highlighting rules: a stack machine of contexts, common to all editors.

In: the keywords of a language. Out: contexts of rules. The first matching rule wins; it assigns
styles, and pushes a context or pops the current one. The expressions use only syntax that Python,
Oniguruma and PCRE share, and only contexts span lines.

Each statement is a context, so a word is a keyword only at the start of a statement or after the
keyword that it belongs to; elsewhere it is a name, as in the parser.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from robocomp_dsl.highlight.table import StatementKeywords, Words

NAME = r"[A-Za-z_]\w*"
_NUMBER = r"0[xX][0-9a-fA-F]+|[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_BEHIND = {"name": "[A-Za-z_]", "string": '"', "number": r"[-+.\d]", "digit": r"\.?\d"}
_IN_BRACES = r"\{[\w\s,]*\}"
_OPERATOR = r"->|=>|::|&&|\|\||[=:<>+.!-]"
_OPERATORS = {"bdsl": r"->|::|[=:+*/.-]"}
"""The operators of languages with expressions."""

PLAIN = "plain"


_BEHIND_TYPE = {
    "idsl": r"(?=\s+[A-Za-z_]|\s*[<>,)]|\s*$)",
    "bdsl": r"(?=\s+[A-Za-z_]|\s*[\[;{]|\s*$)",
}


@dataclass(frozen=True, slots=True)
class HighlightRule:
    """A pattern with the styles of its groups (or of the whole match) and its effect."""

    pattern: str
    styles: tuple[str, ...] = ()
    push: str = ""
    pop: bool = False


@dataclass(frozen=True, slots=True)
class Context:
    """Rules, and the style of text that no rule matches."""

    rules: tuple[HighlightRule, ...]
    style: str = ""


def contexts(words: Words) -> dict[str, Context]:
    """The contexts of a language by name; the initial context is `root`."""
    statements = {statement.word: _statement(words, statement) for statement in words.statements}
    starts = [_start(words, statement) for statement in words.statements]
    first = "field" if words.language == "pdsl" else ""
    plain = (
        HighlightRule(NAME, (first,), PLAIN)
        if first
        else HighlightRule(rf"(?={NAME}|[\[:])", (), PLAIN)
    )
    root = (*_COMMENTS, *starts, plain, *_LITERALS, HighlightRule("[{};,]", ("punctuation",)))
    return {
        "root": Context(root),
        "comment": Context((HighlightRule(r"\*/", ("comment",), pop=True),), "comment"),
        "doc": Context((HighlightRule(r"\*/", ("doc",), pop=True),), "doc"),
        PLAIN: _statement(words, StatementKeywords(PLAIN, False, False, words.plain, ())),
        **statements,
    }


_COMMENTS = (
    HighlightRule(r"/\*\*(?![*/<])", ("doc",), "doc"),
    HighlightRule(r"///(?![/<]).*", ("doc",)),
    HighlightRule(r"/\*", ("comment",), "comment"),
    HighlightRule(r"//.*", ("comment",)),
    HighlightRule(r"#.*", ("comment",)),
)
_LITERALS = (
    HighlightRule(r'"(?:[^"\\\n]|\\.)*"?', ("string",)),
    HighlightRule(
        rf"\b(?:{_NUMBER})\b|[+-](?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|\.\d+", ("number",)
    ),
)


def _start(words: Words, item: StatementKeywords) -> HighlightRule:
    """The rule for the first word of a statement."""
    style = "legacy" if item.legacy else "declaration" if item.opens else "keyword"
    begin = rf"\b({item.word})\b" + _ahead(words.keywords[item.word])
    if item.opens and "name" in words.keywords[item.word] and item.word != "connect":
        return HighlightRule(
            _case(words, rf"{begin}(?:(\s+)({NAME}))?"), (style, "", "name"), item.word
        )
    return HighlightRule(_case(words, begin), (style,), item.word)


def _statement(words: Words, item: StatementKeywords) -> Context:
    """The context after the first word of a statement, up to `;` or a brace."""
    braces = rf"(?=\}}|\{{(?!{_IN_BRACES[2:]}))" if words.language == "pdsl" else "(?=[{}])"
    rules = [
        *_COMMENTS,
        HighlightRule(";", ("punctuation",), pop=True),
        HighlightRule(braces, pop=True),
        *([HighlightRule(_IN_BRACES, ("value",))] if words.language == "pdsl" else []),
        *_brackets(words),
        *_durations(words),
        _LITERALS[0],
        *_listed(words, item.values, "value"),
        *(HighlightRule(_inner(words, word), ("modifier",)) for word in item.inner),
        *_listed(words, words.truth, "truth"),
        *_types(words),
        _LITERALS[1],
        *_functions(words),
        HighlightRule(NAME, ("text",)),
        HighlightRule(_OPERATORS.get(words.language, _OPERATOR), ("operator",)),
        HighlightRule(r"[(),\[\]]", ("punctuation",)),
    ]
    return Context(tuple(rules))


def _inner(words: Words, word: str) -> str:
    """The pattern of a keyword inside a statement."""
    return _case(words, rf"(?<![.\w]){word}(?![.\w])" + _ahead(words.keywords[word]))


def _types(words: Words) -> Iterable[HighlightRule]:
    """Built-in types; in IDSL and BDSL only where something follows that may follow a type."""
    ahead = _BEHIND_TYPE.get(words.language, r"(?![.\w])")
    if words.types:
        yield HighlightRule(
            _case(words, rf"(?<![.\w])(?:{'|'.join(words.types)})\b{ahead}"), ("type",)
        )


def _functions(words: Words) -> Iterable[HighlightRule]:
    """Names before a parenthesis, in the languages with operations or functions."""
    if words.language in ("idsl", "bdsl"):
        yield HighlightRule(rf"{NAME}(?=\s*\()", ("function",))


def _brackets(words: Words) -> Iterable[HighlightRule]:
    """Operation patterns, counts of groups, and units."""
    if words.patterns:
        yield HighlightRule(rf"\[\s*(?:{'|'.join(words.patterns)})\s*\]", ("pattern",))
    if words.units:
        numbers = r"\[[\d\s:,]*\]" if words.language == "bdsl" else r"\[[\d\s:]*\]"
        yield HighlightRule(numbers, ("number",))
        yield HighlightRule(r"\[[^\[\]\n]*\]", ("unit",))


def _durations(words: Words) -> Iterable[HighlightRule]:
    if words.durations:
        units = "|".join(sorted(words.durations, key=len, reverse=True))
        yield HighlightRule(_case(words, rf"\b(\d+\.?\d*\s*)({units})\b"), ("number", "unit"))


def _listed(words: Words, listed: Iterable[str], style: str) -> Iterable[HighlightRule]:
    longest = sorted(map(re.escape, listed), key=len, reverse=True)
    if longest:
        yield HighlightRule(_case(words, rf"(?<![.\w])(?:{'|'.join(longest)})(?![.\w])"), (style,))


def _case(words: Words, pattern: str) -> str:
    return f"(?i){pattern}" if words.any_case else pattern


def _ahead(followers: Iterable[str]) -> str:
    """A lookahead for what may follow a keyword on its line."""
    chars = "|".join(sorted(_BEHIND.get(item, re.escape(item)) for item in followers))
    return rf"(?=\s*(?:{chars}|/[/*]|$))"
