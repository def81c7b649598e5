from __future__ import annotations

import uuid
from collections.abc import Callable, Iterator

import pytest

from tests.middleware.ros1.ros1_peers import Master, RospyPeer
from tests.middleware.ros2.ros_network import NO_MASTER, RosComponent, RosNetwork


class Ros1Network(RosNetwork):
    """A domain whose components use one ROS master."""

    master = NO_MASTER

    @property
    def settings(self) -> dict[tuple[str, str], str]:
        return {(self.kind, "master"): self.master, (self.kind, "host"): "127.0.0.1"}


@pytest.fixture(scope="session")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Master]:
    started = Master(tmp_path_factory.mktemp("ros1"))
    yield started
    started.stop()


@pytest.fixture
def own_master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Master]:
    """A master that a test may end."""
    started = Master(tmp_path_factory.mktemp("ros1"))
    yield started
    started.stop()


@pytest.fixture
def lone_network() -> Iterator[Ros1Network]:
    """Components without a master."""
    network = Ros1Network("ros1")
    yield network
    network.close()


@pytest.fixture
def ros1_network(lone_network: Ros1Network, master: Master) -> Ros1Network:
    lone_network.master = master.uri
    return lone_network


@pytest.fixture
def component(ros1_network: Ros1Network) -> Callable[..., RosComponent]:
    """Opens components under names that no other test uses."""

    def open_component(name: str, threads: int = 1, **addresses: str) -> RosComponent:
        return ros1_network.component(f"{name}_{uuid.uuid4().hex[:6]}", threads, **addresses)

    return open_component


@pytest.fixture(scope="session")
def rospy(master: Master) -> Iterator[RospyPeer]:
    peer = RospyPeer(master, "peer")
    yield peer
    peer.close()
