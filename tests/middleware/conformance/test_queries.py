"""Queries and commands of every middleware."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.errors import (
    AmbiguousServer,
    InterfaceMismatch,
    NoServer,
    RemoteError,
    Timeout,
)
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_handlers import HANDLERS, blocked
from tests.middleware.probe_types import PROBE, Broken
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Queries and commands"), pytest.mark.needs("services")]


def test_query_returns_result(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    assert network.node("client").probe().add(2, 3) == 5


def test_query_returns_result_and_output(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    assert network.node("client").probe().divide(17, 5) == (3, 2)


def test_query_without_outputs_returns_when_done(network: Network) -> None:
    done: list[int] = []
    network.node("server").serve({"nothing": lambda: done.append(1)})
    network.node("client").probe().nothing()
    assert done == [1]


def test_query_returns_array(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    sent = np.arange(1_300_000, dtype=np.float32)
    assert np.array_equal(network.node("client").probe().echo(sent), sent)


def test_query_raises_declared_exception(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    with pytest.raises(Broken) as caught:
        network.node("client").probe().divide(1, 0)
    assert (caught.value.code, caught.value.what) == (7, "by zero")


def test_query_raises_remote_error_for_other_exception_and_server_continues(
    network: Network,
) -> None:
    network.node("server").serve(HANDLERS)
    probe = network.node("client").probe()
    with pytest.raises(RemoteError, match=r"server\.\w+.*KeyError.*no such thing"):
        probe.fail()
    assert probe.add(1, 1) == 2


@pytest.mark.usefixtures("short_discovery_timeout")
def test_query_without_server_raises_no_server(network: Network) -> None:
    probe = network.node("client").probe()
    for _ in range(2):
        with pytest.raises(
            NoServer, match="no component serves Test::Probe, which client requires"
        ):
            probe.add(1, 2)


@pytest.mark.usefixtures("short_discovery_timeout")
def test_command_without_server_raises_no_server(network: Network) -> None:
    with pytest.raises(NoServer):
        network.node("client").probe().note("hello")


@pytest.mark.usefixtures("short_discovery_timeout")
def test_connection_to_missing_component_raises_no_server(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    with pytest.raises(NoServer, match="other does not serve"):
        network.node("client").probe("other").add(1, 2)


def test_several_servers_are_ambiguous_until_one_is_named(network: Network) -> None:
    network.node("left").serve({"add": lambda *_: 1})
    network.node("right").serve({"add": lambda *_: 2})
    client = network.node("client")
    assert client.probe("right").add(0, 0) == 2
    assert client.probe("left.Probe").add(0, 0) == 1
    registry = client.ports.presence.registry
    wait_until(lambda: len(registry.find("server", PROBE.name)) == 2)
    probe = client.probe()
    with pytest.raises(AmbiguousServer, match=r"left\.Probe, right\.Probe.*--connect Probe=left"):
        probe.add(0, 0)


def test_commands_arrive_once_and_in_order(network: Network) -> None:
    received: list[str] = []
    server = network.node("server")
    server.serve({"note": received.append})
    probe = network.node("client").probe()
    for i in range(300):
        probe.note(str(i))
    wait_until(lambda: len(received) == 300)
    assert received == [str(i) for i in range(300)]


def test_call_waits_for_server_that_starts_later(network: Network) -> None:
    client, server = network.node("client"), network.node("server")
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(client.probe().add, 2, 2)
        server.serve(HANDLERS)
        assert asked.result(DEADLINE) == 4


def test_query_times_out_without_reply(network: Network) -> None:
    free = threading.Event()
    server = network.node("server")
    server.serve({"block": lambda: blocked(free), "add": lambda a, b: a + b})
    first, second = network.node("first").probe(), network.node("second").probe()
    with ThreadPoolExecutor(1) as pool:
        blocking = pool.submit(first.block)
        wait_until(lambda: server.execution.busy)
        second.set_timeout(0.2)
        with pytest.raises(Timeout):
            second.add(1, 1)
        free.set()
        blocking.result(DEADLINE)
    second.set_timeout(5)
    assert second.add(1, 1) == 2


PICK = rt.Operation("pick", inputs={"x": rt.Double, "y": rt.Int}, returns=rt.Double)
OLD_VERSION = rt.Interface(
    "Test::Versions",
    rt.Operation("second", inputs={"a": rt.Int}, returns=rt.Int),
    PICK,
    rt.Operation("gone", returns=rt.Int),
    rt.Operation("note", rt.Pattern.COMMAND, {"text": rt.String}),
    rt.Operation("changed", inputs={"x": rt.Double}, returns=rt.Int, units={"x": "m"}),
    rt.Operation("reset", rt.Pattern.COMMAND, {"x": rt.Double}),
)
NEW_VERSION = rt.Interface(
    "Test::Versions",
    rt.Operation("added", returns=rt.Int),
    rt.Operation("note", rt.Pattern.COMMAND, {"text": rt.String}),
    rt.Operation("second", inputs={"a": rt.Int}, returns=rt.Int),
    rt.Operation("pick", inputs={"x": rt.Double, "y": rt.Int}, returns=rt.Double),
    rt.Operation("changed", inputs={"x": rt.Double}, returns=rt.Int, units={"x": "mm"}),
    rt.Operation("reset", rt.Pattern.COMMAND, {"x": rt.Double, "y": rt.Double}),
)


@pytest.mark.needs("services")
def test_operations_that_did_not_change_work_between_versions(network: Network) -> None:
    noted: list[str] = []
    handlers = {"second": lambda a: a + 1, "pick": lambda x, y: x * y, "note": noted.append}
    network.node("server").serve(handlers, NEW_VERSION, "Versions")
    client = network.node("client")
    channel = client.ports.proxy(client.at(OLD_VERSION, "Versions"))
    call = {operation.name: channel.bind(operation) for operation in OLD_VERSION.operations}
    assert call["second"](4) == 5
    assert call["pick"](1.5, 4) == 6.0
    call["note"]("later")
    wait_until(lambda: noted == ["later"])
    with pytest.raises(InterfaceMismatch, match=r"Test::Versions\.gone: server does not have"):
        call["gone"]()
    with pytest.raises(InterfaceMismatch, match=r"changed: `x` is in m here, but in mm there"):
        call["changed"](1.0)
    with pytest.raises(InterfaceMismatch, match=r"reset: the input `y` \(`double`\) is new there"):
        call["reset"](1.0)
    assert call["second"](5) == 6
