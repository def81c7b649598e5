"""DDSL: builds connections with their quality of service and monitors, and external programs.

In: the rules that the parser recognised. Out: nodes of `ast.ddsl`.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Number, QualifiedName, Text
from robocomp_dsl.syntax.languages.builder import BlockSetting, literal, of_kind
from robocomp_dsl.syntax.languages.qos import QosBuilder

POSITIONS = ("sender", "receiver")
"""Where a monitor runs."""

FAILURE_POLICIES = ("bypass", "close")
"""What a connection does when its monitor fails."""


class ConnectionsBuilder(QosBuilder):
    """The part of the DDSL builder for connections."""

    def connection(
        self,
        span: Span,
        source: ast.PortRef,
        target: ast.PortRef,
        over: Name | None,
        body: tuple[Any, ...] | None,
    ) -> ast.Connection:
        """`connect a.X -> b.X over local { … };`."""
        if body is None:
            return ast.Connection(span, source, target, over)
        items, block = body
        qos = ast.Qos(block, **self.settings(items))
        return ast.Connection(span, source, target, over, qos, of_kind(ast.Monitor, items))

    def external_connection(
        self, span: Span, middleware: Name, source: Text, target: Text, carrier: Name | Text | None
    ) -> ast.ExternalConnection:
        """`connect yarp "/camera:o" -> "/view:i" carrier fast_tcp;`."""
        return ast.ExternalConnection(span, middleware, source, target, carrier)

    def carrier(self, _span: Span, word: Name | Text) -> Name | Text:
        """`carrier fast_tcp`."""
        return word

    def over(self, _span: Span, name: Name) -> Name:
        """`over local`."""
        return name

    def port_ref(self, span: Span, instance: Name, port: Name) -> ast.PortRef:
        """`a.X`."""
        return ast.PortRef(span, instance, port)

    def connection_body(self, span: Span, *items: Any) -> tuple[list[Any], Span]:
        """`reliable; depth 1;`."""
        return self.without_second_length(items), span

    def thread_priority(self, span: Span, value: Number) -> BlockSetting:
        """`thread priority 20;`."""
        return BlockSetting(span, "thread_priority", value)

    def monitor(
        self,
        span: Span,
        file: Text,
        class_name: Name,
        arguments: tuple[ast.Argument, ...] | None,
        at: Name | None,
        on_failure: Name | None,
    ) -> ast.Monitor:
        """`monitor "limits.py" Limit { max = 3; } at receiver on failure close;`."""
        if at is not None:
            self.check_choice(at, POSITIONS, "position of a monitor")
        if on_failure is not None:
            self.check_choice(on_failure, FAILURE_POLICIES, "policy for failures")
        return ast.Monitor(span, file, class_name, arguments or (), at, on_failure)

    def monitor_body(self, _span: Span, *items: Any) -> tuple[ast.Argument, ...]:
        """The arguments between the braces."""
        return of_kind(ast.Argument, items)

    def argument(self, span: Span, name: Name, value: Name | Text | Number) -> ast.Argument:
        """`max = 3;`."""
        return ast.Argument(span, name, literal(value))

    def at(self, _span: Span, position: Name) -> Name:
        """`at receiver`."""
        return position

    def on_failure(self, _span: Span, policy: Name) -> Name:
        """`on failure close`."""
        return policy

    def arbitration(self, span: Span, target: ast.PortRef, *items: Any) -> ast.Arbitration:
        """`arbitrate b.Y { … };`."""
        return ast.Arbitration(span, target, of_kind(ast.Candidate, items))

    def candidate(self, span: Span, source: ast.PortRef, condition: ast.Condition) -> ast.Candidate:
        """`from a.X when seen;`."""
        return ast.Candidate(span, source, condition)

    def condition(self, span: Span, *events: Name) -> ast.Condition:
        """`seen && !stop`."""
        return ast.Condition(span, events)

    def extern(
        self,
        span: Span,
        name: Name,
        over: Name,
        address: Text | None,
        role: Name,
        interface: QualifiedName,
    ) -> ast.External:
        """`extern laser over ice at "laser:tcp -p 10001" implements Laser;`."""
        return ast.External(span, name, over, address, role, interface, self.doc(span))

    def extern_role(self, _span: Span, word: Name) -> Name:
        """`implements`."""
        return word
