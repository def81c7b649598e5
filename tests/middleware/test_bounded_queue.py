"""The queue of a subscription that holds its publishers, alone and with a stuck handler."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any

import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.bounded_queue import BoundedQueue
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from tests.middleware.network import Network
from tests.middleware.probe_types import NEWS, NewsProxy
from tests.support.waiting import wait_until

TEXT = "x" * 50_000


def sample(number: int) -> Any:
    return SimpleNamespace(number=number)


def test_bounded_queue_keeps_order_and_holds_until_there_is_room() -> None:
    samples = BoundedQueue[Any](2, 60.0)
    sender = threading.Thread(target=lambda: [samples.put(sample(i)) for i in range(5)])
    sender.start()
    assert [samples.take().number for _ in range(5)] == [0, 1, 2, 3, 4]
    sender.join(60)
    assert not sender.is_alive()


def test_bounded_queue_drops_for_stuck_subscriber_until_it_takes_again() -> None:
    held: list[None] = []
    samples = BoundedQueue[Any](2, 0.01, lambda: held.append(None))
    for number in range(100):
        samples.put(sample(number))
    assert len(held) == 98
    assert [samples.take().number for _ in range(2)] == [0, 1]
    samples.put(sample(100))
    assert samples.take().number == 100


def test_bounded_queue_close_ends_put_and_take() -> None:
    samples = BoundedQueue[Any](1, 60.0)
    samples.put(sample(0))
    sender = threading.Thread(target=samples.put, args=(sample(1),))
    sender.start()
    samples.close()
    sender.join(60)
    assert not sender.is_alive()
    for _ in range(2):
        with pytest.raises(QueueClosed):
            samples.take()


def test_stuck_reliable_subscriber_still_answers_and_counts_its_losses(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(bounded_queue, "HOLD_S", 0.1)
    network = Network("zenoh")
    release, received = threading.Event(), []

    def hear(_text: str, number: int) -> None:
        received.append(number)
        release.wait(60)

    try:
        listener, speaker = network.node("listener"), network.node("speaker")
        listener.subscribe(hear, qos=Qos(reliable=True, depth=1))
        listener.execution = CallbackGroup()
        listener.serve({"add": lambda a, b: a + b})
        at = Endpoint(NEWS, "speaker", "News", (), Qos(reliable=True))
        news = NewsProxy(speaker.ports.advertise(at))
        assert news.wait_for_server(30)
        wait_until(news.has_subscribers)
        sent = 200
        for number in range(sent):
            news.announced(TEXT, number)
        assert speaker.count("announced", "News").drops == 0
        for number in range(20):
            assert speaker.probe().add(number, 1) == number + 1
        release.set()

        def hears_again() -> bool:
            nonlocal sent
            news.announced("again", -1)
            sent += 1
            return -1 in received

        wait_until(hears_again)
        count = listener.count("announced", "News")
        wait_until(
            lambda: listener.statistics.refresh() or len(received) + count.drops == sent,
            lambda: f"{len(received)} received, {count.drops} lost of {sent}",
        )
    finally:
        release.set()
        network.close()
