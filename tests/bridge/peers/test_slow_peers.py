"""Readers that hang: the bridge's memory is bounded, drops are counted, other outputs continue."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.bridge.peers import rover
from tests.bridge.peers.bridge_process import BridgeProcess
from tests.bridge.peers.running_rover import Nodes, Programs
from tests.middleware.ros1.ros1_peers import needs_ros1
from tests.middleware.yarp.yarp_tools import needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1, needs_yarp]
BYTES = 1 << 20
DEPTH = 5
BRIDGE = f"""\
import "sensor_msgs/msg/Image.msg";
import "std_msgs/msg/UInt8MultiArray.msg";

Bridge eyes
{{
    input camera : sensor_msgs::Image over ros1 at "/camera";
    output hanging over yarp at "/hanging:i" {{ depth {DEPTH}; item camera.data; }};
    output slow : sensor_msgs::Image over ros1 at "/slow" = camera {{ depth {DEPTH}; }};
    output fine : std_msgs::UInt8MultiArray over ros1 at "/fine" {{ data = camera.data; }};
}};
"""


def resident_bytes(pid: int) -> int:
    """The memory of a process."""
    (pages,) = re.findall(r"VmRSS:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text())
    return int(pages) * 1024


def test_bridge_loses_messages_of_hanging_readers_only(
    tmp_path: Path,
    yarp_program: Programs,
    rospy_node: Nodes,
    bridge: Callable[..., BridgeProcess],
) -> None:
    yarp_program("sleep", "/hanging:i")
    slow, fine, camera = rospy_node("slow"), rospy_node("fine"), rospy_node("camera")
    slow.command("subscribe_slowly", "/slow", "sensor_msgs/Image", 3600)
    fine.command("subscribe", "/fine", "std_msgs/UInt8MultiArray")
    camera.command("advertise", "/camera", "sensor_msgs/Image")
    running = bridge(rover.write_bridge(tmp_path, BRIDGE, "eyes"))
    wait_until(lambda: camera.command("connections", "/camera") == 1, lambda: running.log)

    def publish() -> int:
        camera.command("publish_image", "/camera", BYTES)
        time.sleep(0.01)
        return int(fine.command("count", "/fine"))

    wait_until(publish, lambda: running.log)
    start = resident_bytes(running.pid)
    hanging = rf"/eyes/hanging:o: /hanging:i does not take .* \({line('output hanging')}\)"
    wait_until(lambda: publish() and re.search(hanging, running.log), lambda: running.log)
    lost = rf"/slow does not take .* \({line('output slow')}\)"
    wait_until(lambda: publish() and re.search(lost, running.log), lambda: running.log)
    count = publish()
    wait_until(lambda: publish() > count + 100, lambda: running.log)
    grown = resident_bytes(running.pid) - start
    print(f"memory: {start >> 20} MB, grown by {grown >> 20} MB")  # noqa: T201
    assert grown < 4 * DEPTH * BYTES * 2
    assert running.is_running
    log = running.ended()
    counts = {
        name: int(number)
        for name, number in re.findall(r"output `(\w+)`: .*?(\d+) lost by the middleware", log)
    }
    assert counts.keys() == {"hanging", "slow"}, log
    assert min(counts.values()) > 50, log


def line(text: str) -> str:
    return rover.line_of(text, BRIDGE, "eyes.bdsl")
