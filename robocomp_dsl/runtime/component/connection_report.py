"""The connections of a running component as data.

In: the wiring of the component, its presence and its counts. Out: a `ConnectionInfo` for each
connection of each port.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Protocol

from robocomp_dsl.runtime.component.qos_settings import format_qos
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.component.wiring import Wiring
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts
from robocomp_dsl.runtime.connection.connections_interface import ConnectionInfo, ConnectionState
from robocomp_dsl.runtime.connection.endpoint import NOBODY, Endpoint
from robocomp_dsl.runtime.connection.interface_version import is_other_version
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.qos_merge import connection_qos, sender_qos
from robocomp_dsl.runtime.connection.usable_records import is_reachable
from robocomp_dsl.runtime.middleware import registry
from robocomp_dsl.runtime.presence.port_record import PortRecord

_ROLE_NAMES = {
    "server": "implements",
    "client": "requires",
    "publisher": "publishes",
    "subscriber": "subscribesTo",
}
_PEER_ROLES = {"client": "server", "subscriber": "publisher", "publisher": "subscriber"}


class MonitorReport(Protocol):
    """What monitors say of a connection."""

    port: str
    peer: str
    monitors: tuple[str, ...]
    state: str
    passed: int
    rejected: int


class ConnectionReport:
    """The connections of one component."""

    def __init__(self, wiring: Wiring, ports: ComponentPorts, statistics: Statistics) -> None:
        self._wiring = wiring
        self._ports = ports
        self._statistics = statistics

    def connections(self, monitors: Iterable[MonitorReport] = ()) -> list[ConnectionInfo]:
        """All connections, in the order of the ports."""
        self._statistics.refresh()
        reports = list(monitors)
        found: list[ConnectionInfo] = []
        for role, port in self._wiring.ports():
            at = self._wiring.endpoint(port)
            for info in self._of_port(role, at):
                self._add_counts(info, at.port)
                _add_monitors(info, reports)
                found.append(info)
        return found

    def _of_port(self, role: str, at: Endpoint) -> Iterator[ConnectionInfo]:
        default = ConnectionInfo(
            port=at.port,
            role=_ROLE_NAMES[role],
            declared=at.interface.name,
            middleware=", ".join(at.middlewares),
            qos=format_qos(sender_qos(at) if role == "publisher" else at.qos),
        )
        if role == "server":
            yield default
        elif role == "publisher":
            yield from self._subscribers(at, default)
        else:
            yield from self._peers(role, at, default)

    def _subscribers(self, at: Endpoint, default: ConnectionInfo) -> Iterator[ConnectionInfo]:
        found = self._ports.presence.registry.find("subscriber", at.interface.name)
        searching = (r for r in found if matches(_as_endpoint(at, r), at.component, at.port))
        infos = [self._info(default, record, at) for record in _usable_of_each(searching, at)]
        infos += [self._info(default, record, at) for record in at.external]
        if not infos:
            default.state = ConnectionState.Waiting
            default.reason = "no subscriber"
            infos = [default]
        yield from infos

    def _peers(self, role: str, at: Endpoint, default: ConnectionInfo) -> Iterator[ConnectionInfo]:
        known = self._ports.presence.registry.find(_PEER_ROLES[role], at.interface.name)
        for record in at.external:
            yield self._info(default, record, at)
        if at.external and not at.peers:
            return
        for peer in at.peers or ("",):
            own = replace(at, peers=(peer,) if peer else ())
            found = _usable_of_each((r for r in known if matches(own, r.component, r.port)), at)
            for record in found:
                info = self._info(default, record, at)
                info.qos = format_qos(connection_qos(at, peer or record.name))
                yield info
            if not found:
                waiting = _copy(default)
                waiting.peer = "" if peer == NOBODY else peer
                waiting.state = ConnectionState.Waiting
                waiting.reason = "disconnected" if peer == NOBODY else "there is no such port"
                waiting.qos = format_qos(connection_qos(at, peer))
                yield waiting

    def _info(self, default: ConnectionInfo, record: PortRecord, at: Endpoint) -> ConnectionInfo:
        info = _copy(default)
        info.peer = record.name
        info.middleware = record.middleware or default.middleware
        reason = _obstacle(record, at)
        if reason:
            info.state, info.reason = ConnectionState.Unreachable, reason
        return info

    def _add_counts(self, info: ConnectionInfo, port: str) -> None:
        for counts in list(self._statistics.operations.values()):
            if counts.port == port:
                info.calls += counts.calls
                info.failures += counts.failures
                info.drops += counts.drops
                info.missed += counts.missed
                info.held += counts.held


def _usable_of_each(records: Iterable[PortRecord], at: Endpoint) -> list[PortRecord]:
    """The records of each peer, without those that do not matter because another one is usable."""
    found = list(records)
    usable = {record.name for record in found if not _obstacle(record, at)}
    return [r for r in found if r.name not in usable or not _obstacle(r, at)]


def _as_endpoint(at: Endpoint, record: PortRecord) -> Endpoint:
    return Endpoint(at.interface, record.component, record.port, record.peers)


def _needs_same_version(record: PortRecord) -> bool:
    """Whether all operations must be the same; otherwise those work that are."""
    capabilities = registry.known_capabilities(record.middleware)
    return record.role != "server" and not (capabilities and capabilities.topic_versions)


def _obstacle(record: PortRecord, at: Endpoint) -> str:
    """Why the two ports cannot exchange anything, or ""."""
    if _needs_same_version(record) and is_other_version(at, record):
        return "it was generated from another version of the interface"
    if at.middlewares and record.middleware and record.middleware not in at.middlewares:
        own = ", ".join(at.middlewares)
        return f"it is on {record.middleware}, this port on {own}"
    capabilities = registry.known_capabilities(record.middleware)
    if capabilities is None:
        return f"the middleware {record.middleware} is not installed here"
    return "" if is_reachable(record, capabilities) else "it is in another process"


def _copy(info: ConnectionInfo) -> ConnectionInfo:
    return ConnectionInfo(
        port=info.port,
        role=info.role,
        declared=info.declared,
        peer=info.peer,
        middleware=info.middleware,
        qos=info.qos,
    )


def _add_monitors(info: ConnectionInfo, reports: list[MonitorReport]) -> None:
    for report in reports:
        if report.port == info.port and info.peer in report.peer:
            info.monitors = list(report.monitors)
            info.monitorState = report.state
            info.passed, info.rejected = report.passed, report.rejected
            info.condition = getattr(report, "constraint", "")
            info.winner = bool(getattr(report, "is_winner", False))
