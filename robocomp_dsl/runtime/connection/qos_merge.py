"""Combines qualities of service: of a port and its connections, and of several connections."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import fields, replace
from typing import Any

from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos

PRIORITIES = ("background", "low", "normal", "high", "realtime")
"""Priorities of messages, the lowest first."""

_SELECT: dict[str, Callable[[Iterable[Any]], Any]] = {
    "reliable": any,
    "keep_all": any,
    "latched": any,
    "depth": max,
    "priority": lambda names: max(names, key=PRIORITIES.index),
    "deadline": min,
    "liveliness": min,
    "thread_priority": max,
}


def override(qos: Qos, items: Qos) -> Qos:
    """`qos` with the specified items of `items`."""
    specified = {f.name: getattr(items, f.name) for f in fields(items)}
    return replace(qos, **{name: value for name, value in specified.items() if value is not None})


def strictest(qualities: Iterable[Qos]) -> Qos:
    """The quality of service that satisfies all of `qualities`."""
    requested = list(qualities)
    merged: dict[str, Any] = {}
    for name, select in _SELECT.items():
        values = [value for qos in requested if (value := getattr(qos, name)) is not None]
        merged[name] = select(values) if values else None
    return Qos(**merged)


def connection_qos(at: Endpoint, peer: str) -> Qos:
    """The quality of service of the connection of a port with `peer` (`component.port`).

    Items for the component of the peer apply, too; those for its port are stronger.
    """
    qos = at.qos
    component, dot, _ = peer.rpartition(".")
    names = (component, peer) if dot else (peer,)
    for name in names:
        for named, items in at.peer_qos:
            # A connection may name the component only; it then has one such port.
            if named == name or (not dot and named.startswith(f"{peer}.")):
                qos = override(qos, items)
    return qos


def sender_qos(at: Endpoint) -> Qos:
    """The quality of service of all connections of a port together, as of a publisher.

    A message is sent once for all of them.
    """
    return strictest((at.qos, *(items for _, items in at.peer_qos)))
