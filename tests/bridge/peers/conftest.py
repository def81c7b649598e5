"""A master of ROS 1, a name server of YARP, and bridges between their programs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.bridge.peers.bridge_process import BridgeProcess
from tests.bridge.peers.running_rover import Nodes, Programs, Rover
from tests.bridge.peers.yarp_peers import YarpProgram
from tests.middleware.ros1.ros1_peers import Master, RospyPeer
from tests.middleware.yarp.yarp_tools import Tools, free_port
from tests.support.waiting import wait_until


@pytest.fixture
def master(tmp_path: Path) -> Iterator[Master]:
    folder = tmp_path / "ros"
    folder.mkdir()
    running = Master(folder)
    yield running
    running.stop()


@pytest.fixture
def node(master: Master) -> Iterator[RospyPeer]:
    peer = RospyPeer(master, "robot")
    yield peer
    peer.close()


@pytest.fixture
def yarp(tmp_path: Path) -> Iterator[Tools]:
    home = tmp_path / "yarp"
    home.mkdir()
    tools = Tools(home, free_port())
    tools.start_name_server()
    wait_until(lambda: tools.knows("/root"))
    yield tools
    tools.close()


@pytest.fixture
def yarp_program(yarp: Tools) -> Iterator[Callable[..., YarpProgram]]:
    """Starts programs of YARP."""
    started: list[YarpProgram] = []

    def start(*command: Any) -> YarpProgram:
        started.append(YarpProgram(yarp, *command))
        return started[-1]

    yield start
    for program in started:
        program.kill()


@pytest.fixture
def rospy_node(master: Master) -> Iterator[Callable[[str], RospyPeer]]:
    """Starts nodes of rospy."""
    started: list[RospyPeer] = []

    def start(name: str) -> RospyPeer:
        started.append(RospyPeer(master, name))
        return started[-1]

    yield start
    for peer in started:
        peer.close()


@pytest.fixture
def bridge(master: Master, yarp: Tools) -> Iterator[Callable[..., BridgeProcess]]:
    """Starts the bridge in a folder; it ends with the test."""
    started: list[BridgeProcess] = []

    def start(folder: Path, *arguments: str) -> BridgeProcess:
        started.append(BridgeProcess(folder, yarp.environment | ros(master), *arguments))
        return started[-1]

    yield start
    for process in started:
        process.close()


@pytest.fixture
def running(
    tmp_path: Path,
    yarp_program: Programs,
    rospy_node: Nodes,
    bridge: Callable[..., BridgeProcess],
) -> Rover:
    """A bridge through which data flows both ways."""
    return Rover(tmp_path, yarp_program, rospy_node, bridge)


def ros(master: Master) -> dict[str, str]:
    """The variables of a program that uses a master."""
    return {"ROS_MASTER_URI": master.uri, "ROS_HOSTNAME": "127.0.0.1"}
