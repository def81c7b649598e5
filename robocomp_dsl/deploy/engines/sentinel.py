"""Ends what a deployment started when rcdeploy itself can no longer do it.

Runs as a process of its own (`python -I -S sentinel.py TOKEN GRACE_S`), so it imports nothing of
this project. In: a pipe from rcdeploy as standard input, which the kernel closes however rcdeploy
ends. Out: no process whose environment has `ROBOCOMP_DEPLOYMENT=TOKEN` is left: first SIGTERM, so
that motors stop in order, after the grace SIGKILL. The environment is inherited by everything a
component starts, also by what leaves its process group.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import time

MARK = "ROBOCOMP_DEPLOYMENT"
NOTHING_LEFT = b"done"
"""What rcdeploy says at an end in good order."""
_SETTLE_S = 0.05
"""Longer than a fork takes to become an exec, which is when the mark appears."""


def marked(token: str) -> list[int]:
    """Processes that belong to the deployment `token`."""
    wanted = f"{MARK}={token}".encode()
    found = []
    for name in os.listdir("/proc"):  # noqa: PTH208 - runs hundreds of times, and without pathlib
        if not name.isdigit():
            continue
        with contextlib.suppress(OSError), open(f"/proc/{name}/environ", "rb") as stream:  # noqa: PTH123
            if wanted in stream.read().split(b"\0"):
                found.append(int(name))
    return found


def end_all(token: str, grace_s: float) -> list[int]:
    """End them all; the processes that had to be killed."""
    _signal(marked(token), signal.SIGTERM)
    _wait(marked(token), grace_s)
    killed: list[int] = []
    quiet = 0
    while quiet < 2:
        left = marked(token)
        killed += [pid for pid in left if pid not in killed]
        _signal(left, signal.SIGKILL)
        _wait(left, 1.0)
        quiet = 0 if left else quiet + 1
        if quiet == 1:
            select.select([], [], [], _SETTLE_S)
    return killed


def _signal(pids: list[int], number: int) -> None:
    for pid in pids:
        with contextlib.suppress(OSError):
            os.kill(pid, number)


def _wait(pids: list[int], longest_s: float) -> None:
    """Until all `pids` have ended, or `longest_s` has passed."""
    deadline = time.monotonic() + longest_s
    watched = set()
    for pid in pids:
        with contextlib.suppress(OSError):
            watched.add(os.pidfd_open(pid))
    while watched and (left := deadline - time.monotonic()) > 0:
        for ended in select.select(list(watched), [], [], left)[0]:
            watched.remove(ended)
            os.close(ended)
    for descriptor in watched:
        os.close(descriptor)


def main() -> None:
    """Wait for the end of rcdeploy, then end what it left."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_IGN)
    token, grace_s = sys.argv[1], float(sys.argv[2])
    told = b""
    while data := os.read(0, 64):
        told += data
    if told != NOTHING_LEFT:
        end_all(token, grace_s)


if __name__ == "__main__":
    main()
