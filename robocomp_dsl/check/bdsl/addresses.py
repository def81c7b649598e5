"""Addresses of the whole bridge: loops, and addresses that two ports share.

In: the resolved ports. Out: findings.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from robocomp_dsl.check.bdsl.context import BridgeContext
from robocomp_dsl.check.codes import bridge as codes
from robocomp_dsl.diagnostics import Note
from robocomp_dsl.model.bridge_ports import BridgePort

_CARRIER = re.compile(r"[a-z_]+:(?=/)")


def check_addresses(
    inputs: Iterable[BridgePort],
    outputs: Iterable[BridgePort],
    services: Iterable[BridgePort],
    context: BridgeContext,
) -> None:
    """Report loops, outputs with one address, and services with one address."""
    received = {_key(port): port for port in inputs if _names_topic(port, context)}
    sent: dict[tuple[str, str], BridgePort] = {}
    for port in outputs:
        if not _names_topic(port, context):
            continue
        key = _key(port)
        if key in received:
            _report_loop(port, received[key], context)
        first = sent.setdefault(key, port)
        if first is not port and _same_receiver(first, port):
            _report_shared(port, first, context)
    served: dict[tuple[str, str], BridgePort] = {}
    for port in services:
        first = served.setdefault(_key(port), port) if port.address else port
        if first is not port:
            _report_served_twice(port, first, context)


def _names_topic(port: BridgePort, context: BridgeContext) -> bool:
    """Whether the address names a topic or port of a program, not a component."""
    description = context.workspace.middlewares.describe(port.middleware)
    return bool(port.address and description and description.capabilities.external_peers)


def _same_receiver(first: BridgePort, second: BridgePort) -> bool:
    """Whether receivers cannot tell two outputs: not two operations of an imported interface."""
    return first.is_own or second.is_own or first.operation is second.operation


def _key(port: BridgePort) -> tuple[str, str]:
    return port.middleware, _CARRIER.sub("", port.address).lstrip("/")


def _report_loop(port: BridgePort, source: BridgePort, context: BridgeContext) -> None:
    context.report.add(
        codes.BRIDGE_LOOP,
        port.span,
        f"`{port.name}` sends to `{port.address}`, from which `{source.name}` receives",
        label="each message would cause the next one",
        notes=[Note(source.span, "received here")],
        help="choose another address for one of them",
    )


def _report_shared(port: BridgePort, first: BridgePort, context: BridgeContext) -> None:
    context.report.add(
        codes.SHARED_ADDRESS,
        port.span,
        f"`{first.name}` and `{port.name}` both send to `{port.address}`",
        notes=[Note(first.span, "the other one is here")],
        help="receivers cannot tell them apart; use two addresses",
    )


def _report_served_twice(port: BridgePort, first: BridgePort, context: BridgeContext) -> None:
    context.report.add(
        codes.BRIDGE_ADDRESS,
        port.span,
        f"`{first.name}` and `{port.name}` are both served at `{port.address}`",
        notes=[Note(first.span, "the other one is here")],
        help="choose another address for one of them",
    )
