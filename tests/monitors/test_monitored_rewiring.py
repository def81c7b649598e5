"""Changes of ports with monitored connections while the components run."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from robocomp_dsl.client import DomainClient
from robocomp_dsl.runtime.connection.connections_interface import (
    COMPONENTCONNECTIONS,
    ComponentConnectionsProxy,
    Refusal,
)
from robocomp_dsl.runtime.errors import CallRejected
from tests.monitors.components import Caller, Deployment, Listener, Server, Speaker
from tests.support.waiting import wait_until

SMALL_CALLS = """
    class Small(Monitor):
        def accept_add(self, a: int, b: int) -> bool:
            return a < 10
    """
SMALL_NEWS = """
    class Small(Monitor):
        def accept_announced(self, who: str, n: int) -> bool:
            return n < 10
    """


@contextmanager
def connections_of(deployment: Deployment, name: str) -> Iterator[ComponentConnectionsProxy]:
    with DomainClient(deployment.domain, deployment.middleware) as client:
        channel = client.channel(COMPONENTCONNECTIONS, name, "Component")
        proxy = ComponentConnectionsProxy(channel)
        assert proxy.wait_for_server(60)
        yield proxy


def test_monitored_client_stays_monitored_after_change_of_qos(deployment: Deployment) -> None:
    deployment.write(SMALL_CALLS)
    entry = {"port": "Probe", "at": "receiver", "peer": "caller.Probe"}
    deployment.start(Server, "server", [entry | {"monitors": [deployment.monitor("Small")]}])
    identify = [{"port": "Probe", "at": "identify", "peer": "server.Probe"}]
    caller = deployment.start(Caller, "caller", identify, peers=("server",))
    proxy = caller.worker.probe_proxy
    assert proxy.wait_for_server(60)
    with connections_of(deployment, "caller") as connections:
        assert connections.setQos("Probe", "", "priority=normal") == "priority=normal"
        assert proxy.add(3, 1) == 4
        with pytest.raises(CallRejected):
            proxy.add(10, 1)
        with pytest.raises(Refusal, match="`Probe` has monitored connections"):
            connections.disconnect("Probe", "/server")
    with connections_of(deployment, "server") as connections:
        assert "thread_priority=1" in connections.setQos("Probe", "", "thread_priority=1")
    with pytest.raises(CallRejected):
        proxy.add(10, 1)


def test_monitored_subscriber_gets_messages_once_after_change_of_qos(
    deployment: Deployment,
) -> None:
    deployment.write(SMALL_NEWS)
    entry = {"port": "News", "at": "receiver", "peer": "first.News"}
    monitors = [entry | {"monitors": [deployment.monitor("Small")]}]
    listener = deployment.start(Listener, "listener", monitors, peers=("first", "second"))
    first = deployment.start(Speaker, "first")
    second = deployment.start(Speaker, "second")
    proxies = {each.worker.news_proxy: each.worker.name for each in (first, second)}
    heard = listener.worker.heard

    def announce(number: int) -> None:
        for proxy, name in proxies.items():
            proxy.announced(name, number)

    def is_connected() -> bool:
        announce(0)
        return {name for name, _ in heard} == {"first", "second"}

    wait_until(is_connected, "both are connected")
    with connections_of(deployment, "listener") as connections:
        assert "depth=90" in connections.setQos("News", "", "depth=90")
        with pytest.raises(Refusal, match="monitored connections"):
            connections.connect("News", "/third", "")
    heard.clear()
    wait_until(is_connected, "both are connected again")
    for number in (1, 20, 2):
        announce(number)
    wait_until(lambda: ("second", 2) in heard and ("first", 2) in heard, "all messages arrive")
    numbered = sorted(message for message in heard if message[1])
    assert numbered == [("first", 1), ("first", 2), ("second", 1), ("second", 2), ("second", 20)]
