"""The members of Thrift declarations: fields, enumerators, and functions of services.

In: tokens. Out: nodes of the tree; a member with a mistake is reported and left out.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeVar

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import idsl as ast
from robocomp_dsl.syntax.ast.base import Bool, Literal, Name, Number, QualifiedName, Unit
from robocomp_dsl.syntax.codes import yarp as codes
from robocomp_dsl.syntax.comment_units import unit_in
from robocomp_dsl.syntax.thrift.cursor import Cursor, SyntaxMistake
from robocomp_dsl.syntax.thrift.tokens import NUMBER
from robocomp_dsl.syntax.thrift.types import TypeReader, read_annotations
from robocomp_dsl.syntax.thrift.values import read_value

Member = TypeVar("Member")
_PARAM = re.compile(r"[@\\]param(?:\[\w+\])?\s+(\w+)\s+([^@\\]*)")


class MemberReader:
    """Reads the members of the declarations of one file."""

    def __init__(self, cursor: Cursor, types: TypeReader, constants: dict[str, Literal]) -> None:
        self._cursor = cursor
        self._types = types
        self._constants = constants

    def fields(self, *, closing: str = "}") -> tuple[ast.Field, ...]:
        """The fields up to the sign `closing`, which is read too."""
        numbers: dict[str, Span] = {}
        return self._members(lambda: self._field(numbers), closing)

    def enumerators(self) -> tuple[ast.Enumerator, ...]:
        """The enumerators up to the brace."""
        return self._members(self._enumerator, "}")

    def operations(self) -> tuple[ast.Operation, ...]:
        """The functions up to the brace."""
        return self._members(self._operation, "}")

    def _members(self, read: Callable[[], Member], closing: str) -> tuple[Member, ...]:
        found: list[Member] = []
        cursor = self._cursor
        while not cursor.accept(closing):
            if cursor.is_at_end:
                cursor.fail(f"expected `{closing}`")
            start = cursor.token
            try:
                found.append(read())
            except SyntaxMistake:
                if closing != "}":
                    raise
                if cursor.token is start:
                    cursor.next()
                cursor.skip_statement(inside=True)
        return tuple(found)

    def _field(self, numbers: dict[str, Span]) -> ast.Field:
        cursor = self._cursor
        first = cursor.token
        if first.kind == NUMBER:
            self._number(numbers)
        is_optional = cursor.accept("optional")
        if not is_optional:
            cursor.accept("required")
        type_ = self._types.read()
        cursor.accept("&")
        name = cursor.name("the name of a field")
        default = None
        if cursor.accept("="):
            default = self._default(type_, name)
        elif is_optional:
            cursor.report(
                codes.THRIFT_LEFT_OUT,
                first.span.cover(name.span),
                f"`{name.text}` is optional, but YARP always sends it",
                "give it a default value, or remove `optional`",
            )
        read_annotations(cursor)
        span = first.span.cover(cursor.last.span)
        behind = cursor.behind()
        if cursor.accept(",", ";"):
            behind = behind or cursor.behind()
        unit, doc = "", "\n".join(text for text in (first.doc, behind) if text)
        if type_.text not in ("bool", "string"):
            unit, doc = unit_in(doc)
        return ast.Field(span, type_, name, default, Unit(name.span, unit) if unit else None, doc)

    def _number(self, numbers: dict[str, Span]) -> None:
        """Read the number of a field and the colon."""
        cursor = self._cursor
        token = cursor.next()
        cursor.expect(":")
        if numbers.setdefault(token.text, token.span) is not token.span:
            cursor.report(
                codes.THRIFT_STATEMENT,
                token.span,
                f"two members have the number {token.text}",
                "the numbers of members are unique, and count from 1",
            )

    def _default(self, type_: QualifiedName, name: Name) -> Literal | None:
        value = read_value(self._cursor, self._constants)
        literal = value.literal
        if literal is None and not value.is_empty:
            self._cursor.report(
                codes.THRIFT_LEFT_OUT,
                value.span,
                f"the default of `{name.text}` is not used: it starts empty",
                "set it in the program",
            )
        if isinstance(literal, Number) and type_.name.text == "bool" and literal.value in (0, 1):
            return Bool(literal.span, bool(literal.value))
        return literal

    def _enumerator(self) -> ast.Enumerator:
        cursor = self._cursor
        doc = cursor.token.doc
        name = cursor.name("the name of an enumerator")
        value = None
        if cursor.accept("="):
            token = cursor.token
            literal = read_value(cursor, self._constants).literal
            if not (isinstance(literal, Number) and isinstance(literal.value, int)):
                cursor.report(
                    codes.THRIFT_STATEMENT, token.span, f"the value of `{name.text}` is no integer"
                )
                raise SyntaxMistake
            value = literal
        read_annotations(cursor)
        span = name.span.cover(cursor.last.span)
        behind = cursor.behind()
        if cursor.accept(",", ";"):
            behind = behind or cursor.behind()
        return ast.Enumerator(span, name, value, doc or behind)

    def _operation(self) -> ast.Operation:
        cursor = self._cursor
        first = cursor.token
        one_way = Name(first.span, "command") if cursor.accept("oneway", "async") else None
        result = None
        result_span = cursor.token.span
        if not cursor.accept("void"):
            result = self._types.read()
        name = cursor.name("the name of a function")
        cursor.expect("(")
        fields = self.fields(closing=")")
        throws: tuple[QualifiedName, ...] = ()
        if cursor.accept("throws"):
            cursor.expect("(")
            throws = tuple(field.type for field in self.fields(closing=")"))
        read_annotations(cursor)
        span = first.span.cover(cursor.last.span)
        cursor.accept(",", ";")
        if one_way and (result or throws):
            cursor.report(
                codes.THRIFT_STATEMENT,
                result_span if result else throws[0].span,
                f"`{name.text}` is oneway and has no reply",
                "its result is `void`, and it throws nothing",
            )
            raise SyntaxMistake
        units = dict(_PARAM.findall(first.doc))
        params = tuple(self._param(field, units.get(field.name.text, "")) for field in fields)
        return ast.Operation(span, name, result, params, throws, pattern=one_way, doc=first.doc)

    @staticmethod
    def _param(field: ast.Field, doc: str) -> ast.Param:
        """An argument; its unit is in its own comment, or in that of the function."""
        unit = field.unit
        if unit is None and (text := unit_in(doc.strip())[0]):
            unit = Unit(field.name.span, text)
        return ast.Param(field.span, field.type, field.name, unit=unit, default=field.default)
