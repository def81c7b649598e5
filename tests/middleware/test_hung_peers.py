"""Peers that hang: none delays the start or the end of another by more than a moment.

Every test asserts that something finishes while the peers still hang. The bound is generous for a
busy machine, and below the 20 s that two peers took.
"""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from robocomp_dsl.runtime.client import DomainClient
from robocomp_dsl.runtime.presence.domain_folder import (
    Membership,
    domain_path,
    folder_lock,
    join,
)
from robocomp_dsl.runtime.presence.domain_session import open_session
from robocomp_dsl.runtime.presence.state_monitor import StateMonitor
from tests.middleware.domain_process import domain_process
from tests.middleware.network import Network
from tests.support.waiting import wait_until

BOUND_S = 15.0
STOPPED = ("T", "t")
CLIENT = """
import sys
from robocomp_dsl.runtime.client import DomainClient
DomainClient(sys.argv[1]).close()
"""


@pytest.fixture
def network() -> Iterator[Network]:
    opened = Network("zenoh")
    yield opened
    opened.close()


@contextmanager
def finishes() -> Iterator[None]:
    started = time.monotonic()
    yield
    assert time.monotonic() - started < BOUND_S


def is_stopped(pid: int) -> bool:
    """Whether the kernel has stopped a process (`proc(5)`, field 3 of `stat`)."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] in STOPPED


@contextmanager
def stopped_processes(domain: str, count: int) -> Iterator[list[int]]:
    with ExitStack() as stack:
        pids = [stack.enter_context(domain_process(domain, f"p{i}")).pid for i in range(count)]
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
            wait_until(lambda pid=pid: is_stopped(pid))
        yield pids
        assert all(is_stopped(pid) for pid in pids), "they hang to the end"


@contextmanager
def full_listener(domain: str) -> Iterator[Membership]:
    """A member of the domain whose socket accepts nobody, and has no room for another attempt."""
    with ExitStack() as stack:
        member, _ = join(domain)
        listener = stack.enter_context(socket.socket(socket.AF_UNIX))
        listener.bind(str(member.socket))
        listener.listen(0)
        while True:
            attempt = stack.enter_context(socket.socket(socket.AF_UNIX))
            attempt.setblocking(False)
            try:
                attempt.connect(str(member.socket))
            except BlockingIOError:
                break
        yield member
    member.leave()


def test_open_session_beside_stopped_processes_finds_the_others(network: Network) -> None:
    server = network.node("server")
    server.serve({"add": lambda a, b: a + b})
    with stopped_processes(network.domain, 2):
        with finishes():
            opened = open_session(network.domain)
        peers = opened.session.info.peers_zid
        wait_until(lambda: server.ports.presence.opened.session.info.zid() in list(peers()))
        with finishes():
            opened.close()
        with finishes():
            assert network.node("client").probe().add(20, 22) == 42


def test_domain_client_and_monitor_start_and_end_beside_stopped_processes(network: Network) -> None:
    with stopped_processes(network.domain, 2):
        with finishes():
            DomainClient(network.domain).close()
        with finishes():
            StateMonitor(network.domain).close()


def test_starts_at_the_same_time_beside_stopped_processes_find_each_other(network: Network) -> None:
    with stopped_processes(network.domain, 2), finishes():
        threads = [threading.Thread(target=network.node, args=(f"n{i}",)) for i in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        sessions = [node.ports.presence.opened.session for node in network.nodes]  # type: ignore[attr-defined]
        wait_until(lambda: all(len(list(s.info.peers_zid())) == 5 for s in sessions))


def test_stopped_process_is_connected_when_it_continues(network: Network) -> None:
    seen: list[str] = []
    with domain_process(network.domain, "server") as process:
        process.send_signal(signal.SIGSTOP)
        wait_until(lambda: is_stopped(process.pid))
        opened = open_session(network.domain)
        subscriber = opened.session.liveliness().declare_subscriber(
            "rc/**", lambda sample: seen.append(str(sample.key_expr)), history=True
        )
        assert not list(opened.session.info.peers_zid())
        process.send_signal(signal.SIGCONT)
        wait_until(lambda: any("/server/" in key for key in seen))
        subscriber.undeclare()
        opened.close()


def test_listener_with_a_full_backlog_blocks_neither_start_nor_end(network: Network) -> None:
    with full_listener(network.domain) as member:
        with finishes():
            opened = open_session(network.domain)
        with finishes():
            opened.close()
        assert member.socket.is_socket(), "a member is not removed because it is busy"


@pytest.mark.parametrize("tcp", [False, True])
def test_close_does_not_wait_for_peers_that_connect_and_send_nothing(
    network: Network, tcp: bool
) -> None:
    port = 0
    if tcp:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
    opened = open_session(network.domain, port)
    peer = socket.socket(socket.AF_INET if tcp else socket.AF_UNIX)
    with peer:
        peer.connect(("127.0.0.1", port) if tcp else str(opened.socket))
        before = set(Path("/proc/self/fd").iterdir())
        with finishes():
            opened.close()
        assert set(Path("/proc/self/fd").iterdir()) <= before, "no descriptor is left"


def test_process_beside_stopped_processes_exits_with_code_0(network: Network) -> None:
    """A thread that is still in zenoh when the interpreter ends would abort it."""
    with stopped_processes(network.domain, 2) as pids:
        command = [sys.executable, "-c", CLIENT, network.domain]
        with finishes(), subprocess.Popen(command) as process:
            assert process.wait(BOUND_S) == 0
        assert all(is_stopped(pid) for pid in pids)


def test_start_does_not_wait_for_a_stopped_holder_of_the_folder_lock(network: Network) -> None:
    with domain_process(network.domain, "holder", "locked") as process:
        process.send_signal(signal.SIGSTOP)
        wait_until(lambda: is_stopped(process.pid))
        with finishes(), folder_lock(domain_path(network.domain)) as locked:
            assert not locked
        with finishes():
            server = network.node("server")
            server.serve({"add": lambda a, b: a + b})
            assert network.node("client").probe().add(1, 2) == 3


def test_starts_without_the_folder_lock_find_each_other(
    network: Network, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two members may then connect to each other at the same time."""
    with domain_process(network.domain, "holder", "locked") as process:
        process.send_signal(signal.SIGSTOP)
        wait_until(lambda: is_stopped(process.pid))
        threads = [threading.Thread(target=network.node, args=(f"n{i}",)) for i in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        sessions = [node.ports.presence.opened.session for node in network.nodes]  # type: ignore[attr-defined]
        wait_until(lambda: all(len(list(s.info.peers_zid())) == 5 for s in sessions))
