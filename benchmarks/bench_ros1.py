"""Round trips in ROS 1: rospy to rospy, component to rospy, component to component; in turns.

Topics carry a string of 80 characters there and back, a persistent service returns it. A laser scan
is encoded and decoded by the codec of the middleware, and by rosbags.
"""

from __future__ import annotations

import os
import socket
import subprocess
import tempfile
import uuid
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from statistics import median
from time import perf_counter_ns, sleep
from typing import Any

from benchmarks.bench_middleware import CALLS, in_turns, ratio
from benchmarks.processes import line, process
from benchmarks.ros1_component import Caller

PYTHON = "/usr/bin/python3"
"""Of Debian's `ros-base`."""
KINDS = ("topic", "service")
SCRIPT = str(Path(__file__).parent / "rospy_twoway.py")


def run() -> list[dict[str, Any]]:
    """All figures; none without ROS."""
    if not Path("/usr/bin/rosmaster").exists():
        print("   ROS 1 is not installed: skipped")
        return []
    with ExitStack() as stack:
        return _figures(stack)


def _figures(stack: ExitStack) -> list[dict[str, Any]]:
    folder = stack.enter_context(tempfile.TemporaryDirectory())
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        number = probe.getsockname()[1]
    master = f"http://127.0.0.1:{number}"
    os.environ |= {"ROS_MASTER_URI": master, "ROS_HOSTNAME": "127.0.0.1"}
    os.environ |= {"ROS_HOME": folder, "ROS_LOG_DIR": folder}
    command = [PYTHON, "/usr/bin/rosmaster", "--core", "-p", str(number)]
    started = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    stack.callback(started.wait)
    stack.callback(started.kill)
    sleep(2)
    domain = f"bench-{uuid.uuid4().hex[:8]}"
    for name in ("rospy", "mixed"):
        line(stack.enter_context(process("-W", "ignore", SCRIPT, "serve", name, python=PYTHON)))
    own = process("-m", "benchmarks.ros1_component", "own", domain, master)
    line(stack.enter_context(own))
    plain = stack.enter_context(
        process("-W", "ignore", SCRIPT, "call", "rospy", str(CALLS), python=PYTHON)
    )
    line(plain)
    callers = {
        "component to rospy": Caller("caller_mixed", "mixed", domain, master),
        "component to component": Caller("caller_own", "own", domain, master),
    }
    calls: dict[str, Callable[[], Any]] = {}
    for name, caller in callers.items():
        stack.callback(caller.ports.close)
        calls |= {f"{name}, topic": caller.topic, f"{name}, service": caller.service}
    rospy = "rospy to rospy"
    took = in_turns(
        calls,
        {f"{rospy}, {each}": partial(_round, plain, each) for each in KINDS},
    )
    figures = [
        {"name": f"{name}, round trip", "value": median(values), "unit": "us"}
        for name, values in took.items()
    ]
    for kind in KINDS:
        for name in callers:
            value = ratio(took, f"{name}, {kind}", f"{rospy}, {kind}")
            figures.append({"name": f"{name} / {rospy}, {kind}", "value": value, "unit": "x"})
    return figures + codec_figures()


def _round(plain: subprocess.Popen[str], kind: str) -> float:
    assert plain.stdin
    plain.stdin.write(f"{kind}\n")
    plain.stdin.flush()
    return float(line(plain))


def codec_figures() -> list[dict[str, Any]]:
    """A laser scan of 360 rays, encoded and decoded."""
    from benchmarks.ros1_codec import codecs  # noqa: PLC0415 - needs rosbags

    took: dict[str, list[float]] = {}
    for _ in range(15):
        for name, both in codecs().items():
            start = perf_counter_ns()
            for _ in range(200):
                both()
            took.setdefault(name, []).append((perf_counter_ns() - start) / 200_000)
    figures = [
        {"name": f"scan of 360 rays, both ways, {name}", "value": median(values), "unit": "us"}
        for name, values in took.items()
    ]
    value = ratio(took, "ros1", "rosbags")
    figures.append({"name": "the same, ros1 / rosbags", "value": value, "unit": "x", "goal": 0.5})
    return figures
