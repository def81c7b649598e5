"""The end of components: calls in flight, interrupts, and nothing that is left behind."""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError, NoServer
from robocomp_dsl.runtime.middleware.registry import transport_folder
from tests.middleware.conformance.peer_launcher import Peer
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_handlers import HANDLERS, blocked
from tests.support.waiting import wait_until

pytestmark = pytest.mark.feature("Shutdown")


@pytest.mark.needs("between_processes", "services")
def test_interrupt_ends_waiting_call(network: Network) -> None:
    free = threading.Event()
    server = network.node("server")
    server.serve({"block": lambda: blocked(free)})
    client = network.node("client")
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(client.probe().block)
        wait_until(lambda: server.execution.busy)
        client.ports.interrupt()
        with pytest.raises(NoServer, match="stopping"):
            asked.result(DEADLINE)
        free.set()


@pytest.mark.needs("services")
def test_calls_after_component_end_report_it(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    client = network.node("client")
    called, fresh = client.probe(), client.probe()
    assert called.add(1, 2) == 3
    called.note("before")
    client.ports.close()
    for probe in (called, fresh):
        with pytest.raises(NoServer, match="stopping"):
            probe.add(1, 2)
        with pytest.raises(NoServer, match="stopping"):
            probe.note("after")


@pytest.mark.needs("between_processes", "services")
def test_server_that_closes_ends_calls_in_flight(network: Network) -> None:
    free = threading.Event()
    server = network.node("server")
    server.serve({"block": lambda: blocked(free)})
    probes = [network.node(f"client{i}").probe() for i in range(3)]
    with ThreadPoolExecutor(4) as pool:
        calls = [pool.submit(probe.block) for probe in probes]
        wait_until(lambda: server.execution.busy)
        closing = pool.submit(server.ports.close)
        for call in calls:
            with pytest.raises(MiddlewareError):
                call.result(DEADLINE)
        free.set()
        closing.result(DEADLINE)


@pytest.mark.needs("between_processes", "services")
def test_client_that_closes_ends_its_call_in_flight(network: Network) -> None:
    free = threading.Event()
    server = network.node("server")
    server.serve(HANDLERS | {"block": lambda: blocked(free)})
    client = network.node("client")
    with ThreadPoolExecutor(1) as pool:
        call = pool.submit(client.probe().block)
        wait_until(lambda: server.execution.busy)
        client.ports.close()
        with pytest.raises(MiddlewareError):
            call.result(DEADLINE)
    free.set()
    assert network.node("other").probe().add(1, 1) == 2
    assert not server.failures


@pytest.mark.needs("topics")
def test_components_close_while_they_publish(network: Network) -> None:
    listener, publisher = network.node("listener"), network.node("publisher")
    received: list[int] = []
    listener.subscribe(lambda _who, n: received.append(n))
    news = publisher.news()
    stop = threading.Event()

    def publish() -> None:
        n = 0
        while not stop.is_set():
            n += 1
            try:
                news.announced("p", n)
            except MiddlewareError:
                return

    with ThreadPoolExecutor(1) as pool:
        publishing = pool.submit(publish)
        wait_until(lambda: received)
        listener.ports.close()
        network.node("second").subscribe(lambda _who, n: received.append(-n))
        wait_until(lambda: received[-1] < 0)
        stop.set()
        publishing.result(DEADLINE)
    publisher.ports.close()
    with suppress(MiddlewareError):  # it may have no effect, or be an error of the middleware
        news.announced("p", 0)
    assert not news.has_subscribers()
    assert not listener.failures
    assert not publisher.failures


def test_no_handler_is_called_after_close(network: Network) -> None:
    if not network.capabilities.topics:
        pytest.skip(f"{network.middleware}: it has no topics (topics)")
    listener = network.node("listener")
    received: list[int] = []
    listener.subscribe(lambda _who, n: received.append(n))
    news = network.node("publisher").news()
    wait_until(lambda: news.announced("p", 1) or received)
    listener.ports.close()
    count = len(received)
    for n in range(100):
        news.announced("p", n)
    wait_until(lambda: not news.has_subscribers())
    assert len(received) == count


def test_closed_components_leave_no_threads_descriptors_or_files(middleware: str) -> None:
    def use() -> None:
        network = Network(middleware)
        server, client = network.node("server"), network.node("client")
        if network.capabilities.services:
            server.serve(HANDLERS)
            assert client.probe().add(1, 2) == 3
        if network.capabilities.topics:
            received: list[int] = []
            client.subscribe(lambda _who, n: received.append(n))
            news = server.news()
            wait_until(lambda: news.announced("p", 1) or received)
        network.close()
        wait_until(lambda: not transport_folder(network.domain, middleware).exists())

    use()  # What a process keeps: runtimes of foreign libraries, their first threads.
    use()
    gc.collect()
    threads, descriptors = _threads(), _descriptors()
    for _ in range(5):
        use()
    gc.collect()
    wait_until(lambda: _threads() <= threads, lambda: str(threading.enumerate()))
    wait_until(lambda: _descriptors() <= descriptors)


def _threads() -> int:
    return len(list(Path("/proc/self/task").iterdir()))


def _descriptors() -> int:
    return len(list(Path("/proc/self/fd").iterdir()))


@pytest.mark.needs("between_processes", "services")
def test_component_of_other_process_closes_in_order(
    network: Network, start_peer: Callable[..., Peer]
) -> None:
    server = start_peer("serve")
    probe = network.node("client").probe()
    assert probe.add(1, 2) == 3
    assert server.ask("close") == "closed"
    wait_until(lambda: not probe.wait_for_server(0.0))
    with pytest.raises(NoServer):
        probe.add(1, 2)
