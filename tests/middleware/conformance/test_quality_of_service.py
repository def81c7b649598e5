"""The items of the quality of service that a middleware claims, and losses that are counted."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from tests.middleware.conformance.peer_launcher import Peer
from tests.middleware.network import DEADLINE, Network
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Quality of service"), pytest.mark.needs("topics")]


@pytest.mark.needs("reliable")
def test_reliable_subscriber_gets_all_messages_though_it_is_slower(network: Network) -> None:
    received: list[int] = []
    turn = threading.Semaphore(0)

    def receive(_who: str, n: int) -> None:
        turn.acquire(timeout=DEADLINE)
        received.append(n)

    network.node("s").subscribe(receive, qos=Qos(reliable=True, depth=8))
    news = network.node("p").news(qos=Qos(reliable=True))
    turn.release()
    wait_until(news.has_subscribers)
    wait_until(lambda: news.announced("p", -1) or turn.release() or received)
    turn.release(10_000)
    wait_until(lambda: news.announced("p", -2) or received[-1] == -2)
    for n in range(500):
        news.announced("p", n)
    wait_until(lambda: received[-1] == 499)
    assert [n for n in received if n >= 0] == list(range(500))


@pytest.mark.needs("priority")
@pytest.mark.parametrize("priority", ["realtime", "high", "normal", "low", "background"])
def test_priority_is_accepted_by_publishers_and_subscribers(
    network: Network, priority: str
) -> None:
    received: list[int] = []
    qos = Qos(priority=priority)
    network.node("s").subscribe(lambda _who, n: received.append(n), qos=qos)
    news = network.node("p").news(qos=qos)
    wait_until(lambda: news.announced("p", 7) or received)
    assert set(received) == {7}


@pytest.mark.needs("sequence_numbers", "between_processes")
def test_messages_lost_while_subscriber_is_stopped_are_counted(
    network: Network, start_peer: Callable[..., Peer]
) -> None:
    subscriber = start_peer("subscribe", qos={"depth": 10})
    news = network.node("publisher").news()
    wait_until(lambda: news.announced("", -1) or int(subscriber.ask("count")))
    subscriber.stop()
    for n in range(3000):
        news.announced("x" * 10_000, n)
    subscriber.resume()
    wait_until(lambda: news.announced("", 3000) or int(subscriber.ask("last")) == 3000)
    wait_until(lambda: int(subscriber.ask("lost")) > 0)


def test_depth_larger_than_the_default_keeps_a_burst(network: Network) -> None:
    free = threading.Event()
    received: list[int] = []

    def receive(_who: str, n: int) -> None:
        received.append(n)
        free.wait(DEADLINE)

    network.node("s").subscribe(receive, qos=Qos(depth=200))
    news = network.node("p").news()
    wait_until(lambda: news.announced("p", -1) or received)
    for n in range(150):
        news.announced("p", n)
    free.set()
    wait_until(lambda: received[-1] == 149)
    assert [n for n in received if n >= 0] == list(range(150))
