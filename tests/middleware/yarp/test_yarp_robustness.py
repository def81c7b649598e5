"""Peers that restart, send garbage, read slowly, or have changed their types."""

from __future__ import annotations

import logging
import random
import socket
import threading
from collections.abc import Callable
from typing import Any

import pytest

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.bottle.profile import PROFILE_3
from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.tcp import outgoing_link
from robocomp_dsl.runtime.middleware.yarp.addresses import PortAddress
from robocomp_dsl.runtime.middleware.yarp.name_client import NameClient
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from robocomp_dsl.runtime.middleware.yarp.outgoing import open_connection
from robocomp_dsl.runtime.middleware.yarp.outgoing_message import OutgoingMessage
from robocomp_dsl.runtime.middleware.yarp.output_link import OutputLink
from robocomp_dsl.runtime.middleware.yarp.port import YarpPort
from tests.middleware.yarp.conftest import EVENTS, LOOPBACK, POSE, SCAN, Pose, YarpComponent
from tests.middleware.yarp.test_yarp_transport import rpc
from tests.middleware.yarp.test_yarp_wire import Recorder
from tests.support.waiting import wait_until

Components = Callable[..., YarpComponent]
LIMIT_S = 60.0


class Grip(rt.Struct):
    verb: rt.String = ""
    what: rt.String = ""
    joint: rt.Int = 0
    value: rt.Double = 0.0


GRIPPER = rt.Interface("Test::Gripper", rt.Operation("command", rt.Pattern.PUBLISH, {"grip": Grip}))


def test_published_struct_is_a_flat_request(component: Components, names: NameClient) -> None:
    recorder = Recorder()
    port = YarpPort("/gripper/rpc:i", (LOOPBACK, 0), recorder, is_rpc=True)
    names.register(port.name, LOOPBACK, port.number)
    publish = component().publisher(GRIPPER, port.name)
    publish(Grip("set", "opening", 1, 12.5))
    wait_until(lambda: recorder.received == ["set opening 1 12.5"])
    port.close()


def test_link_is_open_again_after_restarts(
    component: Components, name_server: NameServer, names: NameClient
) -> None:
    """The reader restarts while the name server restarts, too; messages meanwhile are counted."""
    first = Recorder()
    reader = YarpPort("/reader", (LOOPBACK, 0), first)
    names.register("/reader", LOOPBACK, reader.number)
    own = component()
    publish = own.publisher(EVENTS, "/reader")
    wait_until(lambda: publish("first", 1) or first.received)
    name_server.close()
    reader.close()
    for number in range(outgoing_link.DEPTH + 10):
        publish("lost", number)
    again = NameServer((LOOPBACK, name_server.number))
    second = Recorder()
    restarted = YarpPort("/reader", (LOOPBACK, 0), second)
    names.register("/reader", LOOPBACK, restarted.number)
    wait_until(lambda: publish("second", 2) or "event second 2" in second.received)
    counts = own.statistics.of("Events", "event")

    def accounted() -> int:
        return len(first.received) + len(second.received) + counts.drops

    wait_until(lambda: accounted() >= counts.calls)
    # A message whose acknowledgement was lost counts as dropped, although it may have arrived.
    assert accounted() <= counts.calls + 1
    assert counts.drops >= 10
    wait_until(lambda: names.query("/own/Events:o"))
    restarted.close()
    again.close()


def test_garbage_ends_only_its_connection(component: Components, names: NameClient) -> None:
    received: list[Pose] = []
    own = component()
    own.subscribe(POSE, received.append)
    at = wait_until(lambda: names.query("/own/PosePub:i"))
    generator = random.Random(3)
    valid = open_connection(
        PortAddress(at.name, "fast_tcp", at.host, at.number), "/garbage", LIMIT_S
    )
    valid.send(b"YA\x0b\x00\x00\x00RP" + generator.randbytes(200))
    for head in (b"", b"CONNECT ", b"CONNACK /x\r\nD\r\n", b"YA\x64\x1e\x00\x00RP"):
        with socket.create_connection(at.socket) as peer:
            peer.sendall(head + generator.randbytes(3000) + b"\r\n")
            peer.shutdown(socket.SHUT_WR)
            peer.settimeout(LIMIT_S)
            while peer.recv(1 << 16):
                pass
    wait_until(lambda: "/garbage" not in own.inputs("PosePub")())
    assert rpc(names, "/own/PosePub:i", "1 2 map") == ""
    wait_until(lambda: received == [Pose(1.0, 2.0, "map")])
    valid.close()


class SlowReader(Recorder):
    """Takes no message until it is told to."""

    def __init__(self) -> None:
        super().__init__()
        self.go_on = threading.Event()

    def receive(self, *arguments: Any, **options: Any) -> Any:
        self.go_on.wait(LIMIT_S)
        return super().receive(*arguments, **options)


def test_slow_reader_loses_the_oldest_and_is_logged_once(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bounded_queue, "MAX_BYTES", 1 << 20)
    slow = SlowReader()
    reader = YarpPort("/reader", (LOOPBACK, 0), slow)
    counts = OperationCounts("Scan", "ranges")
    address = PortAddress("/reader", "tcp", LOOPBACK, reader.number)
    link = OutputLink(address, "/own/Scan:o", lambda each: each, Qos())
    link.start()
    with caplog.at_level(logging.WARNING, "robocomp"):
        for number in range(40):
            message = OutgoingMessage([number, b"x" * (1 << 18)], PROFILE_3)
            link.send(message, counts)
    assert counts.drops >= 30
    assert 0 < link.queued_bytes <= (1 << 20) + message.wire_size
    warnings = [r.getMessage() for r in caplog.records if "does not take" in r.getMessage()]
    assert warnings == ["/own/Scan:o: /reader does not take the messages in time; it has lost 1"]
    slow.go_on.set()
    wait_until(lambda: slow.received and slow.received[-1].startswith("39 "))
    assert len(slow.received) + counts.drops == 40
    link.close()
    reader.close()


def test_messages_that_no_reader_took_are_counted() -> None:
    counts = OperationCounts("Scan", "ranges")
    with socket.socket() as probe:
        probe.bind((LOOPBACK, 0))
        address = PortAddress("/nobody", "tcp", LOOPBACK, probe.getsockname()[1])
        link = OutputLink(address, "/own/Scan:o", lambda each: each, Qos())
        link.start()
        link.send(OutgoingMessage([1.5], PROFILE_3), counts)
        link.close()
    assert counts.drops == 1


@pytest.mark.parametrize(
    ("port", "text", "message"),
    [
        (
            "PosePub",
            "1.0 2.0 0.5 map",
            "has 4 values (float64, float64, float64, string), but should have: x double, y double,"
            " frame string",
        ),
        ("PosePub", "1.0 2.0", "has 2 values (all float64), but should have: x double, y double,"),
        ("Scan", "a b", "takes numbers (float64), not"),
    ],
)
def test_changed_type_is_reported_with_both_shapes(
    component: Components,
    names: NameClient,
    caplog: pytest.LogCaptureFixture,
    port: str,
    text: str,
    message: str,
) -> None:
    own = component()
    own.subscribe(POSE, lambda _: None)
    own.subscribe(SCAN, lambda _: None)
    wait_until(lambda: names.query(f"/own/{port}:i"))
    at = names.query(f"/own/{port}:i", "fast_tcp")
    assert at is not None
    stream = open_connection(at, "/changed", LIMIT_S)

    stream.send(b"".join(OutgoingMessage(read_text(text), PROFILE_3).parts))
    wait_until(lambda: message in caplog.text)
    stream.close()
