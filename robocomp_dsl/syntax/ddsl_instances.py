"""DDSL: one component of a deployment and its connections.

In: what the parser recognised of it. Out: nodes of `ast_ddsl`.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax import codes
from robocomp_dsl.syntax.ast_base import Bool, Duration, Literal, Name, Number, Text, Unit
from robocomp_dsl.syntax.builder import Setting, only
from robocomp_dsl.syntax.ddsl_devices import Devices

POLICIES = ("on-failure", "always", "never")
UNITS = {"ms": 0.001, "s": 1.0, "min": 60.0, "h": 3600.0}


class Instances(Devices):
    """The part of the DDSL builder that is about instances and connections."""

    def instance(
        self, span: Span, name: Name, kind: Name | None, host: Name | None, body: Any
    ) -> ast.Instance:
        """`component name : kind on host { … };`."""
        items = body or ()
        return ast.Instance(
            span,
            name,
            kind,
            host,
            settings=only(ast.Setting, items),
            devices=only(ast.Device, items),
            attachments=only(ast.Attach, items),
            actions=only(ast.Action, items),
            environment=only(ast.Environment, items),
            doc=self.doc(span),
            **self.settings(items),
        )

    def on(self, _span: Span, host: Name) -> Name:
        """`on host`."""
        return host

    def instance_body(self, _span: Span, *items: Any) -> tuple[Any, ...]:
        """What stands between the braces."""
        return items

    def config(self, span: Span, path: Text) -> Setting:
        """`config "x.yaml";`."""
        return Setting(span, "config", path)

    def context(self, span: Span, name: Text) -> Setting:
        """`context "lab";`."""
        return Setting(span, "context", name)

    def searched(self, span: Span, path: Text) -> Setting:
        """`from "arm.yaml";`."""
        return Setting(span, "from_", path)

    def prefix(self, span: Span, name: Name | Text) -> Setting:
        """`prefix left;` or `prefix "left/hand";`."""
        return Setting(span, "prefix", name)

    def setting(self, span: Span, key: Name, value: Any) -> ast.Setting:
        """`set key = value;`."""
        return ast.Setting(span, key, _literal(value))

    def key(self, span: Span, *parts: Name | Unit) -> Name:
        """`motors[2].min`."""
        for index in only(Unit, parts):
            if not index.text.isdecimal():
                self.say(
                    codes.UNEXPECTED,
                    index.span,
                    f"expected the number of a group, found `{index.text}`",
                    help="the first group is `[0]`",
                )
        return Name(span, "".join(span.text.split()))

    def environment(self, span: Span, name: Name, value: Name | Text | Number) -> ast.Environment:
        """`env NAME = value;`."""
        text = value if isinstance(value, Text) else Text(value.span, value.span.text)
        return ast.Environment(span, name, text)

    def executable(self, span: Span, command: Text) -> Setting:
        """`executable "python3 main.py";`."""
        return Setting(span, "executable", command)

    def port(self, span: Span, value: Number) -> Setting:
        """`port 7451;`."""
        return Setting(span, "port", value)

    def after(self, span: Span, *names: Any) -> Setting:
        """`after a, b;`."""
        return Setting(span, "after", tuple(self.without_comma(names)))

    def policy(self, span: Span, *_words: Name) -> Name:
        """`on-failure`, which is three tokens, or one word."""
        return Name(span, "".join(span.text.split()))

    def restart(
        self, span: Span, policy: Name, most: Number | None, window: Duration | None
    ) -> Setting:
        """`restart on-failure max 5 in 60 s;`."""
        self.vocabulary(policy, POLICIES, "restart policy")
        return Setting(span, "restart", ast.Restart(span, policy, most, window))

    def ready(self, span: Span, within: Duration) -> Setting:
        """`ready within 10 s;`."""
        return Setting(span, "ready", within)

    def duration(self, span: Span, value: Number, unit: Name) -> Duration:
        """`10 s`."""
        known = self.vocabulary(unit, UNITS, "unit of time")
        return Duration(span, value.value * (UNITS[unit.text.lower()] if known else 1.0))

    def connection(
        self, span: Span, source: ast.PortRef, target: ast.PortRef, qos: ast.Qos | None
    ) -> ast.Connection:
        """`connect a.X -> b.X { … };`."""
        return ast.Connection(span, source, target, qos)

    def port_ref(self, span: Span, instance: Name, port: Name) -> ast.PortRef:
        """`a.X`."""
        return ast.PortRef(span, instance, port)

    def qos_body(self, span: Span, *items: Any) -> ast.Qos:
        """`reliable; depth 1;`."""
        return ast.Qos(span, **self.settings(items))

    def reliability(self, span: Span, word: Name) -> Setting:
        """`reliable;` or `best_effort;`."""
        return Setting(span, "reliability", word)

    def priority(self, span: Span, word: Name) -> Setting:
        """`priority high;`."""
        return Setting(span, "priority", word)

    def depth(self, span: Span, value: Number) -> Setting:
        """`depth 1;`."""
        return Setting(span, "depth", value)

    def deadline(self, span: Span, value: Duration) -> Setting:
        """`deadline 40 ms;`."""
        return Setting(span, "deadline", value)


def _literal(value: Name | Text | Number) -> Literal:
    if isinstance(value, Name) and value.text.lower() in ("true", "false"):
        return Bool(value.span, value.text.lower() == "true")
    return value
