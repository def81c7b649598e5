"""The style of each language as data: spacing, and where long lines may break.

In: the name of a language. Out: its `Style`. `_BEFORE` and `_AFTER` have the punctuation of all
languages; each language adds its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from robocomp_dsl.format.tokens import FormatToken

WIDTH = 100
"""Maximum columns of a line, except for lines that cannot be broken."""
INDENT = "    "

_BEFORE = frozenset((",", "_SEMI", ")", "(", "::", "."))
_AFTER = frozenset(("(", "::", "."))


@dataclass(frozen=True, slots=True)
class Style:
    """There is no space before tokens in `before`, after tokens in `after`, and between `pairs`.

    All are punctuation or kinds of tokens. `second` are kinds without a space after the first word
    of a statement. A long line may break before `breaks` and after commas, and if that is not
    enough before `wraps`, words in lower case or punctuation. With `inline_braces`, braces around a
    plain list are not a block. `operators`: a `-` may be a sign, and brackets with numbers belong
    to the word before them; the scanner gives these the kinds `UNARY` and `INDEX`.
    """

    before: frozenset[str] = _BEFORE
    after: frozenset[str] = _AFTER
    pairs: frozenset[tuple[str, str]] = frozenset()
    second: frozenset[str] = frozenset()
    breaks: frozenset[str] = frozenset()
    wraps: frozenset[str] = frozenset()
    operators: bool = False
    inline_braces: bool = False

    def separator(self, left: FormatToken, right: FormatToken, place: int) -> str:
        """The text between two tokens; `right` is token `place` (from 0) of its statement."""
        if right.symbol in self.before or left.symbol in self.after:
            return ""
        if place == 1 and right.symbol in self.second:
            return ""
        # After the first word of a statement, as in `item (a);`, a parenthesis is no call.
        return "" if (left.symbol, right.symbol) in self.pairs and place != 1 else " "


STYLES: Mapping[str, Style] = {
    # sequence<T, 9> Name;  f(int a) throws E;  float v [m];  double m[9] [N];
    "idsl": Style(
        before=_BEFORE | {"<", ">", "INDEX"},
        after=_AFTER | {"<"},
        breaks=frozenset(("throws",)),
        operators=True,
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
    # set motors[2].min = 1;  set weights = {1, 2};
    # restart on-failure;  connect a.B -> c.B;  when !(a || b);  cores 2-3;
    "ddsl": Style(
        before=_BEFORE - {"("} | {"BRACKETED", "}"},
        after=_AFTER | {"!", "{"},
        pairs=frozenset((("NUMBER", "NUMBER"), ("ID", "-"), ("-", "ID"))),
        breaks=frozenset(("->",)),
        inline_braces=True,
    ),
    # :playing parallel { states a, b; };
    "smdsl": Style(after=_AFTER | {":"}),
    # input a : double[3] [mm] over yarp at "/a";  x = f(-a[0]) to [m] * (b - 1);
    "bdsl": Style(
        before=_BEFORE - {"("} | {"INDEX"},
        after=_AFTER | {"UNARY"},
        pairs=frozenset((("ID", "("), ("{", "}"))),
        wraps=frozenset(("over", "at", "on", "and", "to", "->", "+", "-", "*", "/")),
        operators=True,
        inline_braces=True,
    ),
}
