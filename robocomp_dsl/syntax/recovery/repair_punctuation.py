"""Repairs of punctuation: a missing `;`, a surplus comma, a wrong bracket.

In: the context of a syntax error. Out: possible repairs, the most likely first.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.grammar.grammar_file import END
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import WINDOW, ErrorContext, quote_token
from robocomp_dsl.syntax.recovery.repair import Repair, missing_sign

IDENTIFIER = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_PUNCTUATION = re.compile(r"\W+")
_OFTEN_MISSING = (",", ")", "(", "{", ">", "<", ":", "->", "=>", ".", "=")
_ARROWS = ("->", "=>")
_ANY_ARROW = re.compile(r"[-=]+[ \t]*>+|<[-=]+|[→⇒]")
_CLOSING = {")": "(", "]": "[", ">": "<"}
_BACK = 3
"""A character is missing at most this many tokens before the unexpected one."""

_HIDDEN = re.compile(r"[ \t]*//[^\n]*?([)}\]>]*;)[ \t]*$", re.MULTILINE)


_MANUAL = "`[…]` (optional) and `*[…]` (repeated) are notation of the manual; omit the brackets"


def missing_semicolon(context: ErrorContext) -> Iterator[Repair]:
    """A missing `;`; a warning only if the line or block ends here."""
    before, token = context.previous, context.lookahead[0]
    clear = context.starts_line() or before.kind == "RBRACE" or token.kind in ("RBRACE", END)
    yield Repair(
        legacy_codes.LEGACY_SEMICOLON if clear else syntax_codes.MISSING_SEMICOLON,
        before.end,
        before.end,
        f"`;` is missing after {quote_token(before)}",
        label="text after `//` is a comment" if _comment_follows(context) else "",
        title="add `;`",
        edits=((before.end, before.end, ";"),),
        replacement=(Token("_SEMI", ";", before.end, before.end),),
        required=0 if before.kind == "RBRACE" else 1 if clear else 3,
        is_certain=True,
    )


def _comment_follows(context: ErrorContext) -> bool:
    return bool(_HIDDEN.match(context.source.text, context.previous.end))


def commented_semicolon(context: ErrorContext) -> Iterator[Repair]:
    """`Qt(QWidget//QDialog);`: the statement ends inside a comment."""
    before, end = context.previous, context.previous.end
    comment = _HIDDEN.match(context.source.text, end)
    if not comment or not context.starts_line():
        return
    punctuation = [(context.tables.punctuation.get(text, "_SEMI"), text) for text in comment[1]]
    yield Repair(
        syntax_codes.MISSING_PUNCTUATION,
        end,
        end,
        f"`{comment[1]}` is missing after {quote_token(before)}",
        label="text after `//` is a comment",
        title=f"add `{comment[1]}`",
        edits=((end, end, comment[1]),),
        replacement=tuple(Token(kind, text, end, end) for kind, text in punctuation),
        required=1,
        is_certain=True,
    )


def earlier_semicolon(context: ErrorContext, item: Sequence[Token], keep: int) -> Iterator[Repair]:
    """A missing `;` before the last accepted identifier, which begins a line."""
    if len(item) < 2 or "\n" not in context.source.text[item[-2].end : item[-1].start]:
        return
    end = item[-2].end
    yield Repair(
        legacy_codes.LEGACY_SEMICOLON,
        end,
        end,
        f"`;` is missing after {quote_token(item[-2])}",
        title="add `;`",
        edits=((end, end, ";"),),
        replacement=(*item[:-1], Token("_SEMI", ";", end, end), item[-1]),
        keep=keep,
        is_certain=True,
    )


def _accepted_punctuation(context: ErrorContext, accepted: list[str]) -> list[tuple[str, str]]:
    """Terminal and text of the accepted punctuation, often missing ones first."""
    texts = {context.tables.terminal_texts.get(kind, ""): kind for kind in accepted}
    optional = "_SEMI" in accepted
    ends = context.lookahead[0].kind == "_SEMI"
    in_list = context.states[-1] not in context.tables.item_states
    often = (*_OFTEN_MISSING, "}") if ends or in_list else _OFTEN_MISSING
    return [(texts[t], t) for t in often if t in texts and not (t == "=" and optional)]


def wrong_bracket(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """The end of a block that begins and ends with a bracket other than braces."""
    token = context.lookahead[0]
    if "RBRACE" not in accepted or token.text not in _CLOSING or not context.open_braces:
        return
    if context.source.text[context.open_braces[-1].start] != _CLOSING[token.text]:
        return
    yield Repair(
        syntax_codes.UNEXPECTED,
        token.start,
        token.end,
        f"a block ends with `}}`, not with {quote_token(token)}",
        title="write `}`",
        edits=((token.start, token.end, "}"),),
        replacement=(Token("RBRACE", "}", token.start, token.end),),
        skip=1,
        required=1,
        is_certain=True,
    )


def wrong_punctuation(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """One punctuation character instead of another."""
    token = context.lookahead[0]
    if not _PUNCTUATION.fullmatch(token.text) or token.kind == "RBRACE":
        return
    for kind, text in [*_accepted_punctuation(context, accepted), ("_SEMI", ";")]:
        if token.kind == "STRAY" and token.text not in text:
            continue
        yield Repair(
            syntax_codes.UNEXPECTED,
            token.start,
            token.end,
            title=f"write `{text}`",
            edits=((token.start, token.end, text),),
            replacement=(Token(kind, text, token.start, token.end),),
            skip=1,
        )


def arrow(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`-->`, `= >`, `<-` or `→` for the arrow of the language."""
    texts = {context.tables.terminal_texts.get(kind, ""): kind for kind in accepted}
    right = next((token for token in _ARROWS if token in texts), "")
    start = context.lookahead[0].start
    run = _ANY_ARROW.match(context.source.text, start)
    if not right or not run:
        return
    yield Repair(
        syntax_codes.UNEXPECTED,
        start,
        run.end(),
        f"the arrow is written `{right}`",
        title=f"write `{right}`",
        edits=((start, run.end(), right),),
        replacement=(Token(texts[right], right, start, run.end()),),
        skip=sum(token.start < run.end() for token in context.lookahead if token.kind != END),
        required=1,
        is_certain=True,
    )


def surplus_token(context: ErrorContext) -> Iterator[Repair]:
    """One token too many."""
    token = context.lookahead[0]
    if token.kind in (END, "_SEMI", "RBRACE"):
        return
    if context.states[-1] in context.tables.item_states and context.lookahead[1].kind == "_SEMI":
        return  # a surplus statement, not a surplus token
    stray = token.kind == "STRAY"
    manual = context.tables.language == "smdsl" and (
        token.text in ("[parallel]", "]") or (token.text[0] in "[*" and token.kind == "STRAY")
    )
    shown = quote_token(token) if token.text.isprintable() else f"U+{ord(token.text[0]):04X}"
    yield Repair(
        syntax_codes.STRAY_CHARACTER if stray else syntax_codes.UNEXPECTED,
        token.start,
        token.end,
        message=f"{shown} is not allowed here" if stray else "",
        help=_MANUAL if manual else "",
        title=f"delete {shown}",
        edits=((token.start, token.end, ""),),
        skip=1,
        required=0 if stray else 3,
    )


def missing_punctuation(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """A punctuation character is missing."""
    for kind, text in _accepted_punctuation(context, accepted):
        # In `a b c` another one is missing after the next identifier.
        required = 1 if text == "," and IDENTIFIER.fullmatch(context.lookahead[0].text) else 3
        yield missing_sign(kind, text, context.previous, required=required)


def _closes_list(context: ErrorContext) -> bool:
    """Whether a `}` follows before the end of the statement."""
    kinds = (token.kind for token in context.lookahead)
    return next((kind for kind in kinds if kind in ("RBRACE", "_SEMI", END)), END) == "RBRACE"


def earlier_punctuation(
    context: ErrorContext, item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`law pose, fixed} pose;`: a punctuation character is missing before the last tokens."""
    for index in range(len(item) - 1, max(len(item) - _BACK, 0), -1):
        states = context.states_after(keep, item[:index])
        if states is None:
            continue
        there = context.replace(states=states, previous=item[index - 1], lookahead=item[index:])
        for kind, text in _accepted_punctuation(there, there.accepted_terminals()):
            if text in "})>" or (text == "{" and not _closes_list(context)):
                continue
            repair = missing_sign(kind, text, item[index - 1], required=WINDOW)
            again = (*item[:index], *repair.replacement, *item[index:])
            yield repair.replace(replacement=again, keep=keep)
