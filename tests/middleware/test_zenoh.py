"""What only zenoh has: hostile bytes, other processes, sockets left behind, taken ports."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
import zenoh

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.errors import MalformedMessage, MiddlewareError, NoServer
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.domain_session import open_session
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.port_registry import PortRegistry
from robocomp_dsl.runtime.presence.state_monitor import StateMonitor
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_types import OTHER_NEWS, PROBE
from tests.support.waiting import wait_until

ROOT = Path(__file__).parents[2]
SERVER = """
import sys, threading
sys.path.insert(0, sys.argv[2])
from tests.middleware.network import Network
n = Network("zenoh"); n.domain = sys.argv[1]
node = n.node("server")
node.ports.publish_state("compute")
node.serve({"add": lambda a, b: a + b, "block": threading.Event().wait})
print("ready", flush=True)
sys.stdin.read()
n.close()
"""


@pytest.fixture
def network() -> Iterator[Network]:
    opened = Network("zenoh")
    yield opened
    opened.close()


@pytest.fixture
def server(network: Network) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [sys.executable, "-c", SERVER, network.domain, str(ROOT)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == "ready\n"
        yield process
        process.kill()


@pytest.mark.parametrize(
    "payload",
    [b"", b"\0", b"\0\1\0\0", b"\0\1\0\0\1\0\0\0", b"\xff" * 100, os.urandom(3000)],
    ids=["empty", "one byte", "header", "half", "ones", "random"],
)
def test_zenoh_refuses_and_counts_malformed_requests(network: Network, payload: bytes) -> None:
    server = network.node("server")
    server.serve({"add": lambda a, b: a + b})
    at = Endpoint(PROBE, "server", "Probe")
    key = f"{keys.port_key(network.domain, 'q', at)}/add"
    raw = open_session(network.domain)
    try:
        querier = raw.session.declare_querier(key, timeout=DEADLINE)
        wait_until(lambda: querier.matching_status.matching)
        reply = querier.get(payload=payload).recv()
        assert reply.err is not None
        assert reply.err.payload.to_bytes().startswith(b"RCM")
        assert server.count("add").malformed == 1
        unknown = raw.session.declare_querier(f"{key}s", timeout=DEADLINE)
        reply = unknown.get(payload=payload).recv()
        assert reply.err is not None
    finally:
        raw.close()
    assert network.node("client").probe().add(1, 2) == 3


def test_zenoh_counts_malformed_commands(network: Network) -> None:
    received: list[str] = []
    server = network.node("server")
    server.serve({"note": received.append})
    key = f"{keys.port_key(network.domain, 'c', Endpoint(PROBE, 'server', 'Probe'))}/note"
    raw = open_session(network.domain)
    try:
        publisher = raw.session.declare_publisher(key)
        wait_until(lambda: publisher.matching_status.matching)
        publisher.put(b"\0\1\0\0\xff\xff\xff\xff")
        wait_until(lambda: server.count("note").malformed)
    finally:
        raw.close()
    network.node("client").probe().note("still here")
    wait_until(lambda: received == ["still here"])


def test_zenoh_reports_malformed_reply_to_caller(network: Network) -> None:
    raw = open_session(network.domain)
    try:
        at = Endpoint(PROBE, "liar", "Probe")
        key = f"{keys.port_key(network.domain, 'q', at)}/add"
        queryable = raw.session.declare_queryable(key, lambda q: q.reply(key, b"\0\1\0\0\1"))
        port = PortRecord("server", PROBE.name, "liar", "Probe", PROBE.hash.hex(), "zenoh")
        token = raw.session.liveliness().declare_token(keys.record_key(network.domain, port))
        with pytest.raises(MalformedMessage):
            network.node("client").probe().add(1, 2)
        del token, queryable
    finally:
        raw.close()


def test_zenoh_discovers_other_process(network: Network, server: subprocess.Popen[str]) -> None:
    assert server.pid
    assert network.node("client").probe().add(20, 22) == 42


def test_zenoh_reports_killed_server_at_once(
    network: Network, server: subprocess.Popen[str]
) -> None:
    probe = network.node("client").probe()
    assert probe.add(1, 1) == 2
    failures: list[Exception] = []

    def ask() -> None:
        try:
            probe.block()
        except NoServer as error:
            failures.append(error)

    asking = threading.Thread(target=ask)
    asking.start()
    server.send_signal(signal.SIGKILL)
    server.wait(DEADLINE)
    asking.join(DEADLINE)
    assert failures
    with pytest.raises(NoServer):
        probe.add(1, 1)


def test_zenoh_ends_call_at_once_when_chosen_server_exits(network: Network) -> None:
    network.node("server").serve({"block": threading.Event().wait})
    client = network.node("client")
    registry: PortRegistry = client.ports.presence.registry
    assert client.probe().wait_for_server(DEADLINE)
    (there,) = registry.find("server", PROBE.name)
    lost: list[str] = []
    registry.on_lost(there, lambda: lost.append("there"))
    assert not lost
    registry.on_lost(replace(there, component="gone"), lambda: lost.append("gone"))
    assert lost == ["gone"]


def test_zenoh_watch_reports_states_and_exit(
    network: Network, server: subprocess.Popen[str]
) -> None:
    seen: list[tuple[str, int, str]] = []
    watch = StateMonitor(network.domain)
    try:
        watch.start(lambda *what: seen.append(what))
        wait_until(lambda: seen)
        assert seen == [("server", server.pid, "compute")]
        server.send_signal(signal.SIGKILL)
        wait_until(lambda: len(seen) == 2)
        assert seen[1] == ("server", server.pid, "")
    finally:
        watch.close()


def test_zenoh_watch_ignores_states_after_its_end(network: Network) -> None:
    node = network.node("late")
    node.ports.publish_state("compute")
    node.ports.close()
    node.ports.publish_state("finalize")
    node.ports.publish_state("")


def test_zenoh_removes_sockets_of_killed_processes(
    network: Network, server: subprocess.Popen[str]
) -> None:
    opened = open_session(network.domain)
    folder = opened.socket.parent
    server.send_signal(signal.SIGKILL)
    server.wait(DEADLINE)
    again = open_session(network.domain)
    try:
        assert {p.name for p in folder.iterdir() if p.is_socket()} == {
            opened.socket.name,
            again.socket.name,
        }
        assert folder.stat().st_mode & 0o077 == 0
    finally:
        again.close()
        opened.close()
    assert not folder.exists()


def test_zenoh_connects_processes_that_start_together(network: Network) -> None:
    opened = []
    guard = threading.Lock()

    def start() -> None:
        session = open_session(network.domain)
        with guard:
            opened.append(session)

    threads = [threading.Thread(target=start) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(DEADLINE)
    try:
        wait_until(lambda: all(len(list(o.session.info.peers_zid())) == 5 for o in opened))
    finally:
        for opened_session in opened:
            opened_session.close()


def test_zenoh_reports_interface_mismatch_on_both_sides_of_topic(
    network: Network, caplog: pytest.LogCaptureFixture
) -> None:
    subscriber, publisher = network.node("listener"), network.node("speaker")
    subscriber.subscribe(lambda *_: None)
    publisher.ports.advertise(Endpoint(OTHER_NEWS, "speaker", "News"))
    wait_until(lambda: "listener and speaker have different versions" in caplog.text)
    wait_until(lambda: "speaker and listener have different versions" in caplog.text)
    assert "different versions of Test::News" in caplog.text


def test_zenoh_reports_occupied_port() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(MiddlewareError, match=f"port {port} cannot be used"):
            open_session(Network("zenoh").domain, port)


def test_zenoh_listens_on_loopback_only(network: Network) -> None:
    node = network.node("server")
    opened = node.ports.presence.opened  # type: ignore[attr-defined]
    assert opened.socket.is_socket()
    for link in opened.session.info.links():
        assert "unixsock" in str(link)
    assert isinstance(opened.session, zenoh.Session)
