"""DDSL: builds the tree of `ast.ddsl`.

In: a source. Out: the tree and syntax diagnostics.
"""

from __future__ import annotations

from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Import, Name, Text
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.builder import BlockSetting, of_kind
from robocomp_dsl.syntax.languages.ddsl_connections import ConnectionsBuilder
from robocomp_dsl.syntax.languages.ddsl_instances import InstancesBuilder, split_on
from robocomp_dsl.syntax.languages.parse_source import parse_source


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a DDSL file."""
    file: ast.File = parse_source("ddsl", DdslBuilder, source, report)
    return file


class DdslBuilder(InstancesBuilder, ConnectionsBuilder):
    """Builds the nodes of `ast.ddsl`."""

    ITEM_NAMES: ClassVar = {
        "file_item": "`import`, `Deployment` or `group`",
        "deployment_item": "`component`, `program`, `connect`, `extern`, `arbitrate`, `host`, "
        "`group`, `middleware`, `clock`",
        "host_item": "`address`, `user`, `labels`, `port`",
        "instance_item": "a setting of the component (`config`, `set`, `after`, `device`, …)",
        "device_item": "`set`, a parameter of the device",
        "connection_item": "`reliable`, `best_effort`, `priority`, `keep`, `depth`, `latched`, "
        "`deadline`, `liveliness`, `thread priority`, `monitor`",
        "monitor_item": "an argument of the monitor, such as `max = 3;`",
        "arbitration_item": "`from`",
        "group_item": "`component`, `program`, `connect`, `arbitrate`, `export`, `group`, "
        "`after`, `place`, `prefix`, `set`, `inprocess`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        deployments = of_kind(ast.Deployment, items)
        for another in deployments[1:]:
            self.report(
                codes.DUPLICATE,
                another.name.span,
                "a file describes one deployment",
                label="this one is ignored",
                notes=(Note(deployments[0].name.span, "the first one is here"),),
            )
        deployment = deployments[0] if deployments else None
        groups = of_kind(ast.Group, items)
        self.has_block = self.has_block or bool(groups)
        complete = self.is_complete("Deployment")
        return ast.File(span, of_kind(Import, items), deployment, complete, groups)

    def deployment(self, span: Span, name: Name, *items: Any) -> ast.Deployment:
        """`Deployment name { … };`."""
        self.has_block = True
        return ast.Deployment(
            span,
            name,
            hosts=of_kind(ast.Host, items),
            instances=of_kind(ast.Instance, items),
            connections=of_kind(ast.Connection, items),
            groups=of_kind(ast.Group, items),
            externals=of_kind(ast.External, items),
            external_connections=of_kind(ast.ExternalConnection, items),
            arbitrations=of_kind(ast.Arbitration, items),
            doc=self.doc(span),
            **self.settings(items),
        )

    def middleware(self, span: Span, name: Name) -> BlockSetting:
        """`middleware zenoh;`."""
        return BlockSetting(span, "middleware", name)

    def clock(
        self, span: Span, kind: Name, source: Name | None, lockstep: ast.LockStep | None
    ) -> BlockSetting:
        """`clock sim from body lockstep;`."""
        return BlockSetting(span, "clock", ast.Clock(span, kind, source, lockstep))

    def lockstep(self, span: Span, limit: Duration | None, lost: Name | None) -> ast.LockStep:
        """`lockstep limit 5 s lost stop`."""
        return ast.LockStep(span, limit, lost)

    def host(self, span: Span, name: Name, body: dict[str, Any] | None) -> ast.Host:
        """`host name { … };`."""
        return ast.Host(span, name, doc=self.doc(span), **(body or {}))

    def host_body(self, _span: Span, *items: Any) -> dict[str, Any]:
        """The settings between the braces."""
        return self.settings(items)

    def address(self, span: Span, text: Text) -> BlockSetting:
        """`address "10.0.0.2";`."""
        return BlockSetting(span, "address", text)

    def user(self, span: Span, name: Name | Text) -> BlockSetting:
        """`user robot;`."""
        return BlockSetting(span, "user", name)

    def labels(self, span: Span, *names: Any) -> BlockSetting:
        """`labels arm, gpu;`."""
        return BlockSetting(span, "labels", tuple(self.without_trailing_comma(names)))

    def group(
        self, span: Span, name: Name, on: Name | ast.OnLabel | None, *items: Any
    ) -> ast.Group:
        """`group name on host { … };`."""
        return self._group_node(span, name, None, on, items)

    def group_instance(
        self,
        span: Span,
        name: Name,
        definition: Name,
        on: Name | ast.OnLabel | None,
        body: Any,
    ) -> ast.Group:
        """`group name : definition on host { … };`."""
        return self._group_node(span, name, definition, on, body or ())

    def group_body(self, _span: Span, *items: Any) -> tuple[Any, ...]:
        """The items between the braces."""
        return items

    def _group_node(
        self,
        span: Span,
        name: Name,
        definition: Name | None,
        on: Name | ast.OnLabel | None,
        items: tuple[Any, ...],
    ) -> ast.Group:
        host, label = split_on(on)
        return ast.Group(
            span,
            name,
            host,
            label=label,
            instances=of_kind(ast.Instance, items),
            connections=of_kind(ast.Connection, items),
            exports=of_kind(ast.Export, items),
            groups=of_kind(ast.Group, items),
            arbitrations=of_kind(ast.Arbitration, items),
            doc=self.doc(span),
            definition=definition,
            settings=of_kind(ast.Setting, items),
            **self.settings(items),
        )

    def inprocess(self, span: Span) -> BlockSetting:
        """`inprocess;`."""
        return BlockSetting(span, "inprocess", Name(span, "inprocess"))

    def export(self, span: Span, port: Name, instance: Name, alias: Name | None) -> ast.Export:
        """`export Port from instance as Other;`."""
        return ast.Export(span, alias or port, ast.PortRef(span, instance, port))

    def alias(self, _span: Span, name: Name) -> Name:
        """`as Other`."""
        return name
