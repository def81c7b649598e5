"""Packet loss and delay of a link, where the kernel has no `tc netem` (sch_netem).

As a script: `forward LINK BRIDGE_END LOSS DELAY_S` copies frames between two interfaces, each lost
with the probability LOSS, otherwise later by DELAY_S; it prints `ready`. `plain INTERFACE` lets the
kernel compute checksums and segments itself, because no network card will for copied frames.
"""

from __future__ import annotations

import fcntl
import heapq
import random
import select
import socket
import struct
import sys
import time

ETH_P_ALL = 3
PACKET_OUTGOING = 4
FRAME_BYTES = 65536
SIOCETHTOOL = 0x8946
OFFLOADS = (0x17, 0x1F, 0x24, 0x19)
"""ETHTOOL_STXCSUM, ETHTOOL_STSO, ETHTOOL_SGSO, ETHTOOL_SSG of linux/ethtool.h."""


def disable_offloads(interface: str) -> None:
    """Let the kernel finish packets before it gives them to `interface`."""
    import ctypes  # noqa: PLC0415 - not needed for each frame

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        for command in OFFLOADS:
            value = ctypes.create_string_buffer(struct.pack("II", command, 0))
            request = struct.pack("16sP", interface.encode(), ctypes.addressof(value))
            fcntl.ioctl(control, SIOCETHTOOL, request)


def open_interface(name: str) -> socket.socket:
    """A socket for all frames of an interface."""
    interface = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
    interface.bind((name, 0))
    interface.setblocking(False)
    return interface


def forward(first: str, second: str, loss: float, delay_s: float) -> None:
    """Copy frames in both directions until the process is killed."""
    ends = [open_interface(first), open_interface(second)]
    others = {ends[0]: ends[1], ends[1]: ends[0]}
    chance = random.Random(7)
    queue: list[tuple[float, int, socket.socket, bytes]] = []
    count = 0
    print("ready", flush=True)
    while True:
        timeout = max(queue[0][0] - time.monotonic(), 0.0) if queue else None
        for end in select.select(ends, [], [], timeout)[0]:
            frame, address = end.recvfrom(FRAME_BYTES)
            if address[2] != PACKET_OUTGOING and chance.random() >= loss:
                count += 1
                heapq.heappush(queue, (time.monotonic() + delay_s, count, others[end], frame))
        while queue and queue[0][0] <= time.monotonic():
            _, _, end, frame = heapq.heappop(queue)
            try:
                end.send(frame)
            except OSError:
                continue  # the queue of the interface is full, or it is down: the frame is lost


if __name__ == "__main__":
    if sys.argv[1] == "plain":
        disable_offloads(sys.argv[2])
    else:
        forward(sys.argv[2], sys.argv[3], float(sys.argv[4]), float(sys.argv[5]))
