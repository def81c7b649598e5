"""Time stamps of messages: envelopes of YARP, headers of ROS messages, arrival."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import pytest

from robocomp_dsl.runtime import MessageStamp, message_stamp, publishing_stamp
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.middleware.yarp.envelopes import read_envelope, write_envelope
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.outgoing import open_connection
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort
from tests.middleware.ros2.ros_messages import Header, Time
from tests.middleware.yarp.conftest import EVENTS, LOOPBACK, SCAN, YarpComponent
from tests.middleware.yarp.sensor_messages import CAMERA, Image
from tests.middleware.yarp.test_yarp_wire import ENVELOPE, Recorder
from tests.support.waiting import wait_until

Components = Callable[..., YarpComponent]
LIMIT_S = 60.0


@pytest.mark.parametrize(
    ("envelope", "stamp"),
    [
        ("42 1234.5", MessageStamp(1_234_500_000_000, "envelope", 42)),
        ("42 1234.5 name", MessageStamp(1_234_500_000_000, "envelope", 42)),
        ("-1 1700000000.123456789", MessageStamp(1_700_000_000_123_456_789, "envelope", -1)),
        ("0 -0.25", MessageStamp(-250_000_000, "envelope", 0)),
        ("1 1.5e3", MessageStamp(1_500_000_000_000, "envelope", 1)),
        ("", MessageStamp(5, "arrival")),
        ("42", MessageStamp(5, "arrival")),
        ("42 soon", MessageStamp(5, "arrival")),
        ("x 1.5", MessageStamp(5, "arrival")),
        ("1 nan", MessageStamp(5, "arrival")),
        ("1 1e300", MessageStamp(5, "arrival")),
    ],
)
def test_read_envelope(envelope: str, stamp: MessageStamp) -> None:
    assert read_envelope(envelope, 5) == stamp


@pytest.mark.parametrize(
    ("stamp", "envelope"),
    [
        (MessageStamp(1_234_500_000_000, "envelope", 42), "42 1234.5"),
        (MessageStamp(1_700_000_000_123_456_789, "header"), "7 1700000000.123456789"),
        (MessageStamp(-250_000_000, "envelope", 0), "0 -0.25"),
        (MessageStamp(3_000_000_000, "envelope", 2**31), "-2147483648 3"),
    ],
)
def test_write_envelope(stamp: MessageStamp, envelope: str) -> None:
    assert write_envelope(stamp, 7) == envelope
    assert read_envelope(envelope, 5).time_ns == stamp.time_ns


class StampRecorder(Recorder):
    """Keeps the envelopes of messages, too."""

    def __init__(self) -> None:
        super().__init__()
        self.envelopes: list[str] = []

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        self.envelopes.append(envelope)
        return super().receive(bottle, size, envelope, wants_reply=wants_reply)


def test_message_stamp_is_that_of_the_envelope(component: Components, names: NameClient) -> None:
    stamps: list[MessageStamp] = []
    component().subscribe(EVENTS, lambda *_: stamps.append(message_stamp()))
    at = wait_until(lambda: names.query("/own/Events:i", "fast_tcp"))
    stream = open_connection(at, "/writer", LIMIT_S)
    stream.send(bytes.fromhex(ENVELOPE))  # captured: `x 1` with `42 1234.5`
    wait_until(lambda: len(stamps) == 1)  # another connection is read by another thread
    stream.close()
    text = wait_until(lambda: names.query("/own/Events:i", "text"))
    stream = open_connection(text, "/writer", LIMIT_S)
    before = time.time_ns()
    stream.send(b"D 42 1234.5\r\nevent bump 3\r\nD\r\nevent bump 4\r\n")
    wait_until(lambda: len(stamps) == 3)
    assert MessageStamp(1_234_500_000_000, "envelope", 42) == stamps[0] == stamps[1]
    assert stamps[2].source == "arrival"
    assert before <= stamps[2].time_ns <= time.time_ns()
    stream.close()


@pytest.mark.parametrize("carrier", ["tcp", "fast_tcp", "text", "text_ack"])
def test_publishing_stamp_writes_an_envelope(
    component: Components, names: NameClient, carrier: str
) -> None:
    recorder = StampRecorder()
    reader = YarpPort("/reader", (LOOPBACK, 0), recorder)
    names.register("/reader", LOOPBACK, reader.number)
    own = component()
    publish = own.publisher(EVENTS, f"{carrier}:/reader")
    wait_until(lambda: publish("connected", 0) or recorder.received)
    seen = len(recorder.received)
    assert set(recorder.envelopes) == {""}
    with publishing_stamp(1_500_000_000, 42):
        publish("stamped", 1)
        with publishing_stamp(2_500_000_000):
            publish("counted", 2)
        publish("stamped", 3)
    publish("plain", 4)
    wait_until(lambda: recorder.received[-1] == "event plain 4")
    assert recorder.envelopes[-4:] == ["42 1.5", "1 2.5", "42 1.5", ""]
    assert seen <= len(recorder.received) - 4
    reader.close()


def test_publication_with_a_header_has_its_stamp_as_envelope(
    component: Components, names: NameClient
) -> None:
    recorder = StampRecorder()
    reader = YarpPort("/reader", (LOOPBACK, 0), recorder)
    names.register("/reader", LOOPBACK, reader.number)
    publish = component().publisher(CAMERA, "fast_tcp:/reader")
    image = Image(Header(Time(12, 500_000_000), "eye"), 1, 1, "mono8", 0, 1, b"x")
    wait_until(lambda: publish(image) or recorder.received)
    assert recorder.envelopes[0].endswith(" 12.5")
    with publishing_stamp(9_000_000_000, 1):
        publish(image)
    wait_until(lambda: recorder.envelopes[-1] == "1 9")
    reader.close()


def test_message_stamp_of_components_on_yarp(component: Components) -> None:
    stamps: list[MessageStamp] = []
    component("reader").subscribe(SCAN, lambda _: stamps.append(message_stamp()))
    publish = component("writer").publisher(SCAN)

    def published() -> Any:
        with publishing_stamp(3_000_000_001, 5):
            publish([1.0])
        return stamps

    wait_until(published)
    assert stamps[0] == MessageStamp(3_000_000_001, "envelope", 5)
    assert stamps[0].seconds == 3.000000001


def test_message_stamp_is_that_of_a_header_on_any_middleware(domain: str) -> None:
    group, stamps = CallbackGroup(), list[MessageStamp]()
    context = ComponentContext("own", domain, group, Statistics())
    ports = open_ports("inproc", context)
    at = Endpoint(CAMERA, "own", "Camera")
    ports.subscribe(at, {"push": lambda _: stamps.append(message_stamp())}, group)
    publish = ports.advertise(at).bind(CAMERA.operations[0])
    before = time.time_ns()
    stamped = Image(Header(Time(12, 5)))
    wait_until(lambda: publish(stamped) or stamps)
    assert stamps[0] == MessageStamp(12_000_000_005, "header")
    stamps.clear()
    wait_until(lambda: publish(Image()) or any(s.source == "arrival" for s in stamps))
    assert before <= stamps[-1].time_ns <= time.time_ns()
    ports.close()
    assert message_stamp().source == "arrival"
