"""Components of ours and programs that others wrote: rclpy on Fast DDS, and zenoh-ros2-sdk.

`make test-peers` installs them into build/peers-venv.
"""

from __future__ import annotations

import random
from collections.abc import Iterator

import numpy as np
import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from tests.middleware.ros2.peer_process import PEERS, PeerProcess, start_peer
from tests.middleware.ros2.ros_messages import (
    CHAT,
    SCAN,
    SWITCH,
    Header,
    LaserScan,
    SetBoolRequest,
    SetBoolResponse,
    String,
    Time,
)
from tests.middleware.ros2.ros_network import RosNetwork
from tests.support.waiting import wait_until

pytestmark = pytest.mark.peers
MUTATIONS = 300


@pytest.fixture
def peer(request: pytest.FixtureRequest) -> Iterator[PeerProcess]:
    """The peer that the middleware of the test can reach."""
    fixture = "ros_network" if "ros_network" in request.fixturenames else "service_network"
    process = start_peer(request.getfixturevalue(fixture))
    yield process
    process.close()


def test_peer_receives_and_sends_topics(ros_network: RosNetwork, peer: PeerProcess) -> None:
    received: list[str] = []
    component = ros_network.component("component", Out="/peer/in")
    component.subscribe(CHAT, lambda text: received.append(text.data), "In", "/peer/out")
    publish, _ = component.publisher(CHAT, "Out")
    wait_until(lambda: (publish(String("grüße an ROS")), received)[1])
    assert set(received) == {"grüße an ROS"}
    assert component.counts("In", "said").malformed == 0


def test_peer_service_is_called(service_network: RosNetwork, peer: PeerProcess) -> None:
    user = service_network.component("user")
    for data in (True, False):
        reply = user.answered(SWITCH, "set", "Switch", "/peer/set", request=SetBoolRequest(data))
        assert reply == SetBoolResponse(data, PEERS[service_network.kind])


def test_peer_calls_a_service_of_a_component(
    service_network: RosNetwork, peer: PeerProcess
) -> None:
    lamp = service_network.component("lamp", Switch="/lamp/on")
    lamp.serve(SWITCH, {"set": lambda r: SetBoolResponse(r.data, "component")}, "Switch")
    reply = wait_until(lambda: peer.command("call", "/lamp/on"))
    assert reply == [True, "component"]


def test_peer_that_comes_late_receives_a_latched_topic(
    ros_network: RosNetwork, peer: PeerProcess
) -> None:
    component = ros_network.component("component", Map="/robot_map")
    publish, _ = component.publisher(CHAT, "Map", qos=Qos(latched=True, depth=1))
    publish(String("old"))
    publish(String("latest"))
    peer.command("subscribe", "/robot_map", "latched")
    wait_until(lambda: peer.command("received", "/robot_map"))
    assert peer.command("received", "/robot_map") == ["latest"]


def test_peer_sends_malformed_messages(ros_network: RosNetwork, peer: PeerProcess) -> None:
    received: list[str] = []
    component = ros_network.component("component")
    component.subscribe(CHAT, lambda text: received.append(text.data), "In", "/talk")
    wait_until(lambda: peer.command("subscribers", "/talk"))
    generator = random.Random(12)
    valid = bytes.fromhex("000100000600000068656c6c6f00")
    for _ in range(MUTATIONS):
        data = bytearray(valid)
        for _ in range(generator.randint(1, 4)):
            data[generator.randrange(len(data))] = generator.randrange(256)
        peer.command("raw", "/talk", bytes(data[: generator.randint(1, len(data))]).hex())
    wait_until(lambda: (peer.command("publish", "/talk", "done"), "done" in received)[1])
    assert component.failures == []
    counts = component.counts("In", "said")
    assert counts.failures == counts.malformed


@pytest.mark.parametrize("ros_network", ["ros2", "dds"], indirect=True)
def test_peer_echoes_numbers_and_arrays(ros_network: RosNetwork, peer: PeerProcess) -> None:
    received: list[LaserScan] = []
    component = ros_network.component("component", Out="/peer/scan_in")
    component.subscribe(SCAN, received.append, "In", "/peer/scan_out")
    publish, _ = component.publisher(SCAN, "Out")
    scan = LaserScan(
        Header(Time(-1, 4_294_967_295), "läser"),
        angle_min=-1.5,
        range_max=30.0,
        ranges=np.linspace(0, 30, 1081, dtype=np.float32),
    )
    wait_until(lambda: (publish(scan), received)[1])
    assert received[0] == scan


@pytest.mark.parametrize("ros_network", ["ros2", "dds"], indirect=True)
def test_peer_topic_that_is_latched_reaches_a_component(
    ros_network: RosNetwork, peer: PeerProcess
) -> None:
    received: list[str] = []
    component = ros_network.component("component")
    component.subscribe(
        CHAT, lambda m: received.append(m.data), "Map", "/peer/map", qos=Qos(latched=True, depth=1)
    )
    wait_until(lambda: received)
    assert received == ["latched by rclpy"]
