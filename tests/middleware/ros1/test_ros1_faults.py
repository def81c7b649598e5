"""Peers that send garbage, read slowly or break connections; no part of ROS is needed."""

from __future__ import annotations

import http.client
import logging
import socket
import threading
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import MalformedMessage, MiddlewareError
from robocomp_dsl.runtime.middleware.ros1.handshake import exchange_headers
from robocomp_dsl.runtime.middleware.ros1.settings import read_settings
from robocomp_dsl.runtime.middleware.ros1.tcpros import (
    LENGTH,
    TcprosStream,
    encode_header,
    parse_header,
)
from robocomp_dsl.runtime.middleware.ros1.xmlrpc import RosApi, RosApiError
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import TcpMessage
from tests.middleware.ros1.conftest import Ros1Network
from tests.middleware.ros2.ros_messages import (
    CHAT,
    SWITCH,
    SetBoolRequest,
    SetBoolResponse,
    String,
)
from tests.middleware.ros2.ros_network import RosComponent
from tests.support.waiting import wait_until

ANY = {"callerid": "/test", "md5sum": "*", "type": "*"}
TIMEOUT_S = 60.0


@pytest.fixture
def base(lone_network: Ros1Network) -> Iterator[RosComponent]:
    """A component that serves, publishes and receives."""
    base = lone_network.component("base")
    base.serve(SWITCH, {"set": lambda r: SetBoolResponse(r.data, "ours")}, "Switch")
    return base


def node_of(component: RosComponent) -> Any:
    transport: Any = component.ports.transport("ros1")
    return transport.node


def opened(component: RosComponent) -> TcprosStream:
    return TcprosStream.connect(("127.0.0.1", node_of(component).listener.number), TIMEOUT_S)


def ends(stream: TcprosStream) -> bool:
    """Whether the node ends the connection; it may send a reason first."""
    stream.socket.settimeout(TIMEOUT_S)
    try:
        while stream.socket.recv(4096):
            pass
    except ConnectionResetError:
        pass
    finally:
        stream.close()
    return True


def called(component: RosComponent) -> bool:
    """Whether the component still serves ROS clients."""
    stream = opened(component)
    exchange_headers(stream, {**ANY, "service": "/base/Switch"}, TIMEOUT_S)
    stream.send(LENGTH.pack(1) + b"\1")
    reply = bytes(stream.take(1 + 4 + 1 + 4 + 4))
    stream.close()
    return reply == b"\1" + LENGTH.pack(9) + b"\1" + LENGTH.pack(4) + b"ours"


@pytest.mark.parametrize(
    "garbage",
    [
        b"GET / HTTP/1.1\r\n\r\n",
        LENGTH.pack(0xFFFFFFFF),
        LENGTH.pack(8) + LENGTH.pack(100) + b"abcd",
        LENGTH.pack(7) + LENGTH.pack(3) + b"abc",
        LENGTH.pack(0),
        encode_header({"topic": "/nothing", "md5sum": "*"}),
        encode_header({"service": "/base/Switch"}),
        encode_header({"port": "/base/Switch", "md5sum": "0"}),
    ],
    ids=["http", "huge", "field", "no equals", "empty", "topic", "no md5", "hash"],
)
def test_listener_ends_connection_with_invalid_header(base: RosComponent, garbage: bytes) -> None:
    stream = opened(base)
    stream.send(garbage)
    assert ends(stream)
    assert called(base)


def test_listener_survives_header_that_ends_within(base: RosComponent) -> None:
    stream = opened(base)
    stream.send(LENGTH.pack(100) + b"abc")
    stream.close()
    assert called(base)


def test_service_replies_to_malformed_request_with_the_reason(base: RosComponent) -> None:
    stream = opened(base)
    exchange_headers(stream, {**ANY, "service": "/base/Switch", "persistent": "1"}, TIMEOUT_S)
    for request, reason in ((b"\7", "7 is no bool"), (b"", "1 bytes expected"), (b"\0\0", "more")):
        stream.send(LENGTH.pack(len(request)) + request)
        assert bytes(stream.take(1)) == b"\0"
        assert reason in bytes(stream.frame()).decode()
    stream.close()
    wait_until(lambda: base.counts("Switch", "set").malformed == 3)


def test_service_ends_connection_with_request_that_is_too_long(base: RosComponent) -> None:
    stream = opened(base)
    exchange_headers(stream, {**ANY, "service": "/base/Switch", "persistent": "1"}, TIMEOUT_S)
    stream.send(LENGTH.pack(0xFFFFFFF0))
    assert bytes(stream.take(1)) == b"\0"
    assert "4294967280 bytes" in bytes(stream.frame()).decode()
    assert ends(stream)


@pytest.mark.parametrize("reply", [b"HTTP/1.0 200 OK\r\n\r\n<a/>", b"\0" * 100, b""])
def test_api_of_a_peer_that_is_no_node_raises(reply: bytes) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(TIMEOUT_S)
        api = RosApi(f"http://127.0.0.1:{server.getsockname()[1]}", TIMEOUT_S)

        def answer() -> None:
            for _ in range(2):  # the library repeats a call once
                try:
                    accepted, _ = server.accept()
                except OSError:
                    return
                with accepted:
                    accepted.recv(65536)
                    accepted.sendall(reply)

        thread = threading.Thread(target=answer)
        thread.start()
        with pytest.raises(RosApiError, match="http://127"):
            api.call("getPid", "/test")
        server.shutdown(socket.SHUT_RDWR)  # wakes the thread that accepts
        thread.join(TIMEOUT_S)


@pytest.mark.parametrize("body", [b"garbage", b"<?xml version='1.0'?><methodCall/>", b""])
def test_node_api_survives_garbage(base: RosComponent, body: bytes) -> None:
    place = urlsplit(node_of(base).api_uri).netloc
    connection = http.client.HTTPConnection(place, timeout=TIMEOUT_S)
    connection.request("POST", "/", body)
    connection.getresponse().read()
    connection.close()
    api = RosApi(node_of(base).api_uri, TIMEOUT_S)
    assert api.call("getPid", "/test")
    with pytest.raises(RosApiError, match="TCPROS"):
        api.call("requestTopic", "/test", "/base/Chat", [["UDPROS"]])
    with pytest.raises(RosApiError, match="not published"):
        api.call("requestTopic", "/test", "/nothing", [["TCPROS"]])
    with pytest.raises(RosApiError, match="list of addresses"):
        api.call("publisherUpdate", "/test", "/nothing", 5)
    assert api.call("publisherUpdate", "/test", "/nothing", ["not an address"]) == 0
    api.close()


def test_node_api_reports_ports_and_connections(base: RosComponent) -> None:
    publish, channel = base.publisher(CHAT, "Chat")
    base.subscribe(CHAT, lambda _: None, "Ear", "/ear")
    stream = opened(base)
    header = exchange_headers(stream, {**ANY, "topic": "/base/Chat"}, TIMEOUT_S)
    assert header["md5sum"] == "992ce8a1687cec8c8bd883ec73ca41d1"
    assert header["message_definition"] == "string data\n"
    wait_until(channel.has_subscribers)
    publish(String("hello"))
    assert bytes(stream.frame()) == LENGTH.pack(5) + b"hello"
    api = RosApi(node_of(base).api_uri, TIMEOUT_S)
    assert api.call("getPublications", "/test") == [["/base/Chat", "std_msgs/String"]]
    assert ["/ear", "std_msgs/String"] in api.call("getSubscriptions", "/test")
    (row,) = api.call("getBusInfo", "/test")
    assert row[1:] == ["/test", "o", "TCPROS", "/base/Chat", True]
    published, _, _ = api.call("getBusStats", "/test")
    assert published[0][:2] == ["/base/Chat", 9]
    assert api.call("getName", "/test") == "/base"
    api.close()
    stream.close()


@pytest.mark.parametrize(
    "sent",
    [
        LENGTH.pack(0xFFFFFFFF),
        LENGTH.pack(3) + b"abc",
        LENGTH.pack(6) + LENGTH.pack(2) + b"\xff\xfe",
    ],
    ids=["huge", "short", "no text"],
)
def test_subscriber_reports_malformed_messages_of_a_publisher(
    lone_network: Ros1Network, sent: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.WARNING)
    texts: list[str] = []
    user = lone_network.component("user")
    user.subscribe(CHAT, lambda text: texts.append(text.data), "Ear", "/ear")
    publisher = lone_network.component("publisher", Chat="/ear")
    publish, channel = publisher.publisher(CHAT, "Chat")
    node = node_of(publisher)
    (publication,) = node._publications.values()
    node_of(user).update_publishers("/ear", [node.api_uri])
    wait_until(channel.has_subscribers)
    link = publication.links[0]
    link.send(TcpMessage(sent), publisher.counts("Chat", "said"))
    wait_until(lambda: user.counts("Ear", "said").malformed)
    wait_until(lambda: publish(String("valid")) or texts)
    assert set(texts) == {"valid"}
    assert "from /publisher on /ear" in caplog.text


def test_publisher_drops_the_oldest_messages_of_a_slow_reader(base: RosComponent) -> None:
    publish, channel = base.publisher(CHAT, "Chat", qos=Qos(depth=3))
    stream = opened(base)
    exchange_headers(stream, {**ANY, "topic": "/base/Chat"}, TIMEOUT_S)
    wait_until(channel.has_subscribers)
    text, sent = "x" * 100_000, 0
    counts = base.counts("Chat", "said")
    while counts.drops < 10:
        publish(String(f"{sent:06}{text}"))
        sent += 1
    numbers = []
    while not numbers or numbers[-1] < sent - 1:
        numbers.append(int(bytes(stream.frame()[4:10])))
    assert numbers == sorted(numbers)
    assert len(numbers) == sent - counts.drops
    assert numbers[-3:] == [sent - 3, sent - 2, sent - 1]
    stream.close()


def test_components_without_a_master_are_warned_once_and_connected(
    base: RosComponent, lone_network: Ros1Network, caplog: pytest.LogCaptureFixture
) -> None:
    user = lone_network.component("user")
    user.publisher(CHAT, "Chat")
    call = user.caller(SWITCH, "set", "Switch")
    assert call(SetBoolRequest(True)) == SetBoolResponse(True, "ours")
    wait_until(lambda: "/user: the ROS master http://127.0.0.1:9 cannot be reached" in caplog.text)


def test_parse_header_is_the_inverse_of_encode_header() -> None:
    fields = {"callerid": "/a", "md5sum": "*", "message_definition": "string data=ü\n"}
    assert parse_header(encode_header(fields)[4:]) == fields
    with pytest.raises(MalformedMessage, match="within a length"):
        parse_header(b"\1")


@pytest.mark.parametrize("text", ["127.0.0.1:11311", "http://", "https://a:1", "http://a:x"])
def test_settings_refuse_address_of_master(text: str) -> None:
    with pytest.raises(MiddlewareError, match=r"ros1\.master"):
        read_settings({"master": text}, {})
    with pytest.raises(MiddlewareError, match="ROS_MASTER_URI"):
        read_settings({}, {"ROS_MASTER_URI": text})


@pytest.mark.parametrize(
    ("master", "host", "unreachable"),
    [
        ("http://10.0.0.2:11311", "", True),
        ("http://10.0.0.2:11311", "10.0.0.3", False),
        ("http://localhost:11311", "", False),
    ],
)
def test_settings_tell_whether_a_remote_master_cannot_reach_the_node(
    master: str, host: str, unreachable: bool
) -> None:
    assert read_settings({"master": master, "host": host}, {}).is_unreachable is unreachable


def test_settings_are_those_of_ros_by_default() -> None:
    assert read_settings({}, {}).master == "http://127.0.0.1:11311"
    found = read_settings({}, {"ROS_MASTER_URI": "http://robot:11311/", "ROS_IP": "10.0.0.3"})
    assert (found.master, found.host) == ("http://robot:11311", "10.0.0.3")
    assert read_settings({"host": "10.0.0.4"}, {"ROS_HOSTNAME": "robot"}).host == "10.0.0.4"
    with pytest.raises(MiddlewareError, match="address of this machine"):
        read_settings({"host": "0.0.0.0"}, {})
    with pytest.raises(MiddlewareError, match="no setting `hots`; known: host, master"):
        read_settings({"hots": "x"}, {})
