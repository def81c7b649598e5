"""PDSL: builds the tree of `ast.pdsl`.

In: a source. Out: the tree and syntax diagnostics.
"""

from __future__ import annotations

import re
from typing import Any, ClassVar, TypeGuard

from robocomp_dsl.diagnostics import Note, Report, nearest
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import pdsl as ast
from robocomp_dsl.syntax.ast.base import Bool, Literal, LiteralList, Name, Number, Text, Unit
from robocomp_dsl.syntax.codes import legacy as legacy_codes
from robocomp_dsl.syntax.codes import syntax as syntax_codes
from robocomp_dsl.syntax.languages.bracketed import is_length, list_in_brackets
from robocomp_dsl.syntax.languages.builder import Builder, of_kind, parse_number
from robocomp_dsl.syntax.languages.parse_source import parse_source
from robocomp_dsl.syntax.languages.pdsl_ranges import repair_range

_COUNT = re.compile(r"(\d*)(\s*:\s*)?(\d*)")
_BOUNDS = re.compile(r"(\d+)\s*(?:,|-|\.\.+)\s*(\d+)")
"""How other languages write a length: `[1, 8]`, `[1..8]`."""
_FLAG = re.compile(r"[A-Z]")
_NO_UNIT = re.compile(r"[-+.]?\d[\d.]*\s*:|:\s*[-+.]?\d|[-+]?\d[\d.]*\Z")


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a PDSL file."""
    file: ast.File = parse_source("pdsl", PdslBuilder, source, report)
    return file


class PdslBuilder(Builder):
    """Builds the nodes of `ast.pdsl`."""

    ITEM_NAMES: ClassVar = {
        "file_item": "`ComponentParams`",
        "member_item": "a parameter",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        sets = of_kind(ast.ParameterSet, items)
        for another in sets[1:]:
            self.report(
                syntax_codes.DUPLICATE,
                another.name.span,
                "a file contains one `ComponentParams` block",
                label="this one is ignored",
                notes=(Note(sets[0].name.span, "the first one is here"),),
            )
        return ast.File(span, sets[0] if sets else None, self.is_complete("ComponentParams"))

    def parameters(self, span: Span, name: Name, *items: Any) -> ast.ParameterSet:
        """`ComponentParams name { … };`."""
        self.has_block = True
        return ast.ParameterSet(span, name, _members(items), self.doc(span))

    def group(self, span: Span, name: Name, count: Unit | None, *items: Any) -> ast.Group:
        """`name[1:32] { … };`."""
        length = self._count(count, "groups")
        return ast.Group(span, name, _members(items), length, self.doc(span))

    def _count(self, count: Unit | None, noun: str) -> ast.Range | None:
        """The length of a list of `noun`; the tokens are the same as those of a unit."""
        if count is None:
            return None
        match = _COUNT.fullmatch(count.text)
        if not match:
            bounds = _BOUNDS.fullmatch(count.text)
            right = f"[{bounds[1]}:{bounds[2]}]" if bounds else ""
            self.report(
                syntax_codes.UNEXPECTED,
                count.span,
                f"expected a number of {noun}, found `{count.text}`",
                help=f"write `[1:32]` for one to 32 {noun}, `[3]` for three, `[]` for any number",
                fix=self.replace_fix(f"write `{right}`", count.span, right) if right else None,
            )
            return ast.Range(count.span, None, None)
        start = self.inside(count).start
        low, high = (_bound(count.span, start, match, group) for group in (1, 3))
        return ast.Range(count.span, low, high if match[2] else low)

    def enumeration(self, span: Span, *children: Any) -> ast.Enumeration:
        """`{a, b}`."""
        return ast.Enumeration(span, tuple(self.without_trailing_comma(children)))

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
        self,
        span: Span,
        name: Name,
        count: Unit | None,
        kind: Name | ast.Enumeration,
        default: Literal | LiteralList | None,
        *attributes: Any,
    ) -> ast.Parameter:
        """`name[1:8] type default [unit] low:high live;`."""
        if count is None and attributes and self._is_late_length(attributes[0], kind, name):
            count, attributes = attributes[0], attributes[1:]
        unit: Unit | None = None
        bounds: ast.Range | None = None
        live: Name | None = None
        for attribute in repair_range(attributes, self):
            if isinstance(attribute, Unit) and (items := self._list(attribute, kind, count)):
                self.first_of(default, items, "the default")
                default = default or items
            elif isinstance(attribute, Unit) and _NO_UNIT.match(attribute.text):
                self._numbers_in_brackets(attribute, name)
            elif isinstance(attribute, Unit):
                unit = self.first_of(unit, attribute, "the unit")
            elif isinstance(attribute, ast.Range):
                bounds = self.first_of(bounds, attribute, "the range")
            elif isinstance(attribute, Name) and self._is_flag(attribute, kind, default):
                live = (
                    self.first_of(live, attribute, "`live`")
                    if attribute.text.lower() == "live"
                    else live
                )
            else:
                default = self._default(default, attribute)
        length = self._count(count, "values")
        is_live = live is not None
        return ast.Parameter(
            span, name, kind, default, unit, bounds, is_live, length, self.doc(span)
        )

    def _is_late_length(
        self, attribute: Any, kind: Name | ast.Enumeration, name: Name
    ) -> TypeGuard[Unit]:
        """`weights float[8]`: the length follows the type, and is reported."""
        if not isinstance(attribute, Unit) or not is_length(attribute):
            return False
        if attribute.span.start != kind.span.end:
            return False
        at, (start, end) = name.span.end, (attribute.span.start, attribute.span.end)
        text = attribute.span.text
        self.report(
            syntax_codes.UNEXPECTED,
            attribute.span,
            "the length of a list is written after the name",
            fix=self.findings.fix(f"write `{name.text}{text}`", (at, at, text), (start, end, "")),
        )
        return True

    def _list(
        self, unit: Unit, kind: Name | ast.Enumeration, count: Unit | None
    ) -> LiteralList | None:
        """The values of a list that is written in brackets, which is reported."""
        items = list_in_brackets(unit)
        if items is None or not _has_values(items, kind, count):
            return None
        written = f"{{{unit.text}}}"
        self.report(
            syntax_codes.UNEXPECTED,
            unit.span,
            "the values of a list are written in braces",
            label="brackets contain a unit",
            fix=self.replace_fix(f"write `{written}`", unit.span, written),
        )
        return items

    def _is_flag(
        self,
        word: Name,
        kind: Name | ast.Enumeration,
        default: Literal | LiteralList | None,
    ) -> bool:
        """Whether a word is `live` or a historical flag, and not the default of an enumeration."""
        choices = kind.choices if isinstance(kind, ast.Enumeration) else ()
        if default is None and word.text in {choice.text for choice in choices}:
            return False
        if word.text.lower() == "live" or word.text == "T":
            return True
        if default is not None and nearest(word.text, ("live",)):
            self.check_choice(word, ("live",), "flag")
            return True
        if not _FLAG.fullmatch(word.text):
            return False
        self.report(
            legacy_codes.MEANINGLESS_KEYWORD,
            word.span,
            f"the flag `{word.text}` has no effect",
            label="ignored",
            fix=self.replace_fix("delete it", word.span),
        )
        return True

    def _numbers_in_brackets(self, unit: Unit, name: Name) -> None:
        """`[0:2]` or `[3]`: a range or a list length in the position of a unit."""
        if ":" in unit.text:
            self.report(
                syntax_codes.UNEXPECTED,
                unit.span,
                "a range is written without brackets",
                label="brackets contain a unit",
                fix=self.replace_fix(f"write `{unit.text}`", unit.span, unit.text),
            )
            return
        self.report(
            syntax_codes.UNEXPECTED,
            unit.span,
            f"`{unit.text}` is not a unit",
            help=f"the length of a list is written after its name: `{name.text}[{unit.text}]`",
        )

    def _default(
        self, first: Literal | LiteralList | None, literal: Text | Number | Name
    ) -> Literal | LiteralList:
        value: Literal = literal
        if isinstance(literal, Name) and literal.text.lower() in ("true", "false"):
            value = Bool(literal.span, literal.text.lower() == "true")
        if first is not None and not isinstance(first, Text) and isinstance(literal, Text):
            self._quoted_unit(literal)
        else:
            self.first_of(first, value, "the default")
        return first or value

    def _quoted_unit(self, text: Text) -> None:
        """`speed float 5 "mm/s"`: a unit in quotes after the default."""
        self.report(
            syntax_codes.DUPLICATE,
            text.span,
            "a second default, in quotes",
            label="write units in brackets",
            fix=self.replace_fix(f"write `[{text.value}]`", text.span, f"[{text.value}]"),
        )


def _has_values(items: LiteralList, kind: Name | ast.Enumeration, count: Unit | None) -> bool:
    """Whether these are values and no unit; the name of a unit may be that of a choice."""
    if len(items.items) > 1 or any(isinstance(item, Text) for item in items.items):
        return True
    if count is None:
        return False
    choices = kind.choices if isinstance(kind, ast.Enumeration) else ()
    names = {choice.text for choice in choices}
    return all(not isinstance(i, Name) or i.text in names for i in items.items)


def _members(items: Any) -> tuple[ast.Member, ...]:
    return tuple(item for item in items if isinstance(item, (ast.Parameter, ast.Group)))


def _bound(span: Span, start: int, match: re.Match[str], group: int) -> Number | None:
    if not match[group]:
        return None
    start_index, end = match.span(group)
    return Number(span.subspan(start + start_index, start + end), parse_number(match[group]))
