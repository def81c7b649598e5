"""The ROS master, or a node of ROS, is restarted."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.errors import MiddlewareError
from tests.middleware.ros1.conftest import Ros1Network
from tests.middleware.ros1.ros1_peers import Master, RospyPeer, needs_ros1
from tests.middleware.ros2.ros_messages import (
    CHAT,
    SWITCH,
    SetBoolRequest,
    SetBoolResponse,
    String,
)
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1]


@pytest.fixture
def network(lone_network: Ros1Network, own_master: Master) -> Ros1Network:
    lone_network.master = own_master.uri
    return lone_network


def test_component_registers_with_a_restarted_master(
    network: Ros1Network, own_master: Master, caplog: pytest.LogCaptureFixture
) -> None:
    base = network.component("base")
    base.serve(SWITCH, {"set": lambda _: SetBoolResponse(True, "ours")}, "Switch")
    publish, _ = base.publisher(CHAT, "Chat")
    wait_until(lambda: own_master.nodes_of(2, "/base/Switch"))
    own_master.stop()
    wait_until(lambda: "Start the master with `roscore`" in caplog.text)
    own_master.start()
    wait_until(lambda: own_master.nodes_of(2, "/base/Switch") == ["/base"])
    wait_until(lambda: own_master.nodes_of(0, "/base/Chat") == ["/base"])
    peer = RospyPeer(own_master, "late")
    try:
        peer.command("subscribe", "/base/Chat", "std_msgs/String")
        wait_until(lambda: publish(String("x")) or peer.command("received", "/base/Chat"))
        assert peer.command("call", "/base/Switch", True) == [True, "ours"]
    finally:
        peer.close()


def test_component_connects_to_a_restarted_node(network: Ros1Network, own_master: Master) -> None:
    texts: list[str] = []
    user = network.component("user")
    user.subscribe(CHAT, lambda text: texts.append(text.data), "In", "/twice/out")
    publish, _ = user.publisher(CHAT, "Out", "/twice/in")
    call = user.caller(SWITCH, "set", "Switch", "/twice/set")
    for round_ in ("first", "second"):
        peer = RospyPeer(own_master, "twice")
        try:
            wait_until(lambda: (publish(String(round_)), round_ in texts)[1])  # noqa: B023
            assert wait_until(lambda: call(SetBoolRequest(True)), ignoring=MiddlewareError).success
        finally:
            peer.close()
