"""Topics between components of ours on each middleware of ROS 2."""

from __future__ import annotations

import logging
import threading

import numpy as np
import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import EncodeError, MiddlewareError
from tests.middleware.ros2.ros_messages import (
    CHAT,
    OTHER_CHAT,
    SCAN,
    Header,
    LaserScan,
    SmallInt,
    String,
    Time,
)
from tests.middleware.ros2.ros_network import RosNetwork
from tests.support.waiting import wait_until


def _is_heard(channel: object) -> bool:
    return channel.has_subscribers()  # type: ignore[attr-defined]


@pytest.mark.parametrize("peers", [(), ("laser",), ("laser.Scan",)], ids=["any", "name", "port"])
def test_topic_reaches_a_subscriber_of_another_component(
    ros_network: RosNetwork, peers: tuple[str, ...]
) -> None:
    received: list[LaserScan] = []
    laser, viewer = ros_network.component("laser"), ros_network.component("viewer")
    viewer.subscribe(SCAN, received.append, "Scan", *peers)
    publish, channel = laser.publisher(SCAN, "Scan")
    wait_until(lambda: _is_heard(channel))
    scan = LaserScan(
        Header(Time(7, 4_000_000_000), "base"), range_max=2.5, ranges=np.arange(3, dtype=np.float32)
    )
    wait_until(lambda: (publish(scan), received)[1])
    assert received[0] == scan
    assert viewer.counts("Scan", "scanned").failures == 0


def test_topic_at_a_chosen_address_reaches_an_external_subscription(
    ros_network: RosNetwork,
) -> None:
    received: list[str] = []
    talker = ros_network.component("talker", Chat="/robot/chatter")
    listener = ros_network.component("listener")
    listener.subscribe(CHAT, lambda text: received.append(text.data), "Ear", "/robot/chatter")
    publish, channel = talker.publisher(CHAT, "Chat")
    wait_until(lambda: _is_heard(channel))
    wait_until(lambda: (publish(String("häll°")), received)[1])
    assert set(received) == {"häll°"}


def test_topic_that_is_latched_reaches_a_late_subscriber(ros_network: RosNetwork) -> None:
    received: list[str] = []
    latched = Qos(latched=True, depth=1)
    talker = ros_network.component("talker")
    publish, _ = talker.publisher(CHAT, "Chat", qos=latched)
    publish(String("first"))
    publish(String("last"))
    listener = ros_network.component("listener")
    listener.subscribe(
        CHAT, lambda text: received.append(text.data), "Chat", "talker.Chat", qos=latched
    )
    wait_until(lambda: received)
    assert received == ["last"]


def test_topic_that_keeps_all_loses_nothing_when_handlers_are_slow(
    ros_network: RosNetwork,
) -> None:
    received: list[str] = []
    entered, release = threading.Event(), threading.Event()

    def block_once(text: String) -> None:
        received.append(text.data)
        entered.set()
        release.wait()

    keep_all = Qos(keep_all=True)
    talker, listener = ros_network.component("talker"), ros_network.component("listener")
    listener.subscribe(CHAT, block_once, "Chat", "talker.Chat", qos=keep_all)
    publish, channel = talker.publisher(CHAT, "Chat", qos=keep_all)
    wait_until(lambda: _is_heard(channel))
    wait_until(lambda: (publish(String("start")), entered.is_set())[1])
    numbers = [str(i) for i in range(300)]
    for number in numbers:
        publish(String(number))
    release.set()
    wait_until(lambda: received[-1] == numbers[-1])
    assert [text for text in received if text != "start"] == numbers


def test_topic_of_two_named_publishers_arrives_once_from_each(ros_network: RosNetwork) -> None:
    received: list[str] = []
    listener = ros_network.component("listener")
    # The address of one of them is not the default: it publishes on a topic of the subscriber.
    left = ros_network.component("left")
    right = ros_network.component("right", Chat="/elsewhere")
    listener.subscribe(CHAT, lambda m: received.append(m.data), "Chat", "left", "right")
    channels = [c.publisher(CHAT, "Chat") for c in (left, right)]
    for name, (publish, channel) in zip(("left", "right"), channels, strict=True):
        wait_until(lambda channel=channel: _is_heard(channel))
        wait_until(lambda name=name, publish=publish: (publish(String(name)), name in received)[1])
    received.clear()
    for number in range(5):
        for name, (publish, _) in zip(("left", "right"), channels, strict=True):
            publish(String(f"{name} {number}"))
    wait_until(lambda: {"left 4", "right 4"} <= set(received))
    later = [text for text in received if " " in text]
    assert sorted(later) == sorted(f"{name} {i}" for name in ("left", "right") for i in range(5))


def test_topic_is_refused_with_a_value_its_type_lacks(ros_network: RosNetwork) -> None:
    publish, _ = ros_network.component("talker").publisher(OTHER_CHAT, "Chat")
    with pytest.raises(EncodeError, match="data"):
        publish(SmallInt(2**20))


def test_topic_with_another_type_under_its_name_is_reported(
    ros_network: RosNetwork, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.WARNING)
    ros_network.component("talker").publisher(CHAT, "Chat")
    other = ros_network.component("listener")
    other.subscribe(OTHER_CHAT, lambda _: None, "Ear", "/talker/Chat")

    def is_reported() -> bool:
        return any(
            "std_msgs" in m and "Int16" in m and "/talker/Chat" in m for m in caplog.messages
        )

    wait_until(is_reported)


@pytest.mark.parametrize("name", ["/1st/scan", "/base scan", "/base//scan", "/", "/x" * 200])
def test_topic_name_that_ros_forbids_is_refused(ros_network: RosNetwork, name: str) -> None:
    component = ros_network.component("talker", Chat=name)
    with pytest.raises(MiddlewareError, match=r"Chat: (`.*` is not a valid|the) ROS name"):
        component.publisher(CHAT, "Chat")
