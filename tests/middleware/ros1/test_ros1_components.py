"""Components exchange messages and services of ROS without a master."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.errors import InterfaceMismatch, RemoteError
from tests.middleware.ros1.conftest import Ros1Network
from tests.middleware.ros2.ros_messages import (
    BASE,
    OTHER_SWITCH,
    SCAN,
    SWITCH,
    Header,
    LaserScan,
    SetBoolRequest,
    SetBoolResponse,
    String,
    Time,
    TriggerRequest,
    TriggerResponse,
)
from tests.support.waiting import wait_until


def answer(request: SetBoolRequest) -> SetBoolResponse:
    if not request.data:
        raise ValueError("no light")
    return SetBoolResponse(True, "ünder")


def test_component_receives_messages_of_ros(lone_network: Ros1Network) -> None:
    scans: list[LaserScan] = []
    lone_network.component("mapper").subscribe(SCAN, scans.append, "Scan", "laser")
    publish, _ = lone_network.component("laser").publisher(SCAN, "Scan")
    scan = LaserScan(Header(Time(1, 2), "front"), ranges=[1.0, 2.5])
    wait_until(lambda: publish(scan) or scans)
    assert scans[0] == scan


def test_component_calls_services_of_ros(lone_network: Ros1Network) -> None:
    texts: list[str] = []
    handlers = {
        "enable": answer,
        "stop": lambda _: TriggerResponse(True, "stopped"),
        "say": lambda text: texts.append(text.data),
    }
    lone_network.component("left/base-1").serve(BASE, handlers, "Base")
    user = lone_network.component("left/user")
    enable = user.caller(BASE, "enable", "Base")
    assert enable(SetBoolRequest(True)) == SetBoolResponse(True, "ünder")
    with pytest.raises(RemoteError, match="ValueError: no light"):
        enable(SetBoolRequest(False))
    assert user.caller(BASE, "stop", "Base")(TriggerRequest()).message == "stopped"
    user.caller(BASE, "say", "Base")(String("hello"))
    wait_until(lambda: texts == ["hello"])


def test_component_with_another_version_of_an_interface_is_refused(
    lone_network: Ros1Network,
) -> None:
    lone_network.component("lamp").serve(SWITCH, {"set": answer}, "Switch")
    call = lone_network.component("user").caller(OTHER_SWITCH, "set", "Switch", "lamp")
    with pytest.raises(InterfaceMismatch):
        call(TriggerRequest())
