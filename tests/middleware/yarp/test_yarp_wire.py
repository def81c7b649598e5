"""Dialogues captured from YARP 3.5, replayed on a port of ours, and invalid bytes."""

from __future__ import annotations

import contextlib
import socket
from collections.abc import Iterator
from typing import Any

import pytest

from robocomp_dsl.runtime.codec.bottle.text_reader import read_text
from robocomp_dsl.runtime.codec.bottle.text_writer import write_text
from robocomp_dsl.runtime.codec.bottle.values import Bottle
from robocomp_dsl.runtime.errors import EncodeError, MalformedMessage, MiddlewareError
from robocomp_dsl.runtime.middleware.yarp import wire
from robocomp_dsl.runtime.middleware.yarp.port import MAX_CONNECTIONS, YarpPort
from tests.middleware.yarp.conftest import LOOPBACK
from tests.support.waiting import wait_until

TIMEOUT_S = 60.0
ACK = "59 41 00 00 00 00 52 50"
SET_UP_TCP = "59 41 e4 1e 00 00 52 50 03 00 00 00 2f 77 00"
SET_UP_FAST_TCP = "59 41 64 1e 00 00 52 50 03 00 00 00 2f 77 00"
END = (
    "59 41 0a 00 00 00 52 50 01 01 ff ff ff ff ff ff ff ff 0a 00 00 00 00 00 00 00"
    " 02 00 00 00 7e 00 00 01 71 00"
)
DATA = (
    "59 41 0a 00 00 00 52 50 02 01 ff ff ff ff ff ff ff ff 08 00 00 00 73 00 00 00 00 00 00 00"
    " 00 00 00 00 7e 44 00 01"
    " 00 01 00 00 08 00 00 00 01 00 00 00 01 00 00 00 0a 00 00 00 00 00 00 00 00 00 04 40"
    " 04 00 00 00 0b 00 00 00 68 65 6c 6c 6f 20 77 6f 72 6c 64 09 00 00 00 73 65 74 00"
    " 0c 00 00 00 03 00 00 00 01 02 ff 01 01 00 00 02 00 00 00 03 00 00 00 04 00 00 00"
    " 00 01 00 00 02 00 00 00 04 00 00 00 01 00 00 00 61 01 00 00 00 05 00 00 00"
    " 09 00 00 00 31 00 00 00"
)
TEXT = '1 2.5 "hello world" [set] {1 2 255} (3 4) (a 5) true'
REQUEST = (
    "59 41 0a 00 00 00 52 50 02 01 ff ff ff ff ff ff ff ff 08 00 00 00 0f 00 00 00 00 00 00 00"
    " 00 00 00 00 7e 64 00 01 04 01 00 00 01 00 00 00 03 00 00 00 6f 6e 65"
)
REPLY = "01 01 00 00 01 00 00 00 4d 00 00 00"
ENVELOPE = (
    "59 41 0a 00 00 00 52 50 02 01 ff ff ff ff ff ff ff ff 14 00 00 00 19 00 00 00 00 00 00 00"
    " 0c 00 00 00 7e 00 00 01 44 20 34 32 20 31 32 33 34 2e 35 00"
    " 00 01 00 00 02 00 00 00 04 00 00 00 01 00 00 00 78 01 00 00 00 01 00 00 00"
)
ADMIN = (
    "59 41 0a 00 00 00 52 50 02 01 ff ff ff ff ff ff ff ff 08 00 00 00 10 00 00 00 00 00 00 00"
    " 00 00 00 00 7e 61 00 01 00 01 00 00 01 00 00 00 09 00 00 00 76 65 72 00"
)


class Recorder:
    """Takes messages, and replies to requests."""

    def __init__(self) -> None:
        self.received: list[str] = []
        self.errors: list[MalformedMessage] = []
        self.reply: Bottle | None = [77]

    def receive(
        self, bottle: Bottle, size: int, envelope: str, *, wants_reply: bool
    ) -> Bottle | None:
        self.received.append(write_text(bottle))
        return self.reply if wants_reply else None

    def reject(self, error: MalformedMessage) -> Bottle:
        self.errors.append(error)
        return ["malformed"]

    def unwritable(self, error: EncodeError) -> Bottle:
        return ["unwritable"]


@pytest.fixture
def recorder() -> Recorder:
    return Recorder()


@pytest.fixture
def port(recorder: Recorder) -> Iterator[YarpPort]:
    opened = YarpPort("/srv", (LOOPBACK, 0), recorder)
    yield opened
    opened.close()


class Client:
    """A connection that sends bytes and compares what arrives."""

    def __init__(self, port: YarpPort) -> None:
        self.socket = socket.create_connection((LOOPBACK, port.number), TIMEOUT_S)

    def send(self, data: str | bytes) -> Client:
        self.socket.sendall(bytes.fromhex(data) if isinstance(data, str) else data)
        return self

    def expect(self, data: str | bytes) -> Client:
        wanted_bytes = bytes.fromhex(data) if isinstance(data, str) else data
        found = b""
        while len(found) < len(wanted_bytes):
            arrived = self.socket.recv(len(wanted_bytes) - len(found))
            assert arrived, f"closed after {found!r}"
            found += arrived
        assert found == wanted_bytes
        return self

    def expect_end(self) -> None:
        with contextlib.suppress(ConnectionResetError):
            assert self.socket.recv(1) == b""
        self.socket.close()


@pytest.fixture
def client(port: YarpPort) -> Iterator[Client]:
    opened = Client(port)
    yield opened
    opened.socket.close()


def test_tcp_data_is_acknowledged(client: Client, port: YarpPort, recorder: Recorder) -> None:
    client.send(SET_UP_TCP).expect(wire.number(port.number))
    client.send(DATA).expect(ACK)
    assert recorder.received == [TEXT]
    assert port.inputs() == {"/w": "tcp"}
    client.send(END).expect(ACK).expect_end()
    wait_until(lambda: port.inputs() == {})


def test_fast_tcp_data_has_no_acks(client: Client, port: YarpPort, recorder: Recorder) -> None:
    client.send(SET_UP_FAST_TCP).expect(wire.number(port.number))
    client.send(DATA).send(END).expect_end()
    assert recorder.received == [TEXT]


def test_tcp_request_is_replied_to(client: Client, port: YarpPort, recorder: Recorder) -> None:
    client.send(SET_UP_TCP).expect(wire.number(port.number))
    client.send(REQUEST).expect(REPLY).expect(ACK)
    recorder.reply = None  # without a Bottle, the client would take the ack for the reply
    client.send(REQUEST).expect("00 01 00 00 00 00 00 00").expect(ACK)
    recorder.reply = [object()]
    client.send(REQUEST).expect("04 01 00 00 01 00 00 00 0a 00 00 00").expect(b"unwritable")


def test_tcp_message_with_envelope(client: Client, port: YarpPort, recorder: Recorder) -> None:
    client.send(SET_UP_TCP).expect(wire.number(port.number))
    client.send(ENVELOPE).expect(ACK)
    assert recorder.received == ["x 1"]


def test_tcp_admin_command(client: Client, port: YarpPort) -> None:
    client.send(SET_UP_TCP).expect(wire.number(port.number))
    reply = (
        "00 01 00 00 04 00 00 00 09 00 00 00 76 65 72 00 01 00 00 00 01 00 00 00"
        " 01 00 00 00 02 00 00 00 01 00 00 00 03 00 00 00"
    )
    client.send(ADMIN).expect(reply).expect(ACK)


def test_text_ack_dialogue(client: Client, recorder: Recorder) -> None:
    recorder.reply = read_text("[ok] (1 2.5)")
    client.send(b"CONNACK /cli2\r\n").expect(b"Welcome /cli2\r\n")
    client.send(b"d\r\nhello 4\r\n").expect(b"[ok] (1 2.5)\r\n<ACK>\r\n")
    client.send(b"D 42 1234.5\nx 1\n").expect(b"<ACK>\r\n")
    client.send(b"D\r\n(1\r\n2)\r\n").expect(b"<ACK>\r\n")
    client.send(b"q\r\n").expect(b"<ACK>\r\n").expect_end()
    assert recorder.received == ["hello 4", "x 1", "(1 2)"]


def test_text_dialogue(client: Client, recorder: Recorder) -> None:
    client.send(b"CONNECT /w\r\n").expect(b"Welcome /w\r\n")
    client.send(b"D\r\nsecond\r\n").send(b"q\r\n").expect_end()
    assert recorder.received == ["second"]


@pytest.mark.parametrize(
    ("command", "reply"),
    [
        ("[ver]", "[ver] 1 2 3"),
        ("ver", "[ver] 1 2 3"),
        ("[list] [in]", '"/adm"'),
        ("[list] [out]", ""),
        ('[list] [in] "/adm"', '(from "/adm") (to "/srv") (carrier text_ack)'),
        ('[list] [out] "/no"', ""),
        ("[list]", ""),
        ('[add] "tcp://rp"', '-1 "/srv does not write: it has no outputs\\r\\n"'),
        (
            '[del] "/none"',
            '-1 "Could not find an outgoing connection to /none\\r\\n'
            'Could not find an incoming connection from /none\\r\\n"',
        ),
        ("[prop] [set] key 5", "[ok]"),
        ("[prop] [get] key", ""),
        ('[prop] [get] "/peer"', '[fail] "cannot find any connection to/from /peer"'),
        ("[nonsense]", '[fail] "send [help] for list of valid commands"'),
        ("", '[fail] "send [help] for list of valid commands"'),
        ("5", '[fail] "send [help] for list of valid commands"'),
    ],
)
def test_admin_replies(client: Client, command: str, reply: str) -> None:
    client.send(b"CONNACK /adm\r\n").expect(b"Welcome /adm\r\n")
    client.send(f"a\r\n{command}\r\n".encode()).expect(f"{reply}\r\n<ACK>\r\n".encode())


def test_admin_properties_are_kept(client: Client) -> None:
    client.send(b"CONNACK admin\r\n").expect(b"Welcome admin\r\n")
    client.send(b"a\r\n[prop] [set] key 5 x\r\n").expect(b"[ok]\r\n<ACK>\r\n")
    client.send(b"a\r\n[prop] [get] key\r\n").expect(b"5 x\r\n<ACK>\r\n")
    client.send(b"a\r\n[prop] [get]\r\n").expect(b"(key 5 x)\r\n<ACK>\r\n")


def test_admin_removes_an_input(client: Client, port: YarpPort) -> None:
    client.send(b"CONNECT /w\r\n").expect(b"Welcome /w\r\n")
    admin = Client(port).send(b"CONNACK admin\r\n").expect(b"Welcome admin\r\n")
    admin.send(b'a\r\n[del] "/w"\r\n')
    admin.expect(b'0 "Removed connection from /w to /srv\\r\\n"\r\n<ACK>\r\n')
    client.expect_end()
    admin.socket.close()


def test_port_describes_itself(client: Client, port: YarpPort) -> None:
    client.send(b"CONNACK <ping>\r\n").expect(b"Welcome <ping>\r\n").send(b"*\r\n")
    client.expect(f"This is /srv at tcp://127.0.0.1:{port.number}/\r\n".encode())
    client.expect(b"There are no outgoing connections\r\nThere are no incoming connections\r\n")
    client.expect(b"<ACK>\r\n").send(b"nonsense\r\n").expect(b"Port command not understood.\r\n")


@pytest.mark.parametrize(
    "data",
    [
        b"GET / HTTP/1.1\r\n\r\n",
        b"\xff" * 100,
        bytes.fromhex("59 41 61 1e 00 00 52 50"),  # udp
        wire.set_up("tcp", "/w")[:8] + b"\xff\xff\xff\x7f" + b"x" * 2000,
        wire.set_up("fast_tcp", "/w") + b"\0" * 64,
        wire.set_up("fast_tcp", "/w") + wire.INDEX + b"\1\1" + b"\xff" * 16,
        wire.set_up("fast_tcp", "/w")
        + wire.INDEX
        + b"\2\1"
        + b"\xff" * 8
        + b"\xff\xff\xff\x7f" * 3,
        wire.set_up("fast_tcp", "/w") + wire.INDEX + b"\1\1" + b"\xff" * 8 + b"\2\0\0\0" * 3,
        b"",
        b"YA",
    ],
)
def test_invalid_bytes_end_their_connection_only(port: YarpPort, data: bytes) -> None:
    bad = Client(port).send(data)
    bad.socket.shutdown(socket.SHUT_WR)
    while True:
        try:
            if not bad.socket.recv(100):
                break
        except ConnectionResetError:
            break
    bad.socket.close()
    good = Client(port).send(SET_UP_TCP).expect(wire.number(port.number))
    good.send(REQUEST).expect(REPLY).expect(ACK).socket.close()


def test_invalid_bottle_is_reported_and_the_connection_continues(
    client: Client, port: YarpPort, recorder: Recorder
) -> None:
    client.send(SET_UP_TCP).expect(wire.number(port.number))
    client.send(wire.frame(b"\1\2\3\4\5", "D")).expect(ACK)
    client.send(REQUEST).expect(REPLY).expect(ACK)
    assert len(recorder.errors) == 1


def test_connections_are_limited(port: YarpPort) -> None:
    clients = [Client(port) for _ in range(MAX_CONNECTIONS)]
    wait_until(lambda: port._listener.connections == MAX_CONNECTIONS)
    Client(port).expect_end()
    clients.pop().socket.close()
    wait_until(lambda: port._listener.connections < MAX_CONNECTIONS)
    clients.append(Client(port).send(b"CONNECT /w\r\n").expect(b"Welcome /w\r\n"))
    for each in clients:
        each.socket.close()


def test_closed_port_ends_its_connections(client: Client, port: YarpPort) -> None:
    client.send(b"CONNECT /w\r\n").expect(b"Welcome /w\r\n")
    port.close()
    client.expect_end()
    with pytest.raises(OSError, match="refused"):
        socket.create_connection((LOOPBACK, port.number), TIMEOUT_S)


def test_port_in_use_is_reported(port: YarpPort) -> None:
    with pytest.raises(
        MiddlewareError, match=r"cannot listen at 127\.0\.0\.1:\d+: Address already"
    ):
        YarpPort("/other", (LOOPBACK, port.number))


def test_frame_of_data_is_that_of_yarp() -> None:
    payload = bytes.fromhex(DATA)[-0x73:]
    assert wire.frame(payload, "D") == bytes.fromhex(DATA)
    assert wire.frame(b"", "q") == bytes.fromhex(END)
    assert wire.frame(bytes.fromhex(ENVELOPE)[-25:], "D", "42 1234.5") == bytes.fromhex(ENVELOPE)
    assert wire.set_up("tcp", "/w") == bytes.fromhex(SET_UP_TCP)
    assert wire.set_up("fast_tcp", "/w") == bytes.fromhex(SET_UP_FAST_TCP)


def test_help_lists_the_commands(client: Client) -> None:
    client.send(b"CONNACK admin\r\n").expect(b"Welcome admin\r\n")
    client.send(b"a\r\n[help]\r\n").expect(b'[many] "[help]  ')
    data: Any = client.socket.recv(10_000)
    assert b"[add] $portname" in data
