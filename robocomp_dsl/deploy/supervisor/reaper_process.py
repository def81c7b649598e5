"""Runs the reaper as a child, and a new one when it dies.

In: the token of the deployment. Out: as long as rcdeploy lives, a process that ends the components
if rcdeploy is killed.
"""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.deploy.supervisor import reaper
from robocomp_dsl.deploy.supervisor.child import describe_exit

RESTART_DELAY_S = 0.5
"""Time before a reaper that did not live that long is replaced."""


class ReaperProcess:
    """The reaper of one deployment, from the constructor to `close`."""

    def __init__(self, token: str, grace_s: float) -> None:
        self._command = [
            *(sys.executable, "-I", "-S", str(Path(reaper.__file__))),
            *(token, str(grace_s)),
        ]
        self._process = self._start()

    @property
    def pid(self) -> int:
        """The pid of the current reaper."""
        return self._process.pid

    async def watch(self, log: Callable[[str, str], None]) -> None:
        """Replace the reaper whenever it dies, until the task is cancelled."""
        while True:
            await _wait_for_exit(self._process.pid)
            code, old = self._process.wait(), self.pid
            self._close_pipe()
            while True:
                try:
                    self._process = self._start()
                    break
                except OSError as error:
                    log(f"no reaper can be started: {error}; trying again", "ERROR")
                    await asyncio.sleep(RESTART_DELAY_S)
            log(
                f"the reaper (pid {old}), which ends the components if rcdeploy is killed, died "
                f"({describe_exit(code)}); started another reaper (pid {self.pid})",
                "WARNING",
            )
            await asyncio.sleep(RESTART_DELAY_S)

    def close(self, *, clean: bool) -> None:
        """End the reaper; unless the shutdown was clean, it terminates what is left."""
        try:
            self._process.communicate(reaper.CLEAN_SHUTDOWN if clean else b"")
        except OSError:  # it has died
            self._process.wait()

    def _start(self) -> subprocess.Popen[bytes]:
        return subprocess.Popen(  # noqa: S603 - our own script
            self._command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, start_new_session=True
        )

    def _close_pipe(self) -> None:
        assert self._process.stdin is not None  # noqa: S101 - a pipe
        self._process.stdin.close()


async def _wait_for_exit(pid: int) -> None:
    loop, exited = asyncio.get_running_loop(), asyncio.Event()
    handle = os.pidfd_open(pid)
    loop.add_reader(handle, exited.set)
    try:
        await exited.wait()
    finally:
        loop.remove_reader(handle)
        os.close(handle)
