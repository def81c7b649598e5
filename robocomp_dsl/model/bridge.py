"""Bridges of BDSL, resolved and typed.

Ports and inputs are in `bridge_ports`, expressions and hubs in `bridge_values`.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.model.bridge_actions import BridgeAction
from robocomp_dsl.model.bridge_ports import BridgeFunction, BridgeInput, BridgePort
from robocomp_dsl.model.bridge_values import BridgeCall, BridgeHub, BuiltValue, ExpressionUse
from robocomp_dsl.model.interface import Module
from robocomp_dsl.record import Record
from robocomp_dsl.source import Span


class BridgeOutput(Record):
    """A topic or one-way operation that the bridge sends; one argument for each parameter.

    `rate_hz` None: it is sent when what it reads is complete anew.
    """

    name: str
    port: BridgePort
    rate_hz: float | None
    arguments: tuple[BuiltValue, ...]
    uses: ExpressionUse
    doc: str = ""


class BridgeService(Record):
    """An operation that the bridge serves: the calls in order, then the reply.

    `reply` has one value for each output of the operation; the result comes first, as a parameter
    called `result`.
    """

    name: str
    port: BridgePort
    calls: tuple[BridgeCall, ...]
    reply: tuple[BuiltValue, ...]
    doc: str = ""


class Bridge(Record):
    """One BDSL file. `modules` are the imported IDSL modules.

    `types` is the module `<Bridge>Types` with the interfaces and types that the bridge declares, or
    None if it needs none. Its sequences may have a `size`, which IDSL cannot express: the bridge
    checks it (`BridgeInput.length_checks`).
    """

    name: str
    path: Path
    span: Span
    modules: tuple[Module, ...]
    types: Module | None
    inputs: tuple[BridgeInput, ...]
    functions: tuple[BridgeFunction, ...]
    hubs: tuple[BridgeHub, ...]
    outputs: tuple[BridgeOutput, ...]
    services: tuple[BridgeService, ...]
    actions: tuple[BridgeAction, ...] = ()
    middleware: str = "zenoh"
    doc: str = ""

    @property
    def received(self) -> tuple[BridgeInput, ...]:
        """All topics that it receives: inputs, then those of actions."""
        return (*self.inputs, *(item for action in self.actions for item in action.inputs))

    @property
    def ports(self) -> tuple[BridgePort, ...]:
        """All ports, in order: inputs, outputs, services, calls, those of actions."""
        calls = (call.port for service in self.services for call in service.calls)
        received = (item.port for item in self.inputs)
        sent = (item.port for item in self.outputs)
        served = (service.port for service in self.services)
        of_actions = (port for action in self.actions for port in action.ports)
        return (*received, *sent, *served, *calls, *of_actions)
