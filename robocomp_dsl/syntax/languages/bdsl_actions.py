"""BDSL: builds actions, their commands and conditions.

In: the rules that the parser recognised. Out: nodes of `ast.bdsl`.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Name, Node
from robocomp_dsl.syntax.languages.bdsl_expressions import ExpressionBuilder
from robocomp_dsl.syntax.languages.builder import BlockSetting, of_kind

_Block: TypeAlias = tuple[Span, tuple[Any, ...]]


class EndCondition(Node):
    """A condition with the outcome of the goal: `succeed` or `abort`."""

    outcome: str
    condition: ast.Condition


class ActionBuilder(ExpressionBuilder):
    """The part of the BDSL builder for actions."""

    def action(
        self, span: Span, name: Name, message: ast.TypeRef, place: ast.Place, *items: Any
    ) -> ast.Action:
        """`action name : type over ros1 at "/grasp" { … };`."""
        ends = of_kind(EndCondition, items)
        return ast.Action(
            span,
            name,
            message,
            place,
            of_kind(ast.Command, items),
            of_kind(ast.Input, items),
            of_kind(ast.Assignment, items),
            tuple(end.condition for end in ends if end.outcome == "succeed"),
            tuple(end.condition for end in ends if end.outcome == "abort"),
            doc=self.doc(span),
            **self.settings(items),
        )

    def succeed(self, span: Span, condition: ast.Condition) -> EndCondition:
        """`succeed when hand.width < 0.02;`."""
        return EndCondition(span, "succeed", condition)

    def abort(self, span: Span, condition: ast.Condition) -> EndCondition:
        """`abort when hand.width > 0.2;`."""
        return EndCondition(span, "abort", condition)

    def timeout(self, span: Span, duration: Duration) -> BlockSetting:
        """`timeout 10 s;`."""
        return BlockSetting(span, "timeout", duration)

    def command(
        self,
        span: Span,
        name: Name,
        message: ast.TypeRef | None,
        place: ast.Place,
        cancel: Name | None,
        body: _Block | None,
    ) -> ast.Command:
        """`command name : type over yarp at "/hand:i" on cancel { … };`."""
        return ast.Command(span, name, message, place, cancel is not None, fields_of(body))

    def on_cancel(self, _span: Span, word: Name) -> Name:
        """`on cancel`."""
        return word

    def condition(self, span: Span, *comparisons: ast.Comparison) -> ast.Condition:
        """`a and b`."""
        return ast.Condition(span, comparisons)

    def comparison(self, span: Span, left: ast.Expression, *rest: Any) -> ast.Comparison:
        """`a < b`, or `a`."""
        found = [child for child in rest if child is not None]
        if not found:
            return ast.Comparison(span, self.value(left))
        operator, right = found
        return ast.Comparison(span, self.value(left), operator, self.value(right))


def fields_of(body: _Block | None) -> tuple[ast.Assignment | ast.Item, ...]:
    """The assignments and items of a block, in order."""
    items = body[1] if body else ()
    return tuple(item for item in items if isinstance(item, (ast.Assignment, ast.Item)))
