"""Watches the limits of units where the manager of the user cannot: `python -m … LOGS SPEC...`.

cgroup controllers are not delegated to users on every system. In: the folder of logs; for each unit
`UNIT NAME MEMORY CPU`: its component, bytes, share of a core; 0: no limit. Out: a unit that stays
above a limit for some seconds is killed, which its restart policy takes for a failure; its log has
the reason.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from robocomp_dsl.host_tools.resource_limits import SAMPLE_S, LimitTracker, TreeUsage


@dataclass(slots=True)
class WatchedUnit:
    """A unit with limits. `pid` is that of the process that `usage` measures; 0: none."""

    unit: str
    name: str
    memory_bytes: int
    cpu: float
    pid: int = 0
    usage: TreeUsage | None = None
    tracker: LimitTracker | None = None

    def check(self, pid: int) -> list[tuple[str, bool]]:
        """Texts about limits that `pid` exceeds now, and whether it has for too long."""
        if pid != self.pid:
            self.pid = pid
            self.usage = TreeUsage(pid) if pid else None
            self.tracker = LimitTracker(self) if pid else None
        if self.usage is None or self.tracker is None:
            return []
        self.usage.sample()
        found = self.tracker.add(time.monotonic(), self.usage.memory, self.usage.cpu)
        return [(excess.text, excess.is_lasting) for excess in found]


def read_pids(units: list[str]) -> dict[str, int]:
    """The main process of each unit; 0 if it does not run."""
    text = _systemctl("show", "--property=Id,MainPID", "--", *units)
    blocks = (dict(line.split("=", 1) for line in b.splitlines()) for b in text.split("\n\n"))
    return {block["Id"]: int(block["MainPID"]) for block in blocks if "MainPID" in block}


def _systemctl(*words: str) -> str:
    command = ["systemctl", "--user", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout  # noqa: S603


def log_line(logs: Path, watched: WatchedUnit, level: str, text: str) -> None:
    """Append a line to the log of a component."""
    fields = {"time": time.time(), "level": level, "component": watched.name, "message": text}
    with (logs / f"{watched.name}.log").open("a", encoding="utf-8") as log:
        log.write(json.dumps(fields) + "\n")


def main(arguments: list[str]) -> None:
    """Watch until the process is stopped."""
    logs, *words = arguments
    units = [
        WatchedUnit(unit, name, int(memory), float(cpu))
        for unit, name, memory, cpu in zip(*[iter(words)] * 4, strict=True)
    ]
    while True:
        pids = read_pids([watched.unit for watched in units])
        for watched in units:
            for text, is_lasting in watched.check(pids.get(watched.unit, 0)):
                suffix = "; it is killed" if is_lasting else ""
                log_line(Path(logs), watched, "ERROR" if is_lasting else "WARNING", text + suffix)
                if is_lasting:
                    _systemctl("kill", "--signal=SIGKILL", "--", watched.unit)
        time.sleep(SAMPLE_S)


if __name__ == "__main__":
    main(sys.argv[1:])
