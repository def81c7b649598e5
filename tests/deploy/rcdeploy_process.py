"""Programs in processes that end with their test; `rcdeploy` in a process; a folder for sockets."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

import pytest

DEADLINE_S = 240.0
PROGRAM = "from robocomp_dsl.cli.rcdeploy.main import main; main()"


class RunningProcess:
    """A process of a test; killed after `DEADLINE_S`."""

    def __init__(self, *command: str, where: Path | None = None) -> None:
        self.process = subprocess.Popen(
            command,
            cwd=where,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self._limit = threading.Timer(DEADLINE_S, self.process.kill)
        self._limit.daemon = True
        self._limit.start()
        self.lines: list[str] = []

    def until(self, *texts: str) -> str:
        """Read until every text of `texts` has appeared; the line of the last text of `texts`."""
        assert self.process.stdout is not None
        found: dict[str, str] = {}
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))
            found |= {text: line for text in texts if text in line}
            if len(found) == len(texts):
                return found[texts[-1]]
        missing = " and ".join(f"`{text}`" for text in texts if text not in found)
        raise AssertionError(f"{missing} did not appear:\n" + "\n".join(self.lines))

    def end(self) -> int:
        """Read the rest; the exit code."""
        assert self.process.stdout is not None
        self.lines += self.process.stdout.read().splitlines()
        code = self.process.wait(DEADLINE_S)
        self._limit.cancel()
        self.process.stdout.close()
        return code

    def has(self, text: str) -> bool:
        return any(text in line for line in self.lines)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        if self.process.poll() is None:
            self.process.kill()
            self.end()
        self._limit.cancel()


def rcdeploy(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run `rcdeploy` to its end, in a process."""
    command = [sys.executable, "-c", PROGRAM, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)


def start_rcdeploy(*arguments: str) -> RunningProcess:
    """Start `rcdeploy` in a process."""
    return RunningProcess(sys.executable, "-c", PROGRAM, *arguments)


@contextlib.contextmanager
def runtime_folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder for the sockets of one test; its path is short enough for them."""
    with tempfile.TemporaryDirectory(prefix="rc-") as name:
        monkeypatch.setenv("XDG_RUNTIME_DIR", name)
        yield Path(name) / f"robocomp-{os.getuid()}"
