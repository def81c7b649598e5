"""What programs that speak another protocol, or send garbage, can do to a component: nothing."""

from __future__ import annotations

import logging
import os
import random
import socket
import threading
from array import array
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.middleware.local import listener, packets, ports
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool
from robocomp_dsl.runtime.presence.port_record import PortRecord
from tests.middleware.local.direct import FRAMES, Side, open_descriptors
from tests.middleware.probe_handlers import HANDLERS
from tests.middleware.probe_types import PROBE
from tests.support.waiting import wait_until

Open = Callable[[str], Side]
ADD = ports.head_of(packets.QUERY, PROBE, PROBE.operation("add"))
REQUEST = PROBE.operation("add").encode_request((1, 2))
STRANGER = Endpoint(PROBE, "stranger", "Probe")


@pytest.fixture
def server(side: Open) -> Iterator[tuple[Side, PortRecord]]:
    """A server; after the test it still answers, holds no more threads, and was not ended."""
    served = side("server")
    record = served.serve(HANDLERS)
    call = side("client").calls(record)
    assert call("add", 1, 2) == 3
    threads = threading.active_count()
    yield served, record
    assert call("add", 3, 4) == 7
    assert side("another").calls(record)("add", 5, 6) == 11
    assert not served.failures
    wait_until(lambda: threading.active_count() <= threads + 1)


def connected(record: PortRecord, greet: bool = True) -> socket.socket:
    path, port = ports.parse_address(record.address)
    opened = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    opened.settimeout(60)
    opened.connect(path)
    if greet:
        opened.send(ports.hello_packet(STRANGER, port, packets.QUERY))
        assert opened.recv(100)[0] == packets.READY
    return opened


def is_closed(opened: socket.socket) -> bool:
    """Wait for the end of a connection; replies before it are skipped."""
    with opened:
        while True:
            try:
                if not opened.recv(1 << 17):
                    return True
            except ConnectionError:
                continue


def send(opened: socket.socket, packet: bytes, *descriptors: int) -> None:
    rights = (socket.SOL_SOCKET, socket.SCM_RIGHTS, array("i", descriptors))
    try:
        opened.sendmsg([packet], [rights] if descriptors else [])
    finally:
        for descriptor in descriptors:
            os.close(descriptor)


GREETINGS = {
    "text": b"GET / HTTP/1.1\r\n\r\n",
    "one byte": b"\1",
    "no greeting": ADD + REQUEST,
    "another version": packets.HEAD.pack(packets.HELLO, 0, 0) + b"RCL0" + bytes(13),
    "cut": ports.hello_packet(STRANGER, 1, packets.QUERY)[:10],
    "long": bytes(packets.MAX_PACKET + 1),
}


@pytest.mark.parametrize("greeting", list(GREETINGS))
def test_listener_closes_connections_of_other_protocols(
    server: tuple[Side, PortRecord], greeting: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        opened = connected(server[1], greet=False)
        opened.send(GREETINGS[greeting])
        assert is_closed(opened)
        wait_until(lambda: "rejected a" in caplog.text)
    assert server[0].transport._listener.rejected == 1


def test_listener_refuses_a_port_of_another_kind(server: tuple[Side, PortRecord]) -> None:
    opened = connected(server[1], greet=False)
    opened.send(ports.hello_packet(STRANGER, 1, packets.PUBLICATION))
    assert opened.recv(200)[0] == packets.REFUSED
    assert is_closed(opened)


def test_listener_closes_the_oldest_of_many_silent_connections(
    server: tuple[Side, PortRecord],
) -> None:
    opened = [connected(server[1], greet=False) for _ in range(listener.MAX_SILENT + 5)]
    assert all(is_closed(each) for each in opened[:5])
    late = opened[-1]
    late.send(ports.hello_packet(STRANGER, 1, packets.QUERY))
    assert late.recv(100)[0] == packets.READY
    for each in opened:
        each.close()


PACKETS = {
    "unknown kind": bytes((99, 0, 0, 0)) + REQUEST,
    "unknown operation": ADD[:2] + b"\xff\xff" + REQUEST,
    "publication": packets.HEAD.pack(packets.PUBLICATION, 0, 0) + bytes(16) + REQUEST,
    "without a body": b"\1",
    "shared without a file": ADD[:1] + b"\1" + ADD[2:] + packets.SIZE.pack(100),
    "long": bytes(packets.MAX_PACKET + 1),
}


@pytest.mark.parametrize("packet", list(PACKETS))
def test_server_closes_connection_of_a_malformed_packet(
    server: tuple[Side, PortRecord], packet: str
) -> None:
    opened = connected(server[1])
    opened.send(PACKETS[packet])
    assert is_closed(opened)
    counts = server[0].statistics.operations.values()
    wait_until(lambda: sum(each.malformed for each in counts) == 1)


def test_malformed_request_is_answered_and_the_connection_continues(
    server: tuple[Side, PortRecord],
) -> None:
    with connected(server[1]) as opened:
        opened.send(ADD + REQUEST[:-1])
        assert opened.recv(1000)[0] == packets.FAILURE
        opened.send(ADD + REQUEST)
        assert opened.recv(1000)[0] == packets.RESULT
    assert server[0].count("add").malformed == 1


def test_descriptors_of_strangers_are_closed(server: tuple[Side, PortRecord]) -> None:
    def null() -> int:
        return os.open("/dev/null", os.O_RDONLY)

    before = open_descriptors()
    shared = ADD[:1] + b"\1" + ADD[2:] + packets.SIZE.pack(100)
    for packet, count in ((ADD + REQUEST, 1), (ADD + REQUEST, 5), (shared, 1), (shared, 2)):
        opened = connected(server[1])
        opened.send(packets.ANNOUNCEMENT)
        send(opened, packet, *(null() for _ in range(count)))
        assert is_closed(opened)
    with connected(server[1]) as opened:  # without an announcement they are discarded
        send(opened, ADD + REQUEST, null(), null())
        assert opened.recv(100)[0] == packets.RESULT
    silent = connected(server[1], greet=False)
    send(silent, GREETINGS["text"], null())
    assert is_closed(silent)
    wait_until(lambda: open_descriptors() <= before)


def test_client_survives_malformed_replies(side: Open, folder: object) -> None:
    """A server that answers with garbage."""
    from robocomp_dsl.runtime.errors import MiddlewareError  # noqa: PLC0415

    ready = packets.HEAD.pack(packets.READY, 0, 0) + packets.DEPTH.pack(1)
    replies = [
        [b"x"],
        [packets.HEAD.pack(packets.RESULT, 0, 0)],
        [ready, bytes((packets.RESULT, 0, 9, 9))],
        [ready, bytes((packets.RESULT, 1)) + ADD[2:] + packets.SIZE.pack(8)],
        [ready, bytes((packets.RESULT, 0)) + ADD[2:] + b"zzz"],
        [ready, bytes((packets.FAILURE, 0)) + ADD[2:]],
        [ready, bytes((packets.FAILURE, 0)) + ADD[2:] + b"RCD"],
        [ready, b"\xff"],
        [ready, bytes(packets.MAX_PACKET + 7)],
    ]
    path = f"{folder}/liar"
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listening:
        listening.bind(path)
        listening.listen()

        def lie() -> None:
            for each in replies:
                accepted, _ = listening.accept()
                with accepted, suppress(OSError):
                    for reply in each:
                        accepted.recv(1000)
                        accepted.send(reply)

        thread = threading.Thread(target=lie)
        thread.start()
        record = PortRecord("server", PROBE.name, "liar", "Probe", "", "local", f"{path}#1")
        client, before = side("client"), open_descriptors()
        for _ in replies:
            with pytest.raises(MiddlewareError):
                client.calls(record)("add", 1, 2)
        thread.join()
    Path(path).unlink()
    assert open_descriptors() <= before


def mutated(data: bytes, rng: random.Random) -> bytes:
    """`data` with some bytes changed, removed, repeated or added."""
    changed = bytearray(data)
    for _ in range(rng.randint(1, 6)):
        at = rng.randrange(len(changed)) if changed else 0
        kind = rng.randrange(4)
        if kind == 0 and changed:
            changed[at] = rng.choice((0, 1, 127, 128, 255, rng.randrange(256)))
        elif kind == 1:
            del changed[at : at + rng.randint(1, 8)]
        elif kind == 2:
            changed[at:at] = changed[at : at + rng.randint(1, 8)]
        else:
            changed[at:at] = rng.randbytes(rng.randint(1, 8))
    return bytes(changed)


def send_mutations(record: PortRecord, originals: list[bytes], count: int, seed: int) -> None:
    """Send mutated packets, some of them with a descriptor; reconnect when it is closed."""
    rng, pool = random.Random(seed), MemoryPool()
    opened: socket.socket | None = None
    for _ in range(count):
        if opened is None:
            opened = connected(record, greet=False)
            hello = ports.hello_packet(STRANGER, 1, packets.QUERY)
            opened.send(mutated(hello, rng) if rng.random() < 0.1 else hello)
        packet = mutated(rng.choice(originals), rng) or b"\0"
        try:
            if rng.random() < 0.1:
                body = mutated(REQUEST * 50, rng)
                message = pool.message((body,), len(body))
                size = rng.choice((len(body), rng.randrange(1 << 40)))
                head = ADD[:1] + b"\1" + ADD[2:] + packets.SIZE.pack(size)
                opened.send(packets.ANNOUNCEMENT * rng.choice((1, 1, 1, 2)))
                send(opened, head, os.dup(message.descriptor))
            else:
                opened.send(packet)
            opened.setblocking(False)
            with suppress(BlockingIOError):
                if not opened.recv(1 << 17):
                    raise ConnectionResetError
            opened.settimeout(60)
        except OSError:
            opened.close()
            opened = None
    if opened:
        opened.close()


ORIGINALS = [
    ADD + REQUEST,
    ports.head_of(packets.QUERY, PROBE, PROBE.operation("echo"))
    + PROBE.operation("echo").encode_request((np.zeros(9, np.float32),)),
    ports.head_of(packets.COMMAND, PROBE, PROBE.operation("note"))
    + PROBE.operation("note").encode_request(("text",)),
]


def test_server_survives_mutated_packets(server: tuple[Side, PortRecord]) -> None:
    before = open_descriptors()
    send_mutations(server[1], ORIGINALS, 2000, seed=12)
    wait_until(lambda: open_descriptors() <= before + 4)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_server_survives_many_mutated_packets(server: tuple[Side, PortRecord], seed: int) -> None:
    before, memory = open_descriptors(), resident_bytes()
    send_mutations(server[1], ORIGINALS, 100_000, seed)
    wait_until(lambda: open_descriptors() <= before + 4)
    assert resident_bytes() < memory + 50_000_000


def resident_bytes() -> int:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def test_subscriber_survives_malformed_publications(side: Open) -> None:
    received: list[int] = []
    subscriber = side("s")
    record = subscriber.subscribe({"taken": lambda n, _pixels: received.append(n)}, FRAMES)
    path, port = ports.parse_address(record.address)
    at = Endpoint(FRAMES, "p", "Frames")
    head = ports.head_of(packets.PUBLICATION, FRAMES, FRAMES.operations[0])
    for packet in (head, head + bytes(15), ADD + REQUEST, b"\2", head + bytes(16) + b"xyz"):
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as opened:
            opened.connect(path)
            opened.send(ports.hello_packet(at, port, packets.PUBLICATION))
            opened.send(packet)
    wait_until(lambda: subscriber.count("taken", FRAMES).malformed == 5)
    side("p").publisher(FRAMES, record)("taken", 1, np.zeros(100_000, np.uint8))
    wait_until(lambda: received == [1])
