"""Programs on either side of a bridge, and their name services, end and start again."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.bridge.peers import rover
from tests.bridge.peers.bridge_process import BridgeProcess
from tests.bridge.peers.yarp_peers import YarpProgram
from tests.middleware.ros1.ros1_peers import Master, RospyPeer, needs_ros1
from tests.middleware.yarp.yarp_tools import Tools, needs_yarp
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1, needs_yarp]
Programs = Callable[..., YarpProgram]
Nodes = Callable[[str], RospyPeer]


class Rover:
    """The bridge with a program on each side, while data flows both ways."""

    def __init__(
        self, folder: Path, programs: Programs, nodes: Nodes, bridge: Callable[..., BridgeProcess]
    ) -> None:
        self._programs = programs
        self._nodes = nodes
        self.writer = programs("write", rover.WHEELS, [90.0, 45.0])
        self.reader = programs("read", rover.COMMAND)
        self.server = programs("serve", rover.REQUEST, ["ok"])
        self.publisher = self.start_publisher(0.5)
        self.subscriber = self.start_subscriber()
        self.bridge = bridge(rover.write_bridge(folder))
        wait_until(lambda: self.reader.messages and self.server.messages, self.log)
        wait_until(lambda: self.subscriber.command("count", rover.ANGLES), self.log)

    def log(self) -> str:
        return self.bridge.log

    def start_publisher(self, speed: float) -> RospyPeer:
        peer = self._nodes("publisher")
        peer.command("advertise", rover.SPEED, rover.SPEED_TYPE)
        peer.command("stream", rover.SPEED, {"data": speed}, 0.02)
        return peer

    def start_subscriber(self) -> RospyPeer:
        peer = self._nodes("subscriber")
        peer.command("subscribe", rover.ANGLES, rover.ANGLES_TYPE)
        return peer

    def last_angle(self) -> float:
        last = self.subscriber.command("last", rover.ANGLES)
        return round(float(last["data"][0]), 4) if last else 0.0

    def finish(self) -> dict[str, str]:
        """End the bridge, which must still run; returns its counts by input and output."""
        assert self.bridge.is_running
        log = self.bridge.ended()
        assert "Traceback" not in log
        return {
            name: next(line for line in log.splitlines() if f"`{name}`:" in line and " se" in line)
            for name in ("angles", "command", "setting")
        }


@pytest.fixture
def running(
    tmp_path: Path,
    yarp_program: Programs,
    rospy_node: Nodes,
    bridge: Callable[..., BridgeProcess],
) -> Rover:
    return Rover(tmp_path, yarp_program, rospy_node, bridge)


def test_bridge_reads_a_restarted_yarp_writer(running: Rover, yarp_program: Programs) -> None:
    running.writer.kill()
    wait_until(lambda: "wheels" in running.log(), running.log)
    writer = yarp_program("write", rover.WHEELS, [180.0, 45.0])
    wait_until(lambda: running.last_angle() == 180.0, running.log)
    rover.report_time("YARP writer restarted", writer.ready_at)
    running.finish()
    print(running.log())


def test_bridge_writes_to_restarted_yarp_readers(running: Rover, yarp_program: Programs) -> None:
    for mode, port, name in (
        ("read", rover.COMMAND, "reader"),
        ("serve", rover.REQUEST, "server"),
    ):
        getattr(running, name).kill()
        program = yarp_program(mode, port, *([["ok"]] if mode == "serve" else []))
        wait_until(lambda: program.messages, running.log)  # noqa: B023
        rover.report_time(f"YARP {name} restarted", program.ready_at, lambda: program.times[1])
    counts = running.finish()
    print(counts, running.log())


def test_bridge_joins_restarted_ros_nodes(running: Rover) -> None:
    running.subscriber.close()
    running.subscriber = running.start_subscriber()
    begun = time.monotonic()
    wait_until(lambda: running.subscriber.command("count", rover.ANGLES), running.log)
    rover.report_time("rospy subscriber restarted", begun)
    running.publisher.close()
    publisher = running.start_publisher(0.75)
    begun = time.monotonic()
    wait_until(lambda: running.reader.messages[-1][1] == "speed 0.75", running.log)
    rover.report_time("rospy publisher restarted", begun)
    assert publisher
    running.finish()
    print(running.log())


def test_bridge_continues_when_yarpserver_restarts(
    running: Rover, yarp: Tools, yarp_program: Programs
) -> None:
    yarp.restart_name_server()
    count = len(running.reader.messages)
    wait_until(lambda: len(running.reader.messages) > count + 20, running.log)
    # The restarted server knows no ports, so programs of YARP must start again to be found.
    wait_until(lambda: yarp.run("exists", "/rover/command:o").returncode is not None)
    running.writer.kill()
    running.reader.kill()
    writer = yarp_program("write", rover.WHEELS, [180.0, 45.0])
    reader = yarp_program("read", rover.COMMAND)
    wait_until(lambda: running.last_angle() == 180.0, running.log)
    rover.report_time("yarpserver and YARP writer restarted", writer.ready_at)
    wait_until(lambda: reader.messages, running.log)
    rover.report_time("yarpserver and reader restarted", reader.ready_at, lambda: reader.times[1])
    running.finish()
    print(running.log())


def test_bridge_continues_when_rosmaster_restarts(running: Rover, master: Master) -> None:
    master.stop()
    wait_until(lambda: "roscore" in running.log(), running.log)
    count: Any = len(running.reader.messages)
    wait_until(lambda: len(running.reader.messages) > count + 20, running.log)
    master.start()
    begun = time.monotonic()
    wait_until(lambda: master.nodes_of(0, rover.ANGLES), running.log)
    rover.report_time("rosmaster restarted: registered again", begun)
    running.subscriber.close()
    running.publisher.close()
    running.subscriber = running.start_subscriber()
    begun = time.monotonic()
    wait_until(lambda: running.subscriber.command("count", rover.ANGLES), running.log)
    rover.report_time("rosmaster and subscriber restarted", begun)
    running.start_publisher(0.75)
    begun = time.monotonic()
    wait_until(lambda: running.reader.messages[-1][1] == "speed 0.75", running.log)
    rover.report_time("rosmaster and publisher restarted", begun)
    running.finish()
    print(running.log())
