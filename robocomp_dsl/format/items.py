"""Groups tokens into statements and blocks.

In: tokens. Out: statements, nested as the braces are. The grouping is the same for all languages: a
statement ends with `;` or before a `}`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from robocomp_dsl.format.tokens import FormatToken


@dataclass(slots=True)
class Block:
    """`{ … }`. `opening` are the comments after the brace up to the end of its line.

    `flat`: the content and the `}` are on the same line as the `{`.
    """

    opening: list[FormatToken]
    items: list[Statement]
    close: FormatToken
    flat: bool


@dataclass(slots=True)
class Statement:
    """The tokens up to a `;` with the trailing comments on its line, or comments alone.

    `in_list`: it ends without a `;` before a `}`, as enumerators do.
    """

    parts: list[FormatToken | Block] = field(default_factory=list)
    in_list: bool = False


Part: TypeAlias = FormatToken | Block


def ends_with_line_break(comment: FormatToken) -> bool:
    """Whether a comment must be the last token of its line."""
    return comment.kind == "LINE" or "\n" in comment.text


def ends_line(comment: FormatToken, following: FormatToken | None) -> bool:
    """Whether a comment is the last token of its line, by its kind or by what follows."""
    return ends_with_line_break(comment) or following is None or following.breaks > 0


def parse_statements(tokens: Sequence[FormatToken], *, inline_braces: bool) -> list[Statement]:
    """The statements of a text; with `inline_braces`, braces around a plain list are no block."""
    return _Reader(tokens, inline_braces).items(inside=False)


class _Reader:
    def __init__(self, tokens: Sequence[FormatToken], inline_braces: bool) -> None:
        self._tokens = tokens
        self._position = 0
        self._inline_braces = inline_braces

    def items(self, *, inside: bool) -> list[Statement]:
        """The statements up to the `}` that closes the block, or up to the end."""
        found = []
        while self._position < len(self._tokens) and not (inside and self._is("}")):
            found.append(self._statement(inside))
        return found

    def _statement(self, inside: bool) -> Statement:
        result = Statement()
        bare = True  # nothing but comments so far
        while self._position < len(self._tokens):
            if inside and self._is("}"):
                result.in_list = not bare
                break
            if self._is("{"):
                result.parts += self._braces()
                bare = False
                continue
            token = self._take()
            result.parts.append(token)
            if token.kind == "_SEMI":
                result.parts += self._trailing_comments(or_brace=True)
                break
            bare = bare and token.is_comment
            if bare and ends_line(token, self._peek(0)):
                break
        return result

    def _braces(self) -> list[FormatToken] | list[Block]:
        size = self._list_length() if self._inline_braces else 0
        if size:
            return [self._take() for _ in range(size)]
        self._take()
        first = self._position
        opening = self._trailing_comments(or_brace=False)
        items = self.items(inside=True)
        close = (
            self._take() if self._position < len(self._tokens) else FormatToken("SIGN", "", 0, 0, 0)
        )
        inner = self._tokens[first : self._position]
        flat = not any(p.breaks or ends_with_line_break(p) for p in inner)
        return [Block(opening, items, close, flat)]

    def _list_length(self) -> int:
        """The number of tokens of braces with a list; 0 if they are empty or have statements."""
        words = False
        depth = 0
        for at in range(self._position, len(self._tokens)):
            token = self._tokens[at]
            if token.kind == "_SEMI":
                return 0
            depth += (token.text == "{") - (token.text == "}")
            if not depth:
                return at + 1 - self._position if words else 0
            words = words or not (token.is_comment or token.text in "{}")
        return 0

    def _trailing_comments(self, *, or_brace: bool) -> list[FormatToken]:
        """The comments at the end of the current line; with `or_brace` also those before its `}`.

        Comments before another token on the same line belong to that token.
        """
        count = 0
        while (token := self._peek(count)) and token.is_comment and not token.breaks:
            count += 1
        following = self._peek(count)
        if not count:
            return []
        last = self._tokens[self._position + count - 1]
        closing = or_brace and following is not None and following.text == "}"
        return [self._take() for _ in range(count)] if closing or ends_line(last, following) else []

    def _is(self, symbol: str) -> bool:
        return self._tokens[self._position].text == symbol

    def _peek(self, ahead: int) -> FormatToken | None:
        at = self._position + ahead
        return self._tokens[at] if at < len(self._tokens) else None

    def _take(self) -> FormatToken:
        self._position += 1
        return self._tokens[self._position - 1]
