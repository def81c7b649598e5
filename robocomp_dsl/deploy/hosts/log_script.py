"""Runs on a host: sends its log files from given offsets, and what is appended to them.

In: a JSON object as argument: `root`, `components` (empty: all), `offsets` by component, `last`
(lines of each file, -1: all), `since` (s since 1970), `follow`. Out: frames: a JSON line with
`component`, `offset`, `length` and `time` (of the last change), then so many bytes, which are whole
lines; `{"done": true}` after the first pass. Only the standard library of Python 3.8, no import of
this project: rcdeploy sends the text of this file.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any, BinaryIO

CHUNK = 1 << 20
MAX_LINE = 1 << 16
PERIOD_S = 0.1
ALIVE_S = 1.0
SEARCH_BYTES = 1 << 16


def data_start(log: BinaryIO, offset: int) -> int:
    """The first offset from `offset` on that is not in a hole."""
    try:
        return os.lseek(log.fileno(), offset, os.SEEK_DATA)
    except OSError:
        return offset


def line_time(line: bytes) -> float | None:
    """The time of a JSON line [s]; None if it has none."""
    try:
        fields = json.loads(line.decode("utf-8", "replace")) if line.startswith(b"{") else {}
        return float(fields["time"])
    except (ValueError, KeyError, TypeError):
        return None


def last_lines(log: BinaryIO, count: int) -> int:
    """The offset of the last `count` lines."""
    end = log.seek(0, 2)
    first = data_start(log, 0) if end else 0
    found, position = -1, end
    while position > first:
        begin = max(position - SEARCH_BYTES, first)
        log.seek(begin)
        chunk = log.read(position - begin)
        for i in range(len(chunk) - 1, -1, -1):
            if chunk[i] == 0x0A:
                found += 1
                if found == count:
                    return begin + i + 1
        position = begin
    return first


def first_since(log: BinaryIO, since: float) -> int:
    """An offset of a line shortly before the first line of that time [s since 1970]."""
    end = log.seek(0, 2)
    low = data_start(log, 0) if end else 0
    high = end
    while high - low > SEARCH_BYTES:
        middle = (low + high) // 2
        log.seek(middle)
        log.readline()
        stamp = None
        while stamp is None and log.tell() < high:
            stamp = line_time(log.readline(MAX_LINE))
        if stamp is not None and stamp < since:
            low = middle
        else:
            high = middle
    log.seek(low)
    if low:
        log.readline()
    return log.tell()


class LogFile:
    """One log file, and how far it was sent."""

    def __init__(self, component: str, path: Path, offset: int | None, request: Any) -> None:
        self.component = component
        self.path = path
        if offset is None:
            with path.open("rb") as log:
                offset = 0
                if request["since"]:
                    offset = first_since(log, request["since"])
                if request["last"] >= 0:
                    offset = max(offset, last_lines(log, request["last"]))
        self.offset = offset

    def send(self) -> bool:
        """Send the next whole lines; returns whether there were some."""
        try:
            status = self.path.stat()
            if status.st_size == self.offset:
                return False
            if status.st_size < self.offset:
                self.offset = 0
            with self.path.open("rb") as log:
                begin = data_start(log, self.offset)
                log.seek(begin)
                if begin != self.offset:
                    begin += len(log.readline())
                data = log.read(CHUNK)
        except OSError:
            return False
        end = data.rfind(b"\n") + 1
        if not end and len(data) > MAX_LINE:
            end = len(data)
        self.offset = begin
        if not end:
            return False
        send_frame(
            {
                "component": self.component,
                "offset": begin,
                "length": end,
                "time": status.st_mtime,
            },
            data[:end],
        )
        self.offset = begin + end
        return True


def send_frame(head: dict[str, Any], data: bytes = b"") -> None:
    """Write one frame."""
    sys.stdout.buffer.write(json.dumps(head).encode() + b"\n" + data)
    sys.stdout.buffer.flush()


def find_files(request: Any, known: dict[str, LogFile]) -> None:
    """Add the log files that are not yet known."""
    folder = Path(request["root"]) / "logs"
    for path in sorted(folder.glob("**/*.log")):
        component = str(path.relative_to(folder))[: -len(".log")]
        chosen = not request["components"] or component in request["components"]
        if chosen and component not in known:
            offset = request["offsets"].get(component)
            try:
                known[component] = LogFile(component, path, offset, request)
            except OSError:
                continue


def main() -> None:
    """Send what there is, and with `follow` what comes."""
    request = json.loads(sys.argv[1])
    files: dict[str, LogFile] = {}
    find_files(request, files)
    for log in files.values():
        while log.send():
            pass
    send_frame({"done": True})
    # Files that appear later are new from their first line on.
    request["last"], request["since"] = -1, 0.0
    alive = time.monotonic()
    while request["follow"]:
        busy = [log.send() for log in files.values()]
        now = time.monotonic()
        if now - alive > ALIVE_S:
            alive = now
            send_frame({"alive": True})
            find_files(request, files)
        if not any(busy):
            time.sleep(PERIOD_S)


if __name__ == "__main__":
    try:
        main()
    except (BrokenPipeError, KeyboardInterrupt):
        os._exit(0)
