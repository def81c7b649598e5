"""Repairs of what people who know ROS or YARP write into a bridge.

In: the context of a syntax error in BDSL. Out: possible repairs, the most likely first.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext
from robocomp_dsl.syntax.recovery.repair import Repair
from robocomp_dsl.syntax.recovery.repair_punctuation import IDENTIFIER

_LIST_IN_BRACES = "a list is written in braces, as in `{ 1, 2 }`"


def bridge_mistakes(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """All of them; none for other languages."""
    if context.tables.language == "bdsl" and len(context.lookahead) > 3:
        yield from _ros_slash(context)
        yield from _unit_without_brackets(context, accepted)
        yield from _missing_word(context, accepted)
        yield from _list_in_brackets(context, accepted)


def _ros_slash(context: ErrorContext) -> Iterator[Repair]:
    """`std_msgs/Float64`, as ROS writes it; also with `/msg/` between."""
    slash, name, *rest = context.lookahead
    if slash.text != "/" or not IDENTIFIER.fullmatch(name.text):
        return
    skip = 1
    if rest and name.text in {"msg", "srv"} and rest[0].text == "/":
        name, skip = rest[1], 3
    yield Repair(
        codes.UNEXPECTED,
        context.previous.start,
        name.end,
        "a type of ROS is written with `::`",
        title=f"write `{context.previous.text}::{name.text}`",
        edits=((slash.start, name.start, "::"),),
        replacement=(Token("_SCOPE", "::", slash.start, name.start),),
        skip=skip,
        required=1,
    )


def _unit_without_brackets(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`double[2] deg`."""
    token, after = context.lookahead[0], context.lookahead[1]
    is_behind_type = "OVER" in accepted and "COLON" not in accepted
    follows = after.text.lower() in {"over", "at", ";", "{"}
    if not (is_behind_type and IDENTIFIER.fullmatch(token.text) and follows):
        return
    written = f"[{token.text}]"
    yield Repair(
        codes.UNEXPECTED,
        token.start,
        token.end,
        "a unit is written in brackets",
        title=f"write `{written}`",
        edits=((token.start, token.end, written),),
        skip=1,
        required=1,
    )


def _missing_word(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`over yarp "/left:o"` without `at`, and `rate 20;` without `Hz`."""
    token, at = context.lookahead[0], context.previous.end
    for kind in accepted:
        word = context.tables.terminal_texts.get(kind, "")
        is_address = word == "at" and token.kind == "STRING"
        is_rate = word.lower() == "hz" and context.previous.kind == "NUMBER"
        if is_address or is_rate:
            text = "Hz" if is_rate else word
            yield Repair(
                codes.UNEXPECTED,
                token.start if is_address else context.previous.start,
                token.end if is_address else at,
                f"`{text}` is missing {'before the address' if is_address else 'after a rate'}",
                title=f"add `{text}`",
                edits=((at, at, f" {text}"),),
                replacement=(Token(kind, text, at, at),),
                required=1,
            )


def _list_in_brackets(context: ErrorContext, accepted: list[str]) -> Iterator[Repair]:
    """`["left", "right"]`."""
    token = context.lookahead[0]
    if token.kind == "BRACKETED" and "LBRACE" in accepted and "NUMBER" in accepted:
        written = f"{{ {token.text[1:-1].strip()} }}"
        ends = (token.start, token.end)
        yield Repair(
            codes.UNEXPECTED,
            *ends,
            _LIST_IN_BRACES,
            title=f"write `{written}`",
            edits=((*ends, written),),
            replacement=(Token("LBRACE", "{", *ends), Token("RBRACE", "}", *ends)),
            skip=1,
            required=1,
        )
