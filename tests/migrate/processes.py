"""Run migrated components as processes."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

DEADLINE_S = 240.0


class ComponentProcess:
    """A component process; its output lines are collected."""

    def __init__(self, folder: Path, *options: str) -> None:
        self.lines: list[str] = []
        self._changed = threading.Condition()
        self._process = subprocess.Popen(
            [sys.executable, "main.py", *options],
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=os.environ | {"PYTHONUNBUFFERED": "1"},
        )
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            with self._changed:
                self.lines.append(line.rstrip())
                self._changed.notify_all()
        with self._changed:
            self._changed.notify_all()

    def wait_for(self, words: str) -> str:
        """The first output line with `words`; fails after `DEADLINE_S`."""
        with self._changed:
            self._changed.wait_for(lambda: self._found(words) is not None, DEADLINE_S)
            line = self._found(words)
        assert line is not None, "\n".join(self.lines[-40:])
        return line

    def _found(self, words: str) -> str | None:
        return next((line for line in self.lines if words in line), None)

    def wait_for_end(self) -> int:
        """The exit code of a process that ends by itself."""
        return self._process.wait(DEADLINE_S)

    def stop(self) -> int:
        """Terminate the process; its exit code."""
        self._process.terminate()
        try:
            code = self._process.wait(DEADLINE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            code = self._process.wait()
        self._reader.join()
        return code


@contextmanager
def running(folder: Path, *options: str) -> Iterator[ComponentProcess]:
    """A component that runs during the block."""
    process = ComponentProcess(folder, *options)
    try:
        yield process
    finally:
        process.stop()
