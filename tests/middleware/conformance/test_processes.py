"""Components in real processes: killed in a call, stopped, restarted, started in any order."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from robocomp_dsl.runtime.errors import NoServer, Timeout
from tests.middleware.conformance.peer_launcher import Peer
from tests.middleware.network import DEADLINE, Network
from tests.middleware.probe_handlers import HANDLERS, blocked
from tests.middleware.probe_types import NEWS, PROBE
from tests.support.waiting import wait_until

pytestmark = [
    pytest.mark.feature("Processes that are killed, stopped and restarted"),
    pytest.mark.needs("between_processes"),
]
StartPeer = Callable[..., Peer]
HOLD_S = 0.05
"""A subscriber must not hold a publisher for longer, by default."""
SCHEDULING_S = 0.03
"""What a busy machine may add to that."""


@pytest.mark.needs("services")
def test_call_reaches_server_in_other_process(network: Network, start_peer: StartPeer) -> None:
    start_peer("serve")
    probe = network.node("client").probe()
    assert probe.add(20, 22) == 42
    assert probe.divide(17, 5) == (3, 2)


@pytest.mark.needs("services")
def test_server_killed_in_call_ends_the_call_at_once(
    network: Network, start_peer: StartPeer
) -> None:
    server = start_peer("serve")
    probe = network.node("client").probe()
    assert probe.add(1, 1) == 2
    probe.set_timeout(10 * DEADLINE)
    with ThreadPoolExecutor(1) as pool:
        blocked = pool.submit(probe.block)
        wait_until(lambda: int(server.ask("calls")) == 2)
        server.kill()
        with pytest.raises(NoServer):
            blocked.result(DEADLINE)
    with pytest.raises(NoServer):
        probe.add(1, 1)


@pytest.mark.needs("services")
def test_client_follows_killed_and_restarted_server(
    network: Network, start_peer: StartPeer
) -> None:
    server = start_peer("serve", result=1)
    probe = network.node("client").probe()
    assert probe.add(0, 0) == 1
    server.kill()
    start_peer("serve", result=2)
    wait_until(lambda: probe.add(0, 0) == 2, ignoring=NoServer)


@pytest.mark.needs("services")
def test_server_survives_clients_that_are_killed_in_calls(
    network: Network, start_peer: StartPeer
) -> None:
    free = threading.Event()
    server = network.node("server", threads=2)
    server.serve(HANDLERS | {"block": lambda: blocked(free)})
    server.serve(HANDLERS, port="Second")
    for name in ("first", "second"):
        caller = start_peer("call", name=name, peer="server.Probe")
        wait_until(lambda: server.execution.busy)
        caller.kill()
        assert network.node("client").probe("server.Second").add(2, 3) == 5
        free.set()
        wait_until(lambda: not server.execution.busy)
        free.clear()
    assert not server.failures


@pytest.mark.needs("services")
def test_both_sides_started_at_once_find_each_other(
    network: Network, start_peer: StartPeer
) -> None:
    with ThreadPoolExecutor(2) as pool:
        started = pool.submit(start_peer, "serve")
        assert network.node("client").probe().add(2, 2) == 4
        started.result(DEADLINE)


@pytest.mark.needs("services")
def test_call_of_stopped_server_times_out_and_returns_when_it_continues(
    network: Network, start_peer: StartPeer
) -> None:
    server = start_peer("serve")
    probe = network.node("client").probe()
    assert probe.add(1, 1) == 2
    server.stop()
    probe.set_timeout(0.2)
    with pytest.raises(Timeout):
        probe.add(1, 1)
    server.resume()
    probe.set_timeout(DEADLINE)
    assert probe.add(2, 2) == 4


@pytest.mark.needs("services")
def test_no_reply_of_a_timed_out_call_is_taken_for_another(
    network: Network, start_peer: StartPeer
) -> None:
    server = start_peer("serve")
    probe = network.node("client").probe()
    assert probe.add(1, 1) == 2
    for round_ in range(3):
        server.stop()
        probe.set_timeout(0.05)
        with pytest.raises(Timeout):
            probe.add(1000, round_)
        server.resume()
        probe.set_timeout(DEADLINE)
        assert [probe.add(round_, n) for n in range(5)] == [round_ + n for n in range(5)]


@pytest.mark.needs("topics")
def test_subscriber_killed_while_publishing_disturbs_nobody(
    network: Network, start_peer: StartPeer
) -> None:
    victim, other = start_peer("subscribe", name="victim"), start_peer("subscribe", name="other")
    node = network.node("publisher")
    news = node.news()
    numbers = iter(range(10**9))

    def publish() -> None:
        news.announced("p", next(numbers))

    wait_until(lambda: publish() or all(int(s.ask("count")) > 10 for s in (victim, other)))
    killing = threading.Thread(target=victim.kill)
    killing.start()
    while killing.is_alive():
        publish()
    killing.join()
    registry = node.ports.presence.registry
    wait_until(lambda: publish() or len(registry.find("subscriber", NEWS.name)) == 1)
    latest = next(numbers)
    wait_until(lambda: publish() or int(other.ask("last")) > latest)
    assert not node.failures


@pytest.mark.needs("topics")
def test_publisher_killed_and_restarted_reaches_subscriber(
    network: Network, start_peer: StartPeer
) -> None:
    received: list[str] = []
    network.node("subscriber").subscribe(lambda who, _n: received.append(who))
    for name in ("first", "second"):
        publisher = start_peer("publish", name=name)
        wait_until(lambda name=name: name in received)
        publisher.kill()


@pytest.mark.needs("topics")
@pytest.mark.parametrize("size", [1_000, 200_000])
def test_stopped_subscriber_does_not_hold_publisher(
    network: Network, start_peer: StartPeer, size: int
) -> None:
    """Of some rounds, a busy machine delays no publication in at least one."""
    subscriber = start_peer("subscribe")
    news = network.node("publisher").news()
    text = "x" * size
    sent = 0

    def longest_publication() -> float:
        nonlocal sent
        longest = 0.0
        for _ in range(100):
            sent += 1
            begun = time.monotonic()
            news.announced(text, sent)
            longest = max(longest, time.monotonic() - begun)
        return longest

    def is_not_held() -> bool:
        wait_until(lambda: news.announced("", sent) or int(subscriber.ask("last")) == sent)
        subscriber.stop()
        longest = longest_publication()
        subscriber.resume()
        return longest <= HOLD_S + SCHEDULING_S

    assert any(is_not_held() for _ in range(5))
    wait_until(lambda: news.announced("", sent) or int(subscriber.ask("last")) == sent)


@pytest.mark.needs("services", "topics")
def test_stopped_subscriber_does_not_delay_others(network: Network, start_peer: StartPeer) -> None:
    stopped, other = start_peer("subscribe", name="stopped"), start_peer("subscribe", name="other")
    node = network.node("publisher")
    news = node.news()
    node.serve(HANDLERS)
    wait_until(lambda: news.announced("", 0) or int(stopped.ask("count")) > 0)
    stopped.stop()
    for n in range(1, 2000):
        news.announced("x" * 1000, n)
    wait_until(lambda: news.announced("", 2000) or int(other.ask("last")) == 2000)
    assert network.node("client").probe("publisher").add(1, 2) == 3


def test_killed_processes_leave_nothing_behind(network: Network, start_peer: StartPeer) -> None:
    """No port in the registry of those who stay, no shared memory when the next process starts."""
    node = network.node("observer")
    programs = ["serve"] if network.capabilities.services else []
    programs += ["subscribe", "publish"] if network.capabilities.topics else []
    files: set[str] = set()
    own = _shared_memory_of(os.getpid())
    for program in programs:
        peer = start_peer(program)
        files |= _shared_memory_of(peer.pid) - own
        peer.kill()
    registry = node.ports.presence.registry
    for role, interface in (("server", PROBE), ("subscriber", NEWS), ("publisher", NEWS)):
        wait_until(lambda role=role, i=interface: not registry.find(role, i.name))
    for program in programs:
        start_peer(program)
    wait_until(lambda: not [path for path in files if Path(path).exists()], str(files))


def _shared_memory_of(pid: int) -> set[str]:
    """The files in /dev/shm that a process has mapped (`proc(5)`)."""
    maps = Path(f"/proc/{pid}/maps").read_text().splitlines()
    paths = {f"/{line.partition('/')[2]}" for line in maps}
    return {path for path in paths if path.startswith("/dev/shm/") and "(deleted)" not in path}
