"""The bridge of `rover` with a program on each side, while data flows both ways."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

from tests.bridge.peers import rover
from tests.bridge.peers.bridge_process import BridgeProcess
from tests.bridge.peers.yarp_peers import YarpProgram
from tests.middleware.ros1.ros1_peers import RospyPeer
from tests.support.waiting import wait_until

Programs: TypeAlias = Callable[..., YarpProgram]
Nodes: TypeAlias = Callable[[str], RospyPeer]


class Rover:
    """A writer, a reader and an RPC server of YARP; a publisher and a subscriber of rospy."""

    def __init__(
        self, folder: Path, programs: Programs, nodes: Nodes, bridge: Callable[..., BridgeProcess]
    ) -> None:
        self._nodes = nodes
        self.writer = programs("write", rover.WHEELS, [90.0, 45.0])
        self.reader = programs("read", rover.COMMAND)
        self.server = programs("serve", rover.SETTING, ["ok"])
        self.publisher = self.start_publisher(0.5)
        self.subscriber = self.start_subscriber()
        self.bridge = bridge(rover.write_bridge(folder))
        wait_until(lambda: self.reader.messages and self.server.messages, self.log, 25)
        wait_until(lambda: self.subscriber.command("count", rover.ANGLES), self.log)

    def log(self) -> str:
        """What the bridge has logged."""
        return self.bridge.log

    def start_publisher(self, speed: float) -> RospyPeer:
        """Start a node that publishes a speed."""
        peer = self._nodes("publisher")
        peer.command("advertise", rover.SPEED, rover.SPEED_TYPE)
        peer.command("stream", rover.SPEED, {"data": speed}, 0.02)
        return peer

    def start_subscriber(self) -> RospyPeer:
        """Start a node that receives the angles."""
        peer = self._nodes("subscriber")
        peer.command("subscribe", rover.ANGLES, rover.ANGLES_TYPE)
        return peer

    def last_angle(self) -> float:
        """The first of the angles that arrived last, in degrees."""
        last = self.subscriber.command("last", rover.ANGLES)
        return round(float(last["data"][0]), 4) if last else 0.0

    def last_command(self) -> Any:
        """The newest message at the reader."""
        return self.reader.messages[-1][1]

    def wait_for_more(self) -> None:
        """Wait until more data has passed in both directions."""
        commands = len(self.reader.messages) + 5
        angles = self.subscriber.command("count", rover.ANGLES) + 5
        wait_until(lambda: len(self.reader.messages) > commands, self.log)
        wait_until(lambda: self.subscriber.command("count", rover.ANGLES) > angles, self.log)

    def finish(self) -> str:
        """End the bridge, which must still run; returns its log, with its counts."""
        assert self.bridge.is_running
        log = self.bridge.ended()
        assert "Traceback" not in log
        return log
