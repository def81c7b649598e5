"""A master of ROS 1, a name server of YARP, and bridges between their programs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.bridge.peers.bridge_process import BridgeProcess
from tests.middleware.ros1.ros1_peers import Master, RospyPeer
from tests.middleware.yarp.yarp_tools import Tools, free_port


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
    yield tools
    tools.close()


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


def ros(master: Master) -> dict[str, str]:
    """The variables of a program that uses a master."""
    return {"ROS_MASTER_URI": master.uri, "ROS_HOSTNAME": "127.0.0.1"}
