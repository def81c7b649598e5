"""What a process uses, from /proc (Linux, proc(5)). In: a pid. Out: CPU share and memory."""

from __future__ import annotations

import os
import time
from pathlib import Path

_TICKS_PER_S = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")
_UTIME = 11
"""Index of the user time behind the closing parenthesis of /proc/PID/stat; the system time follows,
nine fields later the resident pages."""
_RSS = _UTIME + 10
_SHORTEST_S = 0.2


class Meter:
    """CPU share of one process between two looks, its memory at the last."""

    def __init__(self, pid: int) -> None:
        self._path = Path(f"/proc/{pid}/stat")
        self._at = time.monotonic()
        self._used_s = 0.0
        self.cpu = 0.0
        self.memory = 0

    def look(self) -> None:
        """Measure now; a process that has ended uses nothing."""
        now = time.monotonic()
        if now - self._at < _SHORTEST_S and self.memory:
            return
        try:
            fields = self._path.read_text(encoding="utf-8").rpartition(")")[2].split()
        except OSError:
            self.cpu, self.memory = 0.0, 0
            return
        used_s = (int(fields[_UTIME]) + int(fields[_UTIME + 1])) / _TICKS_PER_S
        self.cpu = (used_s - self._used_s) / max(now - self._at, 1e-3)
        self.memory = int(fields[_RSS]) * _PAGE
        self._at, self._used_s = now, used_s
