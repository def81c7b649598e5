"""Repairs of missing operands: a name, a text or a number was omitted.

In: the context of a syntax error and the tokens since the start of the statement. Out: possible
repairs, the most likely first. A placeholder takes the place of what is missing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import takewhile

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair

_BACK = 3
"""The operand is missing at most this many tokens before the unexpected one."""

_PLACEHOLDERS = {"ID": "?", "STRING": '""', "NUMBER": "1"}
_NOUNS = {"ID": "a name", "STRING": 'a "string"', "NUMBER": "a number"}

_STATEMENT_ENDS = ("_SEMI", "LBRACE", "RBRACE")

_DECLARING = {
    "idsl": frozenset(("import", "module", "struct", "exception", "enum", "interface", ">")),
    "cdsl": frozenset(("import",)),
    "bdsl": frozenset(("import", "input", "hub", "function", "service")),
    "ddsl": frozenset(
        (
            *("import", "component", "host", "program", "device", "extern", "group", "labels"),
            *("export", "as"),
        )
    ),
    "smdsl": frozenset(("states", "initial_state", "end_state")),
}
"""Language to the words, in lower case, before the name of a declaration that is used elsewhere."""


def missing_operand(context: ErrorContext, accepted: Sequence[str]) -> Iterator[Repair]:
    """`import ;`, `struct { … };`: an operand is missing before the unexpected token."""
    yield from _missing(context, (), 0, accepted)


def missing_operand_before_keyword(
    context: ErrorContext, item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`Idle => on started;`, `implements as other;`: the keyword behind it was read as a name."""
    size = len(item)
    for index in range(size - 1, max(size - _BACK, 0), -1):
        if item[index].kind not in context.tables.keyword_terminals:
            continue
        states = context.states_after(keep, item[:index])
        if states is None:
            continue
        there = context.replace(
            states=states,
            previous=item[index - 1],
            lookahead=(*item[index:], *context.lookahead),
        )
        yield from _missing(there, item[:index], keep, there.accepted_terminals(), size - index)


def _missing(
    context: ErrorContext,
    before: Sequence[Token],
    keep: int,
    accepted: Sequence[str],
    back: int = 0,
) -> Iterator[Repair]:
    """A placeholder before the next token; `back` of the next tokens were read already."""
    token, before_it = context.lookahead[0], context.previous
    if token.kind == "STRAY":
        return
    begins = not before and before_it.kind in _STATEMENT_ENDS
    at = token.start if begins and token.kind != END else before_it.end
    missing = [kind for kind in _PLACEHOLDERS if kind in accepted and kind != token.kind]
    place = f"before {quote_token(token)}" if begins else f"after {quote_token(before_it)}"
    is_clear = len(missing) == 1 and before_it.kind != "NUMBER"
    for kind in missing:
        yield Repair(
            codes.UNEXPECTED,
            token.start if token.kind != END else at,
            token.end if token.kind != END else at,
            f"{_NOUNS[kind]} is missing {place}" if is_clear else "",
            replacement=(
                *before,
                Token(kind, _PLACEHOLDERS[kind], at, at),
                *context.lookahead[:back],
            ),
            keep=keep,
            declares=declares_name(context, before or (before_it,)),
            loses_names=True,
        )


def declares_name(context: ErrorContext, before: Sequence[Token]) -> bool:
    """Whether a name behind these tokens of a statement is that of a declaration."""
    words = _DECLARING.get(context.tables.language, frozenset())
    ends = (before[0].text.lower(), before[-1].text.lower()) if before else ()
    return not words.isdisjoint(ends)


def missing_type(
    context: ErrorContext, item: Sequence[Token], accepted: Sequence[str]
) -> Iterator[Repair]:
    """`rate 50 [Hz];` without `float`: the type of a parameter, as its default shows it."""
    token, at = context.lookahead[0], context.previous.end
    if context.tables.language != "pdsl" or len(item) != 1 or "FLOAT_TYPE" not in accepted:
        return
    rest = list(takewhile(lambda token: token.kind not in _STATEMENT_ENDS, context.lookahead))
    if token.kind == "STRING":
        word = "string"
    elif token.kind == "NUMBER" or token.text == ":":
        is_whole = all(t.text.lstrip("+-").isdecimal() for t in rest if t.kind == "NUMBER")
        has_unit = any(t.kind == "BRACKETED" for t in rest)
        word = "int" if is_whole and not has_unit else "float"
    else:
        return
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        f"`{word}` is missing after {quote_token(context.previous)}",
        title=f"add `{word}`",
        edits=((at, at, f" {word}"),),
        replacement=(Token(f"{word.upper()}_TYPE", word, at, at),),
    )
