"""Images between generated components: round trips, and frames at a fixed rate to three processes.

python -m benchmarks.camera_frames echo DOMAIN MIDDLEWARE...    answers each image
python -m benchmarks.camera_frames watch DOMAIN NAME            prints what it received
"""

from __future__ import annotations

import re
import resource
import sys
import time
import uuid
from contextlib import ExitStack
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

import numpy as np

from benchmarks.bench_middleware import Bell
from benchmarks.processes import line, process
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts, open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryFile

CAMERA = rt.Interface(
    "Bench::Camera",
    rt.Operation("taken", rt.Pattern.PUBLISH, inputs={"stamp": rt.Long, "pixels": rt.UInt8Array}),
)
ROUNDS = 40
IMAGES = 10
FRAME_BYTES = 4_000_000
RATE = 30
FRAMES = 150
WATCHERS = 3


class CameraProxy(rt.Proxy):
    """As generated."""

    __slots__ = ()
    INTERFACE = CAMERA

    def taken(self, stamp: int, pixels: rt.UInt8Array) -> None:
        """Publish."""
        self._call("taken", stamp, pixels)


class Node:
    """A component on one middleware."""

    def __init__(self, name: str, middleware: str, domain: str) -> None:
        self.name = name
        self.only = (middleware,)
        self.group = CallbackGroup()
        self.statistics = Statistics()
        context = ComponentContext(name, domain, self.group, self.statistics)
        self.ports: ComponentPorts = open_ports(middleware, context)

    def camera(self, port: str) -> CameraProxy:
        """A publisher."""
        at = Endpoint(CAMERA, self.name, port, middlewares=self.only)
        return CameraProxy(self.ports.advertise(at))

    def watch(self, handler: Any, port: str, peer: str, depth: int | None = None) -> None:
        """A subscriber."""
        at = Endpoint(CAMERA, self.name, port, (peer,), Qos(depth=depth), self.only)
        self.ports.subscribe(at, {"taken": handler}, self.group)


def echo(domain: str, middlewares: list[str]) -> None:
    """Answer each image with an empty one, until the input ends."""
    nodes = [Node(f"echo-{name}", name, domain) for name in middlewares]
    for node in nodes:
        back = node.camera("Back")
        empty = np.zeros(0, np.uint8)

        def answer(stamp: int, _pixels: Any, back: Any = back, empty: Any = empty) -> None:
            back.taken(stamp, empty)

        node.watch(answer, "There", f"client-{node.only[0]}.There")
    print("ready", flush=True)
    sys.stdin.read()
    for node in nodes:
        node.ports.close()


def image_round_trips() -> list[dict[str, Any]]:
    """An image of 0.9 MB there, an empty one back, in turns."""
    domain, middlewares = f"bench-{uuid.uuid4().hex[:8]}", ["zenoh", "local"]
    pixels = np.random.default_rng(1).integers(0, 255, 900_000, np.uint8)
    took: dict[str, list[float]] = {name: [] for name in middlewares}
    with ExitStack() as stack:
        started = process("-m", "benchmarks.camera_frames", "echo", domain, *middlewares)
        line(stack.enter_context(started))
        links = {}
        for name in middlewares:
            node, bell = Node(f"client-{name}", name, domain), Bell()
            stack.callback(node.ports.close)
            camera = node.camera("There")
            node.watch(bell.ring, "Back", f"echo-{name}.Back")
            assert camera.wait_for_server(10)
            links[name] = camera, bell
        time.sleep(0.5)  # zenoh: both sides subscribe
        for _ in range(ROUNDS):
            for name, (camera, bell) in links.items():
                values = []
                for _ in range(IMAGES):
                    start = time.perf_counter()
                    camera.taken(0, pixels)
                    bell.wait()
                    values.append(1e3 * (time.perf_counter() - start))
                took[name].append(median(values))
    relative = median(a / b for a, b in zip(took["local"], took["zenoh"], strict=True))
    name = "0.9 MB image there, small answer"
    return [
        *({"name": f"{name}, {m}", "value": median(v), "unit": "ms"} for m, v in took.items()),
        {"name": f"{name}, local / zenoh", "value": relative, "unit": "x", "goal": 0.5},
    ]


def watch(domain: str, name: str) -> None:
    """Receive frames; on the end of the input, print what was received."""
    node, delays, read_before = Node(name, "local", domain), [], bytes_read()
    files: set[str] = set()

    def taken(stamp: int, pixels: Any) -> None:
        delays.append((time.monotonic_ns() - stamp) / 1e6)
        if len(delays) == FRAMES // 2:
            files.add(mapped_file(pixels))

    node.watch(taken, "Frames", "camera.Frames")
    print("ready", flush=True)
    sys.stdin.readline()
    copied = (bytes_read() - read_before) / (FRAME_BYTES * max(1, len(delays)))
    delays.sort()
    p99 = delays[int(0.99 * len(delays))]
    print(len(delays), median(delays), p99, copied, *sorted(files), flush=True)
    sys.stdin.read()
    node.ports.close()


def mapped_file(pixels: np.ndarray) -> str:
    """The inode of the memory file that the array is a view of."""
    address = pixels.__array_interface__["data"][0]
    for mapping in Path("/proc/self/maps").read_text().splitlines():
        begin, end = (int(part, 16) for part in mapping.split()[0].split("-"))
        if begin <= address < end and re.search("memfd:robocomp", mapping):
            return mapping.split()[4]
    return "copy"


def bytes_read() -> int:
    """Bytes that this process has read by system calls, sockets excluded."""
    return int(re.search("rchar: ([0-9]+)", Path("/proc/self/io").read_text())[1])


def count_written(stack: ExitStack) -> list[int]:
    """The bytes of each message that is written into a memory file from now on."""
    written: list[int] = []
    write = MemoryFile.write

    def counting(file: MemoryFile, parts: list[Any]) -> None:
        written.append(sum(memoryview(part).nbytes for part in parts))
        write(file, parts)

    stack.enter_context(patch.object(MemoryFile, "write", counting))
    return written


def frames_to_three() -> list[dict[str, Any]]:
    """Frames at a fixed rate to three processes; the receivers use the memory that was written."""
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    pixels = np.random.default_rng(1).integers(0, 255, FRAME_BYTES, np.uint8)
    with ExitStack() as stack:
        watchers = [
            stack.enter_context(process("-m", "benchmarks.camera_frames", "watch", domain, f"w{i}"))
            for i in range(WATCHERS)
        ]
        for watcher in watchers:
            line(watcher)
        node = Node("camera", "local", domain)
        stack.callback(node.ports.close)
        camera = node.camera("Frames")
        while len(node.ports.presence.registry.find("subscriber", CAMERA.name)) < WATCHERS:
            time.sleep(0.01)
        written = count_written(stack)
        cpu = resource.getrusage(resource.RUSAGE_SELF)
        began = time.monotonic()
        for number in range(FRAMES):
            time.sleep(max(0.0, began + number / RATE - time.monotonic()))
            camera.taken(time.monotonic_ns(), pixels)
        used = resource.getrusage(resource.RUSAGE_SELF)
        copies = sum(written) / (FRAMES * FRAME_BYTES)
        time.sleep(0.2)
        results = []
        for watcher in watchers:
            assert watcher.stdin
            watcher.stdin.write("\n")
            watcher.stdin.flush()
            results.append(line(watcher).split())
    files = {tuple(result[4:]) for result in results}
    ms = 1000 * (used.ru_utime - cpu.ru_utime + used.ru_stime - cpu.ru_stime) / FRAMES
    title = "4 MB frames at 30 Hz to 3 subscribers"
    lost = WATCHERS * FRAMES - sum(int(result[0]) for result in results)
    same_memory = len(files) == 1 and not any("copy" in names for names in files)
    return [
        {"name": f"{title}: lost, of {WATCHERS * FRAMES}", "value": lost, "unit": "", "goal": 0},
        {"name": f"{title}: copies at the sender", "value": copies, "unit": "", "goal": 1.01},
        {
            "name": f"{title}: copies at a receiver",
            "value": max(float(result[3]) for result in results) if same_memory else 1.0,
            "unit": "",
            "goal": 0.01,
        },
        {
            "name": f"{title}: to the handler",
            "value": median(float(result[1]) for result in results),
            "unit": "ms",
        },
        {
            "name": f"{title}: to the handler, p99",
            "value": max(float(result[2]) for result in results),
            "unit": "ms",
        },
        {"name": f"{title}: CPU of the sender per frame", "value": ms, "unit": "ms"},
    ]


if __name__ == "__main__":
    if sys.argv[1] == "echo":
        echo(sys.argv[2], sys.argv[3:])
    else:
        watch(*sys.argv[2:])
