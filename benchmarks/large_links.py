"""Large messages between two processes: inline, by memory files, and by named shared memory.

In: a kind of link. Out: a function that sends an array and waits until the other process has read
one byte of each page. The receiver of the last two reads the memory that the sender wrote.

    python -m benchmarks.large_links FOLDER KIND...    receives until its input ends
"""

from __future__ import annotations

import mmap
import os
import secrets
import socket
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from robocomp_dsl.runtime.middleware.local import packets
from robocomp_dsl.runtime.middleware.local.mapped_files import MappedFiles
from robocomp_dsl.runtime.middleware.local.memory_pool import MemoryPool

KINDS = ("inline", "memfd", "memfd pool", "memfd mapped once", "shm")
PAGE = 4096
HEAD = packets.HEAD.pack(1, 0, 0)
SHM = Path("/dev/shm")
Send = Callable[[np.ndarray], None]


def touch(data: bytes | memoryview | mmap.mmap) -> bytes:
    """Read one byte of each page."""
    return int(np.frombuffer(data, np.uint8)[::PAGE].sum()).to_bytes(8, "little")


def _inline(opened: socket.socket) -> None:
    while head := opened.recv(8):
        size = int.from_bytes(head, "little")
        data = bytearray(size)
        view, at = memoryview(data), 0
        while at < size:
            at += opened.recv_into(view[at:])
        opened.send(touch(data))


def _memfd(opened: socket.socket) -> None:
    files = MappedFiles()
    while True:
        packet = packets.receive(opened, files)
        assert isinstance(packet, packets.SharedPacket)
        data = touch(packet.body)
        del packet
        opened.send(data)


def _memfd_reused(opened: socket.socket) -> None:
    _, ancillary, _, _ = opened.recvmsg(64, packets.DESCRIPTOR_SPACE)
    descriptor = int.from_bytes(ancillary[0][2][:4], "little")
    mapped = mmap.mmap(descriptor, os.fstat(descriptor).st_size, prot=mmap.PROT_READ)
    while size := opened.recv(8):
        opened.send(touch(memoryview(mapped)[: int.from_bytes(size, "little")]))


def _shm(opened: socket.socket) -> None:
    while name := opened.recv(64):
        with (SHM / name.decode()).open("rb") as file:
            mapped = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        opened.send(touch(mapped))


RECEIVERS = {"inline": _inline, "shm": _shm}
RECEIVERS |= {"memfd": _memfd, "memfd pool": _memfd, "memfd mapped once": _memfd_reused}


def connect(kind: str, folder: Path, largest: int) -> Send:
    """A function that sends an array of at most `largest` bytes."""
    opened = socket.socket(
        socket.AF_UNIX, socket.SOCK_STREAM if kind == "inline" else socket.SOCK_SEQPACKET
    )
    opened.connect(str(folder / kind))

    def inline(array: np.ndarray) -> None:
        opened.send(array.nbytes.to_bytes(8, "little"))
        opened.sendall(array)
        opened.recv(8)

    pool = MemoryPool()

    def memfd_pool(array: np.ndarray) -> None:
        packets.send(opened, HEAD, pool.message((array,), array.nbytes))
        opened.recv(8)

    def memfd(array: np.ndarray) -> None:
        packets.send(opened, HEAD, MemoryPool().message((array,), array.nbytes))
        opened.recv(8)

    def shm(array: np.ndarray) -> None:
        path = SHM / f"bench-{secrets.token_hex(4)}"
        with path.open("wb") as file:
            file.write(array)
        opened.send(path.name.encode())
        opened.recv(8)
        path.unlink()

    if kind != "memfd mapped once":
        return {"inline": inline, "memfd": memfd, "memfd pool": memfd_pool, "shm": shm}[kind]
    descriptor = os.memfd_create("bench")
    os.ftruncate(descriptor, largest)
    socket.send_fds(opened, [b"x"], [descriptor])

    def reused(array: np.ndarray) -> None:
        os.pwrite(descriptor, array, 0)
        opened.send(array.nbytes.to_bytes(8, "little"))
        opened.recv(8)

    return reused


def main(folder: Path, kinds: list[str]) -> None:
    """Receive by all kinds, until the input ends."""
    for kind in kinds:
        listening = socket.socket(
            socket.AF_UNIX, socket.SOCK_STREAM if kind == "inline" else socket.SOCK_SEQPACKET
        )
        listening.bind(str(folder / kind))
        listening.listen()

        def run(kind: str = kind, listening: socket.socket = listening) -> None:
            try:
                RECEIVERS[kind](listening.accept()[0])
            except ConnectionResetError:
                return  # the end

        threading.Thread(target=run, daemon=True).start()
    time.sleep(0.05)
    print("ready", flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
