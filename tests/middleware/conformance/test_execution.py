"""One handler at a time, and no standstill when components call each other."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_types import ProbeProxy
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Callback groups"), pytest.mark.needs("services")]


def blocked(free: threading.Event) -> None:
    free.wait(DEADLINE)


def wait_for_both(both: threading.Barrier) -> None:
    both.wait()


def test_handlers_of_one_component_do_not_overlap(network: Network) -> None:
    inside = 0
    most = 0

    def add(a: int, b: int) -> int:
        nonlocal inside, most
        inside += 1
        most = max(most, inside)
        inside -= 1
        return a + b

    network.node("server").serve({"add": add})
    probes = [network.node(f"client{i}").probe() for i in range(3)]
    with ThreadPoolExecutor(3) as pool:
        jobs = [pool.submit(probe.add, i, 1) for i in range(100) for probe in probes]
        for job in jobs:
            job.result(DEADLINE)
    assert most == 1


def test_two_components_query_each_other(network: Network) -> None:
    a, b = network.node("a"), network.node("b")
    to_a, to_b = a.probe("b"), b.probe("a")
    a.serve({"nested": lambda depth: to_a.nested(depth - 1) + 1 if depth else 0})
    b.serve({"nested": lambda depth: to_b.nested(depth - 1) + 1 if depth else 0})
    outside = network.node("outside")
    into_a, into_b = outside.probe("a"), network.node("outside2").probe("b")
    with ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(proxy.nested, 8) for proxy in (into_a, into_b)]
        assert [job.result(DEADLINE) for job in jobs] == [8, 8]


def test_component_queries_itself(network: Network) -> None:
    a = network.node("a")
    own: ProbeProxy = a.probe("a")
    a.serve({"nested": lambda depth: own.nested(depth - 1) + 1 if depth else 0})
    assert network.node("outside").probe("a").nested(5) == 5


def test_handlers_of_others_run_while_one_waits(network: Network) -> None:
    free = threading.Event()
    slow = network.node("slow")
    slow.serve({"block": lambda: blocked(free)})
    middle = network.node("middle")
    to_slow = middle.probe("slow")
    middle.serve({"block": to_slow.block, "add": lambda a, b: a + b})
    first, second = network.node("first"), network.node("second")
    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(first.probe("middle").block)
        wait_until(lambda: slow.execution.busy)
        assert second.probe("middle").add(1, 2) == 3
        free.set()
        waiting.result(DEADLINE)


def test_handlers_overlap_with_several_threads(network: Network) -> None:
    both = threading.Barrier(2, timeout=DEADLINE)
    server = network.node("server", threads=2)
    server.serve({"block": lambda: wait_for_both(both)})
    server.serve({"block": lambda: wait_for_both(both)}, port="Second")
    clients = [network.node(f"c{i}") for i in range(2)]
    probes = [clients[0].probe("server.Probe"), clients[1].probe("server.Second")]
    with ThreadPoolExecutor(2) as pool:
        for job in [pool.submit(probe.block) for probe in probes]:
            job.result(DEADLINE)
