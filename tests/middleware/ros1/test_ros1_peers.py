"""Components and programs of ROS Noetic: rospy, rostopic, rosservice, rosnode."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import InterfaceMismatch, MiddlewareError, NoServer, RemoteError
from robocomp_dsl.runtime.middleware.ros1.graph import topic_publishers, topic_type
from tests.middleware.ros1.ros1_messages import CUSTOM_TEXT, CUSTOMS, IMAGES, Custom, Image
from tests.middleware.ros1.ros1_peers import Master, RospyPeer, needs_ros1
from tests.middleware.ros2.ros_messages import (
    BASE,
    CHAT,
    OTHER_CHAT,
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
from tests.middleware.ros2.ros_network import RosComponent
from tests.support.waiting import wait_until

pytestmark = [pytest.mark.peers, needs_ros1]
Open = Callable[..., RosComponent]
BYTES = 1 << 20


def answer(request: SetBoolRequest) -> SetBoolResponse:
    if not request.data:
        raise ValueError("no light")
    return SetBoolResponse(True, "ünder")


def test_rospy_receives_publications_with_counted_headers(
    component: Open, rospy: RospyPeer
) -> None:
    base = component("base")
    publish, channel = base.publisher(SCAN, "Scan")
    topic = f"/{base.name}/Scan"
    rospy.command("subscribe", topic, "sensor_msgs/LaserScan")
    wait_until(channel.has_subscribers)
    for number in range(3):
        publish(LaserScan(Header(Time(5, 6), "laser"), 1.0, ranges=[float(number)]))
    received = wait_until(lambda: len(m := rospy.command("received", topic)) == 3 and m)
    assert [message["header"]["seq"] for message in received] == [1, 2, 3]
    assert received[2]["header"] == {"seq": 3, "stamp": [5, 6], "frame_id": "laser"}
    assert received[2]["ranges"] == [2.0]


def test_component_receives_publications_of_rospy(component: Open, rospy: RospyPeer) -> None:
    scans: list[LaserScan] = []
    component("mapper").subscribe(SCAN, scans.append, "Scan", "/rospy_scan")
    rospy.command("advertise", "/rospy_scan", "sensor_msgs/LaserScan")
    wait_until(lambda: rospy.command("connections", "/rospy_scan"))
    fields = {"header.frame_id": "lidar", "ranges": [1.5, 2.5], "range_max": 4.0}
    rospy.command("publish", "/rospy_scan", fields)
    wait_until(lambda: scans)
    assert scans[0].header.frame_id == "lidar"
    assert scans[0].ranges.tolist() == [1.5, 2.5]
    assert scans[0].range_max == 4.0


def test_messages_travel_through_rospy_and_back(component: Open, rospy: RospyPeer) -> None:
    texts: list[str] = []
    user = component("user")
    user.subscribe(CHAT, lambda text: texts.append(text.data), "Back", "/peer/out")
    publish, channel = user.publisher(CHAT, "Chat", "/peer/in")
    wait_until(lambda: (publish(String("hé")), texts)[1])
    assert set(texts) == {"hé"}
    assert channel.has_subscribers()


def test_latched_message_of_rospy_arrives(component: Open, rospy: RospyPeer) -> None:
    texts: list[str] = []
    user = component("user")
    user.subscribe(CHAT, lambda text: texts.append(text.data), "Map", "/peer/map")
    wait_until(lambda: texts == ["latched by rospy"])


def test_rospy_receives_latched_message(component: Open, rospy: RospyPeer) -> None:
    base = component("base")
    publish, _ = base.publisher(CHAT, "Map", qos=Qos(latched=True))
    publish(String("first"))
    publish(String("latest"))
    topic = f"/{base.name}/Map"
    rospy.command("subscribe", topic, "std_msgs/String")
    wait_until(lambda: rospy.command("received", topic) == [{"data": "latest"}])


def test_image_of_a_megabyte_arrives_as_array(component: Open, rospy: RospyPeer) -> None:
    images: list[Image] = []
    component("viewer").subscribe(IMAGES, images.append, "Images", "/rospy_image")
    rospy.command("advertise", "/rospy_image", "sensor_msgs/Image")
    wait_until(lambda: rospy.command("connections", "/rospy_image"))
    rospy.command("publish_image", "/rospy_image", BYTES)
    wait_until(lambda: images)
    data = images[0].data
    assert isinstance(data, np.ndarray)
    assert not data.flags.owndata, "it is a view of the received message"
    assert bytes(data) == bytes(range(256)) * (BYTES // 256)


def test_rospy_receives_image_of_a_megabyte(component: Open, rospy: RospyPeer) -> None:
    camera = component("camera")
    publish, channel = camera.publisher(IMAGES, "Images")
    topic = f"/{camera.name}/Images"
    rospy.command("subscribe", topic, "sensor_msgs/Image")
    wait_until(channel.has_subscribers)
    publish(Image(height=1024, width=1024, encoding="mono8", data=np.ones(BYTES, np.uint8)))
    (image,) = wait_until(lambda: rospy.command("received", topic))
    assert image["data"] == {"bytes": BYTES, "sum": BYTES}
    assert image["encoding"] == "mono8"


def test_custom_message_travels_both_ways(component: Open, rospy: RospyPeer) -> None:
    rospy.command("define", "lab_msgs/Custom", CUSTOM_TEXT)
    customs: list[Custom] = []
    user = component("user")
    user.subscribe(CUSTOMS, customs.append, "In", "/rospy_custom")
    rospy.command("advertise", "/rospy_custom", "lab_msgs/Custom")
    wait_until(lambda: rospy.command("connections", "/rospy_custom"))
    rospy.command("publish", "/rospy_custom", {"values": [1.0], "count": -3})
    wait_until(lambda: customs)
    assert (customs[0].values.tolist(), customs[0].count) == ([1.0], -3)
    publish, channel = user.publisher(CUSTOMS, "Out")
    topic = f"/{user.name}/Out"
    rospy.command("subscribe", topic, "lab_msgs/Custom")
    wait_until(channel.has_subscribers)
    publish(Custom(at=Time(1, 2), names=[String("a")], count=7))
    (custom,) = wait_until(lambda: rospy.command("received", topic))
    assert custom["names"] == [{"data": "a"}]
    assert (custom["at"], custom["count"]) == ([1, 2], 7)


def test_rospy_calls_service(component: Open, rospy: RospyPeer) -> None:
    lamp = component("lamp")
    lamp.serve(SWITCH, {"set": answer}, "Switch")
    name = f"/{lamp.name}/Switch"
    assert rospy.command("call", name, True) == [True, "ünder"]
    failed, text = rospy.command("call", name, False)
    assert failed == "failed"
    assert "ValueError: no light" in text
    assert rospy.command("call_often", name, 20) == ["ünder"] * 20
    wait_until(lambda: lamp.counts("Switch", "set").calls == 22)


def test_component_calls_service_of_rospy(component: Open, rospy: RospyPeer) -> None:
    user = component("user")
    call = user.caller(SWITCH, "set", "Switch", "/peer/set")
    for _ in range(3):
        assert call(SetBoolRequest(True)) == SetBoolResponse(True, "rospy")
    with pytest.raises(RemoteError, match="rospy refuses"):
        call(SetBoolRequest(False))
    assert call(SetBoolRequest(True)).success


def test_call_of_service_of_other_type_is_a_mismatch(component: Open, rospy: RospyPeer) -> None:
    call = component("user").caller(OTHER_SWITCH, "set", "Switch", "/peer/set")
    with pytest.raises(InterfaceMismatch, match="md5"):
        call(TriggerRequest())


def test_call_of_service_that_nobody_serves(component: Open, rospy: RospyPeer) -> None:
    call = component("user").caller(SWITCH, "set", "Switch", "/no_such_service")
    with pytest.raises(NoServer, match="/no_such_service"):
        call(SetBoolRequest())


def test_rospy_that_calls_another_type_is_refused(
    component: Open, rospy: RospyPeer, caplog: pytest.LogCaptureFixture
) -> None:
    lamp = component("lamp")
    lamp.serve(OTHER_SWITCH, {"set": lambda _: TriggerResponse()}, "Switch")
    failed, text = rospy.command("call", f"/{lamp.name}/Switch", True)
    assert failed == "failed"
    assert "std_srvs/Trigger" in text
    assert "/peer calls" in caplog.text


def test_topics_of_other_types_are_reported(
    component: Open, rospy: RospyPeer, caplog: pytest.LogCaptureFixture
) -> None:
    texts: list[Any] = []
    user = component("user")
    user.subscribe(OTHER_CHAT, texts.append, "Chat", "/peer/out")
    wait_until(lambda: "std_msgs/Int16" in caplog.text)
    assert "user" in caplog.text
    base = component("base")
    base.publisher(OTHER_CHAT, "Chat")
    rospy.command("subscribe", f"/{base.name}/Chat", "std_msgs/String")
    wait_until(lambda: "/peer subscribes to" in caplog.text)
    assert not texts


def test_command_of_a_served_port_is_a_topic(component: Open, rospy: RospyPeer) -> None:
    texts: list[str] = []
    base = component("base", Base="/robot")
    say = lambda text: texts.append(text.data)  # noqa: E731
    idle = {"enable": answer, "stop": lambda _: TriggerResponse(), "say": say}
    base.serve(BASE, idle, "Base")
    rospy.command("advertise", "/robot/say", "std_msgs/String")
    wait_until(lambda: rospy.command("connections", "/robot/say"))
    rospy.command("publish", "/robot/say", {"data": "hello"})
    wait_until(lambda: texts == ["hello"])


def test_tools_of_ros_show_and_call_a_component(
    component: Open, master: Master, rospy: RospyPeer
) -> None:
    lamp = component("lamp")
    lamp.serve(SWITCH, {"set": answer}, "Switch")
    publish, _ = lamp.publisher(CHAT, "Chat")
    name = f"/{lamp.name}"
    wait_until(lambda: master.nodes_of(2, f"{name}/Switch"))
    wait_until(lambda: master.nodes_of(0, f"{name}/Chat"))
    rospy.command("subscribe", f"{name}/Chat", "std_msgs/String")
    wait_until(lambda: publish(String("x")) or rospy.command("received", f"{name}/Chat"))
    shown = master.run("rosnode", "info", name)
    assert "to: /peer" in shown
    assert f"{name}/Switch" in shown
    assert "Pid: " in shown
    assert "std_msgs/String" in master.run("rostopic", "info", f"{name}/Chat")
    assert "success: True" in master.run("rosservice", "call", f"{name}/Switch", "true")
    assert "no light" in master.run("rosservice", "call", f"{name}/Switch", "false")


def test_tools_of_ros_echo_publish_and_end_a_component(
    component: Open, master: Master, rospy: RospyPeer
) -> None:
    texts: list[str] = []
    base = component("base")
    base.subscribe(CHAT, lambda text: texts.append(text.data), "Ear", "/told")
    publish, _ = base.publisher(CHAT, "Chat", qos=Qos(latched=True))
    publish(String("shown"))
    topic = f"/{base.name}/Chat"
    wait_until(lambda: master.nodes_of(0, topic))
    assert "shown" in master.run("rostopic", "echo", "-n", "1", topic)
    master.run("rostopic", "pub", "-1", "/told", "std_msgs/String", "data: typed")
    wait_until(lambda: texts == ["typed"])
    assert "xmlrpc reply" in master.run("rosnode", "ping", "-c", "1", f"/{base.name}")
    assert "killed" in master.run("rosnode", "kill", f"/{base.name}")
    wait_until(lambda: base.failures)
    assert "asked the ROS node" in base.failures[0]


@pytest.mark.skipif(
    not Path("/usr/bin/rosbag").exists(), reason="needs rosbag: `make test-peers` installs it"
)
def test_roscpp_records_and_plays_messages(
    component: Open, master: Master, rospy: RospyPeer, tmp_path: Path
) -> None:
    base = component("base")
    publish, _ = base.publisher(SCAN, "Scan", qos=Qos(latched=True))
    publish(LaserScan(Header(Time(5, 6), "laser"), ranges=[1.5]))
    topic, bag = f"/{base.name}/Scan", str(tmp_path / "scan.bag")
    wait_until(lambda: master.nodes_of(0, topic))
    master.run("rosbag", "record", "-l", "1", "-O", bag, topic)
    scans: list[LaserScan] = []
    component("viewer").subscribe(SCAN, scans.append, "Scan", "/played")
    wait_until(lambda: master.nodes_of(1, "/played"))
    master.run("rosbag", "play", "--wait-for-subscribers", bag, f"{topic}:=/played")
    wait_until(lambda: scans)
    assert scans[0].header == Header(Time(5, 6), "laser")
    assert scans[0].ranges.tolist() == [1.5]


def test_topic_type_asks_the_master(component: Open, master: Master, rospy: RospyPeer) -> None:
    assert topic_type(master.uri, "/peer/out") == "std_msgs/String"
    assert topic_publishers("/peer/out", master.uri) == ["/peer"]
    with pytest.raises(MiddlewareError, match="knows no type of the topic /nothing"):
        topic_type(master.uri, "/nothing")
    with pytest.raises(MiddlewareError, match="roscore"):
        topic_type("http://127.0.0.1:9", "/peer/out")


def test_node_of_a_closed_component_is_unregistered(
    component: Open, master: Master, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)
    base = component("base")
    base.publisher(CHAT, "Chat")
    topic = f"/{base.name}/Chat"
    wait_until(lambda: master.nodes_of(0, topic) == [f"/{base.name}"])
    base.ports.close()
    assert master.nodes_of(0, topic) == []


def test_node_with_the_same_name_ends_the_former(component: Open, master: Master) -> None:
    base = component("base")
    base.publisher(CHAT, "Chat")
    wait_until(lambda: master.nodes_of(0, f"/{base.name}/Chat"))
    master.ask("getPid")
    second = RospyPeer(master, base.name)
    try:
        wait_until(lambda: base.failures)
        assert "new node registered with same name" in base.failures[0]
    finally:
        second.close()
