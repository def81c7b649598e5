"""Peers that come and go, domains, interrupts and statistics of every middleware."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest

from robocomp_dsl.runtime.errors import (
    NoServer,
    RemoteError,
)
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_handlers import HANDLERS
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.feature("Servers that come and go"), pytest.mark.needs("services")]


def test_proxy_follows_restarted_server(network: Network) -> None:
    server = network.node("server")
    server.serve({"add": lambda *_: 1})
    probe = network.node("client").probe()
    assert probe.add(0, 0) == 1
    server.ports.close()

    def gone() -> bool:
        try:
            probe.add(0, 0)
        except NoServer:
            return True
        return False

    wait_until(gone)
    network.node("server").serve({"add": lambda *_: 2})
    assert probe.wait_for_server(DEADLINE)
    assert probe.add(0, 0) == 2


@pytest.mark.parametrize("how", ["called", "waited for"])
def test_proxy_reports_departed_server_at_once(network: Network, how: str) -> None:
    server = network.node("server")
    server.serve(HANDLERS)
    probe = network.node("client").probe()
    assert probe.add(0, 0) == 0 if how == "called" else probe.wait_for_server(DEADLINE)
    server.ports.close()
    wait_until(lambda: not probe.wait_for_server(0.0))
    with ThreadPoolExecutor(1) as pool:
        asked = pool.submit(probe.add, 0, 0)
        with pytest.raises(NoServer):
            asked.result(DEADLINE)


@pytest.mark.usefixtures("short_discovery_timeout")
def test_domains_are_separate(network: Network) -> None:
    network.node("server").serve(HANDLERS)
    other = Network(network.middleware)
    try:
        with pytest.raises(NoServer):
            other.node("client").probe().add(1, 2)
    finally:
        other.close()


def test_calls_are_counted(network: Network) -> None:
    server, client = network.node("server"), network.node("client")
    server.serve(HANDLERS)
    probe = client.probe()
    for _ in range(3):
        probe.add(1, 2)
    with pytest.raises(RemoteError):
        probe.fail()
    assert client.count("add").calls == 3
