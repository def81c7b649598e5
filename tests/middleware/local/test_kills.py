"""Kill -9 of a peer in the middle of calls and publications: nothing is left, nothing hangs."""

from __future__ import annotations

import os
import random
import signal
import threading
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime.errors import NoServer, Timeout
from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.middleware.local.direct import FRAMES, Calls, Side, open_descriptors
from tests.middleware.local.killed_process import (
    ALL_HANDLERS,
    LARGE,
    SMALL,
    Killable,
    killable_processes,
)
from tests.middleware.probe_types import PROBE
from tests.support.waiting import wait_until

Open = Callable[[str], Side]
CALLERS = 3


class Campaign:
    """A component that peers are killed beside; `here` is the name of its socket."""

    def __init__(self, open_side: Open, folder: Path, peers: Killable, seed: int) -> None:
        self.rng = random.Random(seed)
        self.folder = folder
        self.peers = peers
        self.here = open_side("here")
        self.handled = 0
        self.server = self.here.serve(ALL_HANDLERS)
        self.subscriber = self.here.subscribe({"taken": self._count}, FRAMES)

    def _count(self, _number: int, pixels: np.ndarray) -> None:
        self.handled += len(pixels)

    def round(self, role: str) -> None:
        """Start a peer, and kill it while it is used."""
        address = {"client": self.server.address, "publisher": self.subscriber.address}
        pid, own = self.peers.start(role, address.get(role, ""))
        assert "/dev/shm" not in Path(f"/proc/{pid}/maps").read_text()
        getattr(self, f"beside_{role}")(pid, own)

    def kill(self, pid: int) -> None:
        """Kill a process after a few milliseconds."""
        time.sleep(self.rng.random() * 0.01)
        os.kill(pid, signal.SIGKILL)

    def beside_server(self, pid: int, own: str) -> None:
        """All calls return, or raise `NoServer`."""
        record = PortRecord("server", PROBE.name, "killed", "Probe", "", "local", own)
        call = self.here.calls(record)
        assert call("add", 1, 2) == 3
        outcomes: list[str] = []
        threads = [
            threading.Thread(target=self._call_until_lost, args=(call, outcomes))
            for _ in range(CALLERS)
        ]
        for thread in threads:
            thread.start()
        self.kill(pid)
        for thread in threads:
            thread.join(60)
        assert outcomes == ["lost"] * CALLERS

    def _call_until_lost(self, call: Calls, outcomes: list[str]) -> None:
        try:
            while True:
                assert call("echo", SMALL).size == SMALL.size
                assert call("echo", LARGE).size == LARGE.size
        except NoServer:
            outcomes.append("lost")
        except Timeout:
            outcomes.append("timeout")

    def beside_client(self, pid: int, _own: str) -> None:
        """The server continues."""
        before = self.here.count("echo").calls
        wait_until(lambda: self.here.count("echo").calls > before + 2)
        self.kill(pid)

    def beside_publisher(self, pid: int, _own: str) -> None:
        """The subscription continues."""
        before = self.handled
        wait_until(lambda: self.handled > before)
        self.kill(pid)

    def beside_subscriber(self, pid: int, own: str) -> None:
        """The publisher notices."""
        record = PortRecord("subscriber", FRAMES.name, "killed", "Frames", "", "local", own)
        publish = self.here.publisher(FRAMES, record)
        killer = threading.Thread(target=self.kill, args=(pid,))
        killer.start()
        pixels = LARGE.view(np.uint8)

        def is_lost() -> bool:
            publish("taken", 1, pixels)
            publish("taken", 2, pixels[:10])
            return not publish.publisher.has_subscribers()

        wait_until(is_lost)
        killer.join()
        publish.publisher.close()


def run_campaign(side: Open, folder: Path, kills: int, seed: int) -> None:
    with killable_processes(folder) as peers:
        campaign = Campaign(side, folder, peers, seed)
        roles = ("server", "client", "publisher", "subscriber")
        for role in roles:
            campaign.round(role)
        wait_until(lambda: not campaign.here.group.busy)
        descriptors, memory = open_descriptors(), resident_bytes()
        threads = threading.active_count()
        for number in range(kills):
            campaign.round(roles[number % len(roles)])
        # A new component deletes what the killed components left.
        side("new").serve(ALL_HANDLERS)
        wait_until(lambda: len(list(folder.iterdir())) == 4, lambda: str(list(folder.iterdir())))
        wait_until(
            lambda: threading.active_count() <= threads + 2,  # flusher, and the new listener
            lambda: f"{threads} threads before: {threading.enumerate()}",
        )
        wait_until(
            lambda: open_descriptors() <= descriptors + 40,
            lambda: f"{descriptors} descriptors before: {names_of_descriptors()}",
        )
        assert resident_bytes() < memory + 100_000_000
        assert side("client").calls(campaign.server)("add", 1, 2) == 3


def stop(pid: int) -> None:
    """Stop a process; on another processor it runs a moment longer."""
    os.kill(pid, signal.SIGSTOP)
    wait_until(lambda: Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "T")


def names_of_descriptors() -> Counter[str]:
    names: Counter[str] = Counter()
    for path in Path("/proc/self/fd").iterdir():
        with suppress(OSError):
            names[str(path.readlink()).partition(":")[0]] += 1
    return names


def resident_bytes() -> int:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def test_killed_peers_leave_nothing(side: Open, folder: Path) -> None:
    run_campaign(side, folder, kills=12, seed=1)


@pytest.mark.slow
def test_hundreds_of_killed_peers_leave_nothing(side: Open, folder: Path) -> None:
    run_campaign(side, folder, kills=600, seed=2)


def test_caller_of_a_killed_server_does_not_wait(side: Open, folder: Path) -> None:
    with killable_processes(folder) as peers:
        pid, own = peers.start("server")
        record = PortRecord("server", PROBE.name, "killed", "Probe", "", "local", own)
        call = side("client").calls(record)
        call("add", 1, 2)
        stop(pid)
        threading.Timer(0.1, os.kill, (pid, signal.SIGKILL)).start()
        with pytest.raises(NoServer):
            call("add", 1, 2)


def test_calls_of_a_stopped_server_end_with_their_timeout(side: Open, folder: Path) -> None:
    with killable_processes(folder) as peers:
        pid, own = peers.start("server")
        record = PortRecord("server", PROBE.name, "killed", "Probe", "", "local", own)
        side("first").calls(record)("add", 1, 2)
        stop(pid)
        client = side("client")
        for _ in range(3):
            with pytest.raises(Timeout):
                client.calls(record, timeout=0.05)("add", 1, 2)
        # More connections than the backlog has room for.
        clients = [client.calls(record, timeout=0.001) for _ in range(200)]
        for each in clients:
            with pytest.raises(Timeout):
                each("add", 1, 2)
        os.kill(pid, signal.SIGKILL)


def test_stopped_subscriber_does_not_hold_the_publisher(side: Open, folder: Path) -> None:
    with killable_processes(folder) as peers:
        pid, own = peers.start("subscriber")
        stop(pid)
        record = PortRecord("subscriber", FRAMES.name, "killed", "Frames", "", "local", own)
        publisher = side("p")
        publishers = [publisher.publisher(FRAMES, record) for _ in range(200)]
        for publish in publishers[:3] + publishers[-3:]:
            for number in range(300):
                publish("taken", number, LARGE.view(np.uint8)[: 10 + 100_000 * (number % 2)])
        assert publisher.count("taken", FRAMES).drops > 0
        os.kill(pid, signal.SIGKILL)
        for publish in publishers:
            publish.publisher.close()
