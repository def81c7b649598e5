"""Options of one run of the supervisor, and its outcome. Pure data."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Options:
    """Options of one run, times in s.

    `grace_s`: time between SIGTERM and SIGKILL of one component; `stop_timeout_s`: the limit for
    all components together. `duration_s` counts from the moment when all are ready. `keep_going`:
    a permanent failure of one component does not stop the others.
    """

    grace_s: float = 5.0
    stop_timeout_s: float = 15.0
    duration_s: float | None = None
    keep_going: bool = False


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a run ended, with its exit code.

    0: stopped on request, or all exited successfully; 1: a component failed; 141: nobody reads the
    output any more.
    """

    code: int
    reason: str
