"""BDSL: builds the tree of `ast.bdsl`.

In: a source. Out: the tree and syntax diagnostics.
"""

from __future__ import annotations

from typing import Any, ClassVar, TypeAlias

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import bdsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Import, Name, Node, Number
from robocomp_dsl.syntax.ast.ddsl import Qos
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.bdsl_actions import ActionBuilder, fields_of
from robocomp_dsl.syntax.languages.bdsl_expressions import ExpressionBuilder
from robocomp_dsl.syntax.languages.bdsl_types import TypeBuilder
from robocomp_dsl.syntax.languages.builder import BlockSetting, of_kind
from robocomp_dsl.syntax.languages.parse_source import parse_source
from robocomp_dsl.syntax.languages.qos import QosBuilder

POLICIES = ("latest", "all", "synchronised")
"""How a hub joins the messages of its inputs."""

_SYNCHRONISED = ("synchronised", "synchronized")
_Block: TypeAlias = tuple[Span, tuple[Any, ...]]


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a BDSL file."""
    file: ast.File = parse_source("bdsl", BdslBuilder, source, report)
    return file


class WrittenPolicy(Node):
    """`policy synchronised within 20 ms;`."""

    word: Name
    tolerance: Duration | None


class BdslBuilder(ActionBuilder, ExpressionBuilder, TypeBuilder, QosBuilder):
    """Builds the nodes of `ast.bdsl`."""

    ITEM_NAMES: ClassVar = {
        "file_item": "`import` or `Bridge`",
        "bridge_item": "`input`, `hub`, `output`, `function`, `service`, `action`, "
        "`middleware`, `rate`",
        "input_item": "`stamp`, `reliable`, `best_effort`, `priority`, `keep`, `depth`, `latched`, "
        "`deadline`, `liveliness`",
        "hub_item": "`policy`, `max_age`, `length`",
        "output_item": "`field = value;`, `item`, `rate`, a quality of service (`reliable`, "
        "`depth`, …)",
        "service_item": "`field = value;`, `call`",
        "call_item": "`field = value;`",
        "action_item": "`command`, `state`, `feedback.field = value;`, `result.field = value;`, "
        "`succeed when`, `abort when`, `timeout`",
        "command_item": "`field = value;`, `item`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        bridges = of_kind(ast.Bridge, items)
        for another in bridges[1:]:
            self.report(
                codes.DUPLICATE,
                another.name.span,
                "a file describes one bridge",
                label="this one is ignored",
                notes=(Note(bridges[0].name.span, "the first one is here"),),
            )
        bridge = bridges[0] if bridges else None
        return ast.File(span, of_kind(Import, items), bridge, self.is_complete("Bridge"))

    def bridge(self, span: Span, name: Name, *items: Any) -> ast.Bridge:
        """`Bridge name { … };`."""
        self.has_block = True
        return ast.Bridge(
            span,
            name,
            inputs=of_kind(ast.Input, items),
            functions=of_kind(ast.Function, items),
            hubs=of_kind(ast.Hub, items),
            outputs=of_kind(ast.Output, items),
            services=of_kind(ast.Service, items),
            actions=of_kind(ast.Action, items),
            doc=self.doc(span),
            **self.settings(items),
        )

    def middleware(self, span: Span, name: Name) -> BlockSetting:
        """`middleware zenoh;`."""
        return BlockSetting(span, "middleware", name)

    def rate(self, span: Span, frequency: ast.Rate) -> BlockSetting:
        """`rate 20 Hz;`."""
        return BlockSetting(span, "rate", frequency)

    def frequency(self, span: Span, number: Number) -> ast.Rate:
        """`20 Hz`."""
        self.positive(number, "a rate")
        return ast.Rate(span, float(number.value))

    def input(
        self,
        span: Span,
        name: Name,
        message: ast.TypeRef,
        place: ast.Place,
        body: _Block | None,
    ) -> ast.Input:
        """`input name : type over ros2 at "/imu" { … };`."""
        settings = self._port_settings(body)
        return ast.Input(span, name, message, place, doc=self.doc(span), **settings)

    def state(
        self,
        span: Span,
        name: Name,
        message: ast.TypeRef,
        place: ast.Place,
        body: _Block | None,
    ) -> ast.Input:
        """`state name : type over yarp at "/hand:o" { … };`."""
        return self.input(span, name, message, place, body)

    def _port_settings(self, body: _Block | None) -> dict[str, Any]:
        """The settings of a port; those of the quality of service become its `qos`."""
        if body is None:
            return {}
        span, items = body
        settings = self.settings(self.without_second_length(items))
        own = {field: settings.pop(field) for field in ("rate", "stamp") if field in settings}
        return own | ({"qos": Qos(span, **settings)} if settings else {})

    def input_body(self, span: Span, *items: Any) -> _Block:
        """The statements between the braces."""
        return span, items

    hub_body = output_body = call_body = command_body = input_body

    def stamp(self, span: Span, path: ast.Path) -> BlockSetting:
        """`stamp header.stamp;`."""
        return BlockSetting(span, "stamp", path)

    def function(self, span: Span, name: Name, *children: Any) -> ast.Function:
        """`function mirror(double[] values) -> double[];`."""
        *fields, result = children
        parameters = tuple(self.without_trailing_comma(fields))
        return ast.Function(span, name, parameters, result, self.doc(span))

    def hub(self, span: Span, name: Name, *children: Any) -> ast.Hub:
        """`hub name = a, b { policy all; };`."""
        *values, body = children
        settings = self.settings(body[1]) if body else {}
        policy = settings.pop("policy", None)
        if policy is not None:
            settings |= {"policy": policy.word, "tolerance": policy.tolerance}
        joined = tuple(self.value(value) for value in self.without_trailing_comma(values))
        return ast.Hub(span, name, joined, doc=self.doc(span), **settings)

    def policy(self, span: Span, word: Name, tolerance: Duration | None) -> BlockSetting:
        """`policy synchronised within 20 ms;`."""
        synchronises = word.text.lower() in _SYNCHRONISED
        if synchronises and tolerance is None:
            self.report(
                codes.UNEXPECTED,
                word.span,
                f"`policy {word.text}` needs a tolerance",
                help=f"write `policy {word.text} within 20 ms;`: how much the time stamps of "
                "messages that belong together may differ",
            )
        elif synchronises or self.check_choice(word, POLICIES, "hub policy"):
            self._only_synchronised(word, tolerance, synchronises=synchronises)
        return BlockSetting(span, "policy", WrittenPolicy(span, word, tolerance))

    def _only_synchronised(
        self, word: Name, tolerance: Duration | None, *, synchronises: bool
    ) -> None:
        if tolerance is not None and not synchronises:
            self.report(
                codes.MISPLACED,
                tolerance.span,
                "only `policy synchronised` has a tolerance",
                label=f"`policy {word.text}` compares no time stamps",
            )

    def max_age(self, span: Span, duration: Duration) -> BlockSetting:
        """`max_age 500 ms;`."""
        return BlockSetting(span, "max_age", duration)

    def length(self, span: Span, number: Number) -> BlockSetting:
        """`length 2;`."""
        self.positive(number, "a length", integer=True)
        return BlockSetting(span, "length", number)

    def output(
        self,
        span: Span,
        name: Name,
        message: ast.TypeRef | None,
        place: ast.Place,
        value: ast.Expression | None,
        body: _Block | None,
    ) -> ast.Output:
        """`output name : type over ros1 at "/states" = value { … };`."""
        settings = self._port_settings(body)
        whole = None if value is None else self.value(value)
        fields = fields_of(body)
        doc = self.doc(span)
        return ast.Output(span, name, message, place, whole, fields=fields, doc=doc, **settings)

    def item(self, span: Span, value: ast.Expression) -> ast.Item:
        """`item target.finger;`."""
        return ast.Item(span, self.value(value))

    def assignment(self, span: Span, path: ast.Path, value: ast.Expression) -> ast.Assignment:
        """`header.stamp = now;`."""
        return ast.Assignment(span, path, self.value(value))

    def service(
        self, span: Span, name: Name, message: ast.TypeRef, place: ast.Place, *items: Any
    ) -> ast.Service:
        """`service name : type over ros1 at "/enable" { … };`."""
        calls, fields = of_kind(ast.Call, items), of_kind(ast.Assignment, items)
        return ast.Service(span, name, message, place, calls, fields, self.doc(span))

    def call(
        self,
        span: Span,
        name: Name,
        message: ast.TypeRef,
        place: ast.Place,
        body: _Block | None,
    ) -> ast.Call:
        """`call name : type over ice at "motors" { … };`."""
        fields = of_kind(ast.Assignment, body[1]) if body else ()
        return ast.Call(span, name, message, place, fields)
