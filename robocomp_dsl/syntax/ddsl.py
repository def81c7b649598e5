"""DDSL: from text to the tree of `ast_ddsl`.

In: a source. Out: the tree, and findings about its form.
"""

from __future__ import annotations

from typing import Any, ClassVar

from robocomp_dsl.diagnostics import Note, Report
from robocomp_dsl.source import Source, Span
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Duration, Import, Name, Text
from robocomp_dsl.syntax.builder import Setting, only
from robocomp_dsl.syntax.ddsl_instances import Instances
from robocomp_dsl.syntax.read import read


def parse(source: Source, report: Report) -> ast.File:
    """The tree of a DDSL file."""
    file: ast.File = read("ddsl", DdslBuilder, source, report)
    return file


class DdslBuilder(Instances):
    """Makes the nodes of `ast_ddsl`."""

    ITEMS: ClassVar = {
        "file_item": "`import` or `Deployment`",
        "deployment_item": "`component`, `connect`, `host`, `group`, `middleware`, `clock`",
        "host_item": "`address`, `user`, `labels`",
        "instance_item": "a setting of the component (`config`, `set`, `after`, `device`, …)",
        "device_item": "`set`, a parameter of the device",
        "qos_item": "`reliable`, `best_effort`, `priority`, `depth`, `deadline`",
        "group_item": "`component`, `connect`, `export`, `group`, `after`",
    }

    def start(self, span: Span, *items: Any) -> ast.File:
        """The file."""
        found = only(ast.Deployment, items)
        for another in found[1:]:
            self.say(
                codes.REPEATED,
                another.name.span,
                "a file describes one deployment",
                label="this one is ignored",
                notes=(Note(found[0].name.span, "the first one is here"),),
            )
        deployment = found[0] if found else None
        return ast.File(span, only(Import, items), deployment, self.finished("Deployment"))

    def deployment(self, span: Span, name: Name, *items: Any) -> ast.Deployment:
        """`Deployment name { … };`."""
        self.has_block = True
        return ast.Deployment(
            span,
            name,
            hosts=only(ast.Host, items),
            instances=only(ast.Instance, items),
            connections=only(ast.Connection, items),
            groups=only(ast.Group, items),
            doc=self.doc(span),
            **self.settings(items),
        )

    def middleware(self, span: Span, name: Name) -> Setting:
        """`middleware zenoh;`."""
        return Setting(span, "middleware", name)

    def clock(
        self, span: Span, kind: Name, source: Name | None, lockstep: ast.LockStep | None
    ) -> Setting:
        """`clock sim from body lockstep;`."""
        return Setting(span, "clock", ast.Clock(span, kind, source, lockstep))

    def lockstep(self, span: Span, limit: Duration | None, lost: Name | None) -> ast.LockStep:
        """`lockstep limit 5 s lost stop`."""
        return ast.LockStep(span, limit, lost)

    def host(self, span: Span, name: Name, body: dict[str, Any] | None) -> ast.Host:
        """`host name { … };`."""
        return ast.Host(span, name, doc=self.doc(span), **(body or {}))

    def host_body(self, _span: Span, *items: Any) -> dict[str, Any]:
        """What stands between the braces."""
        return self.settings(items)

    def address(self, span: Span, text: Text) -> Setting:
        """`address "10.0.0.2";`."""
        return Setting(span, "address", text)

    def user(self, span: Span, name: Name | Text) -> Setting:
        """`user robot;`."""
        return Setting(span, "user", name)

    def labels(self, span: Span, *names: Any) -> Setting:
        """`labels arm, gpu;`."""
        return Setting(span, "labels", tuple(self.without_comma(names)))

    def group(self, span: Span, name: Name, host: Name | None, *items: Any) -> ast.Group:
        """`group name on host { … };`."""
        return ast.Group(
            span,
            name,
            host,
            instances=only(ast.Instance, items),
            connections=only(ast.Connection, items),
            exports=only(ast.Export, items),
            groups=only(ast.Group, items),
            doc=self.doc(span),
            **self.settings(items),
        )

    def export(self, span: Span, port: Name, instance: Name, alias: Name | None) -> ast.Export:
        """`export Port from instance as Other;`."""
        return ast.Export(span, alias or port, ast.PortRef(span, instance, port))

    def alias(self, _span: Span, name: Name) -> Name:
        """`as Other`."""
        return name
