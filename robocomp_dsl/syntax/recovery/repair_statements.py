"""Repairs across the end of a statement: a token stands on the wrong side of the `;`.

In: the context of a syntax error, the tokens since the start of the statement and those of the
statement before it. Out: possible repairs. The statement before is already part of the tree.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import WINDOW, ErrorContext, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair
from robocomp_dsl.syntax.recovery.repair_operands import declares_name


def token_behind_semicolon(
    context: ErrorContext, before: Sequence[Token], item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`speed float 1 ;live`: the first token of a statement ends the one `before` it.

    Only if it is on the line of the `;` and nothing else is, or if nothing can begin with it.
    """
    if len(before) < 2 or before[-1].kind != "_SEMI":
        return
    semicolon = before[-1]
    token, *rest = (*item, *context.lookahead)
    following = rest[0] if rest else token
    text = context.source.text
    is_alone = "\n" in text[token.end : following.start] or following.kind == "RBRACE"
    if token.kind == END or "\n" in text[semicolon.end : token.start] or not is_alone:
        return
    if context.states_after(keep, (*before[:-1], token, semicolon)) is None:
        return
    yield Repair(
        codes.UNEXPECTED,
        semicolon.start,
        token.end,
        f"{quote_token(semicolon)} and {quote_token(token)} are in the wrong order",
        title=f"write {quote_token(token)} before {quote_token(semicolon)}",
        edits=(
            (semicolon.start, semicolon.start, f" {token.text}"),
            (token.start, token.end, ""),
        ),
        replacement=tuple(item[1:]),
        skip=0 if item else 1,
        keep=keep if item else 0,
        required=1,
        since=before[0].start,
        declares=declares_name(context, before[:-1]),
    )


def token_before_semicolon(
    context: ErrorContext, before: Sequence[Token], item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`speed float 1 turn ; float 2;`: the last token of the statement `before` begins the next.

    Only if a blank or a line break is between the two, as it was behind the `;`.
    """
    if item or len(before) < 3 or before[-1].kind != "_SEMI" or before[-2].kind != "ID":
        return
    token, semicolon = before[-2:]
    if token.end == semicolon.start or token.text.lower() in ("true", "false"):
        return
    if context.states_after(keep, (*before[:-2], semicolon)) is None:
        return
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        semicolon.end,
        f"{quote_token(token)} and {quote_token(semicolon)} are in the wrong order",
        title=f"write {quote_token(semicolon)} before {quote_token(token)}",
        edits=(
            (before[-3].end, before[-3].end, semicolon.text),
            (semicolon.start, semicolon.end, ""),
        ),
        replacement=(Token("ID", token.text, semicolon.start, semicolon.end),),
        required=WINDOW,
        since=before[0].start,
    )
