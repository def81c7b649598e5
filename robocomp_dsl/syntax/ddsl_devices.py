"""DDSL: the devices in a component of a deployment.

In: what the parser recognised of them. Out: nodes of `ast_ddsl`.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax import ast_ddsl as ast
from robocomp_dsl.syntax.ast_base import Name, Number
from robocomp_dsl.syntax.builder import Builder, only

PHASES = ("startup", "interrupt1", "interrupt2", "interrupt3", "shutdown")
"""Phases that may have actions."""

VERBS = ("attach", "detach", "calibrate", "park", "abort")


class Devices(Builder):
    """The part of the DDSL builder that is about devices."""

    def device(self, span: Span, name: Name, kind: Name, body: Any) -> ast.Device:
        """`device name : kind { … };`."""
        return ast.Device(span, name, kind, body or (), self.doc(span))

    def device_body(self, _span: Span, *items: Any) -> tuple[ast.Setting, ...]:
        """What stands between the braces."""
        return only(ast.Setting, items)

    def attach(self, span: Span, device: Name, *names: Any) -> ast.Attach:
        """`attach device to a, b;`."""
        return ast.Attach(span, device, tuple(self.without_comma(names)))

    def action(
        self, span: Span, phase: Name, level: Number, verb: Name, device: Name, by: Name | None
    ) -> ast.Action:
        """`on startup level 5 calibrate device by calibrator;`."""
        self.vocabulary(phase, PHASES, "phase with actions")
        self.vocabulary(verb, VERBS, "action")
        return ast.Action(span, phase, level, verb, device, by)
