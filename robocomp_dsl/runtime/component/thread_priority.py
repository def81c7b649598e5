"""Real-time priority of the threads that receive messages (SCHED_FIFO, Linux).

In: a thread and a priority from 1 to 99; 0: the normal policy. Out: the scheduling policy is set,
or one warning says why it could not be, and what to do. The component runs in both cases.
"""

from __future__ import annotations

import logging
import os
import sys
import threading

log = logging.getLogger("robocomp")
_FIX = (
    "allow it with `LimitRTPRIO={priority}` in the systemd unit, with a line `@robot - rtprio"
    " {priority}` in /etc/security/limits.conf, or with CAP_SYS_NICE in the container"
)
_reported: set[str] = set()


class ThreadPriority:
    """The priority of the threads of one port, which may start later or be changed."""

    def __init__(self, port: str, priority: int | None = None) -> None:
        self._port = port
        self.priority = priority or 0

    def apply(self, thread: int = 0) -> bool:
        """Set the priority of a thread by its native id, 0: this thread; returns the success."""
        reason = set_scheduling(thread, self.priority)
        if reason:
            key = f"{self._port} {self.priority}"
            if key not in _reported:
                _reported.add(key)
                log.warning(
                    "%s receives without real-time priority %d: %s",
                    self._port,
                    self.priority,
                    reason,
                )
        return not reason

    def start_thread(self) -> None:
        """Called by a thread of the port when it starts."""
        if self.priority:
            self.apply()

    def change(self, priority: int | None, threads: list[threading.Thread]) -> bool:
        """Set another priority, also of running threads; returns whether it is in force."""
        self.priority = priority or 0
        return all(self.apply(t.native_id) for t in threads if t.is_alive() and t.native_id)


def set_scheduling(thread: int, priority: int) -> str:
    """Set the policy of a thread; returns why it could not be set, or ""."""
    if sys.platform != "linux":
        return f"{sys.platform} has no SCHED_FIFO for threads"
    policy = os.SCHED_FIFO if priority else os.SCHED_OTHER
    try:
        os.sched_setscheduler(thread, policy, os.sched_param(priority))
    except PermissionError:
        fix = _FIX.format(priority=priority)
        return f"the limit of this user is {_real_time_limit()} (ulimit -r); {fix}"
    except OSError as error:
        return f"{error.strerror}; is it supported by this kernel or container?"
    return ""


def _real_time_limit() -> int:
    import resource  # noqa: PLC0415 - only for the message

    return resource.getrlimit(resource.RLIMIT_RTPRIO)[0]
