"""Queues, priorities and refusals of the quality of service, on every middleware."""

from __future__ import annotations

import os
import sys
import threading
from dataclasses import replace
from typing import Any

import pytest

from robocomp_dsl.runtime.component import thread_priority
from robocomp_dsl.runtime.component.thread_priority import ThreadPriority, set_scheduling
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.connection.qos_support import UnsupportedQos
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_types import NEWS, PROBE
from tests.support.waiting import wait_until

KEEP_ALL = Qos(keep_all=True)
pytestmark = [pytest.mark.feature("Quality of service"), pytest.mark.needs("topics")]


@pytest.mark.needs("keep_all")
def test_keep_all_delivers_every_message_to_slow_subscriber(network: Network) -> None:
    release, received = threading.Event(), []

    def receive(_who: str, number: int) -> None:
        release.wait(DEADLINE)
        received.append(number)

    node = network.node("s")
    node.subscribe(receive, qos=KEEP_ALL)
    news = network.node("p").news(qos=KEEP_ALL)
    assert news.wait_for_server(DEADLINE)
    wait_until(news.has_subscribers)
    for number in range(3000):
        news.announced("p", number)
    release.set()
    wait_until(lambda: len(received) == 3000)
    assert received == list(range(3000))
    node.statistics.refresh()
    assert node.count("announced", "News").drops == 0


@pytest.mark.parametrize(
    ("qos", "item"),
    [(Qos(**{item: True}), item) for item in ("reliable", "keep_all", "latched")]
    + [(Qos(priority="high"), "priority")],
)
def test_item_that_the_middleware_cannot_do_is_refused(
    network: Network, qos: Qos, item: str
) -> None:
    node = network.node("s")
    at = node.at(NEWS, "News", qos=qos)
    if item in network.capabilities.qos:
        node.ports.subscribe(at, {"announced": lambda *_: None}, node.execution)
        node.ports.advertise(at)
        return
    for action in (
        lambda: node.ports.subscribe(at, {"announced": lambda *_: None}, node.execution),
        lambda: node.ports.advertise(at),
    ):
        with pytest.raises(UnsupportedQos) as raised:
            action()
        for word in ("`News`", f"`{item}`", f"`{network.middleware}`", "zenoh"):
            assert word in str(raised.value)


@pytest.mark.parametrize("item", ["keep_all", "latched", "deadline", "liveliness"])
def test_items_of_topics_are_refused_for_services(network: Network, item: str) -> None:
    node = network.node("s")
    at = node.at(PROBE, "Probe", qos=Qos(**{item: True}))
    with pytest.raises(UnsupportedQos, match=f"`{item}`, which only topics have"):
        node.ports.serve(at, {}, node.execution)
    with pytest.raises(UnsupportedQos, match="`Probe`"):
        node.ports.proxy(at)


def test_connections_of_a_port_have_queues_of_their_own(network: Network) -> None:
    release, received = threading.Event(), []

    def receive(who: str, number: int) -> None:
        release.wait(DEADLINE)
        received.append((who, number))

    node = network.node("s")
    at = node.at(NEWS, "News", "a", "b", qos=Qos(depth=2))
    at = replace(at, peer_qos=(("b", Qos(depth=50)),))
    node.ports.subscribe(at, {"announced": receive}, node.execution)
    a, b = network.node("a").news(), network.node("b").news()
    for news in (a, b):
        assert news.wait_for_server(DEADLINE)
        wait_until(news.has_subscribers)
    a.announced("a", -1)
    wait_until(lambda: node.execution.busy)
    for number in range(20):
        a.announced("a", number)
        b.announced("b", number)
    b.announced("b", 20)
    ports = node.ports.subscribed[0].subscriptions
    assert [each.at.qos.depth for each in ports] == [2, 50]
    release.set()
    wait_until(lambda: ("b", 20) in received and ("a", 19) in received)
    assert [n for who, n in received if who == "b"] == list(range(21))


@pytest.mark.skipif(sys.platform != "linux", reason="SCHED_FIFO for threads is of Linux")
def test_thread_priority_is_set_or_the_reason_is_logged(
    network: Network, caplog: pytest.LogCaptureFixture
) -> None:
    seen: list[tuple[int, int]] = []

    def receive(_who: str, _number: int) -> None:
        seen.append((os.sched_getscheduler(0), os.sched_getparam(0).sched_priority))

    thread_priority._reported.clear()
    allowed = _is_allowed(7)
    node = network.node("s")
    node.subscribe(receive, qos=Qos(thread_priority=7))
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    wait_until(lambda: news.announced("p", 1) or seen)
    if allowed:
        assert seen[0] == (os.SCHED_FIFO, 7)
    else:
        assert seen[0][0] == os.SCHED_OTHER
        assert caplog.text.count("receives without real-time priority 7") == 1


def _is_allowed(priority: int) -> bool:
    """Whether this process may use SCHED_FIFO; tried in a thread that ends."""
    reasons: list[str] = []
    thread = threading.Thread(target=lambda: reasons.append(set_scheduling(0, priority)))
    thread.start()
    thread.join(DEADLINE)
    return reasons == [""]


def test_forbidden_thread_priority_warns_once_with_reason_and_fix(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def forbid(*_: Any) -> None:
        raise PermissionError(1, "Operation not permitted")

    thread_priority._reported.clear()
    monkeypatch.setattr(os, "sched_setscheduler", forbid)
    priority = ThreadPriority("base.Laser", 42)
    for _ in range(3):
        priority.start_thread()
    assert caplog.text.count("base.Laser receives without real-time priority 42") == 1
    for word in ("ulimit -r", "LimitRTPRIO=42", "limits.conf"):
        assert word in caplog.text
