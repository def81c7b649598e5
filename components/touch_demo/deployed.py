"""One running deployment.

In: a DDSL file, a name that is also its domain, a log file for the output of its components. Out: a
context in which it runs; at the end it waits until all have exited.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from failure import DemoFailed

_LAST_LINES = 16


@contextmanager
def deployed(ddsl: Path, name: str, log: Path) -> Iterator[Callable[[], None]]:
    """Yields a function that raises `DemoFailed` once the deployment has exited by itself."""
    program = Path(sys.executable).with_name("rcdeploy")
    command = [program, ddsl, "up", "--name", name, "--domain", name, "--no-table"]
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as output:
        process = subprocess.Popen(  # noqa: S603 - our own words
            list(map(str, command)), stdout=output, stderr=subprocess.STDOUT
        )
    try:
        yield lambda: _runs(process, log)
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        code = process.wait()
    if code:
        raise DemoFailed(f"rcdeploy ended with exit code {code}:\n{_end_of(log)}")


def _runs(process: subprocess.Popen[bytes], log: Path) -> None:
    if process.poll() is not None:
        code = process.returncode
        raise DemoFailed(f"rcdeploy ended early, with exit code {code}:\n{_end_of(log)}")


def _end_of(log: Path) -> str:
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    return "\n".join(f"    {line}" for line in lines[-_LAST_LINES:])
