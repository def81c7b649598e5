"""Publications and subscriptions of every middleware."""

from __future__ import annotations

import threading

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.endpoint import Qos
from tests.middleware.network import DEADLINE, Network, Node
from tests.middleware.probe_handlers import HANDLERS
from tests.middleware.probe_types import NEWS, NewsProxy
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Publications"), pytest.mark.needs("topics")]


def wait_for_subscribers(node: Node, count: int) -> None:
    """Wait until a publishing component knows `count` subscribed ports."""
    registry = node.ports.presence.registry
    wait_until(lambda: len(registry.find("subscriber", NEWS.name)) == count)


def wait_for_connection(news: NewsProxy, received: list[tuple[str, int]], who: str) -> None:
    """Publish until a message has arrived: a subscription may take effect after it is known."""

    def arrived() -> bool:
        news.announced(who, -1)
        return (who, -1) in received

    wait_until(arrived)


def test_publications_reach_all_in_order_of_each_publisher(network: Network) -> None:
    received: dict[str, list[tuple[str, int]]] = {"a": [], "b": []}
    for name, into in received.items():
        network.node(name).subscribe(lambda who, n, into=into: into.append((who, n)))
    publishers = [network.node(f"p{i}") for i in range(2)]
    proxies = [p.news() for p in publishers]
    for i, (publisher, proxy) in enumerate(zip(publishers, proxies, strict=True)):
        wait_for_subscribers(publisher, 2)
        for into in received.values():
            wait_for_connection(proxy, into, f"p{i}")
    for n in range(100):
        for p, proxy in enumerate(proxies):
            proxy.announced(f"p{p}", n)
    last = {("p0", 99), ("p1", 99)}
    wait_until(lambda: all(last <= set(into) for into in received.values()))
    for into in received.values():
        for name in ("p0", "p1"):
            assert [n for who, n in into if who == name and n >= 0] == list(range(100))


def test_publication_without_subscriber_does_not_fail(network: Network) -> None:
    network.node("publisher").news().announced("me", 1)


def test_subscriber_connects_to_named_publisher(network: Network) -> None:
    received: list[str] = []
    network.node("s").subscribe(lambda who, _n: received.append(who), "right")
    wrong, right = network.node("wrong").news(), network.node("right").news()
    assert right.wait_for_server(DEADLINE)

    def arrived() -> bool:
        wrong.announced("wrong", 0)
        right.announced("right", 0)
        return len(received) > 3

    wait_until(arrived)
    assert set(received) == {"right"}


def test_failing_subscriber_receives_next_publication(network: Network) -> None:
    received: list[int] = []

    def receive(_who: str, n: int) -> None:
        received.append(n)
        if n == 0:
            raise ValueError("not this number")

    node = network.node("s")
    node.subscribe(receive)
    news = network.node("p").news()
    wait_until(lambda: news.announced("p", 0) or 0 in received)
    failures = len(received)
    wait_until(lambda: news.announced("p", 1) or 1 in received)
    assert failures <= node.count("announced", "News").failures == received.count(0)


def test_topic_knows_whether_it_has_subscribers(network: Network) -> None:
    news = network.node("p").news()
    assert not news.has_subscribers()
    network.node("deaf").serve(HANDLERS)
    subscriber = network.node("s")
    subscriber.subscribe(lambda *_: None)
    wait_until(news.has_subscribers)
    subscriber.ports.close()
    wait_until(lambda: not news.has_subscribers())


def test_subscriber_that_starts_first_or_last_receives_publications(network: Network) -> None:
    received: dict[str, list[tuple[str, int]]] = {"early": [], "late": []}

    def subscribe(name: str) -> None:
        network.node(name).subscribe(lambda who, n: received[name].append((who, n)))

    subscribe("early")
    news = network.node("p").news()
    wait_for_connection(news, received["early"], "p")
    subscribe("late")
    wait_for_connection(news, received["late"], "p")
    restarted = network.nodes[0]
    restarted.ports.close()
    received["again"] = []
    subscribe("again")
    wait_for_connection(news, received["again"], "p")


def test_restarted_publisher_reaches_its_subscribers(network: Network) -> None:
    received: list[tuple[str, int]] = []
    network.node("s").subscribe(lambda who, n: received.append((who, n)), "p")
    for run in ("first", "second"):
        publisher = network.node("p")
        wait_for_connection(publisher.news(), received, run)
        publisher.ports.close()


def test_slow_subscriber_keeps_latest_messages_of_its_depth(network: Network) -> None:
    """What arrives while the handler is busy waits in a queue of two messages."""
    free, held = threading.Event(), threading.Event()
    received: list[int] = []
    arrived: list[int] = []

    def receive(_who: str, n: int) -> None:
        received.append(n)
        held.set()
        free.wait(DEADLINE)

    node = network.node("s")
    node.subscribe(receive, qos=Qos(reliable=False, depth=2))
    # A second port of the component tells what has arrived.
    node.subscribe(lambda _w, n: arrived.append(n), port="Second", group=CallbackGroup())
    publisher = network.node("p")
    news = publisher.news()
    wait_for_subscribers(publisher, 2)
    sent = 0

    def publish() -> bool:
        nonlocal sent
        news.announced("p", sent)
        sent += 1
        return held.is_set()

    def kept_the_latest() -> bool:
        """Whether one round kept two messages: others may have come when the handler was free."""
        held.clear()
        free.clear()
        wait_until(publish)
        for _ in range(50):
            publish()
        wait_until(lambda: arrived and arrived[-1] == sent - 1)
        begin = len(received)
        free.set()
        wait_until(lambda: received[-1] == sent - 1)
        assert received[-2:] == [sent - 2, sent - 1]
        return len(received) - begin <= 3

    wait_until(kept_the_latest)

    def counted() -> bool:
        node.statistics.refresh()
        return bool(node.count("announced", "News").drops == sent - len(received))

    wait_until(counted, lambda: f"{node.count('announced', 'News')}, {sent=} {len(received)=}")


TAGS = rt.Interface(
    "Test::Tags",
    rt.Operation("seen", rt.Pattern.UNMARKED, {"number": rt.Int}),
    rt.Operation("count", returns=rt.Int),
    rt.Operation("lost", rt.Pattern.PUBLISH, {"number": rt.Int}),
)


def test_topic_has_only_the_operations_without_outputs(network: Network) -> None:
    seen: list[int] = []
    handlers = {"seen": seen.append, "lost": lambda number: seen.append(-number)}
    subscriber, publisher = network.node("subscriber"), network.node("publisher")
    at = subscriber.at(TAGS, "Tags")
    subscriber.ports.subscribe(at, handlers, subscriber.execution)
    channel = publisher.ports.advertise(publisher.at(TAGS, "Tags"))
    call = {operation.name: channel.bind(operation) for operation in TAGS.operations}
    assert channel.wait(DEADLINE)
    wait_until(lambda: call["seen"](1) or 1 in seen)
    call["lost"](2)
    wait_until(lambda: -2 in seen)
    with pytest.raises(rt.NotPublishable, match=r"count of Test::Tags returns something"):
        call["count"]()


OLD_NEWS = rt.Interface(
    "Test::Edition",
    rt.Operation("said", rt.Pattern.PUBLISH, {"text": rt.String}),
    rt.Operation("moved", rt.Pattern.PUBLISH, {"x": rt.Double}, units={"x": "m"}),
    rt.Operation("dropped", rt.Pattern.PUBLISH),
)
NEW_NEWS = rt.Interface(
    "Test::Edition",
    rt.Operation("added", rt.Pattern.PUBLISH),
    rt.Operation("moved", rt.Pattern.PUBLISH, {"x": rt.Double}, units={"x": "mm"}),
    rt.Operation("said", rt.Pattern.PUBLISH, {"text": rt.String}),
)


@pytest.mark.needs("topic_versions")
@pytest.mark.parametrize(
    ("published", "subscribed"), [(OLD_NEWS, NEW_NEWS), (NEW_NEWS, OLD_NEWS)], ids=["old", "new"]
)
def test_subscriber_with_other_version_gets_operations_that_did_not_change(
    network: Network,
    caplog: pytest.LogCaptureFixture,
    published: rt.Interface,
    subscribed: rt.Interface,
) -> None:
    received: list[object] = []
    subscriber, publisher = network.node("subscriber"), network.node("publisher")
    same = network.node("same")
    handlers = {
        "said": received.append,
        "moved": received.append,
        "dropped": lambda: received.append("dropped"),
        "added": lambda: received.append("added"),
    }
    at = subscriber.at(subscribed, "Edition")
    subscriber.ports.subscribe(at, handlers, subscriber.execution)
    own: list[object] = []
    every = {o.name: lambda *values: own.extend(values) for o in published.operations}
    same.ports.subscribe(same.at(published, "Edition"), every, same.execution)
    channel = publisher.ports.advertise(publisher.at(published, "Edition"))
    call = {operation.name: channel.bind(operation) for operation in published.operations}
    assert channel.wait(DEADLINE)
    wait_until(lambda: call["said"]("first") or ("first" in received and "first" in own))
    assert channel.has_subscribers()
    call["moved"](1.0)
    call[published.operations[0].name](*(["zero"] if published is OLD_NEWS else []))
    call["said"]("last")
    wait_until(lambda: received[-1] == "last" and own[-1] == "last")
    assert set(received) <= {"first", "zero", "last"}
    assert 1.0 in own
    assert "moved: `x` is in" in caplog.text
