"""CPU cores and real-time priority of a process: `cores 0, 2-3;`, `realtime priority 50;`.

In: `ResourceLimits`. Out: a call whose child processes have them from their first instruction. Both
belong to a thread and are inherited by what it starts (sched(7), fork(2)), so a thread of its own
sets them and starts the process; no code runs between fork and exec.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from robocomp_dsl.model.deployment import ResourceLimits
from robocomp_dsl.model.limits_text import format_cores

Result = TypeVar("Result")


def with_scheduling(limits: ResourceLimits, start: Callable[[], Result]) -> Result:
    """The result of `start`, whose child processes have the cores and priority of `limits`.

    Raises `OSError` if they are not permitted.
    """
    if not limits.cores and not limits.realtime:
        return start()

    def run() -> Result:
        _apply(limits)
        return start()

    with ThreadPoolExecutor(1) as thread:
        return thread.submit(run).result()


def scheduling_error(limits: ResourceLimits) -> str:
    """Why the cores or the priority of `limits` cannot be used here; empty if they can."""
    try:
        actual = with_scheduling(limits, lambda: os.sched_getaffinity(0))
    except OSError as error:
        if limits.cores and not set(limits.cores) & os.sched_getaffinity(0):
            return _missing_cores(limits, set())
        return f"`realtime priority {limits.realtime}` is not permitted: {error.strerror}"
    return _missing_cores(limits, actual) if set(limits.cores) - actual else ""


def _apply(limits: ResourceLimits) -> None:
    if limits.cores:
        os.sched_setaffinity(0, limits.cores)
    if limits.realtime:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(limits.realtime))


def _missing_cores(limits: ResourceLimits, actual: set[int]) -> str:
    missing = format_cores(sorted(set(limits.cores) - actual))
    usable = format_cores(sorted(os.sched_getaffinity(0)))
    return f"the CPU cores {missing} cannot be used; this machine offers {usable}"
