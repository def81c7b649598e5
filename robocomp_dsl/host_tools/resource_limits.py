"""Watches the memory and CPU time of a process and its children, and judges them by their limits.

In: `Limits` and samples from /proc. Out: a warning when a limit is exceeded, and a failure
when it stays exceeded. Memory is the resident size, in which shared pages count for each process.
"""

from __future__ import annotations

import os
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from robocomp_dsl.host_tools.resource_usage import ResourceUsage


class Limits(Protocol):
    """Limits of a process and its children; 0: none. `cpu` 1.0 is one core."""

    @property
    def memory_bytes(self) -> int:
        """Of the resident size."""

    @property
    def cpu(self) -> float:
        """The share of a core."""


SAMPLE_S = 1.0
TOLERANCE_S = 5.0
"""A process that exceeds a limit for so long without a break is restarted."""


@dataclass(frozen=True, slots=True)
class LimitExcess:
    """A limit is exceeded as `text` says; `is_lasting`: for longer than the tolerance."""

    text: str
    is_lasting: bool


class LimitTracker:
    """Judges the samples of one process; pure."""

    def __init__(self, limits: Limits, tolerance_s: float = TOLERANCE_S) -> None:
        self._limits = limits
        self._tolerance_s = tolerance_s
        self._since: dict[str, float] = {}

    def add(self, now: float, memory_bytes: int, cpu: float) -> list[LimitExcess]:
        """The limits that were newly exceeded at `now` [s], or have been for too long."""
        limits = self._limits
        texts = {
            "memory": f"uses {memory_bytes / 1e6:.0f} MB of memory, "
            f"its limit is {limits.memory_bytes / 1e6:.0f} MB",
            "cpu": f"uses {cpu:.0%} of a core, its limit is {limits.cpu:.0%}",
        }
        exceeded = {
            "memory": 0 < limits.memory_bytes < memory_bytes,
            "cpu": 0 < limits.cpu < cpu,
        }
        found = []
        for name, text in texts.items():
            if not exceeded[name]:
                self._since.pop(name, None)
            elif name not in self._since:
                self._since[name] = now
                found.append(LimitExcess(text, is_lasting=False))
            elif now - self._since[name] >= self._tolerance_s:
                found.append(LimitExcess(text, is_lasting=True))
        return found


class TreeUsage:
    """Memory [bytes] and CPU share (1.0: one core) of a process with all its children."""

    def __init__(self, pid: int) -> None:
        self._pid = pid
        self._usages: dict[int, ResourceUsage] = {}
        self.memory = 0
        self.cpu = 0.0

    def sample(self) -> None:
        """Measure now."""
        known, pids = self._usages, process_tree(self._pid)
        self._usages = {p: known.get(p) or ResourceUsage(p) for p in pids}
        for usage in self._usages.values():
            usage.sample()
        self.memory = sum(usage.memory for usage in self._usages.values())
        # The first sample of a process shows its mean since it started.
        self.cpu = sum(usage.cpu for p, usage in self._usages.items() if p in known)


def process_tree(pid: int) -> list[int]:
    """`pid` and its descendants (proc(5): /proc/PID/task/TID/children)."""
    pids = [pid]
    for parent in pids:
        with suppress(OSError):
            for thread in os.listdir(f"/proc/{parent}/task"):  # noqa: PTH208 - names only
                with suppress(OSError):
                    children = Path(f"/proc/{parent}/task/{thread}/children").read_text("ascii")
                    pids += map(int, children.split())
    return pids
