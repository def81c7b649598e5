"""BDSL: builds expressions.

In: the operands and operators of an expression in order, without precedence. Out: expressions of
`ast.bdsl`. `*` and `/` bind more tightly than `+` and `-`. `to [unit]` converts everything before
it in the same pair of parentheses, so operators on both sides of it are reported as ambiguous.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Name, Node, Number, Text, Unit
from robocomp_dsl.syntax.codes import file as file_codes
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.builder import Builder

MAX_DEPTH = 100
"""Operators and calls inside of each other, so that recursion over an expression is safe."""

_PRODUCT = frozenset("*/")
_INTEGERS = re.compile(r"\d+(\s*,\s*\d+)*")
_BOUNDS = re.compile(r"(\d*)\s*:\s*(\d*)")
_NO_UNIT = re.compile(r"\s*|[-+\d\s,:.]+")
_UNITS = "write a unit such as `[rad]`, `[m/s]` or `[ms]`"


class Parenthesized(Node):
    """`(a + b)`; `span` includes the parentheses, unlike that of the value."""

    value: ast.Expression


class ExpressionBuilder(Builder):
    """The part of the BDSL builder for expressions."""

    def expression(self, _span: Span, first: Any, *rest: Any) -> ast.Expression:
        """Operands, operators and conversions; a child that is a `Unit` is a conversion."""
        operands, operators = [first], list[Name]()
        children = iter(rest)
        for child in children:
            if isinstance(child, Unit):
                is_mixed = bool(operators)
                operands = [self._conversion(_fold(operands, operators), child)]
                operators = []
                if is_mixed:
                    self._require_end(children, operands[0])
                    break
            else:
                operators.append(child)
                operands.append(next(children))
        return _fold(operands, operators)

    def _conversion(self, value: ast.Expression, unit: Unit) -> ast.Conversion:
        if _NO_UNIT.fullmatch(unit.text):
            shown = f"`{unit.text}` is not a unit" if unit.text else "the unit is missing"
            self.report(codes.UNEXPECTED, unit.span, shown, help=_UNITS)
        return ast.Conversion(value.span.cover(unit.span), value, unit)

    def _require_end(self, rest: Iterator[Any], converted: ast.Expression) -> None:
        """Report operators after a `to` that has operators before it, too."""
        following = next(rest, None)
        if following is None:
            return
        text = converted.span.text
        self.report(
            codes.UNEXPECTED,
            following.span,
            "operators on both sides of `to` need parentheses",
            label="`to` converts everything before it",
            help=f"write `({text}) {following.text} …` if that is what you mean",
            fix=self.replace_fix("add parentheses", converted.span, f"({text})"),
        )

    def number_value(self, span: Span, value: Number, unit: Unit | None) -> ast.NumberValue:
        """`90 [deg]`."""
        if unit is not None and _NO_UNIT.fullmatch(unit.text):
            self.report(codes.UNEXPECTED, unit.span, f"`{unit.text}` is not a unit", help=_UNITS)
            unit = None
        return ast.NumberValue(span, value.value, unit)

    def text_value(self, span: Span, text: Text) -> ast.TextValue:
        """`"rover_base"`."""
        return ast.TextValue(span, text.value)

    def list_value(self, span: Span, *items: Any) -> ast.ListValue:
        """`{ a, b }`."""
        return ast.ListValue(span, tuple(self.without_trailing_comma(items)))

    def negation(self, span: Span, value: Any) -> ast.Negation:
        """`-a`."""
        return ast.Negation(span, _bare(value))

    def parenthesized(self, span: Span, value: ast.Expression) -> Parenthesized:
        """`(a + b)`."""
        return Parenthesized(span, value)

    def reference(self, span: Span, name: Name) -> ast.Reference | ast.BoolValue:
        """`wheels`, `true`."""
        word = name.text.lower()
        if word in ("true", "false"):
            return ast.BoolValue(span, word == "true")
        return ast.Reference(span, name)

    def function_call(self, span: Span, name: Name, *arguments: Any) -> ast.FunctionCall:
        """`mirror(wheels)`."""
        return ast.FunctionCall(span, name, tuple(self.without_trailing_comma(arguments)))

    def member(self, span: Span, value: Any, name: Name) -> ast.Member:
        """`imu.angular_velocity`."""
        return ast.Member(span, _bare(value), name)

    def selection(self, span: Span, value: Any, index: Unit) -> ast.Expression:
        """`wheels[0]`, `wheels[2,0,1]`, `wheels[0:3]`; the token is the same as that of a unit."""
        operand: ast.Expression = _bare(value)
        if _INTEGERS.fullmatch(index.text):
            indices = tuple(int(number) for number in index.text.split(","))
            return ast.Selection(span, operand, indices)
        bounds = _BOUNDS.fullmatch(index.text)
        if bounds:
            start, stop = (int(bound) if bound else None for bound in bounds.groups())
            return ast.Selection(span, operand, (), (start, stop))
        if _NO_UNIT.fullmatch(index.text):
            self.report(
                codes.UNEXPECTED,
                index.span,
                "expected the numbers of items, from 0",
                help="write `[0]` for an item, `[2,0,1]` or `[0:3]` for a list of items",
            )
            return operand
        self.report(
            codes.UNEXPECTED,
            index.span,
            "a unit after a value needs `to`",
            label="brackets after a value select items",
            help="`to` converts; the unit of an input is written after its type",
            fix=self.replace_fix(f"write `to [{index.text}]`", index.span, f" to [{index.text}]"),
        )
        return ast.Conversion(span, operand, index)

    def value(self, expression: ast.Expression) -> ast.Expression:
        """The expression of a statement; one that is nested too deeply is reported and dropped."""
        if _is_deeper(expression, MAX_DEPTH):
            self.report(
                file_codes.NESTED_TOO_DEEPLY,
                expression.span,
                "the expression is nested too deeply",
                help="assign parts of it to fields or compute it in a function",
            )
            return ast.NumberValue(expression.span, 0)
        return expression


def _bare(value: Any) -> Any:
    """The value without parentheses."""
    return value.value if isinstance(value, Parenthesized) else value


def _fold(operands: Sequence[Any], operators: Sequence[Name]) -> ast.Expression:
    """The tree of operands and operators, left to right, products before sums."""
    spans = [operand.span for operand in operands]
    values: list[ast.Expression] = [_bare(operand) for operand in operands]
    for tight in (True, False):
        folded, folded_spans, rest = [values[0]], [spans[0]], list[Name]()
        for operator, value, span in zip(operators, values[1:], spans[1:], strict=True):
            if (operator.text in _PRODUCT) is tight or not tight:
                whole = folded_spans[-1].cover(span)
                folded[-1] = ast.Operation(whole, operator.text, folded[-1], value)
                folded_spans[-1] = whole
            else:
                folded.append(value)
                folded_spans.append(span)
                rest.append(operator)
        values, spans, operators = folded, folded_spans, rest
    return values[0]


def _is_deeper(expression: ast.Expression, limit: int) -> bool:
    """Whether some operand is inside of more than `limit` operations and calls."""
    level: list[Node] = [expression]
    for _ in range(limit):
        level = [operand for node in level for operand in operands(node)]
        if not level:
            return False
    return True


def operands(node: Node) -> tuple[ast.Expression, ...]:
    """The expressions that an expression consists of."""
    if isinstance(node, ast.Operation):
        return node.left, node.right
    if isinstance(node, (ast.Member, ast.Selection, ast.Negation, ast.Conversion)):
        return (node.value,)
    if isinstance(node, ast.ListValue):
        return node.items
    return node.arguments if isinstance(node, ast.FunctionCall) else ()
