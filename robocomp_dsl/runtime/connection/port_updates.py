"""Applies a change to an open port, without interrupting calls that wait for a reply.

In: the port before and after the change. Out: the port uses other peers, another name or quality of
service; or `UnchangeablePort` says why it cannot while the component runs, and nothing has changed.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

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

_Port = TypeVar("_Port", ServingPort, ServiceChannel, TopicChannel, SubscribedPort)


class UnchangeablePort(MiddlewareError):
    """The port cannot be changed in this way while the component runs."""


def update_port(ports: ComponentPorts, role: str, before: Endpoint, at: Endpoint) -> None:
    """Change the port `before` to `at`. Raises `MiddlewareError`; then nothing has changed."""
    check_qos(at, role, at.middlewares)
    if role == "server":
        _update_server(_find(ports.servers, before), at)
    elif role == "client":
        _find(ports.channels, before).update(at)
    elif role == "publisher":
        _update_topic(ports, _find(ports.topics, before), at)
    else:
        _find(ports.subscribed, before).update(at)


def _find(opened: list[_Port], before: Endpoint) -> _Port:
    for port in opened:
        if port.at.interface is before.interface and port.at.port == before.port:
            return port
    raise UnchangeablePort(
        f"the connections of `{before.port}` cannot be changed while the component runs: they are"
        " part of its lock-step or monitored, or the port is not open yet"
    )


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
