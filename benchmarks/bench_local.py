"""What the middleware `local` is built of, and what it reaches; all in turns, in one run.

Small messages over the links of the operating system and of libraries, and over plain Ice. Large
messages inline, in memory files and in named shared memory. Then generated components: queries,
images over `local` and `zenoh`, and camera frames to three subscribers.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import uuid
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from statistics import median
from time import perf_counter_ns
from typing import Any

import numpy as np

from benchmarks import large_links, raw_links
from benchmarks.bench_middleware import CALLS, Client, in_turns, ratio
from benchmarks.camera_frames import frames_to_three, image_round_trips
from benchmarks.processes import line, process

ROUNDS_LARGE = 20
SIZES_MB = (0.9, 4, 8, 64)
PYTHONS_WITH_ICE = (sys.executable, "/usr/bin/python3")
READY_BYTES = 88


def ice_rounds(stack: ExitStack) -> Callable[[], float] | None:
    """A function that lets two processes make one round by plain Ice; None without Ice."""
    script = str(Path(__file__).parent / "ice_twoway.py")
    for python in PYTHONS_WITH_ICE:
        found = subprocess.run([python, "-c", "import Ice"], capture_output=True, check=False)
        if found.returncode == 0:
            break
    else:
        print("   Ice is not installed: skipped")
        return None
    server = stack.enter_context(process(script, "serve", python=python))
    arguments = (script, "call", line(server), str(CALLS))
    client = stack.enter_context(process(*arguments, python=python))
    line(client)

    def one_round() -> float:
        assert client.stdin
        client.stdin.write("\n")
        client.stdin.flush()
        return float(line(client))

    return one_round


def small_messages() -> list[dict[str, Any]]:
    """Round trips of small messages."""
    kinds = raw_links.installed()
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    with ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        peer = stack.enter_context(process("-m", "benchmarks.raw_links", folder, *kinds))
        line(peer)
        data = bytes(READY_BYTES)
        calls: dict[str, Callable[[], Any]] = {}
        for kind in kinds:
            send = raw_links.connect(kind, Path(folder))
            calls[f"raw {kind}"] = lambda send=send: send(data)
        middlewares = ("local", "zenoh")
        generated = process("-m", "benchmarks.middleware_peer", domain, *middlewares)
        line(stack.enter_context(generated))
        for name in middlewares:
            client = Client(name, domain)
            stack.callback(client.ports.close)
            calls[f"generated {name} query"] = client.query
        took = in_turns(calls, {"Ice twoway": ice} if (ice := ice_rounds(stack)) else {})
    figures = [
        {"name": f"{name}, round trip", "value": median(values), "unit": "us"}
        for name, values in took.items()
    ]
    local = "generated local query"
    goals = {"generated zenoh query": 0.25, "Ice twoway": 0.5, "raw seqpacket": None}
    for other, goal in goals.items():
        if other in took:
            value = ratio(took, local, other)
            figures.append({"name": f"{local} / {other}", "value": value, "unit": "x"})
            if goal:
                figures[-1]["goal"] = goal
    return figures


def large_messages() -> list[dict[str, Any]]:
    """Large messages to another process that reads each page."""
    with ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        arguments = ("-m", "benchmarks.large_links", folder, *large_links.KINDS)
        line(stack.enter_context(process(*arguments)))
        largest = int(max(SIZES_MB) * 1e6)
        sends = {
            kind: large_links.connect(kind, Path(folder), largest) for kind in large_links.KINDS
        }
        took: dict[tuple[str, float], list[float]] = {}
        for megabytes in SIZES_MB:
            array = np.random.default_rng(1).integers(0, 255, int(megabytes * 1e6), np.uint8)
            for _ in range(ROUNDS_LARGE):
                for kind, send in sends.items():
                    start = perf_counter_ns()
                    send(array)
                    took.setdefault((kind, megabytes), []).append((perf_counter_ns() - start) / 1e6)
    return [
        {"name": f"{megabytes:g} MB by {kind}", "value": median(values), "unit": "ms"}
        for (kind, megabytes), values in took.items()
    ]


def run() -> list[dict[str, Any]]:
    """All figures."""
    return [*small_messages(), *large_messages(), *image_round_trips(), *frames_to_three()]
