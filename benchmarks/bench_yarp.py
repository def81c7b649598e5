"""An image of 0.9 MB at 30 Hz between two components on YARP: delay, processor time, and copies.

    python -m benchmarks.bench_yarp DOMAIN    publishes until its input ends

A copy is memory of the size of the image that a process allocates for one frame, beyond the image
that the handler gets (`tracemalloc`, in a run of its own, because it costs time).
"""

from __future__ import annotations

import resource
import sys
import threading
import time
import tracemalloc
import uuid
from typing import Any

import numpy as np

from benchmarks.camera_frames import CAMERA
from benchmarks.processes import line, process
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext

FRAME_BYTES = 640 * 480 * 3
RATE = 30
FRAMES = 120
_TAKEN = CAMERA.operation("taken")


def cpu_ms() -> float:
    """Processor time of this process, in ms."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return (usage.ru_utime + usage.ru_stime) * 1000


def _ports(name: str, domain: str) -> ComponentPorts:
    settings = {("yarp", "name_server"): "127.0.0.1:1"}  # components find each other without one
    context = ComponentContext(
        name, domain, CallbackGroup(), Statistics(), transport_settings=settings
    )
    return open_ports("yarp", context)


def publish(domain: str) -> None:
    """Publish frames; at the end, print ms of processor time and copies for a frame."""
    ports = _ports("camera", domain)
    channel = ports.advertise(Endpoint(CAMERA, "camera", "Camera", middlewares=("yarp",)))
    taken = channel.bind(_TAKEN)
    pixels = np.random.default_rng(0).integers(0, 256, FRAME_BYTES, np.uint8)
    ended = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), ended.set()), daemon=True).start()
    channel.wait(30)
    start, before, frames = time.monotonic(), cpu_ms(), 0
    while not ended.is_set():
        taken(time.monotonic_ns(), pixels)
        frames += 1
        time.sleep(max(0.0, start + frames / RATE - time.monotonic()))
    used = (cpu_ms() - before) / frames
    tracemalloc.start()
    taken(0, pixels)
    copies = tracemalloc.get_traced_memory()[1] / FRAME_BYTES
    print(f"{used} {copies}", flush=True)
    ports.close()


class Watcher:
    """Receives the frames."""

    def __init__(self, domain: str) -> None:
        self.delays: list[float] = []
        self.peaks: list[float] = []
        self.group = CallbackGroup()
        self.ports = _ports("watcher", domain)
        at = Endpoint(CAMERA, "watcher", "Camera", middlewares=("yarp",))
        self.ports.subscribe(at, {"taken": self._taken}, self.group)

    def _taken(self, stamp: int, pixels: Any) -> None:
        self.delays.append((time.monotonic_ns() - stamp) / 1e6)
        assert len(pixels) == FRAME_BYTES
        if tracemalloc.is_tracing():
            self.peaks.append(tracemalloc.get_traced_memory()[1] / FRAME_BYTES - 1)
            tracemalloc.clear_traces()
            tracemalloc.reset_peak()

    def wait(self, frames: int) -> None:
        """Wait until so many more frames have come."""
        goal = len(self.delays) + frames
        while len(self.delays) < goal:
            time.sleep(0.05)


def run() -> list[dict[str, Any]]:
    """The figures."""
    domain = f"bench-{uuid.uuid4().hex[:12]}"
    watcher = Watcher(domain)
    with process("-m", "benchmarks.bench_yarp", domain) as camera:
        watcher.wait(10)
        watcher.delays.clear()
        before = cpu_ms()
        watcher.wait(FRAMES)
        received = (cpu_ms() - before) / FRAMES
        delays = list(watcher.delays)
        tracemalloc.start()
        watcher.wait(10)
        tracemalloc.stop()
        assert camera.stdin is not None
        camera.stdin.close()
        sent, copies = map(float, line(camera).split())
    watcher.ports.close()
    return [
        {"name": "0.9 MB at 30 Hz: delay, median", "value": np.median(delays), "unit": "ms"},
        {"name": "delay, p99", "value": np.percentile(delays, 99), "unit": "ms"},
        {"name": "processor time of the publisher for a frame", "value": sent, "unit": "ms"},
        {"name": "processor time of the subscriber for a frame", "value": received, "unit": "ms"},
        {"name": "copies at the publisher", "value": copies, "unit": ""},
        {"name": "copies at the subscriber", "value": np.median(watcher.peaks), "unit": ""},
    ]


if __name__ == "__main__":
    publish(sys.argv[1])
