"""Bridges from YARP to ROS 1: added latency, CPU time and bytes by the number of inputs.

Interleaved in one run, in turns: YARP directly, ROS 1 directly, a bridge written by hand over the
same transports, and the generated bridge. Each input is a `double[1]`; the output is a JointState
with all of them. The latency is from the publication of the last input to the handler of the
output. Publishers and subscriber are in this process, each bridge is a process.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import threading
import uuid
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from time import monotonic, perf_counter_ns, sleep
from typing import Any

import numpy as np

from benchmarks.bridge_processes import (
    cpu_seconds,
    external,
    open_program,
    process,
    ros_master,
)
from benchmarks.bridge_types import IMAGES, NUMBERS, PICTURES, STATES, Image, JointState
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer

COUNTS = (1, 2, 4, 8, 16, 32)
ROUNDS, MESSAGES = 10, 50
GOAL_US = 150.0
IMAGE_COUNT = 150
IMAGE_BRIDGE = """
import "sensor_msgs/msg/Image.msg";
Bridge eye
{
    input image : sensor_msgs::Image over ros1 at "/eye";
    output picture : sensor_msgs::Image over zenoh = image { header.frame_id = "eye"; };
};
"""


@dataclass
class Variant:
    """One way from inputs to output: `pushes` publish the inputs."""

    pushes: list[Callable[[Any], None]]
    pid: int = 0
    took: list[float] = field(default_factory=list)
    cpu: float = 0.0
    lost: int = 0


class Bench:
    """Publishers and subscribers of all variants for one number of inputs."""

    def __init__(self, count: int, names: int, master: str, stack: ExitStack) -> None:
        self.count, self.names, self.master, self.stack = count, names, master, stack
        self.domain = f"bench-{uuid.uuid4().hex[:8]}"
        self.bell = threading.Semaphore(0)
        own: dict[tuple[str, str], str] = {("yarp", "direct"): "/bench/direct"}
        for name in ("byhand", "generated"):
            for index in range(count):
                own["yarp", f"{name}{index}"] = f"/bench/{name}{count}/i{index}"
        own["ros1", "directros"] = f"/bench/direct{count}"
        self.ports, self.group, self.statistics = open_program(
            "source", self.domain, names, master, own
        )
        stack.callback(self.ports.close)
        self.reader, group, _ = open_program("reader", f"{self.domain}r", names, master, {})
        stack.callback(self.reader.close)
        self._subscribe(NUMBERS, "yarp", "direct", "/bench/direct", group)
        self._subscribe(STATES, "ros1", "directros", f"/bench/direct{count}", group)
        for name in ("byhand", "generated"):
            self._subscribe(STATES, "ros1", name, f"/bench/{name}{count}/states", group)
        self.variants = {
            "direct yarp": Variant([self._publisher(NUMBERS, "yarp", "direct")]),
            "direct ros1": Variant([self._ros_publisher()]),
            "by hand": self._bridge("byhand", self._by_hand),
            "generated": self._bridge("generated", self._generated),
        }

    def _subscribe(self, interface: Any, over: str, port: str, address: str, group: Any) -> None:
        record = external(interface, "publisher", port, over, address)
        at = Endpoint(interface, "reader", port, middlewares=(over,), external=(record,))
        handler = {interface.operations[0].name: lambda _: self.bell.release()}
        self.reader.subscribe(at, handler, group)

    def _publisher(self, interface: Any, over: str, port: str) -> Callable[[Any], None]:
        at = Endpoint(interface, "source", port, middlewares=(over,))
        bound: Callable[[Any], None] = self.ports.advertise(at).bind(interface.operations[0])
        return bound

    def _ros_publisher(self) -> Callable[[Any], None]:
        publish = self._publisher(STATES, "ros1", "directros")
        return lambda numbers: publish(JointState(position=numbers))

    def _bridge(self, name: str, start: Callable[[str], int]) -> Variant:
        pushes = [self._publisher(NUMBERS, "yarp", f"{name}{i}") for i in range(self.count)]
        return Variant(pushes, start(f"/bench/{name}{self.count}"))

    def _by_hand(self, prefix: str) -> int:
        module = "benchmarks.bridge_processes"
        arguments = (f"{self.domain}h", str(self.count), str(self.names), self.master, prefix)
        command = (sys.executable, "-m", module, *arguments)
        return self.stack.enter_context(process(*command)).pid

    def _generated(self, prefix: str) -> int:
        folder = Path(self.stack.enter_context(tempfile.TemporaryDirectory()))
        (folder / "bench.bdsl").write_text(bridge_text(self.count, prefix))
        rcgen = [sys.executable, "-m", "robocomp_dsl.cli.rcgen", "bridge"]
        subprocess.run([*rcgen, str(folder / "bench.bdsl"), "-q"], check=True)
        options = ("--transport", f"yarp.name_server=127.0.0.1:{self.names}")
        options += ("--transport", f"ros1.master={self.master}", "--domain", f"{self.domain}g")
        command = (sys.executable, "main.py", *options)
        return self.stack.enter_context(process(*command, where=folder)).pid

    def wait_until_connected(self) -> None:
        """Publish until every variant delivers, and until nothing is on its way."""
        for variant in self.variants.values():
            deadline = monotonic() + 60
            delivered = 0
            while delivered < 5:
                if monotonic() > deadline:
                    raise TimeoutError("a bridge does not deliver")
                delivered += self.send(variant, 0.5) > 0
        while self.bell.acquire(timeout=0.3):
            pass

    def send(self, variant: Variant, timeout: float = 2.0) -> float:
        """Publish all inputs; the latency in us, 0 if nothing arrived."""
        value = np.array([90.0])
        *others, last = variant.pushes
        for push in others:
            push(value)
        start = perf_counter_ns()
        last(value)
        if not self.bell.acquire(timeout=timeout):
            return 0.0
        return (perf_counter_ns() - start) / 1000

    def measure(self) -> None:
        """All variants in turns; the order changes from round to round."""
        order = list(self.variants.values())
        for number in range(ROUNDS):
            for variant in order if number % 2 else reversed(order):
                before = cpu_seconds(variant.pid) if variant.pid else 0.0
                took = [self.send(variant) for _ in range(MESSAGES)]
                if variant.pid:
                    variant.cpu += cpu_seconds(variant.pid) - before
                variant.took += [latency for latency in took if latency]
                variant.lost += took.count(0.0)


def bridge_text(count: int, prefix: str) -> str:
    """The bridge with `count` inputs."""
    inputs = "".join(
        f'    input i{i} : double[] [deg] over yarp at "{prefix}/i{i}";\n' for i in range(count)
    )
    joined = ", ".join(f"i{i}" for i in range(count))
    return (
        f'import "sensor_msgs/msg/JointState.msg";\nBridge bench\n{{\n{inputs}'
        f"    hub joints = {joined} {{ policy all; }};\n"
        f'    output states : sensor_msgs::JointState over ros1 at "{prefix}/states"\n'
        "    { position = joints to [rad]; };\n};\n"
    )


def figures_of(bench: Bench) -> list[dict[str, Any]]:
    """The figures for one number of inputs."""
    count, variants = bench.count, bench.variants
    middle = {name: median(v.took) for name, v in variants.items()}
    what = f"{count} input{'s' * (count > 1)}"
    direct = middle["direct yarp"] + middle["direct ros1"]
    sent = ROUNDS * MESSAGES
    rows = [
        *((f"{name}, {what}: latency", us, "us") for name, us in middle.items()),
        (f"generated, {what}: added to both direct ways", middle["generated"] - direct, "us"),
        (f"by hand, {what}: added to both direct ways", middle["by hand"] - direct, "us"),
        *(
            (f"{name}, {what}: CPU per message", 1e6 * variants[name].cpu / sent, "us")
            for name in ("by hand", "generated")
        ),
        (f"{what}: generated / by hand", middle["generated"] / middle["by hand"], "x"),
        (f"{what}: lost", float(sum(v.lost for v in variants.values())), ""),
    ]
    found = [{"name": name, "value": value, "unit": unit} for name, value, unit in rows]
    if count == 1:
        found[4]["goal"] = GOAL_US
    return found


def images(master: str) -> list[dict[str, Any]]:
    """Images of 1 MB at 30 Hz from ROS 1 to zenoh."""
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        (folder / "eye.bdsl").write_text(IMAGE_BRIDGE)
        rcgen = [sys.executable, "-m", "robocomp_dsl.cli.rcgen", "bridge"]
        subprocess.run([*rcgen, str(folder / "eye.bdsl"), "-q"], check=True)
        domain = f"bench-{uuid.uuid4().hex[:8]}"
        options = ("--transport", f"ros1.master={master}", "--domain", domain)
        bridge = stack.enter_context(process(sys.executable, "main.py", *options, where=folder))
        ports, _, _ = open_program("camera", f"{domain}s", 0, master, {("ros1", "eye"): "/eye"})
        stack.callback(ports.close)
        at = Endpoint(IMAGES, "camera", "eye", middlewares=("ros1",))
        publish = ports.advertise(at).bind(IMAGES.operations[0])
        reader, group, _ = open_program("reader", domain, 0, "", {}, "zenoh")
        stack.callback(reader.close)
        arrived: list[tuple[int, float]] = []
        where = Endpoint(PICTURES, "reader", "p", ("eye.picture",), middlewares=("zenoh",))
        reader.subscribe(where, {"send": lambda m: arrived.append((m.height, monotonic()))}, group)
        data, sent = np.zeros(10**6, np.uint8), dict[int, float]()
        deadline = monotonic() + 60
        while not arrived and monotonic() < deadline:
            publish(Image(data=data))
            sleep(0.1)
        arrived.clear()
        before, due = cpu_seconds(bridge.pid), monotonic()
        for number in range(1, IMAGE_COUNT + 1):
            sent[number] = monotonic()
            publish(Image(height=number, data=data))
            due += 1 / 30
            sleep(max(due - monotonic(), 0))
        sleep(0.5)
        cpu = cpu_seconds(bridge.pid) - before
    took = [1000 * (moment - sent[number]) for number, moment in arrived if number in sent]
    what = "1 MB images at 30 Hz, ROS 1 to zenoh"
    return [
        {"name": f"{what}: lost of {IMAGE_COUNT}", "value": IMAGE_COUNT - len(took), "unit": ""},
        {"name": f"{what}: latency", "value": median(took), "unit": "ms"},
        {"name": f"{what}: CPU per image", "value": 1000 * cpu / IMAGE_COUNT, "unit": "ms"},
    ]


def run() -> list[dict[str, Any]]:
    """All figures."""
    figures: list[dict[str, Any]] = []
    with ros_master() as master:
        if not master:
            print("   rosmaster is not installed: skipped")
            return figures
        figures += images(master)
        for count in COUNTS:
            names = NameServer(("127.0.0.1", 0))
            with ExitStack() as stack:
                stack.callback(names.close)
                bench = Bench(count, names.number, master, stack)
                bench.wait_until_connected()
                bench.measure()
                figures += figures_of(bench)
                totals = bench.statistics.operations.values()
                size = sum(o.bytes_out for o in totals if o.port.startswith("generated"))
                calls = max(o.calls for o in totals if o.port.startswith("generated"))
                figures.append(
                    {
                        "name": f"{count} inputs: bytes in per message",
                        "value": size / calls,
                        "unit": "bytes",
                    }
                )
    return figures
