"""The network in which pytest and the simulated hosts meet: a bridge in a namespace of pytest.

Addresses exist in these namespaces only: each worker of xdist, and each run, has its own.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
from pathlib import Path

CLONE_NEWNET = 0x40000000
BRIDGE = "robocomp0"
SUBNET = "10.77.0"
OPERATOR_ADDRESS = f"{SUBNET}.1"
"""The address of pytest, and of what it starts, in the network of the hosts."""

_libc = ctypes.CDLL(None, use_errno=True)


def ip(*arguments: str) -> None:
    """Run `ip`. Raises `AssertionError` with what it printed."""
    completed = subprocess.run(["ip", *arguments], capture_output=True, text=True, check=False)
    assert completed.returncode == 0, f"ip {' '.join(arguments)}: {completed.stderr.strip()}"


class TestNetwork:
    """Moves this thread, and all that it starts from then on, into a network of its own.

    `close` moves it back; the kernel removes the network with its last process.
    """

    __test__ = False  # no test class

    def __init__(self) -> None:
        self._previous = os.open("/proc/thread-self/ns/net", os.O_RDONLY | os.O_CLOEXEC)
        if _libc.unshare(CLONE_NEWNET):
            raise OSError(ctypes.get_errno(), "unshare(CLONE_NEWNET)")
        ip("link", "set", "lo", "up")
        ip("link", "add", BRIDGE, "type", "bridge")
        ip("addr", "add", f"{OPERATOR_ADDRESS}/24", "dev", BRIDGE)
        ip("link", "set", BRIDGE, "up")
        self.number = Path("/proc/thread-self/ns/net").stat().st_ino
        self._next_host = 2
        self._next_link = 0

    def new_address(self) -> str:
        """An address that no host has had."""
        address = f"{SUBNET}.{self._next_host}"
        self._next_host += 1
        assert self._next_host < 255, "too many hosts in one network"
        return address

    def attach(self, pid: int, address: str) -> str:
        """Connect the network namespace of `pid`; returns the name of the link on this side."""
        self._next_link += 1
        link = f"host{self._next_link}"
        hardware = f"02:00:00:00:00:{int(address.rsplit('.', 1)[1]):02x}"  # as before a reboot
        peer = ("peer", "name", "eth0", "address", hardware, "netns", str(pid))
        ip("link", "add", link, "type", "veth", *peer)
        ip("link", "set", link, "master", BRIDGE, "up")
        inside = ("nsenter", f"--net=/proc/{pid}/ns/net", "ip", "-batch", "-")
        batch = f"addr add {address}/24 dev eth0\nlink set eth0 up\n"
        subprocess.run(inside, input=batch, text=True, check=True)
        return link

    def set_forwarding(self, link: str, *, on: bool) -> None:
        """Connect a link with the bridge, or disconnect it while both its ends stay up."""
        ip("link", "set", link, *(("master", BRIDGE) if on else ("nomaster",)))

    def detach(self, link: str) -> None:
        """Remove a link, if it still exists."""
        subprocess.run(["ip", "link", "del", link], capture_output=True, check=False)

    def close(self) -> None:
        """Move this thread back to the network of the machine."""
        if _libc.setns(self._previous, CLONE_NEWNET):
            raise OSError(ctypes.get_errno(), "setns(CLONE_NEWNET)")
        os.close(self._previous)
