"""`rcdeploy` as a process of its own, for faults that hit it. In: arguments. Out: its output."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self

from tests.support.waiting import wait_until

TIMEOUT_S = 300.0
"""Long, for a busy machine and a slow link; only a test that fails waits so long."""
PROGRAM = (sys.executable, "-m", "robocomp_dsl.cli.rcdeploy")


class RcdeployRun:
    """A running `rcdeploy`; it is killed at the end."""

    def __init__(self, *arguments: str | Path) -> None:
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 - closed at the end
        self.process = subprocess.Popen(
            [*PROGRAM, *map(str, arguments)],
            stdin=subprocess.DEVNULL,
            stdout=self._output,
            stderr=subprocess.STDOUT,
        )

    @property
    def output(self) -> str:
        """Standard output and errors until now."""
        size = os.fstat(self._output.fileno()).st_size
        # The offset belongs to the process that writes.
        return os.pread(self._output.fileno(), size, 0).decode("utf-8", "replace")

    def kill_when(self, condition: Callable[[], object], moment: str) -> None:
        """SIGKILL as soon as `condition` holds, which must be before the end."""
        wait_until(
            lambda: condition() or self.process.poll() is not None,
            lambda: f"not reached: {moment}\n{self.output}",
        )
        self.process.kill()
        code = self.process.wait()
        assert code == -9, f"rcdeploy ended before the moment `{moment}`: {code}\n{self.output}"

    def wait(self) -> int:
        """The exit code. Raises `AssertionError` with the output if it does not end."""
        try:
            return self.process.wait(TIMEOUT_S)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"rcdeploy does not end:\n{self.output}") from None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        self.process.kill()
        self.process.wait()
        self._output.close()
