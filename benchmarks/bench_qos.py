"""Jitter of a 100 Hz control topic beside a saturating image stream, with and without priority.

The experiment of the paper (A. Paikan et al., channel prioritization; section 3.3 of the iCub
software paper): one process publishes both streams to another, over one connection. The variants
run in turns: without priority, with `priority=realtime` of the messages where the middleware has
it, and with `thread_priority` of the receiver where the system allows it.
"""

from __future__ import annotations

import threading
import time
import uuid
from statistics import median
from typing import Any

import numpy as np

from benchmarks.camera_frames import CAMERA
from benchmarks.pose_interface import TRACK, Pose
from benchmarks.processes import line, process
from benchmarks.qos_publisher import PERIOD_S, PORTS
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.component.thread_priority import set_scheduling
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.registry import known_capabilities

MIDDLEWARES = ("zenoh", "local")
ROUNDS = 6
SECONDS = 2.0
THREAD_PRIORITY = 50


class ControlReceiver:
    """Receives a control topic; `delays` and `intervals` of a round, in ms."""

    def __init__(self, ports: ComponentPorts, middleware: str, name: str, qos: Qos) -> None:
        self.arrivals: list[tuple[float, float]] = []
        peers = (f"source.{name}",)
        own = f"{name}{qos.thread_priority or ''}"
        at = Endpoint(TRACK, "sink", own, peers, qos, (middleware,))
        ports.subscribe(at, {"moved": self._receive}, CallbackGroup())

    def _receive(self, pose: Pose) -> None:
        self.arrivals.append((time.monotonic(), pose.stamp))

    def figures(self) -> dict[str, float]:
        """Jitter (standard deviation of the interval), and p99 of the delay; in ms."""
        arrivals, self.arrivals = self.arrivals, []
        received = np.array(arrivals)
        intervals = np.diff(received[:, 0]) * 1000
        delays = (received[:, 0] - received[:, 1]) * 1000
        return {
            "jitter": float(np.sqrt(np.mean((intervals - PERIOD_S * 1000) ** 2))),
            "delay_p99": float(np.percentile(delays, 99)),
        }


def thread_priority_is_allowed() -> bool:
    """Whether this user may use SCHED_FIFO."""
    reasons: list[str] = []
    thread = threading.Thread(target=lambda: reasons.append(set_scheduling(0, THREAD_PRIORITY)))
    thread.start()
    thread.join()
    return reasons == [""]


def measure(middleware: str) -> dict[str, list[dict[str, float]]]:
    """The figures of every round of every variant."""
    capabilities = known_capabilities(middleware)
    assert capabilities is not None
    has_priority = "priority" in capabilities.qos
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    context = ComponentContext("sink", domain, CallbackGroup(), Statistics())
    ports = open_ports(middleware, context, used=(middleware,))
    images = 0

    def receive_image(_stamp: int, _pixels: Any) -> None:
        nonlocal images
        images += 1

    names = list(PORTS) if has_priority else ["Plain"]
    variants = {name: ControlReceiver(ports, middleware, name, Qos()) for name in names}
    if thread_priority_is_allowed():
        key = f"{names[-1]} with thread priority"
        qos = Qos(thread_priority=THREAD_PRIORITY)
        variants[key] = ControlReceiver(ports, middleware, names[-1], qos)
    at = Endpoint(CAMERA, "sink", "Camera", (), Qos(depth=1), (middleware,))
    ports.subscribe(at, {"taken": receive_image}, CallbackGroup())
    rounds: dict[str, list[dict[str, float]]] = {name: [] for name in variants}
    try:
        with process("-m", "benchmarks.qos_publisher", domain, middleware, *names) as publisher:
            line(publisher)
            assert publisher.stdin
            begun, before = time.monotonic(), images
            for number in range(ROUNDS + 1):
                for name in names if number % 2 else reversed(names):
                    publisher.stdin.write(f"{name} {SECONDS}\n")
                    publisher.stdin.flush()
                    line(publisher)
                    for key, receiver in variants.items():
                        if key.partition(" ")[0] == name and number:
                            rounds[key].append(receiver.figures())
                        elif key.partition(" ")[0] == name:
                            receiver.arrivals.clear()
            rate = (images - before) / (time.monotonic() - begun)
    finally:
        ports.close()
    rounds["images"] = [{"rate": rate}]
    return rounds


def run() -> list[dict[str, Any]]:
    """All figures."""
    figures: list[dict[str, Any]] = []
    for middleware in MIDDLEWARES:
        if known_capabilities(middleware) is None:
            continue
        rounds = measure(middleware)
        rate = rounds.pop("images")[0]["rate"]
        figures.append({"name": f"{middleware}: images beside it", "value": rate, "unit": "Hz"})
        for variant, results in rounds.items():
            label = {"Plain": "without priority", "Urgent": "priority=realtime"}
            what = f"{middleware}, 100 Hz topic, {label[variant.partition(' ')[0]]}"
            what += f", thread_priority={THREAD_PRIORITY}" if " " in variant else ""
            for key, title in (("jitter", "jitter"), ("delay_p99", "p99 of the delay")):
                value = median(result[key] for result in results)
                figures.append({"name": f"{what}: {title}", "value": value, "unit": "ms"})
        if "Urgent" in rounds:
            for key, title in (("jitter", "jitter"), ("delay_p99", "p99 of the delay")):
                pairs = zip(rounds["Urgent"], rounds["Plain"], strict=True)
                value = median(a[key] / b[key] for a, b in pairs)
                name = f"{middleware}: {title} with / without priority"
                figures.append({"name": name, "value": value, "unit": ""})
    return figures
