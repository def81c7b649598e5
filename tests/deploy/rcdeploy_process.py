"""A program whose output is read to a text, and which never outlives its test; where it runs."""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

import pytest

DEADLINE_S = 240.0


class Running:
    """A process started by a test; killed when it hangs, so that no test waits for ever."""

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
        self._limit.start()
        self.lines: list[str] = []

    def until(self, *texts: str) -> str:
        """Read on until every one of `texts` has come, in any order; the line of the last one."""
        assert self.process.stdout is not None
        found: dict[str, str] = {}
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))
            found |= {text: line for text in texts if text in line}
            if len(found) == len(texts):
                return found[texts[-1]]
        missing = " and ".join(f"`{text}`" for text in texts if text not in found)
        raise AssertionError(f"{missing} never came:\n" + "\n".join(self.lines))

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


@contextlib.contextmanager
def runtime_folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder for sockets of this test only, with a path short enough for them."""
    with tempfile.TemporaryDirectory(prefix="rc-") as name:
        monkeypatch.setenv("XDG_RUNTIME_DIR", name)
        yield Path(name) / f"robocomp-{os.getuid()}"
