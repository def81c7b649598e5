"""Streams, links and listeners, as `ros1` and `yarp` use them."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Iterator

import pytest

from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection import bounded_queue
from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.middleware.tcp.listener import TcpListener
from robocomp_dsl.runtime.middleware.tcp.outgoing_link import OutgoingLink, TcpMessage
from robocomp_dsl.runtime.middleware.tcp.stream import CHUNK, ConnectionLost, TcpStream, behind
from tests.support.waiting import wait_until

LIMIT_S = 60.0
LARGE = bytes(range(256)) * 20_000
"""More than the buffers of the system take at once."""


@pytest.fixture
def pair() -> Iterator[tuple[TcpStream, TcpStream]]:
    """Two connected streams."""
    first, second = map(TcpStream, socket.socketpair())
    yield first, second
    first.close()
    second.close()


@pytest.mark.parametrize(
    ("sent", "rest"), [(0, b"abcdef"), (1, b"bcdef"), (3, b"def"), (5, b"f"), (6, b"")]
)
def test_behind_is_what_was_not_sent(sent: int, rest: bytes) -> None:
    assert b"".join(behind((b"abc", b"", b"def"), sent)) == rest


@pytest.mark.parametrize("size", [1, CHUNK, CHUNK + 1, len(LARGE) - 5])
def test_tcp_stream_takes_sizes_across_buffers(
    pair: tuple[TcpStream, TcpStream], size: int
) -> None:
    writer, reader = pair
    thread = threading.Thread(target=writer.send, args=(LARGE[:3], LARGE[3:]))
    thread.start()
    parts = [reader.take(4), reader.take_view(size), reader.take(len(LARGE) - size - 4)]
    thread.join(LIMIT_S)
    assert b"".join(parts) == LARGE
    assert reader.bytes_in == len(LARGE)


def test_tcp_stream_send_now_never_waits(pair: tuple[TcpStream, TcpStream]) -> None:
    """Also after a call with a deadline, which gives the socket a time-out."""
    writer, _ = pair
    writer.deadline = time.monotonic() + LIMIT_S
    writer.send(b"x")
    writer.deadline = None
    while writer.send_now([LARGE]):
        pass
    assert writer.socket.gettimeout() is None


def test_tcp_stream_deadline_and_end_are_told_apart(pair: tuple[TcpStream, TcpStream]) -> None:
    writer, reader = pair
    reader.deadline = time.monotonic() - 1
    with pytest.raises(ConnectionLost) as passed:
        reader.take(1)
    assert passed.value.timed_out
    reader.deadline = None
    assert not reader.is_closed()
    writer.close()
    assert reader.is_closed()
    with pytest.raises(ConnectionLost, match="the peer closed the connection") as ended:
        reader.take(1)
    assert not ended.value.timed_out


def test_outgoing_link_sends_all_in_order(pair: tuple[TcpStream, TcpStream]) -> None:
    """The rest of a large message, and those behind it, are sent by the thread of the link."""
    writer, reader = pair
    counts = OperationCounts("Port", "operation")
    link = OutgoingLink("/sender", "/reader", Qos())
    link.start(writer)
    for number in range(5):
        link.send(TcpMessage(bytes([number]), LARGE), counts)
    for number in range(5):
        assert reader.take(1) == bytes([number])
        assert reader.take_view(len(LARGE)) == LARGE
    wait_until(lambda: link.queued_bytes == 0)
    link.close()
    assert (link.messages_out, counts.drops) == (5, 0)
    assert reader.is_closed()


@pytest.mark.parametrize("qos", [Qos(depth=2), Qos(depth=2, reliable=True)], ids=str)
def test_outgoing_link_drops_and_counts_without_room(
    pair: tuple[TcpStream, TcpStream], qos: Qos, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without `reliable` the oldest, else the latest; what was sent in part is complete."""
    monkeypatch.setattr(bounded_queue, "HOLD_S", 0.01)
    writer, reader = pair
    counts = OperationCounts("Port", "operation")
    link = OutgoingLink("/sender", "/reader", qos)
    link.start(writer)
    for number in range(6):
        link.send(TcpMessage(bytes([number]), LARGE), counts)
    assert counts.drops == 3
    received = [reader.take(1 + len(LARGE))[0] for _ in range(3)]
    assert received == ([0, 1, 2] if qos.reliable else [0, 4, 5])
    link.close()


def test_tcp_listener_keeps_a_connection_that_was_taken_over() -> None:
    taken: list[TcpStream] = []

    def serve(stream: TcpStream) -> bool:
        if stream.take(1) == b"t":
            taken.append(stream)
        return bool(taken)

    listener = TcpListener("/owner", "test", ("127.0.0.1", 0), TcpStream, serve, 8)
    listener.start()
    closed, open_ = (TcpStream.connect(("127.0.0.1", listener.number), LIMIT_S) for _ in range(2))
    closed.send(b"c")
    wait_until(closed.is_closed)
    open_.send(b"t")
    wait_until(lambda: taken and listener.connections == 0)
    listener.close()
    taken[0].send(b"still open")
    assert open_.take(10) == b"still open"
    for stream in (closed, open_, *taken):
        stream.close()
