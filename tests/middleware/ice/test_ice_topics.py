"""Topics between components on Ice, and with plain programs, with and without IceStorm."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import MiddlewareError
from tests.middleware.ice.ice_component import IceComponent
from tests.middleware.ice.icestorm import IceStormProcess, ice_storm
from tests.middleware.ice.peers import PlainProgram, free_port
from tests.support.waiting import wait_until

pytestmark = pytest.mark.peers
TOPIC = "icestorm:StorePub"


class Recorder:
    """A subscriber's handler."""

    def __init__(self) -> None:
        self.received: list[int] = []

    def changed(self, item: Any, number: int) -> None:
        assert item.name == f"n{number}"
        self.received.append(number)


def settings(manager: str) -> dict[tuple[str, str], str]:
    return {("ice", "TopicManager"): manager}


def publisher(own: IceComponent, generated: Any, *external: str, qos: Qos | None = None) -> Any:
    at = own.endpoint(generated.STOREPUB, *external, qos=qos)
    return generated.StorePubProxy(own.ports.advertise(at))


def publish(proxy: Any, generated: Any, number: int) -> None:
    proxy.changed(generated.Item(f"n{number}"), number)


@pytest.fixture
def storm(tmp_path: Path) -> Iterator[IceStormProcess]:
    with ice_storm(tmp_path, free_port()) as storm:
        yield storm


@pytest.fixture
def plain_subscriber(slices: SimpleNamespace) -> Any:
    """A subscriber as a RoboComp programmer writes it."""

    class StorePubI(slices.store.StorePub):  # type: ignore[misc, name-defined]
        def __init__(self) -> None:
            self.received: list[int] = []

        def changed(self, item: Any, number: int, current: Any = None) -> None:
            self.received.append(number)

    return StorePubI()


def test_reliable_topic_loses_nothing_with_a_slow_subscriber(
    component: Callable[..., IceComponent], generated: Any
) -> None:
    subscriber, recorder = component("listener"), Recorder()
    gate = threading.Event()

    def changed(item: Any, number: int) -> None:
        gate.wait(30)
        recorder.changed(item, number)

    subscriber.subscribe(generated.STOREPUB, changed, qos=Qos(reliable=True, depth=2))
    own = component("speaker")
    proxy = publisher(own, generated, qos=Qos(reliable=True, depth=1000))
    assert proxy.wait_for_server(30)
    for number in range(500):
        publish(proxy, generated, number)
    gate.set()
    wait_until(lambda: len(recorder.received) == 500)
    assert recorder.received == list(range(500))
    assert own.statistics.of("StorePub", "changed").drops == 0


def test_reliable_publisher_is_held_for_a_limited_time(
    component: Callable[..., IceComponent],
    generated: Any,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(bounded_queue, "HOLD_S", 0.03)
    subscriber, gate = component("listener"), threading.Event()
    handled: list[int] = []

    def changed(_item: Any, number: int) -> None:
        handled.append(number)
        gate.wait(30)

    subscriber.subscribe(generated.STOREPUB, changed, qos=Qos(reliable=True, depth=1))
    own = component("speaker")
    proxy = publisher(own, generated, qos=Qos(reliable=True, depth=1))
    assert proxy.wait_for_server(30)
    counts = own.statistics.of("StorePub", "changed")
    with caplog.at_level(logging.WARNING):
        for number in range(50):  # the first one is handled, two are queued, the rest is lost
            publish(proxy, generated, number)
        wait_until(lambda: counts.drops >= 40)
    assert "receives nothing and held StorePub.changed for 30 ms" in caplog.text
    gate.set()
    wait_until(lambda: len(handled) >= 3)
    wait_until(lambda: publish(proxy, generated, 99) or 99 in handled)


def test_stopped_subscriber_does_not_hold_publisher(
    component: Callable[..., IceComponent], generated: Any, plain: Callable[..., PlainProgram]
) -> None:
    # A listener whose process reads nothing: a socket that is never read.
    import socket  # noqa: PLC0415

    with socket.create_server(("127.0.0.1", 0)) as listener:
        address = f"sub:tcp -h 127.0.0.1 -p {listener.getsockname()[1]}"
        own = component("speaker")
        proxy = publisher(own, generated, address)
        counts = own.statistics.of("StorePub", "changed")
        item = generated.Item("n" * 100_000)
        for number in range(2000):
            proxy.changed(item, number)
        assert counts.calls == 2000
        assert counts.drops > 1000


def test_plain_subscriber_at_an_address_gets_publications(
    component: Callable[..., IceComponent],
    generated: Any,
    plain: Callable[..., PlainProgram],
    plain_subscriber: Any,
) -> None:
    address = plain().serve(plain_subscriber, "storepub")
    proxy = publisher(component(), generated, address)
    assert proxy.has_subscribers()
    for number in range(100):
        publish(proxy, generated, number)
    wait_until(lambda: len(plain_subscriber.received) == 100)
    assert plain_subscriber.received == list(range(100))


def test_plain_publisher_reaches_subscriber_at_its_address(
    component: Callable[..., IceComponent],
    generated: Any,
    slices: SimpleNamespace,
    plain: Callable[..., PlainProgram],
) -> None:
    port, recorder = free_port(), Recorder()
    own = component(addresses={("ice", "StorePub"): f"tcp -h 127.0.0.1 -p {port}"})
    own.subscribe(generated.STOREPUB, recorder.changed)
    proxy = plain().proxy(f"storepub:tcp -h localhost -p {port}").ice_oneway()
    proxy = slices.store.StorePubPrx.uncheckedCast(proxy)
    for number in range(100):
        proxy.changed(slices.store.Item(f"n{number}", slices.store.Kind.Small, 0.0), number)
    wait_until(lambda: len(recorder.received) == 100)
    assert recorder.received == list(range(100))


def test_component_publishes_to_plain_subscriber_through_icestorm(
    storm: IceStormProcess,
    component: Callable[..., IceComponent],
    generated: Any,
    plain: Callable[..., PlainProgram],
    plain_subscriber: Any,
) -> None:
    import IceStorm  # noqa: PLC0415

    storm.start()
    program = plain()
    proxy = program.proxy(program.serve(plain_subscriber, "storepub")).ice_oneway()
    manager = IceStorm.TopicManagerPrx.checkedCast(program.proxy(storm.manager))
    manager.create("StorePub").subscribeAndGetPublisher({}, proxy)
    news = publisher(component(transport_settings=settings(storm.manager)), generated, TOPIC)
    number = 0

    def arrives() -> bool:
        nonlocal number
        publish(news, generated, number)
        number += 1
        return bool(plain_subscriber.received)

    wait_until(arrives)
    assert plain_subscriber.received == sorted(plain_subscriber.received)


@pytest.mark.parametrize("reliable", [False, True])
def test_component_subscribes_to_plain_publisher_through_icestorm(
    storm: IceStormProcess,
    component: Callable[..., IceComponent],
    generated: Any,
    slices: SimpleNamespace,
    plain: Callable[..., PlainProgram],
    reliable: bool,
) -> None:
    import IceStorm  # noqa: PLC0415

    storm.start()
    recorder, program = Recorder(), plain()
    own = component(transport_settings=settings(storm.manager))
    own.subscribe(generated.STOREPUB, recorder.changed, TOPIC, qos=Qos(reliable=reliable))
    manager = IceStorm.TopicManagerPrx.checkedCast(program.proxy(storm.manager))
    topic = wait_until(lambda: manager.retrieve("StorePub"), ignoring=IceStorm.NoSuchTopic)
    wait_until(topic.getSubscribers)
    proxy = slices.store.StorePubPrx.uncheckedCast(topic.getPublisher())
    for number in range(50):
        proxy.changed(slices.store.Item(f"n{number}", slices.store.Kind.Small, 0.0), number)
    wait_until(lambda: len(recorder.received) == 50)
    assert recorder.received == list(range(50))
    own.ports.close()
    wait_until(lambda: not topic.getSubscribers())


def test_topic_waits_for_icestorm_and_follows_its_restart(
    storm: IceStormProcess,
    component: Callable[..., IceComponent],
    generated: Any,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from robocomp_dsl.runtime.middleware.ice import icestorm  # noqa: PLC0415

    monkeypatch.setattr(icestorm, "RETRY_S", 0.05)
    monkeypatch.setattr(icestorm, "CHECK_S", 0.1)
    recorder = Recorder()
    with caplog.at_level(logging.INFO):
        listener = component("listener", transport_settings=settings(storm.manager))
        listener.subscribe(generated.STOREPUB, recorder.changed, TOPIC)
        speaker = component("speaker", transport_settings=settings(storm.manager))
        news = publisher(speaker, generated, TOPIC)
        publish(news, generated, 0)  # lost, and does not wait
        wait_until(lambda: caplog.text.count("is not connected to the topic StorePub") == 2)
    assert f"IceStorm at `{storm.manager}`: Connection refused; trying again" in caplog.text
    assert "--transport 'ice.TopicManager=…'" in caplog.text
    assert speaker.statistics.of("StorePub", "changed").drops == 1
    number = 0

    def arrives() -> bool:
        nonlocal number
        number += 1
        publish(news, generated, number)
        return bool(recorder.received)

    for _ in range(2):
        storm.start()
        recorder.received.clear()
        wait_until(arrives)
        storm.stop()


def test_subscription_of_an_address_is_refused(
    component: Callable[..., IceComponent], generated: Any
) -> None:
    with pytest.raises(MiddlewareError, match="name a topic of IceStorm, such as icestorm:"):
        component().subscribe(generated.STOREPUB, print, "storepub:tcp -p 1")
