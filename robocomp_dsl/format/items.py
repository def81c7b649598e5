"""What of a text belongs together: statements, and the blocks in them.

In: pieces. Out: statements, nested as their braces are. It knows nothing of any language but that a
statement ends with `;` or before a `}`: what the words mean does not change how they look.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from robocomp_dsl.format.pieces import Piece


@dataclass(slots=True)
class Block:
    """`{ … }`. `opening` are comments that follow the brace on its line and end that.

    `flat` says that its content and the `}` are on the line of the `{`.
    """

    opening: list[Piece]
    items: list[Statement]
    close: Piece
    flat: bool


@dataclass(slots=True)
class Statement:
    """Everything up to a `;` and the comments behind it on its line; or comments alone.

    `listed` says that it ends without a `;` before a `}`, as enumerators do.
    """

    parts: list[Piece | Block] = field(default_factory=list)
    listed: bool = False


Part: TypeAlias = Piece | Block


def fills_line(comment: Piece) -> bool:
    """Whether nothing may follow a comment on its line."""
    return comment.kind == "LINE" or "\n" in comment.text


def ends_line(comment: Piece, following: Piece | None) -> bool:
    """Whether nothing may follow a comment on its line, or nothing does."""
    return fills_line(comment) or following is None or following.breaks > 0


def read(pieces: Sequence[Piece], *, inline_braces: bool) -> list[Statement]:
    """The statements of a text. With `inline_braces`, those around a mere list are no block."""
    return _Reader(pieces, inline_braces).items(inside=False)


class _Reader:
    def __init__(self, pieces: Sequence[Piece], inline_braces: bool) -> None:
        self._pieces = pieces
        self._at = 0
        self._inline_braces = inline_braces

    def items(self, *, inside: bool) -> list[Statement]:
        """The statements up to the `}` that closes the block, or up to the end."""
        found = []
        while self._at < len(self._pieces) and not (inside and self._is("}")):
            found.append(self._statement(inside))
        return found

    def _statement(self, inside: bool) -> Statement:
        made = Statement()
        bare = True  # nothing but comments so far
        while self._at < len(self._pieces):
            if inside and self._is("}"):
                made.listed = not bare
                break
            if self._is("{"):
                made.parts += self._braces()
                bare = False
                continue
            one = self._take()
            made.parts.append(one)
            if one.kind == "_SEMI":
                made.parts += self._comments_behind(or_brace=True)
                break
            bare = bare and one.comment
            if bare and ends_line(one, self._peek(0)):
                break
        return made

    def _braces(self) -> list[Piece] | list[Block]:
        size = self._mere_list() if self._inline_braces else 0
        if size:
            return [self._take() for _ in range(size)]
        self._take()
        first = self._at
        opening = self._comments_behind(or_brace=False)
        items = self.items(inside=True)
        close = self._take() if self._at < len(self._pieces) else Piece("SIGN", "", 0, 0, 0)
        inner = self._pieces[first : self._at]
        flat = not any(p.breaks or fills_line(p) for p in inner)
        return [Block(opening, items, close, flat)]

    def _mere_list(self) -> int:
        """How many pieces the braces are, with all inside, if no statement is; else 0."""
        words = False
        for at in range(self._at + 1, len(self._pieces)):
            one = self._pieces[at]
            if one.text == "}":
                return at + 1 - self._at if words else 0
            if one.kind == "_SEMI" or one.text == "{":
                return 0
            words = words or not one.comment
        return 0

    def _comments_behind(self, *, or_brace: bool) -> list[Piece]:
        """The comments that end the line begun, also those in front of its `}` if `or_brace`.

        Comments in front of another token on the same line belong to that.
        """
        count = 0
        while (one := self._peek(count)) and one.comment and not one.breaks:
            count += 1
        following = self._peek(count)
        if not count:
            return []
        last = self._pieces[self._at + count - 1]
        closing = or_brace and following is not None and following.text == "}"
        return [self._take() for _ in range(count)] if closing or ends_line(last, following) else []

    def _is(self, sign: str) -> bool:
        return self._pieces[self._at].text == sign

    def _peek(self, ahead: int) -> Piece | None:
        at = self._at + ahead
        return self._pieces[at] if at < len(self._pieces) else None

    def _take(self) -> Piece:
        self._at += 1
        return self._pieces[self._at - 1]
