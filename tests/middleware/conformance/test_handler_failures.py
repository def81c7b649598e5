"""Whatever a handler raises is a `RemoteError` at the caller, and the port lives on."""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path

import pytest

from robocomp_dsl.runtime.errors import RemoteError, Timeout
from tests.middleware.network import Network
from tests.support.waiting import wait_until

pytestmark = pytest.mark.feature("Failures of handlers")


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
    Timeout("no reply to a call of the handler"),
)


@pytest.mark.needs("services")
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


@pytest.mark.needs("topics")
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
