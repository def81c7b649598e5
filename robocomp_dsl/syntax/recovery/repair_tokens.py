"""Repairs of whole tokens: one is written twice, two are swapped, a keyword is missing.

In: the context of a syntax error and the tokens since the start of the statement. Out: possible
repairs, the most likely first. The statement is parsed again with the tokens in the right order.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import LOOK_BACK, WINDOW, ErrorContext, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair
from robocomp_dsl.syntax.recovery.repair_operands import declares_name

_BACK = 3
"""A mistake is at most this many tokens before the unexpected one."""

_FREQUENT = frozenset(
    (
        *("struct", "interface", "requires", "communications", "set", "initial_state"),
        *("component", "executable", "address"),
    )
)
"""Keywords that are suggested first where several fit."""

_ONCE = frozenset(
    (
        *("communications", "language", "gui", "period", "threads", "statemachine", "parameters"),
        *("initial_state", "end_state", "states", "transitions", "middleware", "clock"),
        *("address", "user", "labels", "config", "context", "from", "prefix", "executable"),
    )
)
"""Keywords of statements that a block has once, in lower case."""

_NOT_SUGGESTED = frozenset(("unsigned", "gui", "env"))
"""Keywords before a name that are omitted less often than the name behind them."""

_IN_COMMUNICATIONS = 2
"""Open braces where a name is an interface; elsewhere in a component it may be anything."""


def doubled_token(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """`int int x`, `module module M`, `=>=>`: a token twice in a row."""
    tokens, size = [*item, *context.lookahead], len(item)
    if not item:
        tokens, size = [context.previous, *tokens], 1
    for index in range(size, max(size - _BACK, 0), -1):
        first, second = tokens[index - 1], tokens[index]
        if first.text != second.text or second.kind == END or (not item and index < size):
            continue
        if second.kind == "LBRACE" and first.end < second.start:
            continue  # a block without its keyword
        again = index < size
        yield Repair(
            codes.UNEXPECTED,
            second.start,
            second.end,
            f"{quote_token(second)} is written twice",
            title=f"delete the second {quote_token(second)}",
            edits=((first.end, second.end, ""),),
            replacement=(*tokens[:index], *tokens[index + 1 : size]) if again else (),
            skip=0 if again else 1,
            keep=keep if again else 0,
            is_certain=second.text != ",",
            declares=second.text == "," and declares_name(context, item),
        )


def swapped_tokens(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """`state count;` instead of `count state;`: two neighbours in the wrong order."""
    size = len(item)
    for index in range(size, max(size - _BACK, -1), -1):
        yield from _swapped(context, item, keep, index)


def name_behind_parenthesis(
    context: ErrorContext, item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`void (stop int after);`: `void` is not the name of the operation."""
    texts = [token.text for token in item]
    if context.tables.language == "idsl" and "void" in texts[:-2]:
        index = texts.index("void") + 1
        if texts[index] == "(" and item[index + 1].kind == "ID":
            yield from _swapped(context, item, keep, index)


def _swapped(
    context: ErrorContext, item: Sequence[Token], keep: int, index: int
) -> Iterator[Repair]:
    """The tokens `index` and the next one of the statement and what follows, exchanged."""
    tokens, size = [*item, *context.lookahead], len(item)
    if index + 1 >= len(tokens) or tokens[index + 1].kind == END:
        return
    first, second = tokens[index : index + 2]
    if first.kind == second.kind:
        return
    pair = (
        Token(second.kind, second.text, first.start, first.end),
        Token(first.kind, first.text, second.start, second.end),
    )
    right = _swapped_text(context.source.text, first, second)
    # The statement may have been reduced as the wrong tokens demanded.
    again = bool(item)
    yield Repair(
        codes.UNEXPECTED,
        first.start,
        second.end,
        f"{quote_token(first)} and {quote_token(second)} are in the wrong order",
        title=f"write {quote_token(second)} before {quote_token(first)}",
        edits=((first.start, second.end, right),),
        replacement=(*tokens[:index], *pair, *tokens[index + 2 : size]) if again else pair,
        skip=max(index + 2 - size, 0),
        keep=keep if again else 0,
        required=WINDOW,
    )


def _swapped_text(text: str, first: Token, second: Token) -> str:
    """The range of both tokens with the tokens swapped and what stands between them."""
    between = text[first.end : second.start]
    before, behind = text[second.start : second.end], text[first.start : first.end]
    glued = not between and before[-1:].isidentifier() and behind[:1].isidentifier()
    return f"{before}{' ' if glued else between}{behind}"


def doubled_sign(context: ErrorContext, accepted: Sequence[str]) -> Iterator[Repair]:
    """`0::10`, where two signs without a blank between them are another sign."""
    token = context.lookahead[0]
    text = token.text[: len(token.text) // 2]
    kind = context.tables.punctuation.get(text, "")
    if kind in accepted and token.text == text * 2:
        yield Repair(
            codes.UNEXPECTED,
            token.start,
            token.end,
            f"`{text}` is written twice",
            title=f"write `{text}`",
            edits=((token.start, token.end, text),),
            replacement=(Token(kind, text, token.start, token.end),),
            skip=1,
            required=1,
            is_certain=True,
        )


def missing_first_keyword(
    context: ErrorContext, before: Sequence[Token], item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`Name { int a; };` without `struct`: the keyword at the start of the statement."""
    if item and len(item) < WINDOW:
        yield from _missing_keyword(
            context.replace(states=context.states[:keep], lookahead=(*item, *context.lookahead)),
            before,
            item,
            keep,
        )


def missing_keyword_between_names(context: ErrorContext) -> Iterator[Repair]:
    """`Idle => Busy started;` without `on`: types and states have a capital, other names do not."""
    first, second = context.previous.text[:1], context.lookahead[0].text[:1]
    if first.isupper() and second.islower() and context.lookahead[0].kind == "ID":
        yield from missing_keyword(context, ())


def missing_keyword(context: ErrorContext, before: Sequence[Token]) -> Iterator[Repair]:
    """`ready 2 s` without `within`: the keyword before the unexpected token."""
    yield from _missing_keyword(context, before, (), 0)


def _missing_keyword(
    context: ErrorContext, before: Sequence[Token], item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    token = context.lookahead[0]
    kind = _best_keyword(context, before)
    if not kind or token.kind in context.tables.keyword_terminals:
        return
    word = context.tables.terminal_texts[kind]
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        f"`{word}` is missing before {quote_token(token)}",
        title=f"add `{word}`",
        edits=((token.start, token.start, f"{word} "),),
        replacement=(Token(kind, word, token.start, token.start), *item),
        keep=keep,
        loses_names=True,
    )


def _best_keyword(context: ErrorContext, before: Sequence[Token]) -> str:
    """The keyword before the next token with which most of the tokens are accepted, or "".

    Of several: one that the block does not have yet, if it may have it once; the keyword of the
    statement `before`; a frequent one.
    """
    is_name = context.lookahead[0].kind == "ID" and context.tables.language == "cdsl"
    if is_name and len(context.open_braces) < _IN_COMMUNICATIONS:
        return ""
    following = [token.kind for token in context.lookahead]
    texts, words = context.tables.terminal_texts, context.tables.keyword_terminals
    used, last = _words_of_block(context), before[0].kind if before else ""

    def score(kind: str) -> tuple[int, bool, bool, bool]:
        word = texts[kind].lower()
        is_used = word in _ONCE and word in used
        accepted = context.count_accepted([kind, *following])
        return accepted, not is_used, kind == last, word in _FREQUENT

    scores = {
        kind: score(kind)
        for kind in context.accepted_terminals()
        if kind in words and texts.get(kind, "unsigned") not in _NOT_SUGGESTED
    }
    return max(scores, key=lambda kind: scores[kind], default="")


def _words_of_block(context: ErrorContext) -> frozenset[str]:
    """The words around the error in the innermost block, in lower case."""
    at = context.lookahead[0].start
    first = context.open_braces[-1].start if context.open_braces else 0
    near = context.source.text[max(first, at - LOOK_BACK) : context.lookahead[-1].end]
    return frozenset(re.findall(r"\w+", near.lower()))
