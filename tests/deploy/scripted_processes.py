"""Components for the tests of the supervisor: scripts, and a monitor that receives their states.

A script reports its state through a FIFO, as a component does through its liveliness token and the
interface `Component`. `PRELUDE` gives it `report(state)`, `wait()` until SIGTERM, `stopped`, and
its `NAME`. `stopped` is no `threading.Event`: a signal handler that sets an event deadlocks if it
interrupts the main thread while that holds the lock of the event.
"""

from __future__ import annotations

import os
import sys
import threading
from pathlib import Path

from robocomp_dsl.deploy.plan import Plan, Process
from robocomp_dsl.deploy.supervisor.lifecycle_monitor import StateCallback

PRELUDE = """
import os, select, signal, sys, threading
NAME, FIFO = sys.argv[1], sys.argv[2]
class Stopped:
    def __init__(self): self.read_end, self.write_end = os.pipe()
    def set(self, *_): os.write(self.write_end, b".")
    def is_set(self, seconds=0): return bool(select.select([self.read_end], [], [], seconds)[0])
stopped = Stopped()
signal.signal(signal.SIGTERM, stopped.set)
def report(state):
    with open(FIFO, "w") as out:
        out.write(f"{NAME} {os.getpid()} {state}\\n")
def wait():
    stopped.is_set(None)
"""
STEADY = 'report("initialize"); report("compute"); wait(); print("finalized")'


class FifoLifecycleMonitor:
    """A `LifecycleMonitor` that reads a FIFO in a thread."""

    def __init__(self, path: Path) -> None:
        os.mkfifo(path)
        self._stream = os.open(path, os.O_RDWR)
        self._thread = threading.Thread(target=self._listen, daemon=True)

    def start(self, seen: StateCallback) -> None:
        self._seen = seen
        self._thread.start()

    def simulated_time(self) -> None:
        """There is no simulated clock."""

    def close(self) -> None:
        os.write(self._stream, b"end 0 end\n")
        self._thread.join(5)
        os.close(self._stream)

    def _listen(self) -> None:
        with os.fdopen(os.dup(self._stream), encoding="utf-8") as lines:
            for line in lines:
                name, pid, state = line.split()
                if name == "end":
                    return
                self._seen(name, int(pid), "" if state == "gone" else state)


def scripted_process(tmp_path: Path, name: str, body: str, **fields: object) -> Process:
    """A process that runs `body` after `PRELUDE`."""
    script = tmp_path / f"{name}.py"
    script.write_text(PRELUDE + body, encoding="utf-8")
    argv = (sys.executable, "-S", script.name, name, str(tmp_path / "fifo"))
    return Process(name=name, component=name, argv=argv, cwd=tmp_path, **fields)  # type: ignore[arg-type]


def make_plan(tmp_path: Path, *processes: Process, name: str = "demo") -> Plan:
    """A plan of scripted processes; its domain is unique to `tmp_path`."""
    domain = f"{name}-{tmp_path.parent.name}-{tmp_path.name}"
    return Plan(name, tmp_path / "demo.ddsl", domain, "inproc", processes)
