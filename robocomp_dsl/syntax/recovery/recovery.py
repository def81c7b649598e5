"""Error recovery: a small repair if there is one, else the faulty statement is skipped.

In: the parser state; the unexpected token is the next of its stream. Out: a diagnostic, and the
parser in a state in which parsing can continue.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import takewhile

from robocomp_dsl.diagnostics import Report, UncertainText
from robocomp_dsl.syntax.ast.node import Node
from robocomp_dsl.syntax.codes import file as codes
from robocomp_dsl.syntax.codes.legacy import EMPTY_STATEMENT
from robocomp_dsl.syntax.file_diagnostics import FileDiagnostics
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Lexer, Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState
from robocomp_dsl.syntax.grammar.reductions import StackEntry
from robocomp_dsl.syntax.grammar.token_stream import Unrecoverable
from robocomp_dsl.syntax.recovery.error_context import (
    LOOK_BACK,
    ErrorContext,
    describe_expected,
    quote_token,
)
from robocomp_dsl.syntax.recovery.repair import Repair, panic_mode, trailing_text
from robocomp_dsl.syntax.recovery.repair_choice import all_repairs, choose_repair

LOOK_AHEAD = 24
_STATEMENT_ENDS = ("_SEMI", "LBRACE", "RBRACE", END)
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_NAME = re.compile(r"[A-Za-z_]\w*")

MAX_SUPPRESSED = 500
"""Consecutive follow-on errors after which the rest of the file is skipped."""


def recover(parser: ParserState) -> None:
    """Report the unexpected token and bring the parser to a state in which it can continue."""
    try:
        _correct_or_drop(parser)
    except Unrecoverable as garbage:
        at = garbage.last.start
        message = "too many syntax errors; the rest of the file is skipped"
        parser.findings.add(codes.UNRECOVERABLE, at, garbage.last.end, message)
        parser.truncate(at)


def _correct_or_drop(parser: ParserState) -> None:
    _complete_statement(parser)
    base, item = _statement(parser)
    begun = len(parser.stack) > base + 1
    context = _error_context(parser)
    outside = parser.builder.has_block and not context.open_braces and not context.is_single_stray()
    if outside and (not begun or (item and item[0].kind == "ID")):
        _skip_trailing_text(parser, context, item, base)
        return
    start = (item or context.lookahead)[0].start
    _note_dependence(parser, context, start)
    before = _statement_before(parser, base, start)
    repair = choose_repair(context, all_repairs(context, before, item, base + 1))
    if repair:
        _report(parser, context, repair, start, _end_of_statement(context, item))
        _apply(parser, repair)
    else:
        repair = panic_mode(context, item)
        end = start
        try:
            end = _skip_statement(parser, context, base)
        finally:
            _report(parser, context, repair, start, end)
    if parser.findings.too_many_errors and not parser.findings.is_truncated:
        parser.truncate(context.lookahead[0].start)


def _complete_statement(parser: ParserState) -> None:
    """Reduce everything that is complete whatever follows, so that recovery does not drop it."""
    while True:
        following = set(parser.tables.actions[parser.stack[-1][0]].values())
        if len(following) != 1 or max(following) >= 0:
            return
        parser.reduce(-1 - following.pop(), parser.stack[-1][3])


def _statement(parser: ParserState) -> tuple[int, list[Token]]:
    """The stack entry before the statement, and the tokens of the statement so far."""
    stack, restarts = parser.stack, parser.tables.item_states
    base = max(i for i, entry in enumerate(stack) if entry[0] in restarts)
    begun = len(stack) > base + 1
    return base, _tokens_since(parser, stack[base + 1][2]) if begun else []


def _tokens_since(parser: ParserState, start: int) -> list[Token]:
    """The tokens shifted since the one that begins at `start`, if they are still stored.

    Empty for an item that contains a block with statements: such an item is not parsed again.
    """
    item = [token for token in parser.recent_tokens if token.start >= start]
    kinds = [token.kind for token in item]
    if "RBRACE" in kinds and "_SEMI" in kinds[: kinds.index("RBRACE")]:
        return []
    return item if item and item[0].start == start else []


def _statement_before(parser: ParserState, base: int, end: int) -> list[Token]:
    """The tokens of the statement that ends before `end`; none if it is long or has a block."""
    items, source = parser.stack[base][1], parser.findings.source
    last = items[-1] if isinstance(items, list) and items else None
    start = last.span.start if isinstance(last, Node) else _last_boundary(source.text, end)
    if not 0 < end - start <= LOOK_BACK:
        return []
    lexer = Lexer(source, parser.tables, FileDiagnostics(source, Report()))
    return list(takewhile(lambda token: token.start < end, lexer.tokens(start)))


def _last_boundary(text: str, end: int) -> int:
    """Behind the `;` or brace before the `;` before `end`; maybe one in a comment."""
    semicolon = text.rfind(";", 0, end)
    return max(text.rfind(sign, 0, max(semicolon, 0)) for sign in ";{}") + 1


def _error_context(parser: ParserState) -> ErrorContext:
    return ErrorContext(
        tables=parser.tables,
        source=parser.findings.source,
        states=[entry[0] for entry in parser.stack],
        previous=parser.recent_tokens[-1] if parser.recent_tokens else Token("", "", 0, 0),
        lookahead=parser.stream.peek(LOOK_AHEAD),
        open_braces=_opened(parser.stack),
        lone_semicolons=_lone_semicolons(parser.findings),
    )


def _lone_semicolons(findings: FileDiagnostics) -> list[int]:
    """The offsets of superfluous `;` behind a blank: what is left of `};` without its brace."""
    text = findings.source.text
    ends = (found.span.end for found in findings.report if found.code is EMPTY_STATEMENT)
    return [end - 1 for end in ends if text[max(end - 2, 0)].isspace()]


def _opened(entries: list[StackEntry]) -> list[Token]:
    """The open braces among the entries."""
    opened: list[Token] = []
    for _, value, _, _ in entries:
        if isinstance(value, Token) and value.kind == "LBRACE":
            opened.append(value)
        elif isinstance(value, Token) and value.kind == "RBRACE":
            del opened[-1:]
    return opened


def _report(
    parser: ParserState, context: ErrorContext, repair: Repair, start: int, end: int
) -> None:
    """Report the error, unless no token was accepted since the last one (a follow-on error).

    [start, end) is the statement with the error.
    """
    cut = context.lookahead[0].kind == END and parser.findings.is_truncated
    if parser.last_reported_end == context.previous.end:
        parser.suppressed += 1
        if parser.suppressed > MAX_SUPPRESSED and context.lookahead[0].kind != END:
            raise Unrecoverable(context.lookahead[0])
    else:
        parser.suppressed = 0
    if not parser.suppressed and not cut:
        expected = describe_expected(context, parser.builder.ITEM_NAMES)
        repair.report(
            parser.findings,
            f"expected {expected}, found {quote_token(context.lookahead[0])}",
            _uncertain_text(context, repair, start, max(start, end)),
        )
    parser.last_reported_end = -1 if repair.replacement else context.previous.end


def _uncertain_text(context: ErrorContext, repair: Repair, start: int, end: int) -> UncertainText:
    """What is uncertain about the statement [start, end) after the repair."""
    if repair.is_certain:
        return UncertainText(context.source.span(start, start))
    previous, text = context.previous, context.source.text
    if 0 <= repair.since < start:
        start = repair.since
    elif previous.kind == "LBRACE" and start == context.lookahead[0].start:
        start = text.rfind("\n", 0, previous.start) + 1
    statement = _COMMENT.sub("", text[start:end]) if repair.loses_names else ""
    names = frozenset(_NAME.findall(statement))
    return UncertainText(context.source.span(start, end), names, repair.declares)


def _note_dependence(parser: ParserState, context: ErrorContext, start: int) -> None:
    """Note how far the recovery looks back from the statement at `start`."""
    if context.open_braces:
        opened, token = context.open_braces[-1].start, context.lookahead[0]
        # A block that is not closed may end anywhere in it. At the end all is recovered anew.
        is_in_block = token.kind in parser.tables.keyword_terminals
        start = opened if is_in_block else max(opened, start - LOOK_BACK)
    else:
        start = max(start - LOOK_BACK, 0)
    parser.findings.depends_from = start


def _apply(parser: ParserState, repair: Repair) -> None:
    for _ in range(repair.skip):
        parser.stream.take()
    if repair.keep:
        for _ in _tokens_since(parser, parser.stack[repair.keep][2]):
            parser.recent_tokens.pop()
        del parser.stack[repair.keep :]
    parser.stream.push_back(repair.replacement)


def _end_of_statement(context: ErrorContext, item: Sequence[Token]) -> int:
    """The end of the next token that ends the statement or begins a block."""
    kinds = [token.kind for token in item or (context.previous,)]
    depth = kinds.count("LBRACE") - kinds.count("RBRACE")
    for token in context.lookahead:
        if token.kind in _STATEMENT_ENDS and (token.kind != "RBRACE" or depth <= 0):
            return token.end
        depth -= token.kind == "RBRACE"
    return context.lookahead[-1].end


def _skip_statement(parser: ParserState, context: ErrorContext, base: int) -> int:
    """Drop the statement that began after entry `base` and skip the rest; returns its end."""
    token, inside = context.lookahead[0], len(_opened(parser.stack[base + 1 :]))
    if token.kind == END:
        state_count, closing = context.closing_tokens()
        del parser.stack[state_count:]
        parser.stream.push_back(closing)
        return token.end
    del parser.stack[base + 1 :]
    if token.kind != "RBRACE" or inside or not context.open_braces:
        text = context.source.text
        parser.recent_tokens.append(parser.stream.skip_statement(inside, _keywords(parser), text))
    return parser.recent_tokens[-1].end if parser.recent_tokens else token.start


def _skip_trailing_text(
    parser: ParserState, context: ErrorContext, item: list[Token], base: int
) -> None:
    """Report and skip text after the end of the top-level block."""
    del parser.stack[base + 1 :]
    first, last, harmless = (item or context.lookahead)[0], context.previous, True
    if context.lookahead[0].kind != END:
        last, harmless = parser.stream.skip_until(_keywords(parser))
        parser.recent_tokens.append(last)
    repair = trailing_text(first, last, harmless)
    _report(parser, context, repair, first.start, last.end)


def _keywords(parser: ParserState) -> frozenset[str]:
    """The keywords that are accepted next."""
    return parser.tables.keyword_terminals.intersection(parser.tables.actions[parser.stack[-1][0]])
