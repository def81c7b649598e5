"""A thousand operations, a hundred ports, two interfaces on one port name, and many callers."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.connection.endpoint import Qos
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_handlers import HANDLERS
from tests.middleware.probe_types import PROBE
from tests.support.waiting import wait_until

PORTS, OPERATIONS = 40, 25
pytestmark = pytest.mark.feature("Many ports and callers")
WIDE_NEWS = rt.Interface(
    "Test::WideNews",
    *(rt.Operation(f"t{i}", rt.Pattern.PUBLISH, {"n": rt.Int}) for i in range(OPERATIONS)),
)
WIDE = rt.Interface(
    "Test::Wide",
    *(rt.Operation(f"q{i}", inputs={"n": rt.Int}, returns=rt.Int) for i in range(OPERATIONS)),
)
TWIN = rt.Interface("Test::Twin", rt.Operation("twice", inputs={"n": rt.Int}, returns=rt.Int))


@pytest.mark.needs("topics")
def test_thousand_topics_reach_their_subscribers(network: Network) -> None:
    received: dict[tuple[str, str], list[int]] = {}
    listener, publisher = network.node("listener"), network.node("publisher")
    for p in range(PORTS):
        for operation in WIDE_NEWS.operations:
            received[f"T{p}", operation.name] = []
        handlers = {
            operation.name: received[f"T{p}", operation.name].append
            for operation in WIDE_NEWS.operations
        }
        at = listener.at(WIDE_NEWS, f"Own{p}", f"publisher.T{p}", qos=Qos(depth=1000))
        listener.ports.subscribe(at, handlers, listener.execution)
    topics = {}
    for p in range(PORTS):
        channel = publisher.ports.advertise(publisher.at(WIDE_NEWS, f"T{p}"))
        topics |= {(f"T{p}", o.name): channel.bind(o) for o in WIDE_NEWS.operations}
    assert len(topics) == PORTS * OPERATIONS == 1000

    def arrived() -> bool:
        for number, (topic, publish) in enumerate(topics.items()):
            if not received[topic]:
                publish(number)
        return all(received.values())

    wait_until(arrived)
    for number, numbers in enumerate(received.values()):
        assert set(numbers) == {number}, "each topic has its own messages"


@pytest.mark.needs("services")
def test_thousand_operations_of_many_ports_are_called(network: Network) -> None:
    server, client = network.node("server"), network.node("client")
    for p in range(PORTS):
        handlers = {
            operation.name: lambda n, base=p * OPERATIONS + i: base + n
            for i, operation in enumerate(WIDE.operations)
        }
        server.serve(handlers, WIDE, f"W{p}")
    results = []
    for p in range(PORTS):
        channel = client.ports.proxy(client.at(WIDE, "Wide", f"server.W{p}"))
        results += [channel.bind(operation)(0) for operation in WIDE.operations]
    assert results == list(range(PORTS * OPERATIONS))


@pytest.mark.needs("services")
def test_two_interfaces_have_one_port_name(network: Network) -> None:
    server, client = network.node("server"), network.node("client")
    server.serve(HANDLERS, PROBE, "shared")
    server.serve({"twice": lambda n: 2 * n}, TWIN, "shared")
    twice = client.ports.proxy(client.at(TWIN, "Twin", "server.shared")).bind(
        TWIN.operation("twice")
    )
    assert client.probe("server.shared").add(1, 2) == 3
    assert twice(4) == 8


@pytest.mark.needs("services")
def test_concurrent_callers_of_one_proxy_get_their_own_results(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    probe = network.node("client", threads=8).probe()

    def call_often(start: int) -> bool:
        return all(probe.add(start, n) == start + n for n in range(100))

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(call_often, range(0, 8000, 1000), timeout=DEADLINE))


@pytest.mark.needs("topics")
def test_concurrent_publishers_of_one_port_keep_their_order(network: Network) -> None:
    received: list[tuple[str, int]] = []
    network.node("s").subscribe(lambda who, n: received.append((who, n)), qos=Qos(depth=2000))
    news = network.node("p").news()
    wait_until(lambda: news.announced("begin", 0) or received)

    def publish_often(who: str) -> None:
        for n in range(50):
            news.announced(who, n)

    names = [f"thread {i}" for i in range(4)]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(publish_often, names, timeout=DEADLINE))
    wait_until(lambda: len([who for who, _ in received if who != "begin"]) == 200)
    for name in names:
        assert [n for who, n in received if who == name] == list(range(50))
