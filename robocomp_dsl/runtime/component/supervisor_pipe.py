"""The pipe through which a component reports heartbeats and hangs to rcdeploy.

In: a file descriptor, whose number is in `ROBOCOMP_HEARTBEAT_FD`. Out: lines: a number is a
heartbeat, after which the process hangs if no other comes within so many seconds (0: none will); a
JSON object is a `HangReport`. Without the variable nothing is written.
"""

from __future__ import annotations

import os
from contextlib import suppress

from robocomp_dsl.runtime.component.hang_report import HangReport

HEARTBEAT_VARIABLE = "ROBOCOMP_HEARTBEAT_FD"


class SupervisorPipe:
    """The writing end; never blocks, and never fails because of its reader."""

    def __init__(self) -> None:
        number = os.environ.pop(HEARTBEAT_VARIABLE, "")
        self._descriptor = int(number) if number.isdecimal() else -1
        if self._descriptor >= 0:
            try:
                os.set_blocking(self._descriptor, False)
                os.set_inheritable(self._descriptor, False)
            except OSError:
                self._descriptor = -1

    def beat(self, seconds: float) -> None:
        """Report that the next heartbeat follows within `seconds`; 0: none follows."""
        self._write(f"{seconds:g}")

    def report(self, report: HangReport) -> None:
        """Report a hang."""
        self._write(report.to_json())

    def _write(self, line: str) -> None:
        if self._descriptor >= 0:
            # A full pipe: rcdeploy does not read, so it does not watch either.
            with suppress(OSError):
                os.write(self._descriptor, f"{line}\n".encode())
