"""Losses of publications are exact: one or several publishers, few messages, forged numbers."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import zenoh

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.sequence import (
    CONFIRMATIONS,
    MAX_LISTED_GAP,
    MAX_RATE,
    SequenceTracker,
)
from robocomp_dsl.runtime.presence import keys, publications
from robocomp_dsl.runtime.presence.publications import PublicationCounter
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT
from tests.middleware.network import DEADLINE, Network, Node
from tests.middleware.probe_types import NEWS
from tests.support.waiting import wait_until

KEY = "News"


@pytest.fixture
def network() -> Iterator[Network]:
    opened = Network("zenoh")
    yield opened
    opened.close()


class Gate:
    """A handler that waits while the gate is closed: a subscriber that is too slow."""

    def __init__(self, node: Node, depth: int) -> None:
        self.node = node
        self.open = threading.Event()
        self.open.set()
        self.numbers: list[tuple[str, int]] = []
        self.arrived: dict[str, int] = {}
        node.subscribe(self._handle, qos=Qos(reliable=False, depth=depth))
        # Shows what has arrived while the gate is closed.
        at = Endpoint(NEWS, node.name, "Second", (), Qos(depth=100_000))
        node.ports.subscribe(at, {"announced": self.arrived.__setitem__}, CallbackGroup())

    def _handle(self, who: str, number: int) -> None:
        self.open.wait(DEADLINE)
        self.numbers.append((who, number))

    @property
    def drops(self) -> int:
        self.node.statistics.refresh()
        drops: int = self.node.count("announced", KEY).drops
        return drops

    def has(self, *messages: tuple[str, int]) -> bool:
        return set(messages) <= set(self.numbers)


def raw_session(node: Any) -> zenoh.Session:
    session: zenoh.Session = node.ports.presence.opened.session
    return session


def ready_news(network: Network, name: str) -> Any:
    news = network.node(name).news()
    assert news.wait_for_server(DEADLINE)
    wait_until(news.has_subscribers, "the publisher has a subscriber")
    return news


@pytest.mark.parametrize("publishers", [1, 3])
@pytest.mark.parametrize("messages", [5, 400])
def test_losses_are_exact_for_slow_subscriber(
    network: Network, publishers: int, messages: int
) -> None:
    gate = Gate(network.node("s"), depth=2)
    news = {f"p{i}": ready_news(network, f"p{i}") for i in range(publishers)}
    gate.open.clear()
    for number in range(messages):
        for name, proxy in news.items():
            proxy.announced(name, number)
        if number % 100 == 99 or number == messages - 1:
            expected = dict.fromkeys(news, number)
            wait_until(lambda e=expected: gate.arrived == e, "the messages have arrived")
    gate.open.set()
    sent = publishers * messages
    wait_until(
        lambda: gate.drops + len(gate.numbers) == sent,
        lambda: f"{gate.drops} losses and {len(gate.numbers)} messages, of {sent}",
    )
    if messages == 400:
        assert gate.drops >= 0.97 * sent


def test_losses_before_first_and_after_last_message_count(network: Network) -> None:
    gate = Gate(network.node("s"), depth=100)
    node = network.node("p")
    at = Endpoint(NEWS, "p", KEY)
    counter = PublicationCounter(raw_session(node), network.domain, at)
    numbers = counter.counter("announced")
    key = f"{keys.port_key(network.domain, 't', at)}/announced"
    publisher = raw_session(node).declare_publisher(key)
    wait_until(lambda: publisher.matching_status.matching, "the publisher has a subscriber")
    encode = NEWS.operation("announced").encode_request
    for number in range(100):
        attachment = SEQUENCE_FORMAT.pack(counter.id, next(numbers))
        if 40 <= number < 43:  # all others are lost on the way
            publisher.put(encode(("p", number)), attachment=attachment)
    wait_until(lambda: gate.has(("p", 42)), "the messages have arrived")
    wait_until(lambda: gate.drops == 97, lambda: f"{gate.drops} losses, not 97")


def test_losses_of_publisher_that_was_there_first_count_from_its_discovery(
    network: Network,
) -> None:
    node = network.node("p")
    news = node.news()
    for number in range(1000):
        news.announced("p", number)
    gate = Gate(network.node("s"), depth=10)
    wait_until(news.has_subscribers, "the publisher has a subscriber")
    for number in range(1000, 1005):
        news.announced("p", number)
    wait_until(lambda: gate.has(("p", 1004)), "the messages have arrived")
    assert gate.drops == 0


FORGERIES: dict[str, Callable[[int, int], bytes]] = {
    "empty": lambda _id, _n: b"",
    "short": lambda _id, _n: b"\xff\xff\xff\xff",
    "long": lambda _id, _n: b"\xff" * 33,
    "random id": lambda _id, n: SEQUENCE_FORMAT.pack(_id ^ 0x5A5A, n + 500),
    "number ahead": lambda id_, n: SEQUENCE_FORMAT.pack(id_, n + 500),
    "number far ahead": lambda id_, n: SEQUENCE_FORMAT.pack(id_, n + 500_000),
    "number beyond all": lambda id_, _n: SEQUENCE_FORMAT.pack(id_, 2**64 - 1),
    "number behind": lambda id_, _n: SEQUENCE_FORMAT.pack(id_, 0),
}


@pytest.mark.parametrize("forgery", FORGERIES)
def test_forged_attachments_change_no_losses(network: Network, forgery: str) -> None:
    gate = Gate(network.node("s"), depth=10_000)
    node = network.node("p")
    news = node.news()
    wait_until(news.has_subscribers, "the publisher has a subscriber")
    channel: Any = news._channel
    forger = raw_session(network.node("forger"))
    key = f"{keys.port_key(network.domain, 't', Endpoint(NEWS, 'p', KEY))}/announced"
    payload = NEWS.operation("announced").encode_request(("forged", 0))
    publisher = forger.declare_publisher(key)
    wait_until(lambda: publisher.matching_status.matching, "the forger has a subscriber")
    for number in range(30):
        news.announced("p", number)
        wait_until(lambda n=number: gate.has(("p", n)), "the message has arrived")
        if number % 10 == 5:
            attachment = FORGERIES[forgery](channel._ports[0].numbers.id, number)
            before = len(gate.numbers)
            publisher.put(payload, attachment=attachment)
            wait_until(lambda b=before: len(gate.numbers) > b, "the forged message has arrived")
    for number in range(600):  # beyond what the forger has claimed
        news.announced("p", 30 + number)
    wait_until(lambda: gate.has(("p", 629)), "the messages have arrived")
    assert gate.drops == 0


def test_sequence_tracker_counts_gaps_and_late_messages() -> None:
    tracker = SequenceTracker(3)
    for number in (4, 6, 7, 5, 10):
        tracker.accept(number)
    assert tracker.lost == 2  # 8 and 9
    assert tracker.next == 11
    tracker.begin = 0
    assert tracker.lost == 5
    tracker.accept(4)  # a duplicate
    assert tracker.lost == 5


def test_sequence_tracker_accepts_long_gap_that_is_confirmed() -> None:
    tracker = SequenceTracker(0)
    gap = 10 * MAX_LISTED_GAP
    for number in range(gap, gap + CONFIRMATIONS + 1):
        tracker.accept(number)
    assert tracker.lost == gap - 1
    assert tracker.unconfirmed is None


def test_sequence_tracker_counts_every_gap_of_97_percent_loss() -> None:
    tracker = SequenceTracker(0)
    arrived = range(0, 400_000, 4000)
    for number in arrived:
        tracker.accept(number)
    assert tracker.lost == arrived[-1] + 1 - len(arrived)


def test_sequence_tracker_ignores_impossible_number() -> None:
    tracker = SequenceTracker(0)
    tracker.accept(1)
    tracker.accept(100 * MAX_RATE)
    tracker.settle(100 * MAX_RATE)
    assert tracker.lost == 0
    assert tracker.next == 2


def test_sequence_tracker_settles_to_count_and_takes_late_message() -> None:
    tracker = SequenceTracker(0)
    tracker.settle(4)
    assert tracker.lost == 3
    tracker.accept(3)
    assert tracker.lost == 2


def test_losses_of_publisher_on_another_machine_ignore_its_clock(
    network: Network, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its monotonic clock started at another boot: one that is ahead, one that is behind."""
    for name, offset_s in (("ahead", 1e6), ("behind", -1e6)):
        node = network.node(name)
        now = time.monotonic_ns() + round(offset_s * 1e9)
        with monkeypatch.context() as other_machine:
            other_machine.setattr(publications, "clock_id", lambda name=name: f"boot of {name}")
            other_machine.setattr(time, "monotonic_ns", lambda now=now: now)
            counter = PublicationCounter(
                raw_session(node), network.domain, Endpoint(NEWS, name, KEY)
            )
        numbers = counter.counter("announced")
        for _ in range(5):  # before the subscription: no losses
            next(numbers)
        gate = Gate(network.node(f"s_{name}"), depth=100)
        key = f"{keys.port_key(network.domain, 't', Endpoint(NEWS, name, KEY))}/announced"
        publisher = raw_session(node).declare_publisher(key)
        wait_until(lambda p=publisher: p.matching_status.matching, "there is a subscriber")
        known = gate.node.ports.presence.publishers()
        wait_until(lambda k=known, c=counter: (c.id, "announced") in k.counts_at_discovery)
        encode = NEWS.operation("announced").encode_request
        for number in range(10):
            stamp = SEQUENCE_FORMAT.pack(counter.id, next(numbers))
            if number not in (3, 4, 9):  # lost on the way, also the last
                publisher.put(encode((name, number)), attachment=stamp)
        wait_until(lambda g=gate, n=name: g.has((n, 8)), "the messages have arrived")
        wait_until(lambda g=gate: g.drops == 3, lambda g=gate: f"{g.drops} losses")
        counter.close()
