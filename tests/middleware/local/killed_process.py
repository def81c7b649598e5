"""Processes that are killed while they call, serve, publish or subscribe over `local`.

    python -m tests.middleware.local.killed_process FOLDER

For each line `ROLE ADDRESS` of its input it forks a process of that role, which prints its process
id and the address of its port. Forked, because to start Python takes longer than all the rest.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.middleware.local.direct import FRAMES, Side
from tests.middleware.probe_handlers import HANDLERS
from tests.middleware.probe_types import PROBE

ROOT = Path(__file__).parents[3]
ROLES = ("server", "client", "publisher", "subscriber")
ALL_HANDLERS = {**HANDLERS, "note": lambda _text: None}
SMALL, LARGE = np.zeros(10, np.float32), np.zeros(100_000, np.float32)


class Killable:
    """Starts processes to be killed."""

    def __init__(self, starter: subprocess.Popen[str]) -> None:
        self._starter = starter

    def start(self, role: str, address: str = "") -> tuple[int, str]:
        """The process id of a new process and the address of its port."""
        assert self._starter.stdin
        assert self._starter.stdout
        self._starter.stdin.write(f"{role} {address}\n")
        self._starter.stdin.flush()
        pid, _, own = self._starter.stdout.readline().strip().partition(" ")
        return int(pid), own


@contextmanager
def killable_processes(folder: Path) -> Iterator[Killable]:
    """Until the end of the block."""
    module = "tests.middleware.local.killed_process"
    with subprocess.Popen(
        [sys.executable, "-m", module, str(folder)],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as starter:
        try:
            yield Killable(starter)
        finally:
            starter.kill()


def run(role: str, address: str, folder: Path) -> None:
    """Live, until it is killed."""
    side = Side(folder, f"killed-{role}")
    own = ""
    if role == "server":
        own = side.serve(ALL_HANDLERS).address
    elif role == "subscriber":
        own = side.subscribe({"taken": lambda *_: None}, FRAMES).address
    sys.stdout.write(f"{os.getpid()} {own}\n")
    sys.stdout.flush()
    if role == "client":
        call = side.calls(PortRecord("server", PROBE.name, "s", "Probe", "", "local", address))
        while True:
            call("echo", SMALL)
            call("note", "text")
            call("echo", LARGE)
    elif role == "publisher":
        record = PortRecord("subscriber", FRAMES.name, "s", "Frames", "", "local", address)
        publish = side.publisher(FRAMES, record)
        number = 0
        while True:
            publish("taken", number, LARGE.view(np.uint8))
            publish("taken", number + 1, SMALL.view(np.uint8))
            number += 2
    while True:
        signal.pause()


def main(folder: Path) -> None:
    """Fork a process for each line of the input."""
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    for line in sys.stdin:
        role, _, address = line.strip().partition(" ")
        if os.fork() == 0:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            os.close(0)
            try:
                run(role, address, folder)
            finally:
                os._exit(1)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
