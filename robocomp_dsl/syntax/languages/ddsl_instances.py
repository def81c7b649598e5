"""DDSL: builds component instances.

In: the rules that the parser recognised. Out: nodes of `ast.ddsl`.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Duration, Name, Number, Text, Unit
from robocomp_dsl.syntax.codes import syntax as codes
from robocomp_dsl.syntax.languages.builder import BlockSetting, literal, of_kind
from robocomp_dsl.syntax.languages.ddsl_devices import DevicesBuilder

POLICIES = ("on-failure", "always", "never")
MEMORY_UNITS = ("kB", "MB", "GB", "KiB", "MiB", "GiB")


class InstancesBuilder(DevicesBuilder):
    """The part of the DDSL builder for instances."""

    def instance(
        self,
        span: Span,
        name: Name,
        kind: Name | None,
        on: Name | ast.OnLabel | None,
        body: Any,
    ) -> ast.Instance:
        """`component name : kind on host { … };`."""
        return self._instance_node(span, name, kind, on, body)

    def _instance_node(
        self,
        span: Span,
        name: Name,
        kind: Name | None,
        on: Name | ast.OnLabel | None,
        body: Any,
        *,
        is_program: bool = False,
    ) -> ast.Instance:
        items = body or ()
        host, label = split_on(on)
        return ast.Instance(
            span,
            name,
            kind,
            host,
            label=label,
            settings=of_kind(ast.Setting, items),
            devices=of_kind(ast.Device, items),
            attachments=of_kind(ast.Attach, items),
            actions=of_kind(ast.Action, items),
            environment=of_kind(ast.Environment, items),
            own_ports=of_kind(ast.OwnPort, items),
            doc=self.doc(span),
            is_program=is_program,
            **self.settings(items),
        )

    def program(
        self, span: Span, name: Name, on: Name | ast.OnLabel | None, body: Any
    ) -> ast.Instance:
        """`program name on host { … };`."""
        return self._instance_node(span, name, None, on, body, is_program=True)

    def on(self, _span: Span, host: Name) -> Name:
        """`on host`."""
        return host

    def on_label(self, span: Span, _keyword: Name, label: Name) -> ast.OnLabel:
        """`on label gpu`."""
        return ast.OnLabel(span, label)

    def place(self, span: Span, candidates: ast.OnLabel | tuple[Name, ...] | None) -> BlockSetting:
        """`place by load on a, b;`."""
        if isinstance(candidates, ast.OnLabel):
            return BlockSetting(span, "place", ast.Place(span, (), candidates.label))
        return BlockSetting(span, "place", ast.Place(span, candidates or ()))

    def place_hosts(self, _span: Span, *names: Any) -> tuple[Name, ...]:
        """`on a, b`."""
        return tuple(self.without_trailing_comma(names))

    def instance_body(self, _span: Span, *items: Any) -> tuple[Any, ...]:
        """The items between the braces."""
        return items

    def config(self, span: Span, path: Text) -> BlockSetting:
        """`config "x.yaml";`."""
        return BlockSetting(span, "config", path)

    def context(self, span: Span, name: Text) -> BlockSetting:
        """`context "lab";`."""
        return BlockSetting(span, "context", name)

    def searched(self, span: Span, path: Text) -> BlockSetting:
        """`from "arm.yaml";`."""
        return BlockSetting(span, "from_", path)

    def prefix(self, span: Span, name: Name | Text) -> BlockSetting:
        """`prefix left;` or `prefix "left/hand";`."""
        return BlockSetting(span, "prefix", name)

    def setting(self, span: Span, key: Name, value: Any) -> ast.Setting:
        """`set key = value;`."""
        return ast.Setting(span, key, literal(value))

    def key(self, span: Span, *parts: Name | Unit) -> Name:
        """`motors[2].min`."""
        for index in of_kind(Unit, parts):
            if not index.text.isdecimal():
                self.report(
                    codes.UNEXPECTED,
                    index.span,
                    f"expected an index, found `{index.text}`",
                    help="the first element is `[0]`",
                )
        written = (f".{p.text}" if isinstance(p, Name) else f"[{p.text}]" for p in parts)
        return Name(span, "".join(written).removeprefix("."))

    def environment(self, span: Span, name: Name, value: Name | Text | Number) -> ast.Environment:
        """`env NAME = value;`."""
        text = value if isinstance(value, Text) else Text(value.span, value.span.text)
        return ast.Environment(span, name, text)

    def executable(self, span: Span, command: Text) -> BlockSetting:
        """`executable "python3 main.py";`."""
        return BlockSetting(span, "executable", command)

    def port(self, span: Span, value: Number) -> BlockSetting:
        """`port 7451;`."""
        return BlockSetting(span, "port", value)

    def own_port(self, span: Span, port: Name, over: Name, address: Text | None) -> ast.OwnPort:
        """`port Laser over ice at "tcp -p 10001";`."""
        return ast.OwnPort(span, port, over, address)

    def after(self, span: Span, *names: Any) -> BlockSetting:
        """`after a, b;`."""
        return BlockSetting(span, "after", tuple(self.without_trailing_comma(names)))

    def policy(self, span: Span, word: Name) -> Name:
        """`on-failure` (three tokens) or one word."""
        is_one_word = span.start == word.span.start
        return Name(span, word.text if is_one_word else f"on-{word.text}")

    def restart(
        self, span: Span, policy: Name, most: Number | None, window: Duration | None
    ) -> BlockSetting:
        """`restart on-failure max 5 in 60 s;`."""
        self.check_choice(policy, POLICIES, "restart policy")
        return BlockSetting(span, "restart", ast.Restart(span, policy, most, window))

    def ready(self, span: Span, within: Duration) -> BlockSetting:
        """`ready within 10 s;`."""
        return BlockSetting(span, "ready", within)

    def ready_log(self, span: Span, pattern: Text) -> BlockSetting:
        """`ready when log matches "…";`."""
        return BlockSetting(span, "ready_when", ast.ReadyWhen(span, pattern))

    def ready_port(self, span: Span, port: Number) -> BlockSetting:
        """`ready when port 8080 answers;`."""
        return BlockSetting(span, "ready_when", ast.ReadyWhen(span, None, port))

    def ready_after(self, span: Span, delay: Duration) -> BlockSetting:
        """`ready after 2 s;`."""
        return BlockSetting(span, "ready_when", ast.ReadyWhen(span, None, None, delay))

    def memory(self, span: Span, amount: Number, unit: Name) -> BlockSetting:
        """`memory 500 MB;`."""
        self.check_choice(unit, MEMORY_UNITS, "unit of memory")
        return BlockSetting(span, "memory", ast.Memory(span, amount, unit))

    def cpu(self, span: Span, share: Number) -> BlockSetting:
        """`cpu 80 %;`."""
        return BlockSetting(span, "cpu", share)

    def cores(self, span: Span, *ranges: Any) -> BlockSetting:
        """`cores 0, 2-3;`."""
        return BlockSetting(span, "cores", tuple(self.without_trailing_comma(ranges)))

    def core_range(self, span: Span, first: Number, last: Number | None) -> ast.CoreRange:
        """`2` or `2 - 3`."""
        return ast.CoreRange(span, first, last)

    def signed_range(self, span: Span, first: Number, last: Number) -> ast.CoreRange:
        """`2-3`: the lexer takes a `-` directly before a number for its sign."""
        if not last.span.text.startswith("-"):
            self.report(
                codes.UNEXPECTED,
                last.span,
                f"expected `,` or `-` before `{last.span.text}`",
                help="a list of cores is `cores 0, 2-3;`",
            )
            return ast.CoreRange(span, first)
        return ast.CoreRange(span, first, Number(last.span, -last.value))

    def realtime(self, span: Span, priority: Number) -> BlockSetting:
        """`realtime priority 50;`."""
        return BlockSetting(span, "realtime", priority)

    def files(self, span: Span, *paths: Any) -> BlockSetting:
        """`files "../meshes", "../maps";`."""
        return BlockSetting(span, "files", tuple(self.without_trailing_comma(paths)))

    def watchdog(self, span: Span, limit: Duration) -> BlockSetting:
        """`watchdog 2 s;`."""
        return BlockSetting(span, "watchdog", limit)


def split_on(on: Name | ast.OnLabel | None) -> tuple[Name | None, Name | None]:
    """The host and the label of an `on`."""
    return (None, on.label) if isinstance(on, ast.OnLabel) else (on, None)
