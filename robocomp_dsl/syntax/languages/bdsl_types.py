"""BDSL: builds types, places and the paths of fields.

In: the rules that the parser recognised. Out: nodes of `ast.bdsl`. The tokens of lengths, indices
and units are the same, so a builder tells them apart.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, Number, QualifiedName, Text, Unit
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.builder import Builder


class TypeBuilder(Builder):
    """The part of the BDSL builder for types, places and paths."""

    def type_ref(self, span: Span, base: ast.TypeRef, *brackets: Unit) -> ast.TypeRef:
        """`double[3] [mm]`."""
        lengths: list[Number | None] = []
        unit: Unit | None = None
        for bracket in brackets:
            if bracket.text and not bracket.text.isdecimal():
                unit = self.first_of(unit, bracket, "the unit")
            elif unit is not None:
                self.report(
                    codes.UNEXPECTED,
                    bracket.span,
                    "the length of a list precedes the unit",
                    help=f"write `{bracket.span.text} {unit.span.text}`",
                )
            else:
                lengths.append(self._length(bracket))
        return base.replace(span=span, lengths=tuple(lengths), unit=unit)

    def _length(self, bracket: Unit) -> Number | None:
        if not bracket.text:
            return None
        number = self._bracketed_number(bracket)
        if number.value > 0:
            return number
        self.report(
            codes.UNEXPECTED,
            bracket.span,
            "the length of a list is at least 1",
            help="write `[]` for a list of any length",
        )
        return None

    def _bracketed_number(self, bracket: Unit) -> Number:
        return Number(self.inside(bracket), int(bracket.text))

    def named(self, span: Span, name: QualifiedName, operation: Name | None) -> ast.TypeRef:
        """`Module::Interface.operation`."""
        return ast.TypeRef(span, name, operation)

    def shape(self, span: Span, *fields: Any) -> ast.TypeRef:
        """`(double x [m], string name)`."""
        return ast.TypeRef(span, shape=tuple(self.without_trailing_comma(fields)))

    def field(
        self, span: Span, field_type: ast.TypeRef, name: Name, bracket: Unit | None
    ) -> ast.ShapeField:
        """`double x [m]`; the unit becomes that of the type."""
        if field_type.unit is not None:
            self._misplaced(field_type.unit, name)
        elif bracket is not None and (not bracket.text or bracket.text.isdecimal()):
            self._misplaced(bracket, name)
        elif bracket is not None:
            whole = field_type.span.cover(bracket.span)
            field_type = field_type.replace(span=whole, unit=bracket)
        return ast.ShapeField(span, field_type, name)

    def _misplaced(self, bracket: Unit, name: Name) -> None:
        """A unit before the name of a field, or a length after it."""
        is_unit = bracket.span.start < name.span.start
        text = bracket.span.text
        right = f"{name.text} {text}" if is_unit else f"{text} {name.text}"
        whole = bracket.span.subspan(
            min(bracket.span.start, name.span.start), max(bracket.span.end, name.span.end)
        )
        self.report(
            codes.UNEXPECTED,
            bracket.span,
            "the unit of a field follows its name"
            if is_unit
            else "the length of a list follows the type",
            fix=self.replace_fix(f"write `{right}`", whole, right),
        )

    def place(self, span: Span, middleware: Name | None, address: Text | None) -> ast.Place:
        """`over ros2 at "/imu"`."""
        return ast.Place(span, middleware, address)

    def over(self, _span: Span, name: Name) -> Name:
        """`over ros2`."""
        return name

    def at(self, _span: Span, address: Text) -> Text:
        """`at "/imu"`."""
        return address

    def path(self, span: Span, *parts: ast.PathPart) -> ast.Path:
        """`header.stamp`."""
        return ast.Path(span, parts)

    def path_part(self, span: Span, name: Name, index: Unit | None) -> ast.PathPart:
        """`points[0]`."""
        if index is None:
            return ast.PathPart(span, name)
        if index.text.isdecimal():
            return ast.PathPart(span, name, self._bracketed_number(index))
        self.report(
            codes.UNEXPECTED,
            index.span,
            "expected the number of an item, from 0",
            help=f"write `{name.text}[0] = …;`, or assign the whole list: `{name.text} = …;`",
        )
        return ast.PathPart(span, name)

    def positive(self, number: Number, noun: str, *, integer: bool = False) -> None:
        """Report a number that is not greater than 0, or not an integer."""
        if number.value > 0 and (isinstance(number.value, int) or not integer):
            return
        kind = "an integer" if integer else "a number"
        self.report(codes.UNEXPECTED, number.span, f"{noun} is {kind} greater than 0")
