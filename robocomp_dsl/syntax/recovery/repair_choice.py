"""Chooses the most likely repair of a syntax error.

In: the context of the error. Out: the repair after which most of the next tokens are accepted, or
None.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery import repair_identifiers as words
from robocomp_dsl.syntax.recovery import repair_operands as operands
from robocomp_dsl.syntax.recovery import repair_punctuation as signs
from robocomp_dsl.syntax.recovery import repair_statements as statements
from robocomp_dsl.syntax.recovery import repair_tokens as whole
from robocomp_dsl.syntax.recovery.error_context import WINDOW, ErrorContext, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair
from robocomp_dsl.syntax.recovery.repair_bridge import bridge_mistakes
from robocomp_dsl.syntax.recovery.repair_earlier_keyword import misspelled_earlier_keyword
from robocomp_dsl.syntax.recovery.repair_lists import list_mistakes

_CLOSED = ("RBRACE", "_SEMI")


def choose_repair(context: ErrorContext, repairs: Iterable[Repair]) -> Repair | None:
    """The best of the repairs, the most likely first; None if none helps."""
    best, best_progress = None, -1
    for repair in repairs:
        progress = _progress(context, repair)
        if progress > best_progress:
            best, best_progress = repair, progress
    return best


def _progress(context: ErrorContext, repair: Repair) -> int:
    """How many of the next tokens are accepted, at most `WINDOW`; -1 if too few."""
    kinds = [token.kind for token in repair.replacement]
    if repair.keep:
        context = context.replace(states=context.states[: repair.keep])
    behind = context.lookahead_score(kinds, repair.skip)
    return min(repair.skip + behind, WINDOW) if behind >= repair.required else -1


def all_repairs(
    context: ErrorContext, before: Sequence[Token], item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """All possible repairs, the most likely first.

    `before` are the tokens of the previous statement. `item` are the tokens since the start of the
    statement, which began with `keep` states.
    """
    if context.nested_module(item):
        return
    accepted = context.accepted_terminals()
    yield from statements.token_behind_semicolon(context, before, item, keep)
    yield from statements.token_before_semicolon(context, before, item, keep)
    yield from bridge_mistakes(context, accepted)
    if not item and not context.lookahead[0].kind.endswith(("ID", "_TYPE")):
        yield from whole.swapped_tokens(context, item, keep)
        yield from whole.missing_keyword(context, before)
    yield from list_mistakes(context, accepted, item, keep)
    yield from whole.doubled_token(context, item, keep)
    yield from whole.name_behind_parenthesis(context, item, keep)
    yield from whole.doubled_sign(context, accepted)
    yield from signs.missing_semicolon(context)
    yield from signs.commented_semicolon(context)
    yield from signs.earlier_semicolon(context, item, keep)
    yield from operands.missing_operand_before_keyword(context, item, keep)
    yield from signs.arrow(context, accepted)
    yield from operands.missing_type(context, item, accepted)
    yield from words.quoted_identifier(context, accepted)
    yield from words.interface_file_suffix(context)
    yield from words.keyword(context, accepted)
    if context.lookahead[0].kind in context.tables.keyword_terminals and "ID" not in accepted:
        yield from operands.missing_operand(context, accepted)
    yield from words.unquoted_string(context, accepted)
    yield from words.open_bracket(context, accepted)
    yield from words.type_first(context, accepted)
    yield from words.invalid_name(context, accepted)
    yield from operands.missing_operand(context, accepted)
    yield from words.foreign_modifier(context, item, keep)
    yield from misspelled_earlier_keyword(context, item, keep)
    yield from _block(context, [], 0)
    yield from _at_statement_start(context, item, keep)
    yield from signs.wrong_bracket(context, accepted)
    yield from whole.missing_first_keyword(context, before, item, keep)
    # Missing punctuation is more likely than a surplus identifier, and loses no text.
    if signs.IDENTIFIER.fullmatch(context.lookahead[0].text):
        if any(token.text == "," for token in context.lookahead[1:2]):
            yield from whole.swapped_tokens(context, item, keep)
        yield from whole.missing_keyword_between_names(context)
        yield from signs.earlier_punctuation(context, item, keep)
        yield from signs.missing_punctuation(context, accepted)
        yield from whole.swapped_tokens(context, item, keep)
        yield from signs.surplus_token(context)
    else:
        yield from signs.earlier_punctuation(context, item, keep)
        yield from whole.swapped_tokens(context, item, keep)
        yield from signs.surplus_token(context)
        yield from signs.wrong_punctuation(context, accepted)
        yield from signs.missing_punctuation(context, accepted)
    yield from whole.missing_keyword(context, before)


def _at_statement_start(
    context: ErrorContext, item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """The mistake is at the start of the statement: a keyword that was read as a name."""
    if not 0 < len(item) < WINDOW:
        return
    start = context.replace(states=context.states[:keep], lookahead=item)
    rest = tuple(item[1:])
    for repair in words.keyword(start, start.accepted_terminals()):
        yield repair.replace(
            replacement=(*repair.replacement, *rest), skip=0, keep=keep, required=1
        )
    yield from (repair.replace(required=1) for repair in _block(start, item, keep))


def _block(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """A block was not closed before a statement that is not allowed in it."""
    token, (start, end) = context.lookahead[0], context.error_range()
    is_substates = context.tables.language == "smdsl" and token.text == ":"
    words = context.tables.keyword_terminals
    if token.kind not in words and token.kind != END and not is_substates:
        return
    ends = tuple(Token(kind, "", start, start) for kind in _CLOSED)
    for depth, opened in enumerate(reversed(context.open_braces), start=1):
        lone = next((at for at in reversed(context.lone_semicolons) if at > opened.start), -1)
        repair = Repair(
            codes.UNCLOSED_BLOCK,
            start,
            end,
            f"`}};` is missing before {quote_token(token)}",
            notes=(Note(context.source.span(opened.start, opened.end), "opened here"),),
            title="close the block",
            edits=((start, start, "\n};" * depth if token.kind == END else "};\n" * depth),),
            replacement=ends * depth + tuple(item),
            keep=keep,
        )
        if depth == 1 and lone >= 0:
            repair = repair.replace(
                start=lone,
                end=lone + 1,
                message="`}` is missing before `;`",
                edits=((lone, lone, "}"),),
                since=lone,
            )
        yield repair
