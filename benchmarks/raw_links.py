"""Round trips between two processes by the bare means of the operating system and of libraries.

In: a kind of link. Out: an echo (`serve`, in the other process) and a function that sends ready
bytes and waits for them (`connect`), written as fast as Python can.

    python -m benchmarks.raw_links FOLDER KIND...    echoes until its input ends
"""

from __future__ import annotations

import ctypes
import importlib
import socket
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

KINDS = ("stream", "seqpacket", "tcp", "zmq ipc", "iceoryx2")
_MODULES = {"zmq ipc": "zmq", "iceoryx2": "iceoryx2"}
MAX_BYTES = 1 << 16
Call = Callable[[bytes], bytes]


def installed() -> list[str]:
    """The kinds that can run here; the others are named."""
    found = []
    for kind in KINDS:
        try:
            importlib.import_module(_MODULES.get(kind, "socket"))
            found.append(kind)
        except ImportError:
            print(f"   {kind} is not installed: skipped")
    return found


def _socket(kind: str) -> socket.socket:
    if kind == "tcp":
        return socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    types = {"stream": socket.SOCK_STREAM, "seqpacket": socket.SOCK_SEQPACKET}
    return socket.socket(socket.AF_UNIX, types[kind])


def _echo(opened: socket.socket) -> None:
    if opened.family == socket.AF_INET:
        opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    while data := opened.recv(MAX_BYTES):
        opened.send(data)


def serve(kind: str, folder: Path) -> None:
    """Echo; does not return."""
    if kind == "zmq ipc":
        import zmq  # noqa: PLC0415

        replier = zmq.Context.instance().socket(zmq.REP)
        replier.bind(f"ipc://{folder}/zmq")
        while True:
            replier.send(replier.recv())
    if kind == "iceoryx2":
        link = Iceoryx(folder.name, "there", "back")
        while True:
            link.send(link.receive())
    listening = _socket(kind)
    if kind == "tcp":
        listening.bind(("127.0.0.1", 0))
        (folder / "tcp").write_text(str(listening.getsockname()[1]))
    else:
        listening.bind(str(folder / kind))
    listening.listen()
    _echo(listening.accept()[0])


def connect(kind: str, folder: Path) -> Call:
    """A function that sends bytes and returns their echo."""
    if kind == "zmq ipc":
        import zmq  # noqa: PLC0415

        requester = zmq.Context.instance().socket(zmq.REQ)
        requester.connect(f"ipc://{folder}/zmq")

        def by_zmq(data: bytes) -> bytes:
            requester.send(data)
            return requester.recv()

        return by_zmq
    if kind == "iceoryx2":
        link = Iceoryx(folder.name, "back", "there")

        def by_iceoryx(data: bytes) -> bytes:
            link.send(data)
            return link.receive()

        return by_iceoryx
    opened = _socket(kind)
    if kind == "tcp":
        opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        opened.connect(("127.0.0.1", int((folder / "tcp").read_text())))
    else:
        opened.connect(str(folder / kind))

    def by_socket(data: bytes) -> bytes:
        opened.send(data)
        return opened.recv(MAX_BYTES)

    return by_socket


class Iceoryx:
    """Publish and subscribe of iceoryx2, and its events to wait for a sample."""

    def __init__(self, name: str, receives: str, sends: str) -> None:
        import iceoryx2 as iox2  # noqa: PLC0415

        iox2.set_log_level(iox2.LogLevel.Fatal)
        self._node = iox2.NodeBuilder.new().create(iox2.ServiceType.Ipc)

        def service(suffix: str) -> Any:
            return self._node.service_builder(iox2.ServiceName.new(f"{name}/{suffix}"))

        def topic(direction: str) -> Any:
            builder = service(direction).publish_subscribe(iox2.Slice[ctypes.c_uint8])
            return builder.open_or_create()

        def event(direction: str) -> Any:
            return service(f"{direction}-event").event().open_or_create()

        self._notify = event(sends).notifier_builder().create().notify
        self._wait = event(receives).listener_builder().create().blocking_wait
        self._publisher = topic(sends).publisher_builder().initial_max_slice_len(256).create()
        self._subscriber = topic(receives).subscriber_builder().create()

    def send(self, data: bytes) -> None:
        """Copy into shared memory, and wake the other side."""
        sample = self._publisher.loan_slice_uninit(len(data))
        ctypes.memmove(sample.payload_ptr, data, len(data))
        sample.assume_init().send()
        self._notify()

    def receive(self) -> bytes:
        """The next sample."""
        while (sample := self._subscriber.receive()) is None:
            self._wait()
        return bytes(sample.payload().as_memory_view())


def main(folder: Path, kinds: list[str]) -> None:
    """Echo all kinds, until the input ends."""
    for kind in kinds:
        threading.Thread(target=serve, args=(kind, folder), daemon=True).start()
    names = {"zmq ipc": "zmq"}
    files = [folder / names.get(kind, kind) for kind in kinds if kind != "iceoryx2"]
    while not all(file.exists() for file in files):
        time.sleep(0.01)
    time.sleep(0.2)
    print("ready", flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
