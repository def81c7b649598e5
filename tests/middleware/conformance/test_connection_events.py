"""Deadlines and liveliness of every middleware: counts, and hooks in the callback group."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from tests.middleware.conformance.peer_launcher import Peer
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_types import NEWS
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Deadlines and liveliness"), pytest.mark.needs("topics")]


class HookedSubscriber:
    """A subscriber that records the hooks that are called, and whether it holds its slot."""

    def __init__(self, network: Network, qos: Qos, *peers: str) -> None:
        self.calls: list[tuple[Any, ...]] = []
        self.received: list[int] = []
        self.handling = threading.Event()
        self.release = threading.Event()
        self.release.set()
        self.group = CallbackGroup()
        self.statistics = Statistics()
        context = ComponentContext(
            "s", network.domain, self.group, self.statistics, call_hook=self._call_hook
        )
        self.ports = open_ports(network.middleware, context)
        at = Endpoint(NEWS, "s", "News", peers, qos, (network.middleware,))
        self.ports.subscribe(at, {"announced": self._receive}, self.group)

    def _call_hook(self, *call: Any) -> None:
        assert self.group.busy
        self.calls.append(call)

    def _receive(self, _who: str, number: int) -> None:
        self.handling.set()
        self.release.wait(DEADLINE)
        self.received.append(number)

    def hooks(self, name: str) -> list[tuple[Any, ...]]:
        return [call[1:] for call in list(self.calls) if call[0] == name]

    @property
    def missed(self) -> int:
        return self.statistics.of("News", "announced").missed


@pytest.fixture
def subscriber(network: Network, request: pytest.FixtureRequest) -> Iterator[HookedSubscriber]:
    opened = HookedSubscriber(network, request.param)
    yield opened
    opened.release.set()
    opened.ports.close()


@pytest.mark.parametrize("subscriber", [Qos(deadline=0.01)], indirect=True)
def test_missed_deadline_is_reported_once_for_each_gap(
    network: Network, subscriber: HookedSubscriber
) -> None:
    assert not subscriber.missed
    news = network.node("p").news()
    # Before any message: the publisher is connected, and sends nothing.
    wait_until(lambda: subscriber.missed == 1)
    wait_until(lambda: news.announced("p", 0) or subscriber.received)
    for number in range(1, 4):
        # The gap of each message is over before the next one.
        missed = wait_until(lambda n=number: subscriber.missed if subscriber.missed > n else 0)
        news.announced("p", number)
        wait_until(lambda n=number: subscriber.received[-1] == n)
        wait_until(lambda n=missed: subscriber.missed > n)
    wait_until(lambda: len(subscriber.hooks("deadline_missed")) == subscriber.missed)
    assert subscriber.missed <= len(subscriber.received) + 1
    assert all(port == "News" and s > 0.01 for port, s in subscriber.hooks("deadline_missed"))


@pytest.mark.parametrize("subscriber", [Qos(deadline=0.01)], indirect=True)
def test_slow_handler_misses_no_deadline(network: Network, subscriber: HookedSubscriber) -> None:
    news = network.node("p").news()
    wait_until(lambda: subscriber.missed == 1)
    wait_until(lambda: news.announced("p", -1) or subscriber.received)
    subscriber.handling.clear()
    subscriber.release.clear()
    for number in range(3):
        news.announced("p", number)
    assert subscriber.handling.wait(DEADLINE)
    before = subscriber.missed
    checks = subscriber.ports.watch.presence.registry
    for _ in range(20):
        checks.notify()
    assert subscriber.missed == before
    subscriber.release.set()
    wait_until(lambda: subscriber.received[-3:] == [0, 1, 2])


@pytest.mark.parametrize("subscriber", [Qos(liveliness=60.0)], indirect=True)
def test_publisher_that_appears_and_ends_is_reported(
    network: Network, subscriber: HookedSubscriber
) -> None:
    publisher = network.node("p")
    publisher.news()
    wait_until(lambda: subscriber.hooks("publisher_alive") == [("News", "p.News")])
    assert not subscriber.hooks("publisher_lost")
    publisher.ports.close()
    wait_until(lambda: subscriber.hooks("publisher_lost") == [("News", "p.News")])
    network.node("p").news()
    wait_until(lambda: len(subscriber.hooks("publisher_alive")) == 2)


@pytest.mark.parametrize("subscriber", [Qos(liveliness=0.05)], indirect=True)
def test_silent_publisher_that_is_alive_is_not_lost(
    network: Network, subscriber: HookedSubscriber
) -> None:
    publisher = network.node("p")
    publisher.news()
    wait_until(lambda: subscriber.hooks("publisher_alive"))
    probes = publisher.ports.presence
    probed = threading.Event()
    probes.probe("p", DEADLINE, probed.set)
    assert probed.wait(DEADLINE)


def test_events_of_hooks_that_raise_are_logged(
    network: Network, caplog: pytest.LogCaptureFixture
) -> None:
    subscriber = HookedSubscriber(network, Qos(liveliness=60.0))
    try:
        subscriber.calls = None  # type: ignore[assignment] - the hook raises
        network.node("p").news()
        wait_until(lambda: "publisher_alive(News) failed" in caplog.text)
    finally:
        subscriber.ports.close()


@pytest.mark.needs("between_processes")
@pytest.mark.parametrize("subscriber", [Qos(liveliness=0.3)], indirect=True)
def test_stopped_publisher_is_lost_and_alive_again_when_it_continues(
    subscriber: HookedSubscriber, start_peer: Callable[..., Peer]
) -> None:
    publisher = start_peer("publish")
    wait_until(lambda: subscriber.hooks("publisher_alive"))
    publisher.stop()
    wait_until(lambda: subscriber.hooks("publisher_lost"))
    alive = len(subscriber.hooks("publisher_alive"))
    publisher.resume()
    wait_until(lambda: len(subscriber.hooks("publisher_alive")) > alive)


@pytest.mark.needs("between_processes")
@pytest.mark.parametrize("subscriber", [Qos(liveliness=60.0, deadline=0.2)], indirect=True)
def test_killed_publisher_is_lost_at_once_and_misses_its_deadline(
    subscriber: HookedSubscriber, start_peer: Callable[..., Peer]
) -> None:
    publisher = start_peer("publish")
    wait_until(lambda: subscriber.received)
    publisher.kill()
    wait_until(lambda: subscriber.hooks("publisher_lost") == [("News", "publisher.News")])
    # No message comes any more: only a timer can report the gap.
    wait_until(lambda: subscriber.hooks("deadline_missed"))
