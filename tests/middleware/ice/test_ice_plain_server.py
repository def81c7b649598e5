"""A component of ours calls programs written with Ice, known by their addresses."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.errors import (
    MiddlewareError,
    NoServer,
    RemoteError,
    Timeout,
)
from tests.middleware.ice.peers import Ice, PlainProgram, free_port
from tests.support.waiting import wait_until

pytestmark = pytest.mark.peers
EMPTY = bytes.fromhex("060000000101")


@pytest.fixture
def servant(slices: SimpleNamespace) -> Any:  # noqa: C901 - one method per operation
    """An object as a RoboComp programmer writes it."""
    store = slices.store

    class StoreI(store.Store):  # type: ignore[misc, name-defined]
        def __init__(self) -> None:
            self.modes: list[Any] = []
            self.received: list[str] = []
            self.entered = threading.Event()
            self.release = threading.Event()

        def find(self, name: str, current: Any = None) -> Any:
            self.modes.append(current.mode)
            if name == "silent":
                raise slices.faults.Silent
            if name != "a":
                raise slices.faults.NotThere(name, 404)
            return store.Item("a", store.Kind.Huge, 0.5)

        def split(self, number: int, by: int, current: Any = None) -> Any:
            return number // by, number % by, {"seen": number}

        def all(self, current: Any = None) -> Any:
            return [store.Item("é", store.Kind.Large, 1.5), store.Item("", store.Kind.Small, 0.0)]

        def describe(self, current: Any = None) -> Any:
            return self.all(), {"n": 2}

        def scale(self, values: Any, factor: float, current: Any = None) -> Any:
            return [value * factor for value in values]

        def echo(self, pixels: bytes, current: Any = None) -> bytes:
            return pixels

        def empty(self, nothing: Any, current: Any = None) -> Any:
            return nothing

        def fail(self, why: str, current: Any = None) -> None:
            if why == "undeclared":
                raise slices.faults.Silent
            raise KeyError(why)

        def reset(self, current: Any = None) -> None:
            self.entered.set()
            self.release.wait(30)

        def put(self, item: Any, current: Any = None) -> None:
            self.received.append(item.name)

        def list(self, number: int, current: Any = None) -> int:
            return number + 1

        def hidden(self, value: int, current: Any = None) -> int:
            return -value

    return StoreI()


@pytest.fixture
def proxy(
    plain: Callable[..., PlainProgram], servant: Any, connect: Callable[[str], SimpleNamespace]
) -> Any:
    return connect(plain(MessageSizeMax="0").serve(servant, "store")).proxy


def test_component_gets_results_of_plain_server(proxy: Any, generated: Any, servant: Any) -> None:
    assert proxy.find("a") == generated.Item("a", generated.Kind.Huge, 0.5)
    assert servant.modes == [Ice.OperationMode.Idempotent]
    assert proxy.split(17, 5) == (3, 2, {"seen": 17})
    assert [(i.name, i.kind) for i in proxy.all()] == [("é", 300), ("", 0)]
    assert proxy.describe()[1] == {"n": 2}
    scaled = proxy.scale(np.array([1.0, 2.0], np.float32), 1.5)
    assert scaled.dtype == np.float32
    assert scaled.tolist() == [1.5, 3.0]
    assert proxy.empty(generated.Nothing()) == generated.Nothing()
    assert proxy.list_(1) == 2
    assert proxy.hidden__(4) == -4


def test_component_gets_declared_exceptions_of_plain_server(proxy: Any, generated: Any) -> None:
    with pytest.raises(generated.NotThere) as caught:
        proxy.find("z")
    assert (caught.value.name, caught.value.code) == ("z", 404)
    with pytest.raises(generated.Silent):
        proxy.find("silent")


def test_component_gets_failures_of_plain_server_as_remote_errors(proxy: Any) -> None:
    with pytest.raises(RemoteError, match=r"plain\.Store\.fail failed: (?s:.*)KeyError: 'bad'"):
        proxy.fail("bad")
    with pytest.raises(RemoteError, match="::RoboCompFaults::Silent, which is not declared"):
        proxy.fail("undeclared")


def test_component_exchanges_8_mb_with_plain_server(proxy: Any) -> None:
    pixels = np.zeros(8_000_000, np.uint8)
    assert np.array_equal(proxy.echo(pixels), pixels)


def test_component_sends_commands_to_plain_server(proxy: Any, generated: Any, servant: Any) -> None:
    for index in range(100):
        proxy.put(generated.Item(str(index)))
    wait_until(lambda: len(servant.received) == 100)
    assert servant.received == [str(index) for index in range(100)]


def test_call_of_slow_plain_server_times_out(proxy: Any, servant: Any) -> None:
    proxy.set_timeout(0.1)
    with pytest.raises(Timeout, match=r"plain\.Store\.reset did not reply within 0\.1 s"):
        proxy.reset()
    servant.release.set()
    proxy.set_timeout(10)
    assert proxy.list_(1) == 2


def test_limit_of_plain_server_is_named(
    plain: Callable[..., PlainProgram], servant: Any, connect: Callable[[str], SimpleNamespace]
) -> None:
    proxy = connect(plain().serve(servant, "store")).proxy
    with pytest.raises(RemoteError, match=r"accept 1 MB: start it with --Ice\.MessageSizeMax=0"):
        proxy.echo(np.zeros(3_000_000, np.uint8))
    assert proxy.list_(1) == 2


@pytest.mark.parametrize(
    ("address", "message"),
    [
        (
            "store:tcp -h localhost -p {port}",
            r"localhost -p \d+\) cannot be reached: Connection",
        ),
        ("store:tcp -h nohost.invalid -p 1", "the host `nohost.invalid` is unknown"),
    ],
)
def test_unreachable_plain_server_is_named(
    connect: Callable[[str], SimpleNamespace], address: str, message: str
) -> None:
    proxy = connect(address.format(port=free_port())).proxy
    for _ in range(2):
        with pytest.raises(NoServer, match=message):
            proxy.list_(1)
    with pytest.raises(NoServer, match=message):
        proxy.find("a")  # idempotent


def test_invalid_address_of_plain_server_is_named(
    connect: Callable[[str], SimpleNamespace],
) -> None:
    proxy = connect("store at localhost").proxy
    with pytest.raises(MiddlewareError, match="`store at localhost` is no address of Ice"):
        proxy.list_(1)


def test_wrong_object_name_is_reported(
    plain: Callable[..., PlainProgram], servant: Any, connect: Callable[[str], SimpleNamespace]
) -> None:
    address = plain().serve(servant, "shop")
    proxy = connect(address.replace("shop:", "store:")).proxy
    with pytest.raises(NoServer, match="is running, but has no object `store`"):
        proxy.list_(1)


def test_component_follows_restart_of_plain_server(
    plain: Callable[..., PlainProgram], servant: Any, connect: Callable[[str], SimpleNamespace]
) -> None:
    first = plain()
    proxy = connect(first.serve(servant, "store")).proxy
    assert proxy.list_(1) == 2
    first.close()
    with pytest.raises(NoServer):
        proxy.list_(1)
    plain(port=first.port).serve(servant, "store")
    wait_until(lambda: proxy.list_(1) == 2, ignoring=NoServer)


def test_interrupt_ends_call_of_plain_server(
    plain: Callable[..., PlainProgram], servant: Any, connect: Callable[[str], SimpleNamespace]
) -> None:
    connected = connect(plain().serve(servant, "store"))
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(connected.proxy.reset)
        servant.entered.wait(30)
        connected.component.ports.interrupt()
        with pytest.raises(NoServer):
            asked.result(30)
        servant.release.set()
