"""A reliable subscriber that receives nothing holds a publisher for a limited time only."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator

import pytest

from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.middleware.zenoh import held_publisher, transport
from robocomp_dsl.runtime.parameters import Parameters
from tests.middleware.network import Network, Node
from tests.middleware.probe_types import NEWS, NewsProxy
from tests.support.waiting import wait_until

HOLD_S = 0.2
TEXT = "x" * 50_000
"""A message so long that few of them fill all buffers."""
MOST_MESSAGES = 1000


class HeldSubscriber:
    """A reliable subscriber whose handler waits for `release`; it also answers queries."""

    def __init__(self, network: Network) -> None:
        self.node: Node = network.node("listener")
        self.release = threading.Event()
        self.entered = threading.Event()
        self.received: list[int] = []
        self.node.subscribe(self._hear, qos=Qos(reliable=True, depth=1))
        self.node.execution = CallbackGroup()
        self.node.serve({"add": lambda a, b: a + b})

    def _hear(self, _text: str, number: int) -> None:
        self.received.append(number)
        self.entered.set()
        self.release.wait(60)


@pytest.fixture
def network(monkeypatch: pytest.MonkeyPatch) -> Iterator[Network]:
    monkeypatch.setattr(held_publisher, "_HELD_NS", HOLD_S * 0.9e9)
    monkeypatch.setattr(transport, "HOLD_S", HOLD_S)
    # As if the subscriber's process were stopped: it never drops a message itself.
    monkeypatch.setattr(bounded_queue, "HOLD_S", 60.0)
    opened = Network("zenoh")
    yield opened
    opened.close()


@pytest.fixture
def subscriber(network: Network) -> Iterator[HeldSubscriber]:
    held = HeldSubscriber(network)
    yield held
    held.release.set()


def test_held_publisher_drops_and_counts(
    network: Network, subscriber: HeldSubscriber, caplog: pytest.LogCaptureFixture
) -> None:
    speaker = network.node("speaker")
    at = Endpoint(NEWS, "speaker", "News", (), Qos(reliable=True))
    news = NewsProxy(speaker.ports.advertise(at))
    assert news.wait_for_server(30)
    wait_until(news.has_subscribers)
    sent = 0
    with caplog.at_level(logging.WARNING):
        while not speaker.count("announced", "News").drops and sent < MOST_MESSAGES:
            news.announced(TEXT, sent)
            sent += 1
    assert speaker.count("announced", "News").drops == 1
    assert "a subscriber that receives nothing held News.announced" in caplog.text


class Speaker(Component):
    """Publishes without end; `finalized` is set by `finalize`."""

    SPEC = ComponentSpec(
        name="speaker", period=1, publishes=(CalledPort("News", NewsProxy, "news_proxy"),)
    )
    news_proxy: NewsProxy

    def __init__(self) -> None:
        self.finalized = False
        self.number = 0

    def compute(self) -> None:
        self.news_proxy.announced(TEXT, self.number)
        self.number += 1

    def finalize(self) -> None:
        self.finalized = True


def test_held_publisher_can_be_stopped_and_finalizes(
    network: Network, subscriber: HeldSubscriber
) -> None:
    settings = RunSettings(domain=network.domain, qos={"News": Qos(reliable=True)})
    runner = Runner(Speaker, Parameters(), settings)
    runner.start()
    subscriber.entered.wait(30)
    wait_until(lambda: runner.statistics.of("News", "announced").drops)
    runner.stop()
    assert runner.wait()
    assert isinstance(runner.worker, Speaker)
    assert runner.worker.finalized
