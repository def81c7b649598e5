"""Processes that a benchmark measures with: they talk by lines, and end with their input."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def process(*arguments: str, python: str = sys.executable) -> Iterator[subprocess.Popen[str]]:
    """A process that runs until the end of its input; its first line has not been read."""
    command = [python, *arguments]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as started:
        try:
            yield started
        finally:
            assert started.stdin
            started.stdin.close()


def line(started: subprocess.Popen[str]) -> str:
    """The next line of a process."""
    assert started.stdout
    return started.stdout.readline().strip()
