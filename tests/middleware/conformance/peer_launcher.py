"""Starts peers: components in processes of their own, which a test kills, stops and continues.

A launcher has imported what a peer needs, and forks for each: a peer runs within 20 ms.
`python -m tests.middleware.conformance.peer_launcher` is the launcher; its standard input is a
socket. `PeerLauncher` starts it and its peers.
"""

from __future__ import annotations

import contextlib
import gc
import json
import os
import select
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from tests.support.waiting import wait_until

_REQUEST_BYTES = 1 << 16


class Peer:
    """A component in another process: lines in both directions, and signals."""

    def __init__(self, pid: int, to_peer: int, from_peer: int) -> None:
        self.pid = pid
        self._input = os.fdopen(to_peer, "w", buffering=1)
        self._output = os.fdopen(from_peer)
        try:
            self._handle = os.pidfd_open(pid)
        except ProcessLookupError:
            self._handle = -1

    def ask(self, *words: object) -> str:
        """Send a request, and return the line of its reply."""
        self._input.write(" ".join(map(str, words)) + "\n")
        reply = self.read()
        assert reply, f"the peer {self.pid} ended"
        return reply

    def read(self) -> str:
        """The next line of the peer; empty when it has ended."""
        return self._output.readline().strip()

    def kill(self) -> None:
        """End the process as kill -9 does, and wait for its end."""
        self.signal(signal.SIGKILL)
        self.wait()

    def stop(self) -> None:
        """Stop the process as SIGSTOP does, and wait until it has stopped."""
        self.signal(signal.SIGSTOP)
        stat = Path(f"/proc/{self.pid}/stat")  # proc(5): the third field is the state
        wait_until(lambda: stat.read_text().rpartition(")")[2].split()[0] == "T")

    def resume(self) -> None:
        """Let a stopped process continue."""
        self.signal(signal.SIGCONT)

    def signal(self, number: int) -> None:
        """Send a signal to the process, if it still exists."""
        with contextlib.suppress(ProcessLookupError):
            if self._handle >= 0:
                signal.pidfd_send_signal(self._handle, number)

    def wait(self) -> None:
        """Wait for the end of the process."""
        wait_until(self.has_ended, f"process {self.pid} ends")

    def has_ended(self) -> bool:
        """Whether the process has ended."""
        return self._handle < 0 or bool(select.select([self._handle], [], [], 0)[0])

    def close(self) -> None:
        """End the process and close what belongs to it."""
        with contextlib.suppress(OSError):
            self._input.close()
        self.signal(signal.SIGCONT)
        if not self.has_ended():
            self.kill()
        self._output.close()
        if self._handle >= 0:
            os.close(self._handle)


class PeerLauncher:
    """The launcher, and the peers that it has started."""

    def __init__(self) -> None:
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            command = [sys.executable, "-m", __spec__.name]
            self._process = subprocess.Popen(command, stdin=theirs)
        self._peers: list[Peer] = []

    def start(self, program: str, middleware: str, domain: str, **options: Any) -> Peer:
        """Start a program of `peer_programs`, and wait until it is ready."""
        request = {"program": program, "middleware": middleware, "domain": domain} | options
        their_input, to_peer = os.pipe()
        from_peer, their_output = os.pipe()
        try:
            message = json.dumps(request).encode()
            socket.send_fds(self._socket, [message], [their_input, their_output])
            pid = int(self._socket.recv(16))
        finally:
            os.close(their_input)
            os.close(their_output)
        peer = Peer(pid, to_peer, from_peer)
        self._peers.append(peer)
        assert peer.read() == "ready", f"{program} on {middleware} does not start"
        return peer

    def end_peers(self) -> None:
        """End all peers."""
        peers, self._peers = self._peers, []
        for peer in peers:
            peer.close()

    def close(self) -> None:
        """End the launcher and all peers."""
        self.end_peers()
        self._socket.close()
        assert self._process.wait(60) == 0


@contextlib.contextmanager
def launched() -> Iterator[PeerLauncher]:
    """A launcher that ends with the block."""
    launcher = PeerLauncher()
    try:
        yield launcher
    finally:
        launcher.close()


def main() -> None:
    """Fork for each request until the socket is closed."""
    from tests.middleware.conformance.peer_programs import PROGRAMS  # noqa: PLC0415

    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # the kernel reaps the peers
    connection = socket.socket(fileno=0)
    gc.freeze()
    while True:
        data, streams, _, _ = socket.recv_fds(connection, _REQUEST_BYTES, 2)
        if not data:
            return
        request = json.loads(data)
        if pid := os.fork():
            for stream in streams:
                os.close(stream)
            connection.send(str(pid).encode())
        else:
            _run_peer(PROGRAMS[request.pop("program")], request, streams)


def _run_peer(program: Callable[..., None], request: dict[str, Any], streams: list[int]) -> None:
    """Run a program in this process, with a request for each line of its standard input."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    code = 1
    try:
        program(**request)
        code = 0
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    main()
