"""Waits until a program is ready that does not report it: `python -m …` in `ExecStartPost=`.

In: `port N`: the TCP port accepts connections on loopback; `log FILE REGEX`: a line that was logged
since the last start matches. Out: the end of the process. The time limit is that of the unit.
"""

from __future__ import annotations

import re
import socket
import sys
import time
from pathlib import Path

PERIOD_S = 0.05
_HOSTS = ("127.0.0.1", "::1")
_MARK = b'"level": "INFO", "message": "starting"}\n'
_CHUNK = 1 << 16


def wait_for_port(port: int) -> None:
    """Return when something accepts connections at `port` of loopback."""
    while not any(_answers(host, port) for host in _HOSTS):
        time.sleep(PERIOD_S)


def _answers(host: str, port: int) -> bool:
    try:
        with socket.create_connection((host, port), PERIOD_S):
            return True
    except OSError:
        return False


def wait_for_line(log: Path, pattern: str) -> None:
    """Return when a line of `log` since the last start matches `pattern`."""
    expression = re.compile(pattern)
    with log.open("rb") as lines:
        lines.seek(last_start(log))
        rest = b""
        while True:
            *complete, rest = (rest + lines.read(_CHUNK)).split(b"\n")
            if any(expression.search(line.decode(errors="replace")) for line in complete):
                return
            if not complete:
                time.sleep(PERIOD_S)


def last_start(log: Path) -> int:
    """The offset after the last mark of a start in `log`; 0 without a mark."""
    with log.open("rb") as data:
        end = data.seek(0, 2)
        tail = b""
        while end > 0:
            begin = max(end - _CHUNK, 0)
            data.seek(begin)
            chunk = data.read(end - begin) + tail
            if (found := chunk.rfind(_MARK)) >= 0:
                return begin + found + len(_MARK)
            tail, end = chunk[: len(_MARK)], begin
    return 0


def main(arguments: list[str]) -> None:
    """Wait as the command line says."""
    match arguments:
        case ["port", number]:
            wait_for_port(int(number))
        case ["log", file, pattern]:
            wait_for_line(Path(file), pattern)
        case _:
            raise SystemExit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
