"""Stores the logs of a running deployment, bounded in size, age and number of runs.

In: records. Out: the files that `log_runs` reads. A thread writes them at once, so that they
survive the death of rcdeploy; what a full disk refuses is counted.
"""

from __future__ import annotations

import os
import shutil
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from robocomp_dsl.deploy import log_runs
from robocomp_dsl.deploy.line_output import LineOutput, write_descriptor
from robocomp_dsl.deploy.log_runs import SEGMENT_SUFFIX, LogRun
from robocomp_dsl.deploy.logs import RCDEPLOY, LogRecord

MAX_QUEUED_RECORDS = 50_000
"""Records that wait for a slow disk; then the oldest are dropped and counted."""
MAX_RUNS = 100
"""Stored runs of one deployment."""
SEGMENTS = 10
"""The files of one deployment that reach the size limit; the oldest is deleted for a new one."""
CLOSE_TIMEOUT_S = 2.0
DAY_S = 86400.0


@dataclass(frozen=True, slots=True)
class LogLimits:
    """Limits of the stored logs of one deployment: all its runs together [bytes], their age [s]."""

    size: int = 100_000_000
    age_s: float = 14 * DAY_S


class LogStore:
    """Stores one run until `close`. Raises `OSError` if the folder cannot be created."""

    def __init__(self, run: LogRun, limits: LogLimits) -> None:
        self._run = run
        self._limits = limits
        above = log_runs.logs_folder() / run.name
        above.mkdir(mode=0o700, parents=True, exist_ok=True)
        self.folder = _create_next_folder(above)
        self._describe(run)
        self._descriptor = -1
        self._size = 0
        self._output = LineOutput(self._append)
        self._waiting: deque[LogRecord] = deque()
        self._lost = 0
        self._ending = False
        self._wake = threading.Condition()
        self._thread = threading.Thread(target=self._write_all, name="log-store", daemon=True)
        self._thread.start()

    def attach(self, log: Callable[[str], object]) -> None:
        """Report through `log` when the disk refuses records; called from any thread."""
        self._output.on_error = lambda reason: log(
            f"{self.folder} refuses log lines ({reason}); they are dropped until it takes them"
        )

    def record(self, record: LogRecord) -> None:
        """Store a record soon."""
        with self._wake:
            if len(self._waiting) >= MAX_QUEUED_RECORDS:
                self._waiting.popleft()
                self._lost += 1
            self._waiting.append(record)
            self._wake.notify()

    def close(self, code: int, reason: str) -> None:
        """Write what is waiting, and how the run ended."""
        with self._wake:
            self._ending = True
            self._wake.notify()
        self._thread.join(CLOSE_TIMEOUT_S)
        with suppress(OSError):
            self._describe(replace(self._run, ended=time.time(), code=code, reason=reason))

    def _describe(self, run: LogRun) -> None:
        new = self.folder / f"{log_runs.DESCRIPTION}.new"
        new.write_text(run.to_json(), encoding="utf-8")
        new.replace(self.folder / log_runs.DESCRIPTION)

    def _write_all(self) -> None:
        for name in log_runs.stored_names():  # the size is the business of each deployment
            limits = (
                self._limits if name == self._run.name else replace(self._limits, size=sys.maxsize)
            )
            delete_old(name, limits, keep=self.folder)
        ending = False
        while not ending:
            with self._wake:
                self._wake.wait_for(lambda: self._waiting or self._ending)
                records, self._waiting = self._waiting, deque()
                lost, self._lost = self._lost, 0
                ending = self._ending
            chunks = [(_encode(record), 1) for record in records]
            if lost:
                chunks.insert(0, (_notice(lost, "the disk was too slow"), lost))
            self._output.write(chunks, _notice)
        if self._descriptor >= 0:
            os.close(self._descriptor)

    def _append(self, data: bytes) -> int:
        """Append to the current segment, at most to its end of size; opens one if needed."""
        most = max(self._limits.size // SEGMENTS, 1)
        if self._descriptor < 0 or self._size >= most:
            self._open_segment()
        cut = len(data)
        if self._size + len(data) > most:
            # A segment ends with a line; a line that is longer than the rest still goes there.
            cut = data.rfind(b"\n", 0, most - self._size) + 1 or data.find(b"\n") + 1 or len(data)
        written = write_descriptor(self._descriptor, data[:cut])
        self._size += written
        return written

    def _open_segment(self) -> None:
        existing = log_runs.segments(self.folder)
        number = int(existing[-1].stem) + 1 if existing else 1
        path = self.folder / f"{number:06d}{SEGMENT_SUFFIX}"
        new = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o600)
        if self._descriptor >= 0:
            os.close(self._descriptor)
        self._descriptor, self._size = new, 0
        delete_old(self._run.name, self._limits, keep=self.folder)


def delete_old(name: str, limits: LogLimits, keep: Path) -> None:
    """Delete what exceeds the limits: whole runs by age and number, then the oldest segments.

    `keep` is the run that is being written; its newest segment stays.
    """
    folders = log_runs.run_folders(name)
    oldest = time.time() - limits.age_s
    expired = [f for f in folders if _last_written(f) < oldest and f != keep and not _is_running(f)]
    left = [folder for folder in folders if folder not in expired]
    expired += left[:-MAX_RUNS]
    for folder in expired:
        shutil.rmtree(folder, ignore_errors=True)
    files = [file for folder in left[-MAX_RUNS:] for file in log_runs.segments(folder)]
    sizes = {file: _size(file) for file in files}
    total = sum(sizes.values())
    room = max(limits.size // SEGMENTS, 1)
    for file in files[:-1]:
        if total <= limits.size - room:
            break
        total -= sizes[file]
        with suppress(OSError):
            file.unlink()
        if file.parent != keep and not log_runs.segments(file.parent):
            shutil.rmtree(file.parent, ignore_errors=True)


def _create_next_folder(above: Path) -> Path:
    existing = [int(path.name) for path in above.iterdir() if path.name.isdecimal()]
    number = max(existing, default=0) + 1
    while True:
        folder = above / f"{number:06d}"
        try:
            folder.mkdir(mode=0o700)
        except FileExistsError:
            number += 1
        else:
            return folder


def _is_running(folder: Path) -> bool:
    run = log_runs.read_description(folder)
    return run is not None and run.ended is None and Path(f"/proc/{run.pid}").exists()


def _last_written(folder: Path) -> float:
    files = [*log_runs.segments(folder), folder]
    times = []
    for file in files:
        with suppress(OSError):
            times.append(file.stat().st_mtime)
    return max(times, default=0.0)


def _size(file: Path) -> int:
    try:
        return file.stat().st_size
    except OSError:
        return 0


def _encode(record: LogRecord) -> bytes:
    return record.to_json().encode("utf-8", "replace") + b"\n"


def _notice(lost: int, reason: str) -> bytes:
    text = f"… {lost} line{'s were' if lost > 1 else ' was'} dropped: {reason}"
    return _encode(LogRecord(time.time(), RCDEPLOY, "WARNING", text))
