"""The processes of the benchmark of bridges: a ROS master, a YARP name server, and bridges.

`python -m benchmarks.bridge_processes DOMAIN COUNT NAMES MASTER PREFIX` is the bridge written by
hand: `COUNT` inputs `PREFIX/iN`, joined and converted to the topic `PREFIX/states`, with the same
transports as generated ones.
"""

from __future__ import annotations

import math
import os
import shutil
import signal
import socket
import subprocess
import sys
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bridge_types import NUMBERS, STATES, JointState
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.presence.port_record import PortRecord

LOOPBACK = "127.0.0.1"
ROOT = Path(__file__).parents[1]


def free_port() -> int:
    """A TCP port of loopback that nothing uses."""
    with socket.socket() as probe:
        probe.bind((LOOPBACK, 0))
        number: int = probe.getsockname()[1]
        return number


@contextmanager
def process(*command: str, where: Path = ROOT) -> Iterator[subprocess.Popen[str]]:
    """A process that is interrupted at the end."""
    with subprocess.Popen(
        command, cwd=where, text=True, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT
    ) as child:
        try:
            yield child
        finally:
            child.send_signal(signal.SIGINT)
            try:
                child.wait(10)
            except subprocess.TimeoutExpired:
                child.kill()


@contextmanager
def ros_master() -> Iterator[str]:
    """A ROS master, by its URI; "" if rosmaster is not installed."""
    program = shutil.which("rosmaster")
    if not program:
        yield ""
        return
    number = free_port()
    with process(program, "--core", "-p", str(number)):
        yield f"http://{LOOPBACK}:{number}"


def cpu_seconds(pid: int) -> float:
    """The CPU time of a process so far in s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def open_program(
    name: str,
    domain: str,
    names: int,
    master: str,
    addresses: dict[tuple[str, str], str],
    middleware: str = "",
) -> tuple[Any, CallbackGroup, Statistics]:
    """Ports of a program on `yarp` and `ros1`, as far as there are servers, or on `middleware`."""
    group, statistics = CallbackGroup(), Statistics()
    settings = {("yarp", "name_server"): f"{LOOPBACK}:{names}"} if names else {}
    settings |= {("ros1", "master"): master} if master else {}
    context = ComponentContext(
        name, domain, group, statistics, transport_settings=settings, addresses=addresses
    )
    used = [middleware] if middleware else [name for name, _ in settings]
    return open_ports(used[0], context, used=set(used)), group, statistics


def external(interface: Any, role: str, port: str, middleware: str, address: str) -> PortRecord:
    """A peer that is no component."""
    return PortRecord(role, interface.name, "peer", port, "", middleware, address)


def main(domain: str, count: str, names: str, master: str, prefix: str) -> None:
    """The bridge written by hand; it ends with a signal."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    ports, group, _ = open_program("byhand", domain, int(names), master, {})
    at = Endpoint(
        STATES,
        "byhand",
        "states",
        middlewares=("ros1",),
        external=(external(STATES, "subscriber", "states", "ros1", f"{prefix}/states"),),
    )
    publish = ports.advertise(at).bind(STATES.operations[0])
    queues: list[deque[Any]] = [deque(maxlen=10) for _ in range(int(count))]

    def receive(index: int, numbers: Any) -> None:
        queues[index].append(numbers)
        if all(queues):
            degrees = np.concatenate([queue.popleft() for queue in queues])
            publish(JointState(position=degrees * (math.pi / 180)))

    for index in range(int(count)):
        port = f"i{index}"
        record = external(NUMBERS, "publisher", port, "yarp", f"{prefix}/{port}")
        where = Endpoint(NUMBERS, "byhand", port, middlewares=("yarp",), external=(record,))
        ports.subscribe(where, {"push": lambda n, i=index: receive(i, n)}, group)
    signal.pause()


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except KeyboardInterrupt:
        os._exit(0)
