"""Latest messages for subscribers that start later, on every middleware."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.connection.latest_values import LatestValues
from tests.middleware.network import DEADLINE, Network, Node
from tests.middleware.probe_types import NewsProxy
from tests.support.waiting import wait_until

LATCHED = Qos(latched=True)
pytestmark = [pytest.mark.feature("Latched topics"), pytest.mark.needs("topics", "latched")]


def latched_news(node: Node) -> NewsProxy:
    return node.news(qos=LATCHED)


def test_late_subscriber_gets_the_latest_message(network: Network) -> None:
    news = latched_news(network.node("p"))
    for number in range(3):
        news.announced("p", number)
    received: list[int] = []
    network.node("s").subscribe(lambda _who, n: received.append(n), qos=LATCHED)
    wait_until(lambda: received == [2])
    assert news.wait_for_server(DEADLINE)
    wait_until(lambda: news.announced("p", 3) or received[-1] == 3)
    assert received[0] == 2


def test_late_subscriber_gets_the_latest_message_of_each_publisher(network: Network) -> None:
    for name in ("a", "b"):
        latched_news(network.node(name)).announced(name, 1)
    received: list[str] = []
    network.node("s").subscribe(lambda who, _n: received.append(who), qos=LATCHED)
    wait_until(lambda: sorted(received) == ["a", "b"])


def test_subscriber_without_latched_gets_no_latest_message(network: Network) -> None:
    news = latched_news(network.node("p"))
    news.announced("p", 0)
    received: list[int] = []
    plain = network.node("s")
    plain.subscribe(lambda _who, n: received.append(n))
    latched: list[int] = []
    network.node("t").subscribe(lambda _who, n: latched.append(n), qos=LATCHED)
    wait_until(lambda: latched == [0])
    wait_until(lambda: news.announced("p", 1) or received)
    assert 0 not in received


def test_unencodable_message_is_not_latched(network: Network) -> None:
    news = latched_news(network.node("p"))
    news.announced("p", 7)
    with pytest.raises(ValueError, match="n"):
        news.announced("p", "text")  # type: ignore[arg-type]
    received: list[int] = []
    network.node("s").subscribe(lambda _who, n: received.append(n), qos=LATCHED)
    wait_until(lambda: received == [7])


def test_latest_message_does_not_follow_a_later_one(
    network: Network, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[object] = []
    ask = LatestValues._ask
    monkeypatch.setattr(LatestValues, "_ask", lambda *each: asked.append(each))
    news = latched_news(network.node("p"))
    received: list[int] = []
    subscriber = network.node("s")
    subscriber.subscribe(lambda _who, n: received.append(n), qos=LATCHED)
    wait_until(lambda: asked)
    assert news.wait_for_server(DEADLINE)
    wait_until(lambda: news.announced("p", 1) or received)
    # As if the reply had been on its way for a long time.
    count = len(received)
    ask(*asked[0])  # type: ignore[misc]
    wait_until(subscriber.ports.events._events.empty)
    news.announced("p", 2)
    wait_until(lambda: received[-1] == 2)
    # Without sequence numbers the latest message may arrive twice, but no earlier one behind it.
    later = received[count:]
    assert later in ([2], [1, 2], [2, 2], [1, 2, 2])
