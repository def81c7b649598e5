"""A bridge between YARP and ROS 1 in both directions, for the tests of faults."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from tests.bridge.peers.bridge_process import generate

BRIDGE = """\
import "std_msgs/msg/Float64.msg";
import "std_msgs/msg/Float64MultiArray.msg";

Bridge rover
{
    input wheels : double[2] [deg] over yarp at "/rover/wheels:o";
    input speed : std_msgs::Float64 over ros1 at "/rover/speed";
    output angles : std_msgs::Float64MultiArray over ros1 at "/rover/angles"
    {
        data = wheels to [deg];
    };
    output command over yarp at "/rover/command:i" { item "speed"; item speed.data; };
    output setting over yarp at "/rover/rpc:i" { item "set"; item speed.data; };
};
"""
WHEELS, SPEED, ANGLES = "/rover/wheels:o", "/rover/speed", "/rover/angles"
COMMAND, SETTING = "/rover/command:i", "/rover/rpc:i"
SPEED_TYPE, ANGLES_TYPE = "std_msgs/Float64", "std_msgs/Float64MultiArray"
GOAL_S = 2.0
"""A bridge connects again within this time; tests print it and do not depend on it."""


def line_of(text: str, source: str = BRIDGE, file: str = "rover.bdsl") -> str:
    """The place of the first line that contains `text`, as messages show it."""
    lines = source.splitlines()
    return f"{file}:{next(n for n, line in enumerate(lines, 1) if text in line)}"


def write_bridge(folder: Path, text: str = BRIDGE, name: str = "rover") -> Path:
    """Generate the bridge into a folder."""
    (folder / f"{name}.bdsl").write_text(text)
    generate(folder, f"{name}.bdsl", "-o", "out")
    return folder / "out"


def report_time(what: str, since: float, read: Callable[[], float] = time.monotonic) -> None:
    """Print how long the data needed."""
    seconds = read() - since
    print(f"RECOVERY {what}: {seconds:.2f} s{'' if seconds <= GOAL_S else ' (goal: 2 s)'}")  # noqa: T201
