"""The calls of components in one process: who was busy, and whose failure it is."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

import pytest

from robocomp_dsl.runtime.errors import RemoteError, Timeout
from tests.middleware.network import DEADLINE, Network
from tests.support.waiting import wait_until


@pytest.fixture
def network() -> Iterator[Network]:
    opened = Network("inproc")
    yield opened
    opened.close()


@contextmanager
def busy_server(network: Network) -> Iterator[None]:
    """A component `server` one of whose handlers runs."""
    free = threading.Event()
    server = network.node("server")
    server.serve({"block": lambda: free.wait(DEADLINE)})
    with ThreadPoolExecutor(1) as pool:
        blocking = pool.submit(network.node("other").probe("server").block)
        try:
            wait_until(lambda: server.execution.busy)
            yield
        finally:
            free.set()
        blocking.result(DEADLINE)


def test_inproc_query_timeout_names_busy_port(network: Network) -> None:
    probe = network.node("client").probe()
    probe.set_timeout(0.1 + 0.2)
    busy = r"^server\.Probe was busy for 0\.3 s$"
    with busy_server(network), pytest.raises(Timeout, match=busy):
        probe.add(1, 1)


def test_inproc_query_whose_handler_calls_busy_component_is_remote_error(network: Network) -> None:
    middle = network.node("middle")
    to_server = middle.probe("server")
    to_server.set_timeout(0.1)
    middle.serve({"add": to_server.add})
    client = network.node("client").probe("middle")
    failure = r"middle\.Probe\.add failed: Timeout: server\.Probe was busy"
    with busy_server(network), pytest.raises(RemoteError, match=failure):
        client.add(1, 1)
    assert middle.count("add").failures == 2  # of its own call, and of its handler
