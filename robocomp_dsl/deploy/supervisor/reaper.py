"""Terminates the processes of a deployment if rcdeploy itself is killed.

Runs as a separate process (`python -I -S reaper.py TOKEN GRACE_S`), so it imports nothing of this
project. In: a pipe from rcdeploy as standard input, which the kernel closes when rcdeploy exits for
any reason. Out: all processes whose environment has `ROBOCOMP_DEPLOYMENT=TOKEN` are terminated:
SIGTERM first, so that motors stop in order, SIGKILL after the grace period. All processes that a
component starts inherit the environment, even if they leave its process group.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import sys
import time

DEPLOYMENT_VARIABLE = "ROBOCOMP_DEPLOYMENT"
CLEAN_SHUTDOWN = b"done"
"""What rcdeploy writes to the pipe after a clean shutdown."""
_EXEC_DELAY_S = 0.05
"""Longer than the time between fork and exec; the variable is visible only after exec."""


def find_processes(token: str) -> list[int]:
    """Processes that belong to the deployment `token`."""
    entry = f"{DEPLOYMENT_VARIABLE}={token}".encode()
    found = []
    for name in os.listdir("/proc"):  # noqa: PTH208 - runs hundreds of times, and without pathlib
        if not name.isdigit():
            continue
        with contextlib.suppress(OSError), open(f"/proc/{name}/environ", "rb") as stream:  # noqa: PTH123
            if entry in stream.read().split(b"\0"):
                found.append(int(name))
    return found


def terminate_all(token: str, grace_s: float) -> list[int]:
    """Terminate all processes of the deployment; returns those that needed SIGKILL."""
    _signal(find_processes(token), signal.SIGTERM)
    _wait_for_exit(find_processes(token), grace_s)
    killed: list[int] = []
    quiet = 0
    while quiet < 2:
        left = find_processes(token)
        killed += [pid for pid in left if pid not in killed]
        _signal(left, signal.SIGKILL)
        _wait_for_exit(left, 1.0)
        quiet = 0 if left else quiet + 1
        if quiet == 1:
            select.select([], [], [], _EXEC_DELAY_S)
    return killed


def _signal(pids: list[int], number: int) -> None:
    for pid in pids:
        with contextlib.suppress(OSError):
            os.kill(pid, number)


def _wait_for_exit(pids: list[int], longest_s: float) -> None:
    """Wait until all `pids` have exited, at most `longest_s` seconds."""
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
    """Wait for the end of rcdeploy, then terminate its remaining processes."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_IGN)
    token, grace_s = sys.argv[1], float(sys.argv[2])
    received = b""
    while data := os.read(0, 64):
        received += data
    if received != CLEAN_SHUTDOWN:
        terminate_all(token, grace_s)


if __name__ == "__main__":
    main()
