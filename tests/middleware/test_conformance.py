"""What every middleware must do; a new one is added to `MIDDLEWARES` and passes unchanged."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.errors import (
    AmbiguousServer,
    InterfaceMismatch,
    NoServer,
    RemoteError,
    Timeout,
)
from robocomp_dsl.runtime.middleware.base import Endpoint, Qos
from tests.middleware.network import DEADLINE, Network, wait_for
from tests.middleware.probe_types import NEWS, OTHER_PROBE, Broken


def divide(a: int, b: int) -> tuple[int, int]:
    if b == 0:
        raise Broken(7, "by zero")
    return divmod(a, b)


def blocked(free: threading.Event) -> None:
    free.wait(DEADLINE)


def fail() -> None:
    raise KeyError("no such thing")


HANDLERS = {
    "add": lambda a, b: a + b,
    "divide": divide,
    "echo": lambda v: v,
    "fail": fail,
}


def test_a_query_returns(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    assert network.node("client").probe().add(2, 3) == 5


def test_a_query_with_a_result_and_an_output(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    assert network.node("client").probe().divide(17, 5) == (3, 2)


def test_a_query_without_outputs_returns_when_it_is_done(network: Network) -> None:
    done: list[int] = []
    network.node("server").serve({"nothing": lambda: done.append(1)})
    network.node("client").probe().nothing()
    assert done == [1]


def test_an_array_comes_back(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    sent = np.arange(1_300_000, dtype=np.float32)
    assert np.array_equal(network.node("client").probe().echo(sent), sent)


def test_a_declared_exception_arrives_as_itself(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    with pytest.raises(Broken) as caught:
        network.node("client").probe().divide(1, 0)
    assert (caught.value.code, caught.value.what) == (7, "by zero")


def test_any_other_exception_is_a_remote_error_and_the_server_lives_on(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    probe = network.node("client").probe()
    with pytest.raises(RemoteError, match=r"server\.\w+.*KeyError.*no such thing"):
        probe.fail()
    assert probe.add(1, 1) == 2


@pytest.mark.usefixtures("hasty")
def test_a_query_to_nobody(network: Network) -> None:
    probe = network.node("client").probe()
    for _ in range(2):
        with pytest.raises(
            NoServer, match="no component serves Test::Probe, which client requires"
        ):
            probe.add(1, 2)


@pytest.mark.usefixtures("hasty")
def test_a_command_to_nobody(network: Network) -> None:
    with pytest.raises(NoServer):
        network.node("client").probe().note("hello")


@pytest.mark.usefixtures("hasty")
def test_a_wire_to_somebody_who_is_not_there(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    with pytest.raises(NoServer, match="other does not serve"):
        network.node("client").probe("other").add(1, 2)


def test_several_servers_are_ambiguous_until_one_is_named(network: Network) -> None:
    network.node("left").serve({"add": lambda *_: 1})
    network.node("right").serve({"add": lambda *_: 2})
    client = network.node("client")
    assert client.probe("right").add(0, 0) == 2
    assert client.probe("left.Probe").add(0, 0) == 1
    probe = client.probe()
    wait_for(lambda: network.kind == "inproc" or probe.wait_for_server(1))
    with pytest.raises(AmbiguousServer, match=r"left\.Probe, right\.Probe.*--connect Probe=left"):
        probe.add(0, 0)


def test_commands_arrive_once_and_in_order(network: Network) -> None:
    heard: list[str] = []
    server = network.node("server")
    server.serve({"note": heard.append})
    probe = network.node("client").probe()
    for i in range(300):
        probe.note(str(i))
    wait_for(lambda: len(heard) == 300)
    assert heard == [str(i) for i in range(300)]


def test_a_server_that_starts_a_moment_later_is_waited_for(network: Network) -> None:
    client, server = network.node("client"), network.node("server")
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(client.probe().add, 2, 2)
        server.serve(HANDLERS)
        assert asked.result(DEADLINE) == 4


def test_no_answer_in_time(network: Network) -> None:
    free = threading.Event()
    server = network.node("server")
    server.serve({"block": lambda: blocked(free), "add": lambda a, b: a + b})
    first, second = network.node("first").probe(), network.node("second").probe()
    with ThreadPoolExecutor(1) as pool:
        blocking = pool.submit(first.block)
        wait_for(lambda: server.execution.busy)
        second.set_timeout(0.2)
        with pytest.raises(Timeout):
            second.add(1, 1)
        free.set()
        blocking.result(DEADLINE)
    second.set_timeout(5)
    assert second.add(1, 1) == 2


def test_interfaces_of_another_shape(network: Network) -> None:
    network.node("server").serve(HANDLERS, OTHER_PROBE)
    with pytest.raises(InterfaceMismatch, match=r"client and server .*Test::Probe"):
        network.node("client").probe().add(1, 2)


def test_publications_reach_all_in_the_order_of_each_publisher(network: Network) -> None:
    heard: dict[str, list[tuple[str, int]]] = {"a": [], "b": []}
    for name, into in heard.items():
        network.node(name).hear(lambda who, n, into=into: into.append((who, n)))
    publishers = [network.node(f"p{i}") for i in range(2)]
    proxies = [p.news() for p in publishers]
    for proxy in proxies:
        assert proxy.wait_for_server(DEADLINE)
    if network.kind == "zenoh":
        wait_for(lambda: all(len(_subscribers(p)) == 2 for p in publishers))
    for n in range(100):
        for p, proxy in enumerate(proxies):
            proxy.spoke(f"p{p}", n)
    wait_for(lambda: all(len(into) == 200 for into in heard.values()))
    for into in heard.values():
        for name in ("p0", "p1"):
            assert [n for who, n in into if who == name] == list(range(100))


def _subscribers(node: object) -> list[object]:
    return node.middleware._registry.find("subscriber", NEWS.name)  # type: ignore[attr-defined]


def test_a_publication_nobody_hears_is_no_failure(network: Network) -> None:
    network.node("publisher").news().spoke("me", 1)


def test_a_subscriber_wired_to_one_publisher(network: Network) -> None:
    heard: list[str] = []
    network.node("s").hear(lambda who, _n: heard.append(who), "right")
    wrong, right = network.node("wrong").news(), network.node("right").news()
    assert right.wait_for_server(DEADLINE)
    wrong.spoke("wrong", 0)
    right.spoke("right", 0)
    wait_for(lambda: heard)
    assert heard == ["right"]


def test_a_failing_subscriber_hears_the_next(network: Network) -> None:
    heard: list[int] = []

    def hear(_who: str, n: int) -> None:
        if n == 0:
            raise ValueError("not this one")
        heard.append(n)

    node = network.node("s")
    node.hear(hear)
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    news.spoke("p", 0)
    news.spoke("p", 1)
    wait_for(lambda: heard == [1])
    assert node.count("spoke", "News").failures == 1


def test_a_topic_knows_whether_it_is_heard(network: Network) -> None:
    news = network.node("p").news()
    assert not news.has_subscribers()
    network.node("deaf").serve(HANDLERS)
    hearer = network.node("s")
    hearer.hear(lambda *_: None)
    wait_for(news.has_subscribers)
    hearer.middleware.close()
    wait_for(lambda: not news.has_subscribers())


def test_a_slow_subscriber_keeps_the_latest_of_its_depth(network: Network) -> None:
    free = threading.Event()
    heard: list[int] = []

    def hear(_who: str, n: int) -> None:
        free.wait(DEADLINE)
        heard.append(n)

    node = network.node("s")
    node.hear(hear, qos=Qos(reliable=False, depth=2))
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    news.spoke("p", 0)
    wait_for(lambda: node.execution.busy)
    for n in range(1, 50):
        news.spoke("p", n)
    if network.kind == "zenoh":
        # A second subscriber on the same session tells that all have arrived; what was
        # still on its way when it subscribed may reach it before the last.
        probe: list[int] = []
        node.middleware.subscribe(
            Endpoint(NEWS, "s", "Second"),
            {"spoke": lambda _w, n: probe.append(n)},
            CallbackGroup(),
        )
        news.spoke("p", 50)
        wait_for(lambda: probe and probe[-1] == 50)
    else:
        news.spoke("p", 50)
    free.set()
    wait_for(lambda: heard and heard[-1] == 50)
    # One may have been on its way between the queue and the handler.
    assert heard[0] == 0
    assert heard[-2:] == [49, 50]
    assert len(heard) <= 4
    node.statistics.refresh()
    assert node.count("spoke", "News").drops == 51 - len(heard)


def test_publications_behind_their_deadline_are_counted(network: Network) -> None:
    heard: list[int] = []
    node = network.node("s")
    node.hear(lambda _who, n: heard.append(n), qos=Qos(deadline=1e-6))
    strict = node.count("spoke", "News")
    news = network.node("p").news()
    assert news.wait_for_server(DEADLINE)
    for n in range(3):
        news.spoke("p", n)
        wait_for(lambda n=n: heard and heard[-1] == n)
    assert strict.missed == 2


def test_the_proxy_follows_a_server_that_comes_back(network: Network) -> None:
    server = network.node("server")
    server.serve({"add": lambda *_: 1})
    probe = network.node("client").probe()
    assert probe.add(0, 0) == 1
    server.middleware.close()

    def gone() -> bool:
        try:
            probe.add(0, 0)
        except NoServer:
            return True
        return False

    wait_for(gone)
    network.node("server").serve({"add": lambda *_: 2})
    assert probe.wait_for_server(DEADLINE)
    assert probe.add(0, 0) == 2


@pytest.mark.parametrize("how", ["called", "waited for"])
def test_who_was_there_and_has_gone_is_missed_at_once(network: Network, how: str) -> None:
    server = network.node("server")
    server.serve(HANDLERS)
    probe = network.node("client").probe()
    assert probe.add(0, 0) == 0 if how == "called" else probe.wait_for_server(DEADLINE)
    server.middleware.close()
    wait_for(lambda: not probe.wait_for_server(0.0))
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(probe.add, 0, 0)
        with pytest.raises(NoServer):
            asked.result(DEADLINE)


@pytest.mark.usefixtures("hasty")
def test_domains_do_not_see_each_other(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    other = Network(network.kind)
    try:
        with pytest.raises(NoServer):
            other.node("client").probe().add(1, 2)
    finally:
        other.close()


def test_an_interrupt_ends_a_call_that_waits(network: Network) -> None:
    if network.kind == "inproc":
        pytest.skip("a call within the process runs in the caller; there is nothing to wait for")
    free = threading.Event()
    server = network.node("server")
    server.serve({"block": lambda: blocked(free)})
    client = network.node("client")
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(client.probe().block)
        wait_for(lambda: server.execution.busy)
        client.middleware.interrupt()
        with pytest.raises(NoServer, match="stopping"):
            asked.result(DEADLINE)
        free.set()


def test_calls_behind_the_end_of_their_component_say_so(network: Network) -> None:
    if network.kind == "inproc":
        pytest.skip("a call within the process needs no connection")
    network.node("server").serve(HANDLERS)
    client = network.node("client")
    called, fresh = client.probe(), client.probe()
    assert called.add(1, 2) == 3
    called.note("before")
    client.middleware.close()
    for probe in (called, fresh):
        with pytest.raises(NoServer, match="stopping"):
            probe.add(1, 2)
        with pytest.raises(NoServer, match="stopping"):
            probe.note("after")


def test_calls_are_counted(network: Network) -> None:
    server, client = network.node("server"), network.node("client")
    server.serve(HANDLERS)
    probe = client.probe()
    for _ in range(3):
        probe.add(1, 2)
    with pytest.raises(RemoteError):
        probe.fail()
    assert client.count("add").calls == 3
