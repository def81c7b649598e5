"""Publications and subscriptions of every middleware."""

from __future__ import annotations

import threading

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.middleware.network import DEADLINE, Network, Node
from tests.middleware.probe_handlers import HANDLERS
from tests.middleware.probe_types import NEWS
from tests.support.waiting import wait_until


def test_publications_reach_all_in_order_of_each_publisher(network: Network) -> None:
    received: dict[str, list[tuple[str, int]]] = {"a": [], "b": []}
    for name, into in received.items():
        network.node(name).subscribe(lambda who, n, into=into: into.append((who, n)))
    publishers = [network.node(f"p{i}") for i in range(2)]
    proxies = [p.news() for p in publishers]
    for proxy in proxies:
        assert proxy.wait_for_server(DEADLINE)
    wait_until(lambda: all(len(_subscribers(p)) == 2 for p in publishers))
    for n in range(100):
        for p, proxy in enumerate(proxies):
            proxy.announced(f"p{p}", n)
    wait_until(lambda: all(len(into) == 200 for into in received.values()))
    for into in received.values():
        for name in ("p0", "p1"):
            assert [n for who, n in into if who == name] == list(range(100))


def _subscribers(node: Node) -> list[PortRecord]:
    return node.ports.presence.registry.find("subscriber", NEWS.name)


def test_publication_without_subscriber_does_not_fail(network: Network) -> None:
    network.node("publisher").news().announced("me", 1)


def test_subscriber_connects_to_one_publisher(network: Network) -> None:
    received: list[str] = []
    network.node("s").subscribe(lambda who, _n: received.append(who), "right")
    wrong, right = network.node("wrong").news(), network.node("right").news()
    assert right.wait_for_server(DEADLINE)
    wrong.announced("wrong", 0)
    right.announced("right", 0)
    wait_until(lambda: received)
    assert received == ["right"]


def test_failing_subscriber_receives_next_publication(network: Network) -> None:
    received: list[int] = []

    def receive(_who: str, n: int) -> None:
        if n == 0:
            raise ValueError("not this one")
        received.append(n)

    node = network.node("s")
    node.subscribe(receive)
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    news.announced("p", 0)
    news.announced("p", 1)
    wait_until(lambda: received == [1])
    assert node.count("announced", "News").failures == 1


def test_topic_knows_whether_it_has_subscribers(network: Network) -> None:
    news = network.node("p").news()
    assert not news.has_subscribers()
    network.node("deaf").serve(HANDLERS)
    subscriber = network.node("s")
    subscriber.subscribe(lambda *_: None)
    wait_until(news.has_subscribers)
    subscriber.ports.close()
    wait_until(lambda: not news.has_subscribers())


def test_slow_subscriber_keeps_latest_samples_of_its_depth(network: Network) -> None:
    free = threading.Event()
    received: list[int] = []

    def receive(_who: str, n: int) -> None:
        free.wait(DEADLINE)
        received.append(n)

    node = network.node("s")
    node.subscribe(receive, qos=Qos(reliable=False, depth=2))
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    news.announced("p", 0)
    wait_until(lambda: node.execution.busy)
    for n in range(1, 50):
        news.announced("p", n)
    if network.kind == "zenoh":
        # A second subscriber on the same session tells that all have arrived; what was
        # still on its way when it subscribed may reach it before the last.
        probe: list[int] = []
        node.ports.subscribe(
            Endpoint(NEWS, "s", "Second"),
            {"announced": lambda _w, n: probe.append(n)},
            CallbackGroup(),
        )
        news.announced("p", 50)
        wait_until(lambda: probe and probe[-1] == 50)
    else:
        news.announced("p", 50)
    free.set()
    wait_until(lambda: received and received[-1] == 50)
    # One may have been on its way between the queue and the handler.
    assert received[0] == 0
    assert received[-2:] == [49, 50]
    assert len(received) <= 4
    node.statistics.refresh()
    assert node.count("announced", "News").drops == 51 - len(received)


def test_publications_after_their_deadline_are_counted(network: Network) -> None:
    received: list[int] = []
    node = network.node("s")
    node.subscribe(lambda _who, n: received.append(n), qos=Qos(deadline=1e-6))
    strict = node.count("announced", "News")
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    for n in range(3):
        news.announced("p", n)
        wait_until(lambda n=n: received and received[-1] == n)
    assert strict.missed == 2
