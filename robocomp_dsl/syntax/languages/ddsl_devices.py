"""DDSL: builds the devices of a component instance.

In: the rules that the parser recognised. Out: nodes of `ast.ddsl`.
"""

from __future__ import annotations

from typing import Any

from robocomp_dsl.source import Span
from robocomp_dsl.syntax.ast import ddsl as ast
from robocomp_dsl.syntax.ast.base import Name, Number
from robocomp_dsl.syntax.languages.builder import Builder, of_kind

PHASES = ("startup", "interrupt1", "interrupt2", "interrupt3", "shutdown")
"""Phases that may have actions."""

VERBS = ("attach", "detach", "calibrate", "park", "abort")


class DevicesBuilder(Builder):
    """The part of the DDSL builder for devices."""

    def device(self, span: Span, name: Name, kind: Name, body: Any) -> ast.Device:
        """`device name : kind { … };`."""
        return ast.Device(span, name, kind, body or (), self.doc(span))

    def device_body(self, _span: Span, *items: Any) -> tuple[ast.Setting, ...]:
        """The settings between the braces."""
        return of_kind(ast.Setting, items)

    def attach(self, span: Span, device: Name, *names: Any) -> ast.Attach:
        """`attach device to a, b;`."""
        return ast.Attach(span, device, tuple(self.without_trailing_comma(names)))

    def action(
        self, span: Span, phase: Name, level: Number, verb: Name, device: Name, by: Name | None
    ) -> ast.Action:
        """`on startup level 5 calibrate device by calibrator;`."""
        self.check_choice(phase, PHASES, "phase with actions")
        self.check_choice(verb, VERBS, "action")
        return ast.Action(span, phase, level, verb, device, by)
