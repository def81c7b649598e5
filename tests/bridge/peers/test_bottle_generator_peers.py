"""Configurations of yarp-bottle-generator pass data between a real YARP and a real ROS 1.

The configurations have the shapes of the public ones: hubs of one and of several ports, with and
without converters, headers, constants, files of early versions, and messages of a package of its
own.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.bridge.peers.bridge_process import BridgeProcess, generate
from tests.bridge.peers.conftest import ros
from tests.middleware.ros1.ros1_peers import Master, RospyPeer, needs_ros1
from tests.middleware.yarp.yarp_tools import Tools, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1, needs_yarp]

HEADER = """
[header]
num_fields = 3
1_type = counter
2_type = timestamp
3_type = single_value
3_msg = "{frame}"
"""
JOINTS = """
[message]
num_fields = 5
1_type = msg
1_msg = header
2_type = list
2_msg = "waist", "neck_pan", "neck_tilt"
3_type = mux
3_mux = mux1
4_type = list
4_msg =
5_type = list
5_msg =
""" + HEADER.format(frame="")
UPPER_BODY = (
    """
[general]
output_name = /body/joint_states
to_ros = true
num_mux = 1
rate = 60
ros_msg_name = sensor_msgs/JointState
from_ros_topics = false

[mux1]
num_ports = 2
ports = /body/torso/state:o,/body/head/state:o
function = deg_to_rad
verbose = false
"""
    + JOINTS
)
EARLY = (
    """
[general]
output_name = /body/joint_states
num_mux = 1

[mux1]
num_ports = 2
ports = /body/torso/state:o,/body/head/state:o
function = deg_to_rad
verbose = true
"""
    + JOINTS
)
POINT = """
[general]
output_name = /ball_point
to_ros = true
num_mux = 1
rate = 60
ros_msg_name = geometry_msgs/PointStamped
from_ros_topics = false

[mux1]
num_ports = 1
ports = /tracker/data:o
function = none
verbose = false

[message]
num_fields = 2
1_type = msg
1_msg = header
2_type = mux
2_mux = mux1
""" + HEADER.format(frame="l_camera")
TWO_HUBS = """
[general]
output_name = /motors_inertial
to_ros = true
num_mux = 2
rate = 60
ros_msg_name = MotorsInertial
from_ros_topics = false

[mux1]
num_ports = 1
ports = /head/state:o,
function = deg_to_rad
verbose = false

[mux2]
num_ports = 1
ports = /inertial
function = none_double
verbose = false

[message]
num_fields = 2
1_type = mux
1_mux = mux2
2_type = mux
2_mux = mux1
"""
MOTORS_INERTIAL = "float64[] inertial\nfloat64[] encoders\n"
MOTOR_CONTROL = "int32 joint\nfloat64 angle\n"
COMMAND = """
[general]
output_name = /fakebot/motor/rpc:i
to_ros = false
num_mux = 1
rate = 60
from_ros_topics = true

[mux1]
num_ports = 1
ports = /motor_control
function = none
verbose = true

[message]
num_fields = 3
1_type = single_value
1_msg = "set"
2_type = single_value
2_msg = "pos"
3_type = mux
3_mux = mux1
"""
POINT_GOAL = """
[general]
output_name = /gaze/xd:i
to_ros = false
num_mux = 1
rate = 60
from_ros_topics = true

[mux1]
num_ports = 1
ports = /fixation_goal
function = none
verbose = true

[message]
num_fields = 1
1_type = mux
1_mux = mux1
"""

WRITER = """
import sys, time, yarp
yarp.Network.init()
values = {{"/body/torso/state:o": [90.0], "/body/head/state:o": [-180.0, 45.0],
           "/head/state:o": [90.0, 45.0], "/inertial": [1, 2.5], "/tracker/data:o": [1, 2, 3]}}
ports = []
for name in {names!r}:
    port = yarp.BufferedPortBottle()
    port.open(name)
    ports.append((port, values[name]))
print("ready", flush=True)
while True:
    for port, items in ports:
        bottle = port.prepare()
        bottle.clear()
        for item in items:
            bottle.addFloat64(item) if isinstance(item, float) else bottle.addInt32(item)
        port.write()
    time.sleep(0.02)
"""
PI = 3.141592653589793


def write_messages(folder: Path) -> Path:
    """A package of ROS messages, as a user has it."""
    package = folder / "src" / "lab_msgs" / "msg"
    package.mkdir(parents=True)
    (package / "MotorsInertial.msg").write_text(MOTORS_INERTIAL)
    (package / "MotorControl.msg").write_text(MOTOR_CONTROL)
    return folder / "src"


def start_writer(yarp: Tools, *names: str) -> None:
    """Start a program of YARP that writes to ports, without end."""
    process = yarp.python(WRITER.format(names=names))
    assert yarp.line_of(process) == "ready\n"


TO_ROS: dict[str, tuple[str, tuple[str, ...], str, str, dict[str, Any]]] = {
    "several ports": (
        UPPER_BODY,
        ("/body/torso/state:o", "/body/head/state:o"),
        "/body/joint_states",
        "sensor_msgs/JointState",
        {"name": ["waist", "neck_pan", "neck_tilt"], "position": [PI / 2, -PI, PI / 4]},
    ),
    "early version": (
        EARLY,
        ("/body/torso/state:o", "/body/head/state:o"),
        "/body/joint_states",
        "sensor_msgs/JointState",
        {"velocity": [], "effort": [], "position": [PI / 2, -PI, PI / 4]},
    ),
    "point": (
        POINT,
        ("/tracker/data:o",),
        "/ball_point",
        "geometry_msgs/PointStamped",
        {"point": {"x": 1.0, "y": 2.0, "z": 3.0}},
    ),
    "two hubs": (
        TWO_HUBS,
        ("/head/state:o", "/inertial"),
        "/motors_inertial",
        "lab_msgs/MotorsInertial",
        {"inertial": [1.0, 2.5], "encoders": [PI / 2, PI / 4]},
    ),
}


@pytest.mark.parametrize("name", TO_ROS)
def test_rcgen_bridge_of_configuration_yarp_to_ros(
    tmp_path: Path,
    name: str,
    yarp: Tools,
    node: RospyPeer,
    bridge: Callable[..., BridgeProcess],
) -> None:
    text, ports, topic, type_, expected = TO_ROS[name]
    (tmp_path / "lab.ini").write_text(text)
    generate(tmp_path, "lab.ini", "-I", str(write_messages(tmp_path)), "-o", "out")
    if type_.startswith("lab_msgs"):
        node.command("define", type_, MOTORS_INERTIAL)
    node.command("subscribe", topic, type_)
    start_writer(yarp, *ports)
    running = bridge(tmp_path / "out")
    wait_until(lambda: len(node.command("received", topic)) > 2, lambda: running.log)
    first, *_, last = node.command("received", topic)
    assert {field: last[field] for field in expected} == expected
    if "header" in last:
        assert last["header"]["seq"] > first["header"]["seq"]
        assert last["header"]["stamp"] > first["header"]["stamp"]
        assert last["header"]["frame_id"] == ("l_camera" if name == "point" else "")


TO_YARP = {
    "command": (
        COMMAND,
        "/fakebot/motor/rpc:i",
        "/motor_control",
        ("lab_msgs/MotorControl", MOTOR_CONTROL),
        {"joint": 3, "angle": 12.5},
        "set pos 3 12.5\n",
    ),
    "point": (
        POINT_GOAL,
        "/gaze/xd:i",
        "/fixation_goal",
        ("geometry_msgs/Point", ""),
        {"x": -0.5, "y": 0.25, "z": 2.0},
        "-0.5 0.25 2.0\n",
    ),
}


@pytest.mark.parametrize("name", TO_YARP)
def test_rcgen_bridge_of_configuration_ros_to_yarp(
    tmp_path: Path,
    name: str,
    yarp: Tools,
    master: Master,
    node: RospyPeer,
    bridge: Callable[..., BridgeProcess],
) -> None:
    text, port, topic, (type_, definition), fields, line = TO_YARP[name]
    (tmp_path / "lab.ini").write_text(text)
    if definition:
        node.command("define", type_, definition)
    node.command("advertise", topic, type_)  # the master knows the type of the topic
    messages = write_messages(tmp_path)
    generate(tmp_path, "lab.ini", "-I", str(messages), "-o", "out", environment=ros(master))
    reader = yarp.start("read", port)
    running = bridge(tmp_path / "out")
    wait_until(lambda: node.command("connections", topic) == 1, lambda: running.log)
    wait_until(lambda: "lab" in yarp.run("ping", port).stdout, lambda: running.log)
    for _ in range(3):
        node.command("publish", topic, fields)
    assert yarp.line_of(reader) == line
