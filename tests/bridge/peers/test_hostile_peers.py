"""Bytes that are no messages arrive at the ports of a bridge, and types change."""

from __future__ import annotations

import contextlib
import os
import re
import socket
from urllib.parse import urlsplit

import pytest

from robocomp_dsl.runtime.middleware.ros1 import tcpros
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi
from robocomp_dsl.runtime.middleware.yarp import wire
from tests.bridge.peers import rover
from tests.bridge.peers.running_rover import Nodes, Programs, Rover
from tests.middleware.ros1.ros1_peers import LOOPBACK, TIMEOUT_S, Master, RospyPeer, needs_ros1
from tests.middleware.yarp.yarp_tools import Tools, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1, needs_yarp]
WHEELS_LINE = rover.line_of("input wheels")
SPEED_LINE = rover.line_of("input speed")


def send(host: str, number: int, *parts: bytes) -> None:
    """Open a connection, send bytes, and read until the other side closes it or is silent."""
    with socket.create_connection((host, number), 10) as connection, contextlib.suppress(OSError):
        connection.settimeout(0.2)
        for part in parts:
            connection.sendall(part)
        while connection.recv(4096):
            pass


def yarp_garbage() -> list[tuple[bytes, ...]]:
    """What may arrive at a port of YARP: no carrier, wrong lengths, broken Bottles."""
    hello = wire.set_up("fast_tcp", "/garbage")
    return [
        (b"\0" * 64,),
        (os.urandom(4096),),
        (b"GET / HTTP/1.1\r\n\r\n",),
        (hello[:8], b"\xff\xff\xff\xff"),
        (hello, os.urandom(256)),
        (hello, wire.INDEX, b"\xff" * 10),
        (b"CONNECT /garbage\n", b"d\n((((((\n", b'd\n1 2 "open\n', b"d\nleft right\n"),
        (b"CONNECT " + b"x" * 100_000,),
    ]


def ros_garbage() -> list[tuple[bytes, ...]]:
    """What may arrive at the TCPROS port of a node: no header, wrong lengths, other types."""
    header = {"callerid": "/garbage", "topic": rover.ANGLES, "type": "std_msgs/String"}
    return [
        (b"\0" * 64,),
        (os.urandom(4096),),
        (b"GET / HTTP/1.1\r\n\r\n",),
        (b"\xff\xff\xff\xff",),
        (tcpros.encode_header({}),),
        (tcpros.encode_header(header),),
        (tcpros.encode_header(header | {"md5sum": "0" * 32}), os.urandom(64)),
        (tcpros.encode_header({"topic": "/nothing", "md5sum": "*"}),),
        (tcpros.encode_header({"service": "/nothing", "md5sum": "*"}), os.urandom(64)),
    ]


def test_bridge_survives_garbage_at_its_yarp_port(running: Rover, yarp: Tools) -> None:
    at = yarp.address_of("/rover/wheels:i")
    for parts in yarp_garbage():
        send(at.host, at.number, *parts)
        running.wait_for_more()
    log = running.finish()
    assert re.search(rf"rejected a message for wheels.*/garbage.*\({WHEELS_LINE}\)", log), log
    (malformed,) = re.findall(r"input `wheels`: .* (\d+) malformed", log)
    assert int(malformed) >= 3, log


def test_bridge_survives_garbage_at_its_tcpros_port(running: Rover, master: Master) -> None:
    node = RosApi(master.ask("lookupNode", "/rover"), TIMEOUT_S)
    _, host, number = node.call("requestTopic", "/test", rover.ANGLES, [["TCPROS"]])
    for parts in ros_garbage():
        send(host, number, *parts)
        running.wait_for_more()
    at = urlsplit(master.ask("lookupNode", "/rover"))
    for parts in ros_garbage():
        send(at.hostname or LOOPBACK, at.port or 0, *parts)
        running.wait_for_more()
    node.close()
    log = running.finish()
    assert "a peer sent an invalid header" in log
    assert "refused a subscriber: /garbage subscribes to /rover/angles as std_msgs/String" in log


@pytest.mark.parametrize("size", [0, 3, 9])
def test_bridge_survives_malformed_messages_of_a_rospy_publisher(
    running: Rover, rospy_node: Nodes, size: int
) -> None:
    peer = rospy_node("garbage")
    peer.command("advertise_malformed", rover.SPEED, rover.SPEED_TYPE, size)
    wait_until(lambda: peer.command("connections", rover.SPEED) == 1, running.log)
    for _ in range(3):
        peer.command("publish", rover.SPEED, {})
    rejected = rf"rejected a message for speed.*/garbage.*\({SPEED_LINE}\)"
    wait_until(lambda: re.search(rejected, running.log()), running.log)
    running.wait_for_more()
    log = running.finish()
    assert re.search("input `speed`: .* 3 malformed", log), log


@pytest.mark.parametrize(
    ("items", "reason"),
    [
        (["left", "right"], "takes numbers (float64), not 'left' (str)"),
        ([90.0, 45.0, 30.0], "takes 2 items, not 3"),
        ([], "takes 2 items, not 0"),
    ],
)
def test_bridge_reports_yarp_writer_with_another_shape(
    running: Rover, yarp_program: Programs, items: list[object], reason: str
) -> None:
    running.writer.kill()
    changed = yarp_program("write", rover.WHEELS, items)
    wait_until(lambda: WHEELS_LINE in running.log(), running.log)
    changed.kill()
    writer = yarp_program("write", rover.WHEELS, [180.0, 45.0])
    wait_until(lambda: running.last_angle() == 180.0, running.log)
    rover.report_time("YARP writer with the former shape", writer.ready_at)
    log = running.finish()
    assert reason in log


def publish_string(peer: RospyPeer) -> None:
    peer.command("advertise", rover.SPEED, "std_msgs/String")
    peer.command("stream", rover.SPEED, {"data": "fast"}, 0.02)


def test_bridge_reports_ros_topic_with_another_type(running: Rover, rospy_node: Nodes) -> None:
    running.publisher.close()
    wait_until(lambda: "the publisher /publisher ended" in running.log(), running.log)
    changed = rospy_node("publisher")
    publish_string(changed)
    wait_until(lambda: SPEED_LINE in running.log(), running.log)
    changed.close()
    running.start_publisher(0.75)
    wait_until(lambda: running.last_command() == "speed 0.75", running.log)
    log = running.finish()
    assert "std_msgs/String" in log
    assert "std_msgs/Float64" in log


def test_bridge_reports_ros_subscriber_with_another_type(running: Rover, rospy_node: Nodes) -> None:
    changed = rospy_node("changed")
    changed.command("subscribe", rover.ANGLES, "std_msgs/String")
    wait_until(lambda: "std_msgs/String" in running.log(), running.log)
    running.wait_for_more()
    running.finish()
