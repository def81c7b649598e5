"""What all checks of a bridge share: names, imported types, the types module and the report."""

from __future__ import annotations

from typing import NoReturn

from robocomp_dsl.check.bdsl.types_module import TypesModule
from robocomp_dsl.check.names.import_scope import ImportScope
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Code, Fix, Report
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput
from robocomp_dsl.model.bridge_values import (
    BridgeHub,
    Expression,
    ItemAt,
    LengthChecked,
    Negated,
    Selected,
    Sliced,
)
from robocomp_dsl.model.interface import Module
from robocomp_dsl.source import Span


class FaultyExpression(Exception):
    """An expression has no type; what is wrong with it was reported."""


class BridgeContext:
    """The declarations of one bridge while they are resolved.

    A name whose value is None is declared, but faulty: what uses it gives no further finding.
    `declared` are the names in the declarations of the file, by their text.
    `further_modules` are those that the types of actions need besides the imports. `is_complete`:
    the file has no syntax errors, so an unknown name is an error of its own.
    """

    def __init__(
        self,
        scope: ImportScope,
        types: TypesModule,
        workspace: Workspace,
        report: Report,
        *,
        is_complete: bool,
    ) -> None:
        self.scope = scope
        self.types = types
        self.workspace = workspace
        self.report = report
        self.is_complete = is_complete
        self.middleware = ""
        self.inputs: dict[str, BridgeInput | None] = {}
        self.functions: dict[str, BridgeFunction | None] = {}
        self.hubs: dict[str, BridgeHub | None] = {}
        self.declared: dict[str, Span] = {}
        self.used_names: set[str] = set()
        self.port_names: set[str] = set()
        self.further_modules: list[Module] = []
        self._stated: dict[int, Expression] = {}

    def fail(
        self, code: Code, span: Span, message: str, help_: str = "", fix: Fix | None = None
    ) -> NoReturn:
        """Report an error of an expression. Raises `FaultyExpression`."""
        self.report.add(code, span, message, help=help_, fix=fix)
        raise FaultyExpression

    def call_name(self, call: str, service: str) -> str:
        """A port name for a call of `service`, unique without case in the bridge."""
        longer = f"{service}_{call}"
        names = (call, longer, *(f"{longer}{number}" for number in range(2, 1000)))
        free = next(name for name in names if name.lower() not in self.port_names)
        self.port_names.add(free.lower())
        return free

    def state_unit(self, value: Expression) -> None:
        """Remember that the user stated the unit of `value` with `to`."""
        self._stated[id(value)] = value

    def states_unit(self, value: Expression) -> bool:
        """Whether the user stated the unit of `value` with `to`."""
        if isinstance(value, (ItemAt, Selected, Sliced, LengthChecked, Negated)):
            return self.states_unit(value.value)
        return id(value) in self._stated
