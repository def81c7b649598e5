"""Measures CPU share and memory of a process from /proc (Linux, proc(5))."""

from __future__ import annotations

import os
import time
from pathlib import Path

_TICKS_PER_S = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")
_UTIME_INDEX = 11
"""Index of the user time in /proc/PID/stat, counted after the closing parenthesis. The system time
follows; the resident pages are ten fields further."""
_RSS_INDEX = _UTIME_INDEX + 10
_MIN_INTERVAL_S = 0.2


class ResourceUsage:
    """CPU share of one process between two samples (1.0: one core), its memory in bytes."""

    def __init__(self, pid: int) -> None:
        self._path = Path(f"/proc/{pid}/stat")
        self._sampled_at = time.monotonic()
        self._used_s = 0.0
        self.cpu = 0.0
        self.memory = 0

    def sample(self) -> None:
        """Measure now; an exited process counts as zero."""
        now = time.monotonic()
        if now - self._sampled_at < _MIN_INTERVAL_S and self.memory:
            return
        try:
            fields = self._path.read_text(encoding="utf-8").rpartition(")")[2].split()
        except OSError:
            self.cpu, self.memory = 0.0, 0
            return
        used_s = (int(fields[_UTIME_INDEX]) + int(fields[_UTIME_INDEX + 1])) / _TICKS_PER_S
        self.cpu = (used_s - self._used_s) / max(now - self._sampled_at, 1e-3)
        self.memory = int(fields[_RSS_INDEX]) * _PAGE
        self._sampled_at, self._used_s = now, used_s
