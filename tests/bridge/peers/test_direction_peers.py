"""Bridges in every direction between YARP 3.5, rospy and components, with services and stamps."""

from __future__ import annotations

import uuid
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.bridge.peers import rover
from tests.bridge.peers.bridge_process import BridgeProcess
from tests.bridge.peers.running_rover import Nodes, Programs
from tests.middleware.ros1.ros1_peers import Master, needs_ros1
from tests.middleware.yarp.yarp_tools import Tools, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1, needs_yarp]
Bridges = Callable[..., BridgeProcess]
SAME_SIDE = """\
import "std_msgs/msg/Float64.msg";
import "std_msgs/msg/String.msg";

Bridge same
{
    input first : (double x [m], string name) over yarp at "/first:o";
    output second over yarp at "/second:i" { item first.name; item first.x to [mm]; };

    input speed : std_msgs::Float64 over ros1 at "/speed";
    output label : std_msgs::String over ros1 at "/label" { data = text(speed.data); };
};
"""


def test_bridge_joins_programs_of_the_same_middleware(
    tmp_path: Path, yarp_program: Programs, rospy_node: Nodes, bridge: Bridges
) -> None:
    node = rospy_node("robot")
    node.command("subscribe", "/label", "std_msgs/String")
    node.command("advertise", "/speed", "std_msgs/Float64")
    node.command("stream", "/speed", {"data": 1.25}, 0.02)
    yarp_program("write", "/first:o", [0.5, "gripper"])
    reader = yarp_program("read", "/second:i")
    running = bridge(rover.write_bridge(tmp_path, SAME_SIDE, "same"))
    wait_until(lambda: reader.messages, lambda: running.log)
    assert reader.messages[0][1] == "gripper 500.0"
    wait_until(lambda: node.command("count", "/label"), lambda: running.log)
    assert node.command("last", "/label") == {"data": "1.25"}


TO_ZENOH = """\
Bridge reader
{
    input wheels : double[2] [deg] over yarp at "/rover/wheels:o";
    output angles : double[] [rad] over zenoh = wheels;
};
"""
FROM_ZENOH = """\
import "sensor_msgs/msg/JointState.msg";
import "ReaderTypes.idsl";

Bridge writer
{
    input angles : ReaderTypes::AnglesTopic.send over zenoh at "reader";
    output states : sensor_msgs::JointState over ros1 at "/states"
    {
        header.stamp = stamp(angles);
        position = angles to [rad];
    };
};
"""


def test_bridges_join_yarp_and_ros_by_a_topic_of_zenoh(
    tmp_path: Path, yarp_program: Programs, rospy_node: Nodes, bridge: Bridges
) -> None:
    node = rospy_node("robot")
    node.command("subscribe", "/states", "sensor_msgs/JointState")
    yarp_program("write", "/rover/wheels:o", [180.0, 90.0], 0.02, 1700000000.25)
    (tmp_path / "first").mkdir()
    (tmp_path / "second").mkdir()
    first = rover.write_bridge(tmp_path / "first", TO_ZENOH, "reader")
    (tmp_path / "second" / "ReaderTypes.idsl").write_text((first / "ReaderTypes.idsl").read_text())
    second = rover.write_bridge(tmp_path / "second", FROM_ZENOH, "writer")
    domain = f"test-{uuid.uuid4().hex[:12]}"
    running = [bridge(folder, "--domain", domain) for folder in (first, second)]
    wait_until(
        lambda: node.command("count", "/states"), lambda: "\n".join(each.log for each in running)
    )
    state = node.command("last", "/states")
    assert [round(angle, 4) for angle in state["position"]] == [3.1416, 1.5708]


SERVICES = """\
import "std_srvs/srv/SetBool.srv";
import "Motors.idsl";

Bridge services
{
    service enable : std_srvs::SetBool over ros1 at "/enable"
    {
        call motors : Motors::Motors.setPower over yarp at "/motors/rpc:i" { on = request.data; };
        success = motors.result;
        message = text(motors.result);
    };
    service lights : Motors::Motors.setPower over yarp at "/lights/rpc:i"
    {
        call switch : std_srvs::SetBool over ros1 at "/switch" { data = request.on; };
        result = switch.success;
    };
};
"""
MOTORS = "module Motors { interface Motors { bool setPower(bool on); }; };"


def test_bridge_joins_services_of_ros_and_rpc_of_yarp(
    tmp_path: Path,
    yarp: Tools,
    yarp_program: Programs,
    master: Master,
    rospy_node: Nodes,
    bridge: Bridges,
) -> None:
    (tmp_path / "Motors.idsl").write_text(MOTORS)
    server = yarp_program("serve", "/motors/rpc:i", [1])
    rospy_node("robot").command("serve", "/switch")
    running = bridge(rover.write_bridge(tmp_path, SERVICES, "services"))
    wait_until(lambda: master.nodes_of(2, "/enable"), lambda: running.log)
    reply = ""

    def called() -> bool:
        nonlocal reply
        reply = master.run("rosservice", "call", "/enable", "data: true")
        return "success: True" in reply

    wait_until(called, lambda: f"{running.log} {reply}")
    assert server.messages[-1] == ["request", "setPower true"]
    wait_until(lambda: yarp.knows("/lights/rpc:i"), lambda: running.log)
    output = yarp.run("rpc", "/lights/rpc:i", text="setPower 1\nsetPower 0\n").stdout
    assert "Response: [ok] true\n" in output
    assert "Response: [ok] false\n" in output
    server.kill()
    place = rover.line_of("service enable", SERVICES, "services.bdsl")
    failed = (
        "tcp:/motors/rpc:i) cannot be reached: Connection refused; start it, or correct its"
        f" address ({place})"
    )
    answer = master.run("rosservice", "call", "/enable", "data: true")
    assert failed in answer
    assert ".py" not in answer
    yarp_program("serve", "/motors/rpc:i", [1])
    wait_until(called, lambda: f"{running.log} {reply}")
    log = running.ended()
    assert f"service `enable`: failed: motors_rpc_i ({failed}" in log
    assert "failed (a call failed: 1)" in log
    assert " error: " not in log


STAMPS = """\
import "sensor_msgs/msg/JointState.msg";

Bridge stamps
{
    input wheels : double[2] [deg] over yarp at "/rover/wheels:o";
    output states : sensor_msgs::JointState over ros1 at "/states"
    {
        header.stamp = stamp(wheels);
        position = wheels to [rad];
    };

    input joints : sensor_msgs::JointState over ros1 at "/joints";
    output angles : sensor_msgs::JointState over yarp at "/angles:i" = joints;
};
"""


def test_bridge_carries_time_stamps_both_ways(
    tmp_path: Path, yarp_program: Programs, rospy_node: Nodes, bridge: Bridges
) -> None:
    node = rospy_node("robot")
    node.command("subscribe", "/states", "sensor_msgs/JointState")
    node.command("advertise", "/joints", "sensor_msgs/JointState")
    yarp_program("write", "/rover/wheels:o", [180.0, 90.0], 0.02, 1700000000.25)
    reader = yarp_program("read", "/angles:i")
    running = bridge(rover.write_bridge(tmp_path, STAMPS, "stamps"))
    wait_until(lambda: node.command("count", "/states"), lambda: running.log)
    state = node.command("last", "/states")
    assert state["header"]["stamp"] == [1_700_000_000, 250_000_000]
    node.command("stream_stamped", "/joints", [1_600_000_000, 500_000_000], 0.02)
    wait_until(lambda: reader.messages, lambda: running.log)
    assert reader.messages[0][2] == 1_600_000_000.5


WIDTH, HEIGHT = 700, 500
"""1 MB in `rgb8`."""
IMAGES = """\
import "sensor_msgs/msg/Image.msg";

Bridge images
{
    input eye : sensor_msgs::Image over yarp at "/eye:o" { best_effort; depth 2; };
    output camera : sensor_msgs::Image over ros1 at "/camera" = eye
    {
        header.stamp = stamp(eye);
        header.frame_id = "eye";
    };

    input view : sensor_msgs::Image over ros1 at "/view" { best_effort; depth 2; };
    output screen : sensor_msgs::Image over yarp at "/screen:i" = view;
};
"""


def test_bridge_carries_images_of_1_mb_at_30_hz(
    tmp_path: Path, yarp_program: Programs, rospy_node: Nodes, bridge: Bridges
) -> None:
    node, camera = rospy_node("robot"), rospy_node("camera")
    node.command("subscribe", "/camera", "sensor_msgs/Image")
    yarp_program("write_images", "/eye:o", WIDTH, HEIGHT, 1 / 30)
    screen = yarp_program("read_images", "/screen:i")
    running = bridge(rover.write_bridge(tmp_path, IMAGES, "images"))
    camera.command("stream_images", "/view", "rgb8", WIDTH, HEIGHT, 1 / 30)
    wait_until(lambda: len(screen.messages) > 10, lambda: running.log)
    wait_until(lambda: node.command("count", "/camera") > 10, lambda: running.log)
    _, size, first, last, stamp = screen.messages[-1]
    assert (size, last) == ([WIDTH, HEIGHT], [0, 0, 77])
    assert first == [int(stamp - 1_700_000_000) % 256, 0, 0]
    image = node.command("last", "/camera")
    assert (image["encoding"], image["width"], image["height"]) == ("rgb8", WIDTH, HEIGHT)
    assert image["header"]["frame_id"] == "eye"
    assert image["data"]["bytes"] == image["step"] * HEIGHT
    assert image["data"]["sum"] >= 77
    assert "lost" not in running.ended()
