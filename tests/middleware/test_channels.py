"""The calling side of a service and the publishing side of a topic, in what no transport shows."""

from __future__ import annotations

import uuid
from typing import Any, NoReturn

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.connection.server_selector import ServerSelector
from robocomp_dsl.runtime.connection.service_channel import ServiceChannel
from robocomp_dsl.runtime.middleware.transport import BoundOperation, ServerLost
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry
from tests.middleware.probe_types import NEWS, PROBE, NewsProxy
from tests.support.waiting import wait_until


class BrokenConnection:
    """The client of a server that has just exited."""

    def bind(self, *_: object) -> BoundOperation:
        def send(_payload: object) -> NoReturn:
            raise ServerLost

        return BoundOperation(None, send)

    def cancel(self) -> None: ...
    def close(self) -> None: ...
    def set_timeout(self, seconds: float) -> None: ...


def test_service_channel_command_takes_slot_again_when_interrupted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    group, registry = CallbackGroup(), PortRegistry()
    context = ComponentContext("client", "domain", group, Statistics())
    server = PortRecord("server", PROBE.name, "server", "Probe", PROBE.hash.hex(), "inproc")
    registry.add("server", server)
    selector = ServerSelector(Endpoint(PROBE, "client", "Probe"), registry, group, lambda *_: True)
    channel = ServiceChannel(
        context, registry, selector, lambda *_: BrokenConnection(), lambda _: None
    )
    note = channel.bind(PROBE.operation("note"))

    def interrupt(*_: object) -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setattr(registry, "wait_lost", interrupt)
    with group:
        with pytest.raises(KeyboardInterrupt):
            note("text")
        assert group.busy
        assert not group.acquire(False)
    assert not group.busy


def test_topic_channel_on_several_middlewares_counts_publication_once() -> None:
    domain, names = f"test-{uuid.uuid4().hex[:12]}", ("inproc", "zenoh")
    received: dict[str, list[int]] = {name: [] for name in names}
    opened: list[Any] = []

    def open_component(name: str) -> tuple[Any, Statistics]:
        statistics = Statistics()
        ports = open_ports("zenoh", ComponentContext(name, domain, CallbackGroup(), statistics))
        opened.append(ports)
        return ports, statistics

    try:
        for name in names:
            ports, _ = open_component(f"listener-{name}")
            at = Endpoint(NEWS, f"listener-{name}", "News", middlewares=(name,))
            append = received[name].append
            ports.subscribe(at, {"announced": lambda _, n, a=append: a(n)}, CallbackGroup())
        speaker, statistics = open_component("speaker")
        at = Endpoint(NEWS, "speaker", "News", middlewares=names)
        channel = speaker.advertise(at)
        news = NewsProxy(channel)
        wait_until(
            lambda: (
                news.has_subscribers()
                and all(port.publisher.has_subscribers() for port in channel.ports)
            )
        )
        news.announced("me", 1)
        wait_until(lambda: received == {"inproc": [1], "zenoh": [1]}, lambda: str(received))
        assert statistics.of("News", "announced").calls == 1
    finally:
        for ports in opened:
            ports.close()


def test_topic_channel_publishes_where_somebody_subscribes() -> None:
    domain, received = f"test-{uuid.uuid4().hex[:12]}", []
    opened: list[Any] = []
    contexts = {
        name: ComponentContext(name, domain, CallbackGroup(), Statistics())
        for name in ("speaker", "near", "far")
    }
    try:
        opened += [open_ports("zenoh", context) for context in contexts.values()]
        speaker, near, far = opened
        at = Endpoint(NEWS, "speaker", "News", middlewares=("inproc", "zenoh"))
        channel = speaker.advertise(at)
        news = NewsProxy(channel)

        def listen(ports: Any, name: str, middleware: str) -> None:
            at = Endpoint(NEWS, name, "News", middlewares=(middleware,))
            handlers = {"announced": lambda _, n: received.append((name, n))}
            ports.subscribe(at, handlers, CallbackGroup())

        listen(near, "near", "inproc")
        wait_until(news.has_subscribers)
        news.announced("me", 1)
        wait_until(lambda: received == [("near", 1)])
        counts = contexts["speaker"].statistics.of("News", "announced")
        assert (counts.calls, counts.bytes_out) == (1, 0)
        listen(far, "far", "zenoh")
        wait_until(channel.ports[1].publisher.has_subscribers)
        news.announced("me", 2)
        wait_until(lambda: sorted(received) == [("far", 2), ("near", 1), ("near", 2)])
        assert (counts.calls, counts.bytes_out > 0) == (2, True)
    finally:
        for ports in opened:
            ports.close()
