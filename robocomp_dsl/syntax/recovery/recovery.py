"""Error recovery: a small repair if there is one, else the faulty statement is skipped.

In: the parser state; the unexpected token is the next of its stream. Out: a diagnostic, and the
parser in a state in which parsing can continue.
"""

from __future__ import annotations

from robocomp_dsl.syntax.codes import file as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.grammar.lr_state import ParserState
from robocomp_dsl.syntax.grammar.reductions import StackEntry
from robocomp_dsl.syntax.grammar.token_stream import Unrecoverable
from robocomp_dsl.syntax.recovery.error_context import ErrorContext, describe_expected, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair, panic_mode, trailing_text
from robocomp_dsl.syntax.recovery.repair_choice import choose_repair

LOOK_AHEAD = 24
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
    stack, restarts = parser.stack, parser.tables.item_states
    base = max(i for i, entry in enumerate(stack) if entry[0] in restarts)
    begun = len(stack) > base + 1
    item = _tokens_since(parser, stack[base + 1][2]) if begun else []
    context = _error_context(parser)
    outside = parser.builder.has_block and not context.open_braces and not context.is_single_stray()
    if outside and (not begun or (item and item[0].kind == "ID")):
        _skip_trailing_text(parser, context, item, base)
        return
    repair = choose_repair(context, item, base + 1)
    _report(parser, context, repair or panic_mode(context, item))
    if repair:
        _apply(parser, repair)
    else:
        _skip_statement(parser, context, base)
    if parser.findings.too_many_errors and not parser.findings.is_truncated:
        parser.truncate(context.lookahead[0].start)


def _complete_statement(parser: ParserState) -> None:
    """Reduce everything that is complete whatever follows, so that recovery does not drop it."""
    while True:
        following = set(parser.tables.actions[parser.stack[-1][0]].values())
        if len(following) != 1 or max(following) >= 0:
            return
        parser.reduce(-1 - following.pop(), parser.stack[-1][3])


def _tokens_since(parser: ParserState, start: int) -> list[Token]:
    """The tokens shifted since the one that begins at `start`, if they are still stored.

    Empty for an item that contains a block: such an item is not parsed again.
    """
    item = [token for token in parser.recent_tokens if token.start >= start]
    if any(token.kind == "RBRACE" for token in item):
        return []
    return item if item and item[0].start == start else []


def _error_context(parser: ParserState) -> ErrorContext:
    return ErrorContext(
        tables=parser.tables,
        source=parser.findings.source,
        states=[entry[0] for entry in parser.stack],
        previous=parser.recent_tokens[-1] if parser.recent_tokens else Token("", "", 0, 0),
        lookahead=parser.stream.peek(LOOK_AHEAD),
        open_braces=_opened(parser.stack),
    )


def _opened(entries: list[StackEntry]) -> list[Token]:
    """The open braces among the entries."""
    opened: list[Token] = []
    for _, value, _, _ in entries:
        if isinstance(value, Token) and value.kind == "LBRACE":
            opened.append(value)
        elif isinstance(value, Token) and value.kind == "RBRACE":
            del opened[-1:]
    return opened


def _report(parser: ParserState, context: ErrorContext, repair: Repair) -> None:
    """Report the error, unless no token was accepted since the last one (a follow-on error)."""
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
            parser.findings, f"expected {expected}, found {quote_token(context.lookahead[0])}"
        )
    parser.last_reported_end = -1 if repair.replacement else context.previous.end


def _apply(parser: ParserState, repair: Repair) -> None:
    for _ in range(repair.skip):
        parser.stream.take()
    if repair.keep:
        for _ in _tokens_since(parser, parser.stack[repair.keep][2]):
            parser.recent_tokens.pop()
        del parser.stack[repair.keep :]
    parser.stream.push_back(repair.replacement)


def _skip_statement(parser: ParserState, context: ErrorContext, base: int) -> None:
    """Drop the statement that began after entry `base` and skip the rest of it."""
    token, inside = context.lookahead[0], len(_opened(parser.stack[base + 1 :]))
    if token.kind == END:
        state_count, closing = context.closing_tokens()
        del parser.stack[state_count:]
        parser.stream.push_back(closing)
        return
    del parser.stack[base + 1 :]
    if token.kind != "RBRACE" or inside or not context.open_braces:
        text = context.source.text
        parser.recent_tokens.append(parser.stream.skip_statement(inside, _keywords(parser), text))


def _skip_trailing_text(
    parser: ParserState, context: ErrorContext, item: list[Token], base: int
) -> None:
    """Report and skip text after the end of the top-level block."""
    del parser.stack[base + 1 :]
    first, last, harmless = (item or context.lookahead)[0], context.previous, True
    if context.lookahead[0].kind != END:
        last, harmless = parser.stream.skip_until(_keywords(parser))
        parser.recent_tokens.append(last)
    _report(parser, context, trailing_text(first, last, harmless))


def _keywords(parser: ParserState) -> frozenset[str]:
    """The keywords that are accepted next."""
    return parser.tables.keyword_terminals.intersection(parser.tables.actions[parser.stack[-1][0]])
