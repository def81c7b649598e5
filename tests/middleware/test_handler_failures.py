"""Whatever a handler raises is a `RemoteError` at the caller, and the port lives on."""

from __future__ import annotations

import asyncio
import logging
import threading
from collections.abc import Callable
from pathlib import Path
from queue import SimpleQueue

import pytest

from robocomp_dsl.runtime.codec.failures import decode_failure, encode_failure
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.receiver import LeaderFollowerQueue, QueueClosed
from robocomp_dsl.runtime.errors import RemoteError
from tests.middleware.network import Network
from tests.middleware.probe_types import PROBE
from tests.support.waiting import wait_until


class PlainBaseError(BaseException):
    pass


class UnprintableError(Exception):
    def __str__(self) -> str:
        raise ValueError("no text")


FAILURES = (
    SystemExit(0),
    KeyboardInterrupt(),
    asyncio.CancelledError(),
    GeneratorExit(),
    PlainBaseError("plain"),
    UnprintableError(),
)


@pytest.mark.parametrize("failure", FAILURES, ids=lambda failure: type(failure).__name__)
def test_handler_failure_of_any_class_is_remote_error(
    network: Network, failure: BaseException, caplog: pytest.LogCaptureFixture
) -> None:
    def fail() -> None:
        raise failure

    server = network.node("server")
    server.serve({"fail": fail, "add": lambda a, b: a + b})
    probe = network.node("client").probe()
    with (
        caplog.at_level(logging.ERROR, "robocomp"),
        pytest.raises(RemoteError, match=type(failure).__name__),
    ):
        probe.fail()
    assert probe.add(2, 3) == 5
    assert server.count("fail").failures == 1
    line = fail.__code__.co_firstlineno + 1
    assert f"{Path(__file__).name}:{line}" in caplog.text


def test_encode_failure_replaces_what_utf8_has_not() -> None:
    error = OSError("no file \udcff")
    data = encode_failure(PROBE.operation("fail"), error)
    assert str(decode_failure(PROBE.operation("fail"), "a.Probe", data, 1.0)) == (
        "a.Probe.fail failed: OSError: no file ?"
    )


def test_subscriber_survives_system_exit_of_handler(network: Network) -> None:
    received: list[int] = []

    def hear(_who: str, number: int) -> None:
        received.append(number)
        raise SystemExit(number)

    listener = network.node("listener")
    listener.subscribe(hear)
    news = network.node("speaker").news()
    assert news.wait_for_server(30)
    for number in range(3):
        news.announced("me", number)
    wait_until(lambda: received == [0, 1, 2], lambda: str(received))
    wait_until(lambda: listener.count("announced", "News").failures == 3)


@pytest.mark.parametrize("dying", ["take", "handle"])
def test_receiver_thread_death_ends_component_and_blocks_nobody(dying: str) -> None:
    jobs: SimpleQueue[str] = SimpleQueue()
    reasons: SimpleQueue[str] = SimpleQueue()

    def fault() -> None:
        raise SystemError("out of order")

    def take() -> str:
        job = jobs.get()
        if job == "take":
            fault()
        if job == "close":
            raise QueueClosed
        return job

    actions: dict[str, Callable[[], None]] = {"handle": fault}
    group = CallbackGroup()
    queue = LeaderFollowerQueue(
        "arm.Laser", take, lambda job: actions[job](), group, reasons.put, QueueClosed
    )
    jobs.put(dying)
    reason = reasons.get(timeout=30)
    assert "the thread arm.Laser died: SystemError: out of order" in reason
    assert queue.join(30)
    assert not [t for t in threading.enumerate() if t.name == "arm.Laser"]
