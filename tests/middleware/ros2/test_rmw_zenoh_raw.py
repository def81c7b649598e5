"""Bytes that no correct ROS node sends: they are counted, and the component goes on."""

from __future__ import annotations

import json
import random
import time
from collections.abc import Iterator

import pytest
import zenoh

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.rmw_zenoh.operations import service_info, topic_info
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import attachment
from tests.middleware.ros2.ros_messages import (
    CHAT,
    SCAN,
    SWITCH,
    LaserScan,
    SetBoolRequest,
    SetBoolResponse,
    String,
)
from tests.middleware.ros2.ros_network import RosNetwork
from tests.support.waiting import wait_until

GID = bytes(range(16))
HELLO = CHAT.operations[0].encode_request((String("hello"),))
REQUEST = SWITCH.operations[0].encode_request((SetBoolRequest(True),))


@pytest.fixture
def session(zenoh_network: RosNetwork) -> Iterator[zenoh.Session]:
    """A session of a program that writes any bytes."""
    config = zenoh.Config()
    for key, value in {
        "mode": "client",
        "connect/endpoints": [zenoh_network.router_address],
        "scouting/multicast/enabled": False,
    }.items():
        config.insert_json5(key, json.dumps(value))
    with zenoh.open(config) as opened:
        yield opened


def _ask(session: zenoh.Session, key: str, **message: bytes) -> list[zenoh.Reply]:
    return list(session.get(key, target=zenoh.QueryTarget.ALL_COMPLETE, timeout=60, **message))


def test_topic_with_mutated_bytes_counts_malformed_messages(
    zenoh_network: RosNetwork, session: zenoh.Session
) -> None:
    scans: list[LaserScan] = []
    component = zenoh_network.component("component")
    component.subscribe(SCAN, scans.append, "In", "/scan", qos=Qos(depth=4000))
    key = topic_info("/scan", SCAN, SCAN.operations[0]).key(zenoh_network.domain_id)
    valid = SCAN.operations[0].encode_request((LaserScan(ranges=[1.0, 2.0]),))
    publisher = session.declare_publisher(key, congestion_control=zenoh.CongestionControl.BLOCK)
    wait_until(lambda: publisher.matching_status.matching)
    generator = random.Random(7)
    for _ in range(2000):
        data = bytearray(valid)
        for _ in range(generator.randint(1, 4)):
            data[generator.randrange(len(data))] = generator.randrange(256)
        publisher.put(bytes(data[: generator.randint(0, len(data))]))
    publisher.put(SCAN.operations[0].encode_request((LaserScan(ranges=[4.0]),)))
    wait_until(lambda: scans and scans[-1] == LaserScan(ranges=[4.0]))
    counts = component.counts("In", "scanned")
    assert counts.malformed > 1000
    assert counts.failures == counts.malformed
    assert component.failures == []


@pytest.mark.parametrize("number", [b"", bytes(5), attachment(1, 2, GID)[:-1]])
def test_service_rejects_a_request_without_a_valid_attachment(
    zenoh_network: RosNetwork, session: zenoh.Session, number: bytes
) -> None:
    lamp = zenoh_network.component("lamp")
    lamp.serve(SWITCH, {"set": lambda _: SetBoolResponse(True)}, "Switch")
    key = service_info("/lamp/Switch", SWITCH, SWITCH.operations[0]).key(zenoh_network.domain_id)
    (reply,) = wait_until(lambda: _ask(session, key, payload=REQUEST, attachment=number))
    assert reply.err
    assert b"attachment" in reply.err.payload.to_bytes()
    assert lamp.counts("Switch", "set").malformed == 1


def test_service_replies_with_the_number_and_identity_of_the_request(
    zenoh_network: RosNetwork, session: zenoh.Session
) -> None:
    lamp = zenoh_network.component("lamp")
    lamp.serve(SWITCH, {"set": lambda _: SetBoolResponse(True, "ok")}, "Switch")
    key = service_info("/lamp/Switch", SWITCH, SWITCH.operations[0]).key(zenoh_network.domain_id)
    before = time.time_ns()
    number = attachment(41, 1, GID)
    (reply,) = wait_until(lambda: _ask(session, key, payload=REQUEST, attachment=number))
    assert reply.ok
    assert reply.ok.payload.to_bytes().hex() == "0001000001000000030000006f6b00"
    assert reply.ok.attachment
    data = reply.ok.attachment.to_bytes()
    assert data[:8] + data[16:] == number[:8] + number[16:]
    assert int.from_bytes(data[8:16], "little") >= before


def test_topic_counts_the_gaps_in_the_numbers_of_each_publisher(
    zenoh_network: RosNetwork, session: zenoh.Session
) -> None:
    texts: list[str] = []
    component = zenoh_network.component("component")
    component.subscribe(CHAT, lambda text: texts.append(text.data), "In", "/talk")
    key = topic_info("/talk", CHAT, CHAT.operations[0]).key(zenoh_network.domain_id)
    publisher = session.declare_publisher(key)
    wait_until(lambda: publisher.matching_status.matching)
    for number, gid in [(5, GID), (6, GID), (9, GID), (1, bytes(16)), (10, GID), (3, bytes(16))]:
        publisher.put(HELLO, attachment=attachment(number, 0, gid))
    publisher.put(HELLO, attachment=b"an older version")
    wait_until(lambda: len(texts) == 7)
    assert component.counts("In", "said").drops == 2 + 1
