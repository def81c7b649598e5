"""Repairs of a misspelled keyword inside of a statement, which was read as a name.

In: the context of a syntax error and the tokens since the start of the statement. Out: possible
repairs. The statement is parsed again with the keyword.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.grammar.lexer import Token
from robocomp_dsl.syntax.recovery.error_context import ErrorContext
from robocomp_dsl.syntax.recovery.repair import Repair

_BACK = 3
"""The keyword is at most this many tokens before the unexpected one."""


def misspelled_earlier_keyword(
    context: ErrorContext, item: Sequence[Token], keep: int
) -> Iterator[Repair]:
    """`ouut Pose pose`: the mistake shows only at `pose`."""
    keywords = context.tables.keyword_terminals
    texts = {context.tables.terminal_texts[kind]: kind for kind in keywords}
    for index in range(len(item) - 1, max(len(item) - 1 - _BACK, 0), -1):
        token = item[index]
        meant = nearest(token.text, texts) if token.kind == "ID" else None
        if not meant:
            continue
        word = Token(texts[meant], meant, token.start, token.end)
        yield Repair(
            codes.MISSPELLED_KEYWORD,
            token.start,
            token.end,
            f"`{token.text}` is not a keyword",
            label=f"did you mean `{meant}`?",
            title=f"write `{meant}`",
            edits=((token.start, token.end, meant),),
            replacement=(*item[:index], word, *item[index + 1 :]),
            keep=keep,
            required=1,
        )
