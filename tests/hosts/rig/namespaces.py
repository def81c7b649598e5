"""The network in which pytest and the simulated hosts meet: a bridge in a namespace of pytest.

Addresses exist in these namespaces only: each worker of xdist, and each run, has its own.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from pathlib import Path

EMULATOR = Path(__file__).with_name("link_emulator.py")
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
        self._emulators: dict[str, subprocess.Popen[bytes]] = {}

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
        link = f"{link}o" if link in self._emulators else link
        ip("link", "set", link, *(("master", BRIDGE) if on else ("nomaster",)))

    def impair(self, link: str, pid: int, loss: float, delay_s: float) -> None:
        """Lose and delay packets of a link in both directions; `restore` ends it."""
        self.restore(link, pid)
        netem = ("root", "netem", "loss", f"{loss:.3%}", "delay", f"{delay_s * 1e3:.3f}ms")
        inside = ("nsenter", f"--net=/proc/{pid}/ns/net")
        kernel = subprocess.run(
            ["tc", "qdisc", "add", "dev", link, *netem], check=False, stderr=subprocess.DEVNULL
        )
        if kernel.returncode == 0:
            subprocess.run([*inside, "tc", "qdisc", "add", "dev", "eth0", *netem], check=True)
            return
        outer, inner = f"{link}o", f"{link}i"
        ip("link", "add", outer, "type", "veth", "peer", "name", inner)
        plain = (sys.executable, "-S", "-E", str(EMULATOR), "plain")
        subprocess.run([*inside, *plain, "eth0"], check=True)
        subprocess.run([*plain, outer], check=True)
        ip("link", "set", link, "nomaster")
        ip("link", "set", inner, "up")
        ip("link", "set", outer, "master", BRIDGE, "up")
        forward = ("forward", link, inner, str(loss), str(delay_s))
        emulator = subprocess.Popen(
            ["setpriv", "--pdeathsig", "KILL", *plain[:-1], *forward], stdout=subprocess.PIPE
        )
        self._emulators[link] = emulator
        assert emulator.stdout
        assert emulator.stdout.readline() == b"ready\n"

    def restore(self, link: str, pid: int) -> None:
        """End `impair`."""
        emulator = self._emulators.pop(link, None)
        if emulator is None:
            for prefix in ((), ("nsenter", f"--net=/proc/{pid}/ns/net")):
                device = "eth0" if prefix else link
                command = (*prefix, "tc", "qdisc", "del", "dev", device, "root")
                subprocess.run(command, check=False, capture_output=True)
            return
        emulator.kill()
        emulator.wait()
        assert emulator.stdout
        emulator.stdout.close()
        ip("link", "del", f"{link}o")
        ip("link", "set", link, "master", BRIDGE)

    def detach(self, link: str) -> None:
        """Remove a link, if it still exists."""
        if emulator := self._emulators.pop(link, None):
            emulator.kill()
            emulator.communicate()
            subprocess.run(["ip", "link", "del", f"{link}o"], capture_output=True, check=False)
        subprocess.run(["ip", "link", "del", link], capture_output=True, check=False)

    def close(self) -> None:
        """Move this thread back to the network of the machine."""
        if _libc.setns(self._previous, CLONE_NEWNET):
            raise OSError(ctypes.get_errno(), "setns(CLONE_NEWNET)")
        os.close(self._previous)
