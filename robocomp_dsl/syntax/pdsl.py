"""PDSL: from text to the tree of `ast_pdsl`.

In: a source. Out: the tree, and findings about its form.
"""

from __future__ import annotations

import re
from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import ast_pdsl as ast
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Bool, Literal, Name, Number, Text, Unit
from robocomp_dsl.syntax.builder import Builder, number, only
from robocomp_dsl.syntax.read import read

_COUNT = re.compile(r"(\d*)(\s*:\s*)?(\d*)")
_FLAG = re.compile(r"[A-Z]")
_NO_UNIT = re.compile(r"[-+.]?\d[\d.]*\s*:|:\s*[-+.]?\d|\d+\Z")


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a PDSL file."""
    file: ast.File = read("pdsl", PdslBuilder, source, report)
    return file


class PdslBuilder(Builder):
    """Makes the nodes of `ast_pdsl`."""

    ITEMS: ClassVar = {
        "file_item": "`ComponentParams`",
        "member_item": "a parameter",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        sets = only(ast.ParameterSet, items)
        for another in sets[1:]:
            self.say(
                codes.REPEATED,
                another.name.span,
                "a file has one block of parameters",
                label="this one is ignored",
                notes=(Note(sets[0].name.span, "the first one is here"),),
            )
        return ast.File(span, sets[0] if sets else None, self.finished("ComponentParams"))

    def parameters(self, span: Span, name: Name, *items: Any) -> ast.ParameterSet:
        """`ComponentParams name { … };`."""
        self.has_block = True
        return ast.ParameterSet(span, name, _members(items), self.doc(span))

    def group(self, span: Span, name: Name, count: Unit | None, *items: Any) -> ast.Group:
        """`name[1:32] { … };`."""
        return ast.Group(span, name, _members(items), self._count(count), self.doc(span))

    def _count(self, count: Unit | None) -> ast.Range | None:
        """How many groups there may be; the tokens are the same as those of a unit."""
        if count is None:
            return None
        match = _COUNT.fullmatch(count.text)
        if not match:
            self.say(
                codes.UNEXPECTED,
                count.span,
                f"expected a number of groups, found `{count.text}`",
                help="write `[1:32]` for one to 32 groups, `[3]` for three, `[]` for any number",
            )
            return ast.Range(count.span, None, None)
        start = count.span.start + count.span.text.index(count.text)
        low, high = (_bound(count.span, start, match, group) for group in (1, 3))
        return ast.Range(count.span, low, high if match[2] else low)

    def enumeration(self, span: Span, *children: Any) -> ast.Enumeration:
        """`{a, b}`."""
        return ast.Enumeration(span, tuple(self.without_comma(children)))

    def range(self, span: Span, low: Number, high: Number) -> ast.Range:
        """`1:10`."""
        return ast.Range(span, low, high)

    def range_from(self, span: Span, low: Number) -> ast.Range:
        """`1:`."""
        return ast.Range(span, low, None)

    def range_to(self, span: Span, high: Number) -> ast.Range:
        """`:10`."""
        return ast.Range(span, None, high)

    def parameter(
        self, span: Span, name: Name, kind: Name | ast.Enumeration, *attributes: Any
    ) -> ast.Parameter:
        """`name type default [unit] low:high live;`."""
        default: Literal | None = None
        unit: Unit | None = None
        bounds: ast.Range | None = None
        live: Name | None = None
        for one in attributes:
            if isinstance(one, Unit) and _NO_UNIT.match(one.text):
                self._numbers_in_brackets(one, name)
            elif isinstance(one, Unit):
                unit = self.once(unit, one, "the unit")
            elif isinstance(one, ast.Range):
                bounds = self.once(bounds, one, "the range")
            elif isinstance(one, Name) and self._is_flag(one, kind, default):
                live = self.once(live, one, "`live`") if one.text.lower() == "live" else live
            else:
                default = self._default(default, one)
        return ast.Parameter(
            span, name, kind, default, unit, bounds, live is not None, self.doc(span)
        )

    def _is_flag(self, word: Name, kind: Name | ast.Enumeration, default: Literal | None) -> bool:
        """Whether a word is `live` or a historical flag, and not the default of an enumeration."""
        choices = kind.choices if isinstance(kind, ast.Enumeration) else ()
        if default is None and word.text in {choice.text for choice in choices}:
            return False
        if word.text.lower() == "live" or word.text == "T":
            return True
        if default is not None and nearest(word.text, ("live",)):
            self.vocabulary(word, ("live",), "flag")
            return True
        if not _FLAG.fullmatch(word.text):
            return False
        self.say(
            codes.MEANINGLESS_WORD,
            word.span,
            f"the flag `{word.text}` has no meaning",
            label="ignored",
            fix=self.rewrite("delete it", word.span),
        )
        return True

    def _numbers_in_brackets(self, unit: Unit, name: Name) -> None:
        """`[0:2]` or `[3]`: a range, or the length of a list, where a unit stands."""
        if ":" in unit.text:
            self.say(
                codes.UNEXPECTED,
                unit.span,
                "a range stands without brackets",
                label="this is where a unit is",
                fix=self.rewrite(f"write `{unit.text}`", unit.span, unit.text),
            )
            return
        self.say(
            codes.UNEXPECTED,
            unit.span,
            f"`{unit.text}` is no unit",
            help=f"a list is a group: `{name.text}[{unit.text}] {{ … }};`",
        )

    def _default(self, first: Literal | None, one: Text | Number | Name) -> Literal:
        value: Literal = one
        if isinstance(one, Name) and one.text.lower() in ("true", "false"):
            value = Bool(one.span, one.text.lower() == "true")
        if first is not None and not isinstance(first, Text) and isinstance(one, Text):
            self._quoted_unit(one)
        else:
            self.once(first, value, "the default")
        return first or value

    def _quoted_unit(self, text: Text) -> None:
        """`speed float 5 "mm/s"`: a number has its default already."""
        self.say(
            codes.REPEATED,
            text.span,
            "a second default, in quotes",
            label="a unit stands in brackets",
            fix=self.rewrite(f"write `[{text.value}]`", text.span, f"[{text.value}]"),
        )


def _members(items: Any) -> tuple[ast.Member, ...]:
    return tuple(item for item in items if isinstance(item, (ast.Parameter, ast.Group)))


def _bound(span: Span, start: int, match: re.Match[str], group: int) -> Number | None:
    if not match[group]:
        return None
    at, end = match.span(group)
    return Number(span.part(start + at, start + end), number(match[group]))
