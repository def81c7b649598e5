"""The look of each language as data: what stands close together, and where a long line may end.

In: the name of a language. Out: its `Style`. The signs that all languages share are in `_BEFORE`
and `_AFTER`; a language adds its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from robocomp_dsl.format.pieces import Piece

WIDTH = 100
"""Columns of a line; only what cannot be broken is longer."""
INDENT = "    "

_BEFORE = frozenset((",", "_SEMI", ")", "(", "::", "."))
_AFTER = frozenset(("(", "::", "."))


@dataclass(frozen=True, slots=True)
class Style:
    """No space goes in front of `before` and behind `after`, nor between the `pairs`.

    All are texts of signs or kinds of tokens. `second` are kinds that stand close to the first word
    of a statement. `breaks` are words in front of which a long line may end, as it may behind every
    comma. Where `inline_braces` is set, braces around a mere list are no block.
    """

    before: frozenset[str] = _BEFORE
    after: frozenset[str] = _AFTER
    pairs: frozenset[tuple[str, str]] = frozenset()
    second: frozenset[str] = frozenset()
    breaks: frozenset[str] = frozenset()
    inline_braces: bool = False

    def separator(self, left: Piece, right: Piece, place: int) -> str:
        """What goes between two tokens; `right` is number `place` (from 0) of its statement."""
        if right.sign in self.before or left.sign in self.after:
            return ""
        if place == 1 and right.sign in self.second:
            return ""
        return "" if (left.sign, right.sign) in self.pairs else " "


STYLES: Mapping[str, Style] = {
    # sequence<T> Name;  f(int a) throws E;  float v [m];
    "idsl": Style(
        before=_BEFORE | {"<", ">"},
        after=_AFTER | {"<"},
        breaks=frozenset(("throws",)),
    ),
    # requires A, B as front;  language C++;  gui Qt(QWidget);
    "cdsl": Style(before=_BEFORE | {"+"}),
    # mode {a, b} a;  rate float 1 [Hz] 0:10;  motors[1:32]
    "pdsl": Style(
        after=_AFTER | {"{"},
        before=_BEFORE | {"}"},
        pairs=frozenset((("NUMBER", ":"), (":", "NUMBER"))),
        second=frozenset(("BRACKETED",)),
        inline_braces=True,
    ),
    # set motors[2].min = 1;  restart on-failure;  connect a.B -> c.B;
    "ddsl": Style(
        before=_BEFORE | {"-", "BRACKETED"},
        after=_AFTER | {"-"},
        breaks=frozenset(("->",)),
    ),
    # :playing parallel { states a, b; };
    "smdsl": Style(after=_AFTER | {":"}),
}
