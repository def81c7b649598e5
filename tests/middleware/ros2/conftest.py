from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.middleware.ros2.ros_network import RosNetwork

CYCLONE_ON_LOOPBACK = (
    '<CycloneDDS><Domain><General><Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces>'
    "<AllowMulticast>false</AllowMulticast></General><Discovery>"
    "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>"
    '<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>'
)
RMW_ZENOH = "rmw_zenoh"
ROS2 = pytest.param("ros2", marks=pytest.mark.peers)
DDS = pytest.param("dds", marks=pytest.mark.peers)


@pytest.fixture(autouse=True)
def loopback_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """No DDS packet leaves the machine, in this process and its children."""
    monkeypatch.setenv("CYCLONEDDS_URI", CYCLONE_ON_LOOPBACK)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)


MODULES = {"rmw_zenoh": "zenoh", "ros2": "rclpy", "dds": "cyclonedds"}


def _network(kind: str) -> Iterator[RosNetwork]:
    pytest.importorskip(MODULES[kind], reason="`make test-peers` runs it in build/peers-venv")
    opened = RosNetwork(kind)
    yield opened
    opened.close()


@pytest.fixture(params=[RMW_ZENOH, ROS2, DDS])
def ros_network(request: pytest.FixtureRequest) -> Iterator[RosNetwork]:
    """Every middleware of ROS 2."""
    yield from _network(request.param)


@pytest.fixture(params=[RMW_ZENOH, ROS2])
def service_network(request: pytest.FixtureRequest) -> Iterator[RosNetwork]:
    """Those that have services."""
    yield from _network(request.param)


@pytest.fixture
def zenoh_network() -> Iterator[RosNetwork]:
    yield from _network("rmw_zenoh")
