"""What a component reports to systemd, over a real socket."""

from __future__ import annotations

import contextlib
import os
import socket
import threading
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.deploy.supervisor import reaper
from robocomp_dsl.runtime import Component, ComponentSpec
from robocomp_dsl.runtime.component import sd_notify
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.sd_notify import SystemdNotifier
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.parameters import Parameters


class Arm(Component):
    SPEC = ComponentSpec(name="arm", period=1, middleware="inproc")
    failing = False

    def compute(self) -> None:
        if self.failing:
            raise RuntimeError("the arm does not\nmove")


@pytest.fixture
def supervisor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[socket.socket]:
    monkeypatch.delenv(sd_notify.DEPLOYMENT_VARIABLE, raising=False)
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as received:
        name = f"robocomp-test-{uuid.uuid4().hex}"
        received.bind(f"\0{name}")
        received.settimeout(30)
        monkeypatch.setenv("NOTIFY_SOCKET", f"@{name}")
        yield received


def next_message(received: socket.socket) -> str:
    """The next message but pings, which come at any time."""
    while (text := received.recv(4096).decode()) == "WATCHDOG=1":
        pass
    return text


def test_sd_notify_of_a_life(supervisor: socket.socket) -> None:
    runner = Runner(Arm, Parameters(), RunSettings(domain=uuid.uuid4().hex, middleware="inproc"))
    runner.start()
    assert next_message(supervisor) == "STATUS=initialize"
    assert next_message(supervisor) == "STATUS=compute\nREADY=1"
    runner.worker.failing = True  # type: ignore[attr-defined]
    emergency = next_message(supervisor)
    assert emergency.startswith("STATUS=emergency: RuntimeError: the arm does not move")
    assert "READY" not in emergency
    runner.worker.failing = False  # type: ignore[attr-defined]
    assert next_message(supervisor) == "STATUS=compute"
    runner.stop()
    assert runner.wait()
    assert next_message(supervisor) == "STATUS=finalize\nSTOPPING=1"


def test_sd_notify_needs_an_address(supervisor: socket.socket) -> None:
    address = os.environ["NOTIFY_SOCKET"]
    for variables in (
        {},
        {"NOTIFY_SOCKET": "relative"},
        {"NOTIFY_SOCKET": "/no/such/socket"},
        {"NOTIFY_SOCKET": address, "ROBOCOMP_DEPLOYMENT": "token"},
    ):
        SystemdNotifier(variables).ping()
    SystemdNotifier({"NOTIFY_SOCKET": address}).ping()
    assert supervisor.recv(4096) == b"WATCHDOG=1"
    supervisor.setblocking(False)
    with pytest.raises(BlockingIOError):
        supervisor.recv(4096)
    assert sd_notify.DEPLOYMENT_VARIABLE == reaper.DEPLOYMENT_VARIABLE


def test_sd_notify_pings_until_a_hang(
    supervisor: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Hanging(Arm):
        hangs = threading.Event()
        end = threading.Event()

        def compute(self) -> None:
            if self.hangs.is_set():
                while not self.end.wait(0.01):
                    pass

    monkeypatch.setenv("WATCHDOG_USEC", "400000")
    runner = Runner(
        Hanging, Parameters(), RunSettings(domain=uuid.uuid4().hex, middleware="inproc")
    )
    runner.start()
    pings = 0
    while pings < 3:
        pings += supervisor.recv(4096) == b"WATCHDOG=1"
    Hanging.hangs.set()
    assert not runner.wait()
    Hanging.end.set()
    assert runner.hang is not None
    supervisor.setblocking(False)
    messages: list[bytes] = []
    with contextlib.suppress(BlockingIOError):
        while True:
            messages.append(supervisor.recv(4096))
    assert messages[-1] != b"WATCHDOG=1"


@pytest.mark.parametrize(
    ("variables", "seconds"),
    [
        ({"WATCHDOG_USEC": "2000000"}, 2.0),
        ({"WATCHDOG_USEC": "500000", "WATCHDOG_PID": str(os.getpid())}, 0.5),
        ({"WATCHDOG_USEC": "500000", "WATCHDOG_PID": "1"}, 0.0),
        ({"WATCHDOG_USEC": "soon"}, 0.0),
        ({}, 0.0),
    ],
)
def test_sd_notify_watchdog_interval(variables: dict[str, str], seconds: float) -> None:
    notifier = SystemdNotifier({"NOTIFY_SOCKET": "/run/x", **variables})
    assert notifier.watchdog_s == seconds
