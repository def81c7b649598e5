"""A bridge between rospy and rclpy, in both directions; it runs where both are installed."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.bridge.peers import rover
from tests.bridge.peers.bridge_process import BridgeProcess
from tests.bridge.peers.conftest import ros
from tests.bridge.peers.running_rover import Nodes
from tests.middleware.ros1.ros1_peers import Master, needs_ros1
from tests.middleware.ros2.peer_process import PeerProcess
from tests.middleware.ros2.ros_network import next_domain_id
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1]
BRIDGE = """\
import "std_msgs/msg/String.msg";
import "std_srvs/srv/SetBool.srv";

Bridge words
{
    input first : std_msgs::String over ros1 at "/first";
    output second : std_msgs::String over ros2 at "/peer/in" = first;
    input third : std_msgs::String over ros2 at "/peer/out";
    output fourth : std_msgs::String over ros1 at "/fourth" = third;
    service enable : std_srvs::SetBool over ros1 at "/enable"
    {
        call peer : std_srvs::SetBool over ros2 at "/peer/set" { data = request.data; };
        success = peer.success;
        message = peer.message;
    };
};
"""


def test_bridge_joins_rospy_and_rclpy(
    tmp_path: Path, master: Master, rospy_node: Nodes, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("rclpy", reason="`make test-peers` runs it in build/peers-venv")
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    domain = str(next_domain_id())
    monkeypatch.setenv("ROS_DOMAIN_ID", domain)
    for name, value in ros(master).items():
        monkeypatch.setenv(name, value)
    folder = rover.write_bridge(tmp_path, BRIDGE, "words")
    peer = PeerProcess("rclpy_peer", domain)
    try:
        _check_both_ways(folder, rospy_node)
    finally:
        peer.close()


def _check_both_ways(folder: Path, rospy_node: Nodes) -> None:
    node = rospy_node("robot")
    node.command("subscribe", "/fourth", "std_msgs/String")
    node.command("advertise", "/first", "std_msgs/String")
    node.command("stream", "/first", {"data": "over ROS 2 and back"}, 0.05)
    bridge = BridgeProcess(folder, dict(os.environ))
    try:
        wait_until(lambda: node.command("count", "/fourth"), lambda: bridge.log)
        assert node.command("last", "/fourth") == {"data": "over ROS 2 and back"}
        assert node.command("call", "/enable", True) == [True, "rclpy"]
    finally:
        bridge.close()
