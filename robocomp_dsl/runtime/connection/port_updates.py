"""Applies a change to an open port, without interrupting calls that wait for a reply.

In: the port before and after the change. Out: the port uses other peers, another name or quality of
service; or `UnchangeablePort` says why it cannot while the component runs, and nothing has changed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

from robocomp_dsl.runtime.component.naming import is_port_of_connection
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.latched_messages import LatchedMessages
from robocomp_dsl.runtime.connection.qos_merge import sender_qos
from robocomp_dsl.runtime.connection.qos_support import check_qos
from robocomp_dsl.runtime.connection.service_channel import ServiceChannel
from robocomp_dsl.runtime.connection.serving_port import ServingPort
from robocomp_dsl.runtime.connection.subscribed_port import SubscribedPort
from robocomp_dsl.runtime.connection.topic_channel import TopicChannel
from robocomp_dsl.runtime.errors import MiddlewareError

_Port = TypeVar("_Port", bound=ServingPort | ServiceChannel | TopicChannel | SubscribedPort)


class UnchangeablePort(MiddlewareError):
    """The port cannot be changed in this way while the component runs."""


def update_port(ports: ComponentPorts, role: str, before: Endpoint, at: Endpoint) -> None:
    """Change the port `before` to `at`. Raises `MiddlewareError`; then nothing has changed."""
    check_qos(at, role, at.middlewares)
    if role == "server":
        _update_all(_opened(ports.servers, before, at), _update_server)
    elif role == "client":
        _update_all(_opened(ports.channels, before, at), ServiceChannel.update)
    elif role == "publisher":
        _update_all(
            _opened(ports.topics, before, at), lambda topic, new: _update_topic(ports, topic, new)
        )
    else:
        _update_all(_opened(ports.subscribed, before, at), SubscribedPort.update)


def _update_all(
    changes: list[tuple[_Port, Endpoint]], update: Callable[[_Port, Endpoint], None]
) -> None:
    """Change all ports or, if one refuses, none of them."""
    changed: list[tuple[_Port, Endpoint]] = []
    try:
        for port, at in changes:
            changed.append((port, port.at))
            update(port, at)
    except MiddlewareError:
        for port, former in changed[:-1]:
            update(port, former)
        raise


def _opened(
    opened: Sequence[_Port], before: Endpoint, at: Endpoint
) -> list[tuple[_Port, Endpoint]]:
    """The open ports of `before`, and what becomes of each.

    A port with monitored connections consists of several, and a client whose server monitors it
    names another port of the server: only their quality of service can change.
    """
    same = [port for port in opened if port.at.interface is before.interface]
    exact = [port for port in same if port.at.port == before.port]
    own = [port for port in same if is_port_of_connection(port.at.port, before.port)]
    if not exact and not own:
        raise UnchangeablePort(
            f"the connections of `{before.port}` cannot be changed while the component runs: they"
            " are part of its lock-step, or the port is not open yet"
        )
    if not own and all(port.at.peers == before.peers for port in exact):
        return [(exact[0], at)]
    if replace(at, qos=before.qos, peer_qos=before.peer_qos) != before:
        raise UnchangeablePort(
            f"`{before.port}` has monitored connections: while the component runs, only their"
            " quality of service can change; write the connection into the deployment"
        )
    return [(port, replace(port.at, qos=at.qos, peer_qos=at.peer_qos)) for port in (*exact, *own)]


def _update_server(server: ServingPort, at: Endpoint) -> None:
    before = server.at.qos
    if replace(before, thread_priority=None) != replace(at.qos, thread_priority=None):
        raise UnchangeablePort(
            f"of the served port `{at.port}` only `thread_priority` can change while it runs;"
            " its callers have the priority, and its depth is fixed when it starts"
        )
    if at.port != server.at.port:
        server.rename(at)
    else:
        server.at = at
    if before.thread_priority != at.qos.thread_priority:
        server.set_thread_priority(at.qos.thread_priority)


def _update_topic(ports: ComponentPorts, topic: TopicChannel, at: Endpoint) -> None:
    publishers = [ports.publisher(port.middleware, at) for port in topic.ports]
    records = [
        ports.declare("publisher", at, port.middleware, publisher.address)
        for port, publisher in zip(topic.ports, publishers, strict=True)
    ]
    former, topic.records = topic.records, records
    topic.replace_publishers(at, publishers)
    for record in former:
        if record not in records:
            ports.presence.withdraw(record)
    is_latched = bool(sender_qos(at).latched)
    if is_latched != topic.is_latched:
        topic.set_latched(LatchedMessages(at, ports.presence) if is_latched else None)
