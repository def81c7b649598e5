"""IDSL: builds lengths of arrays and sequences, and unsigned integers.

In: the rules that the parser recognised. Out: nodes of `ast.idsl`, and syntax diagnostics.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast.base import Literal, Name, Number, QualifiedName, Unit
from robocomp_dsl.syntax.ast.idsl import Array
from robocomp_dsl.syntax.codes import idsl as codes
from robocomp_dsl.syntax.languages.builder import Builder

MAX_LENGTH = 1_000_000
"""The largest number of elements of an array, and largest bound of a sequence."""
_NUMERIC = re.compile(r"[+-]?\d[\w.]*|")
_UNSIGNED = {"short": "unsigned short", "int": "unsigned int", "long": "unsigned long"}
_ALREADY_UNSIGNED = ("byte", "char")
_NOT_INTEGERS = ("bool", "float", "double", "string")


class LengthsBuilder(Builder):
    """The part of the IDSL builder for brackets, bounds and unsigned integers."""

    def unsigned(self, span: Span, word: Name) -> QualifiedName:
        """`unsigned int`; its name has one space."""
        if word.text in _UNSIGNED:
            return QualifiedName(span, Name(span, _UNSIGNED[word.text]))
        if word.text in _ALREADY_UNSIGNED:
            self.report(
                codes.UNSIGNED_TYPE,
                span,
                f"`{span.text}` is written `byte`",
                fix=self.replace_fix("write `byte`", span, "byte"),
            )
            return QualifiedName(span, Name(span, "byte"))
        return self._unknown_unsigned(span, word, f"`{span.text}` is not a type")

    def unsigned_without_type(self, span: Span, name: Name) -> tuple[QualifiedName, Name]:
        """`unsigned number;`: type and name of a field."""
        return self._unknown_unsigned(span, name, "`unsigned` is not a type"), name

    def _unknown_unsigned(self, span: Span, word: Name, message: str) -> QualifiedName:
        start, is_type = word.span.start, word.text in _NOT_INTEGERS
        self.report(
            codes.UNSIGNED_TYPE,
            span,
            message,
            help="the unsigned integers are `byte`, `unsigned short`, `unsigned int` and "
            "`unsigned long`",
            fix=None
            if is_type
            else self.findings.fix("write `unsigned int`", (start, start, "int ")),
        )
        return QualifiedName(span, Name(span, "unsigned int"))

    def bound(self, _span: Span, number: Number) -> int:
        """`, 10` behind the element of a sequence."""
        return self._length(number.span, number.value, "the largest number of elements")

    def array_and_unit(self, brackets: Sequence[Unit]) -> tuple[Array | None, Unit | None]:
        """The array and the unit in the brackets behind the name of a field."""
        lengths = [b for b in brackets if _NUMERIC.fullmatch(b.text)]
        unit: Unit | None = None
        for bracket in brackets:
            if bracket not in lengths:
                unit = self.first_of(unit, bracket, "the unit")
        if len(lengths) > 1:
            self._report_dimensions(lengths)
        return (self._array(lengths[0]) if lengths else None), unit

    def scalar_unit(self, name: str, brackets: Sequence[Unit]) -> Unit | None:
        """The unit of a parameter, which is not an array."""
        array, unit = self.array_and_unit(brackets)
        if array:
            self.report(
                codes.INVALID_LENGTH,
                array.span,
                f"the parameter `{name}` is not an array",
                help="declare `sequence<type> SomeName;`, or a struct with the array as a field, "
                "and use its name as the type",
            )
        return unit

    def without_default(self, array: Array, name: Name, value: Literal) -> None:
        """Report the default of an array."""
        self.report(
            codes.INVALID_LENGTH,
            value.span,
            f"the array `{name.text}` has no default",
            label=f"its {array.size} elements start with 0, false or an empty text",
            help="remove the default",
        )

    def _array(self, bracket: Unit) -> Array | None:
        if not bracket.text:
            self.report(
                codes.INVALID_LENGTH,
                bracket.span,
                "the number of elements is missing",
                help="write it in the brackets, or declare `sequence<type> SomeName;` for any "
                "number of elements, and use `SomeName` as the type",
            )
            return None
        digits = re.fullmatch(r"\+?(\d+)", bracket.text)
        value = int(digits[1]) if digits and len(digits[1]) < 20 else 0
        return Array(bracket.span, self._length(bracket.span, value, "the length of an array"))

    def _length(self, span: Span, value: float, what: str) -> int:
        """`value` if it is a valid length, else 1."""
        if 1 <= value <= MAX_LENGTH and value == int(value):
            return int(value)
        self.report(codes.INVALID_LENGTH, span, f"{what} is 1 to {MAX_LENGTH}")
        return 1

    def _report_dimensions(self, lengths: Sequence[Unit]) -> None:
        first, last = lengths[0].span, lengths[-1].span
        product = 1
        for bracket in lengths:
            product *= int(bracket.text) if bracket.text.isdecimal() else 0
        fits = 1 <= product <= MAX_LENGTH
        self.report(
            codes.INVALID_LENGTH,
            first.cover(last),
            "an array has one dimension",
            help="store the rows one after the other",
            fix=self.findings.fix(f"write `[{product}]`", (first.start, last.end, f"[{product}]"))
            if fits
            else None,
        )
