"""Connections of running components: listed, and changed while messages and calls travel."""

from __future__ import annotations

import threading
import uuid
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from robocomp_dsl.runtime import CalledPort, Component, ComponentSpec, ServedPort
from robocomp_dsl.runtime.client import DomainClient
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.connection.connections_interface import (
    COMPONENTCONNECTIONS,
    ComponentConnectionsProxy,
    ConnectionInfo,
    ConnectionState,
    Refusal,
)
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.connection.qos_support import UnsupportedQos
from robocomp_dsl.runtime.errors import NoServer
from robocomp_dsl.runtime.middleware.registry import capabilities_of
from robocomp_dsl.runtime.parameters import Parameters
from tests.middleware.probe_types import NEWS, PROBE, NewsProxy, ProbeProxy
from tests.support.waiting import wait_until


class Source(Component):
    """Publishes its name, and adds numbers; `gate` holds `block`."""

    SPEC = ComponentSpec(
        name="source",
        period=2,
        threads=2,
        implements=(ServedPort("Probe", PROBE, {"add": "add", "block": "block"}),),
        publishes=(CalledPort("News", NewsProxy, "news_proxy"),),
    )
    news_proxy: NewsProxy

    def __init__(self) -> None:
        self.gate = threading.Event()
        self.blocked = threading.Event()
        self.number = 0

    def compute(self) -> None:
        self.news_proxy.announced(self.name, self.number)
        self.number += 1

    def add(self, a: int, b: int) -> int:
        return a + b if self.name == "a" else a + b + 1000

    def block(self) -> None:
        self.blocked.set()
        self.gate.wait(60)


class Sink(Component):
    """Receives news, and calls `Probe`."""

    SPEC = ComponentSpec(
        name="sink",
        period=0,
        threads=2,
        requires=(CalledPort("Probe", ProbeProxy, "probe_proxy"),),
        subscribes=(ServedPort("News", NEWS, {"announced": "announced"}),),
    )
    probe_proxy: ProbeProxy

    def __init__(self) -> None:
        self.received: list[tuple[str, int]] = []

    def announced(self, who: str, number: int) -> None:
        self.received.append((who, number))

    def sources(self, last: int = 20) -> set[str]:
        return {who for who, _ in self.received[-last:]}


class Speaker(Component):
    """Publishes when the test does it."""

    SPEC = ComponentSpec(
        name="speaker", period=0, publishes=(CalledPort("News", NewsProxy, "news_proxy"),)
    )
    news_proxy: NewsProxy


class Deployment:
    """Two sources `a` and `b`, and a sink that is connected to `a`."""

    def __init__(self, middleware: str, *, qos: dict[str, Qos] | None = None) -> None:
        self.domain = f"test-{uuid.uuid4().hex[:12]}"
        self.middleware = middleware
        self.runners: list[Runner] = []
        self.a, self.b = (self.start(Source, name=n).worker for n in ("a", "b"))
        connections = {"News": ("a",), "Probe": ("a",)}
        self.runner = self.start(Sink, connections=connections, qos=qos or {})
        self.sink: Any = self.runner.worker
        self.client = DomainClient(self.domain, middleware)
        self.sink_connections = self.connections("sink")

    def start(self, component: type[Component], **settings: Any) -> Runner:
        chosen = RunSettings(domain=self.domain, middleware=self.middleware, **settings)
        runner = Runner(component, Parameters(), chosen)
        runner.start()
        self.runners.append(runner)
        return runner

    def connections(self, name: str) -> ComponentConnectionsProxy:
        channel = self.client.channel(COMPONENTCONNECTIONS, name, "Component")
        proxy = ComponentConnectionsProxy(channel)
        assert proxy.wait_for_server(60)
        return proxy

    def list(self, name: str) -> dict[tuple[str, str], ConnectionInfo]:
        return {(i.port, i.peer): i for i in self.connections(name).getConnections()}

    def close(self) -> None:
        self.client.close()
        for runner in self.runners:
            if isinstance(runner.worker, Source):
                runner.worker.gate.set()
            runner.stop()
            assert runner.wait()


@pytest.fixture(params=["inproc", "local", "zenoh"])
def deployment(request: pytest.FixtureRequest) -> Iterator[Deployment]:
    opened = Deployment(request.param)
    yield opened
    opened.close()


def test_connections_are_listed_with_states_and_counts(deployment: Deployment) -> None:
    sink = deployment.sink
    wait_until(lambda: sink.received and sink.probe_proxy.wait_for_server(60))
    assert sink.probe_proxy.add(1, 2) == 3
    wait_until(lambda: ("News", "a.News") in deployment.list("sink"))
    listed = deployment.list("sink")
    news, probe = listed["News", "a.News"], listed["Probe", "a.Probe"]
    assert (news.role, probe.role) == ("subscribesTo", "requires")
    assert news.state is probe.state is ConnectionState.Connected
    assert news.middleware == deployment.middleware
    assert news.calls > 0
    assert probe.calls == 1
    wait_until(lambda: ("News", "sink.News") in deployment.list("a"))
    assert deployment.list("b")["News", ""].state is ConnectionState.Waiting


def test_connect_and_disconnect_change_the_publishers(deployment: Deployment) -> None:
    sink = deployment.sink
    wait_until(lambda: sink.received)
    deployment.sink_connections.connect("News", "/b.News", "")
    wait_until(lambda: sink.sources() == {"a", "b"})
    deployment.sink_connections.disconnect("News", "/a.News")
    wait_until(lambda: sink.sources() == {"b"})
    numbers = [n for who, n in sink.received if who == "b"]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    deployment.sink_connections.disconnect("News", "b")
    info = wait_until(lambda: deployment.list("sink").get(("News", "")))
    assert (info.state, info.reason) == (ConnectionState.Waiting, "disconnected")
    count = len(sink.received)
    published = deployment.b.number
    wait_until(lambda: deployment.b.number > published + 20)
    assert len(sink.received) <= count + 1


def test_connect_keeps_messages_of_other_connections(deployment: Deployment) -> None:
    sink = deployment.sink
    wait_until(lambda: sink.received)
    for _ in range(5):
        deployment.sink_connections.connect("News", "/b.News", "")
        deployment.sink_connections.disconnect("News", "/b.News")
    length = len(sink.received)
    wait_until(lambda: len(sink.received) > length + 20)
    numbers = [n for who, n in sink.received if who == "a"]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_connect_moves_calls_and_keeps_those_on_the_way(deployment: Deployment) -> None:
    sink = deployment.sink
    assert sink.probe_proxy.wait_for_server(60)
    results: list[str] = []

    def call() -> None:
        sink.probe_proxy.block()
        results.append("answered")

    caller = threading.Thread(target=call)
    caller.start()
    assert deployment.a.blocked.wait(60)
    deployment.sink_connections.disconnect("Probe", "a")
    with pytest.raises(NoServer, match="disconnected"):
        sink.probe_proxy.add(1, 2)
    deployment.sink_connections.connect("Probe", "/b", "")
    wait_until(lambda: sink.probe_proxy.add(1, 2) == 1003)
    assert not results
    deployment.a.gate.set()
    caller.join(60)
    assert results == ["answered"]


def test_remap_of_served_and_published_ports(deployment: Deployment) -> None:
    sink = deployment.sink
    wait_until(lambda: sink.received)
    deployment.connections("b").remap("Probe", "Second")
    deployment.connections("b").remap("News", "Other")
    deployment.sink_connections.connect("News", "/b.Other", "")
    wait_until(lambda: "b" in sink.sources())
    deployment.sink_connections.disconnect("Probe", "/a")
    deployment.sink_connections.connect("Probe", "/b.Second", "")
    wait_until(lambda: sink.probe_proxy.add(0, 0) == 1000)
    with pytest.raises(Refusal, match="has the name"):
        deployment.connections("b").remap("Probe", "Other")


def test_remap_of_a_searching_port_selects_peers_by_port(deployment: Deployment) -> None:
    deployment.connections("b").remap("News", "Other")
    deployment.sink_connections.disconnect("News", "a")
    deployment.sink_connections.connect("News", "/b.Other", "")
    wait_until(lambda: "b" in deployment.sink.sources())


def test_connections_change_before_the_ports_are_open(deployment: Deployment) -> None:
    class LateSink(Sink):
        SPEC = replace(Sink.SPEC, name="late_sink")
        gate = threading.Event()

        def initialize(self) -> None:
            self.gate.wait(60)

    runner = deployment.start(LateSink, connections={"News": ("a",)})
    late: Any = runner.worker
    connections = deployment.connections("late_sink")
    connections.disconnect("News", "a")
    connections.connect("News", "/b.News", "")
    connections.setQos("News", "b.News", "depth=7")
    with pytest.raises(Refusal, match="not connected to `a`"):
        connections.disconnect("News", "a")
    late.gate.set()
    wait_until(lambda: late.sources() == {"b"})
    (port,) = runner.ports.subscribed
    assert [each.at.qos.depth for each in port.subscriptions] == [7]


def test_set_qos_changes_depth_of_one_connection(deployment: Deployment) -> None:
    sink = deployment.sink_connections
    sink.connect("News", "/b.News", "")
    assert sink.setQos("News", "b.News", "depth=7,deadline=2000") == "depth=7,deadline=2000"
    assert sink.setQos("News", "b.News", "deadline=off") == "depth=7"
    assert sink.setQos("News", "", "depth=3") == "depth=3"
    depths = {
        each.at.peers: each.at.qos.depth
        for port in deployment.runner.ports.subscribed
        if port.at.port == "News"
        for each in port.subscriptions
    }
    assert depths == {("a",): 3, ("b.News",): 7}
    wait_until(lambda: deployment.sink.sources() == {"a", "b"})


def test_set_qos_of_a_publisher_takes_effect_while_it_publishes(deployment: Deployment) -> None:
    wait_until(lambda: deployment.sink.received)
    source = deployment.connections("a")
    if "priority" not in capabilities_of(deployment.middleware).qos:
        with pytest.raises(Refusal, match="`priority`, which the middleware"):
            source.setQos("News", "sink.News", "priority=high")
        return
    assert source.setQos("News", "sink.News", "priority=high") == "priority=high"
    length = len(deployment.sink.received)
    wait_until(lambda: len(deployment.sink.received) > length + 10)
    assert deployment.list("a")["News", "sink.News"].qos == "priority=high"


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (("connect", "Nwes", "/b", ""), "no port `Nwes`; its ports: Probe, News"),
        (("connect", "News", "/a", ""), "connected to `a` already"),
        (("connect", "News", "b b", ""), "not a valid component name"),
        (("connect", "News", "/b", "carrier"), "no middleware `carrier`"),
        (("disconnect", "News", "/b"), "not connected to `b`; its connections: a"),
        (("remap", "News", "1x"), "not a remap"),
        (("setQos", "News", "", "fast"), "`fast` is not a quality of service"),
        (("setQos", "News", "b.News", "depth=2"), "not connected to `b.News`"),
        (("setQos", "Probe", "", "deadline=5"), "`deadline`, which only topics have"),
    ],
)
def test_wrong_requests_are_refused(call: tuple[str, ...], text: str) -> None:
    deployment = Deployment("inproc")
    try:
        connected = {("News", "a.News"), ("Probe", "a.Probe")}
        wait_until(lambda: connected <= set(deployment.list("sink")))
        before = [(i.port, i.peer, i.qos) for i in deployment.list("sink").values()]
        with pytest.raises(Refusal) as refused:
            getattr(deployment.sink_connections, call[0])(*call[1:])
        assert text in refused.value.reason
        assert [(i.port, i.peer, i.qos) for i in deployment.list("sink").values()] == before
        with pytest.raises(Refusal, match="change it there"):
            deployment.connections("a").connect("News", "/sink.News", "")
        wait_until(lambda: any(port == "Probe" for port, _ in deployment.list("a")))
        with pytest.raises(Refusal, match="only `thread_priority`"):
            deployment.connections("a").setQos("Probe", "", "depth=2")
    finally:
        deployment.close()


def test_publisher_becomes_latched_and_not_latched_while_it_runs(deployment: Deployment) -> None:
    speaker: Any = deployment.start(Speaker).worker
    connections = deployment.connections("speaker")
    speaker.news_proxy.announced("speaker", 1)
    assert connections.setQos("News", "", "latched") == "latched"
    speaker.news_proxy.announced("speaker", 2)
    peers = {"News": ("speaker",), "Probe": ("a",)}
    qos = {"News": Qos(latched=True)}
    late: Any = deployment.start(Sink, name="late", connections=peers, qos=qos).worker
    wait_until(lambda: late.received == [("speaker", 2)], "the latest message arrives")
    assert connections.setQos("News", "", "latched=off") == ""
    speaker.news_proxy.announced("speaker", 3)
    later: Any = deployment.start(Sink, name="later", connections=peers, qos=qos).worker
    numbers = iter(range(4, 10_000))

    def is_received() -> bool:
        speaker.news_proxy.announced("speaker", next(numbers))
        return bool(later.received)

    wait_until(is_received, "a message arrives")
    assert min(number for _, number in later.received) > 3


def test_unsupported_qos_prevents_the_start() -> None:
    settings = RunSettings(domain="unused", middleware="inproc", qos={"News": Qos(priority="high")})
    with pytest.raises(UnsupportedQos, match=r"port `News` asks for `priority`.*`inproc`"):
        Runner(Sink, Parameters(), settings)
