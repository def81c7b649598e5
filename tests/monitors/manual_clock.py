"""A clock that a test moves."""

from __future__ import annotations

from robocomp_dsl.runtime.clock import WallClock


class ManualClock(WallClock):
    """Time stands still until `time` is changed; hooks still run in wall time."""

    def __init__(self) -> None:
        self.time = 0.0
        self.reset_count = 0

    def now(self) -> float:
        return self.time
