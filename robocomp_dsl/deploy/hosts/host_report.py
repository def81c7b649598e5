"""What a host says about the units of a deployment. Pure.

In: properties of systemd units. Out: `UnitState`, and its meaning in the words of `status.py`.
"""

from __future__ import annotations

import signal
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from robocomp_dsl.deploy import status

_KILLED = ("2", "3")
"""`ExecMainCode`: CLD_KILLED and CLD_DUMPED of siginfo.h."""
_STATES = {("active", "exited"): status.EXITED, ("activating", "auto-restart"): status.BACKOFF}
_ACTIVE_STATES = {
    "active": status.READY,
    "reloading": status.READY,
    "activating": status.STARTING,
    "deactivating": status.STOPPING,
    "failed": status.FAILED,
}
_RESULTS = {
    "timeout": "not ready in time",
    "watchdog": "hangs: no sign of life from its watchdog",
    "oom-kill": "used more memory than its limit",
    "protocol": "ended before it was ready",
    "resources": "the host lacks resources to start it",
}
"""`Result` of systemd.service(5)."""


@dataclass(frozen=True, slots=True)
class UnitState:
    """The state of a unit. `up_s`: since it runs; `revision`: of the unit that the process runs.

    `memory` in bytes and `cpu` (1.0: a core) include children. `text` is what the process said.
    `operations` counts what this deployer has requested of the unit before. `was_ready`: since its
    last start; `failed_too_often`: systemd will not start it again.
    """

    load: str
    active: str
    sub: str
    result: str = ""
    pid: int = 0
    restarts: int = 0
    code: str = ""
    exit_status: str = ""
    text: str = ""
    up_s: float = 0.0
    revision: str = ""
    memory: int = 0
    cpu: float = 0.0
    has_job: bool = False
    operations: int = 0
    was_ready: bool = False
    failed_too_often: bool = False

    @staticmethod
    def from_properties(fields: Mapping[str, Any], monotonic: float) -> UnitState:
        """From the output of `systemctl show`; `monotonic` is the time on the host [s]."""
        entered = int(fields.get("ActiveEnterTimestampMonotonic") or 0) / 1e6
        started = int(fields.get("InactiveExitTimestampMonotonic") or 0) / 1e6
        restarts, limit = int(fields.get("NRestarts") or 0), int(fields.get("StartLimitBurst") or 0)
        # systemd keeps the result of the last run, and counts the restart that it refused.
        refused = fields.get("ActiveState") == "failed" and 0 < limit <= restarts
        return UnitState(
            load=str(fields.get("LoadState", "")),
            active=str(fields.get("ActiveState", "")),
            sub=str(fields.get("SubState", "")),
            result=str(fields.get("Result", "")),
            pid=int(fields.get("MainPID") or 0),
            restarts=restarts - refused,
            code=str(fields.get("ExecMainCode", "")),
            exit_status=str(fields.get("ExecMainStatus", "")),
            text=str(fields.get("StatusText", "")),
            up_s=max(monotonic - entered, 0.0) if entered else 0.0,
            revision=str(fields.get("Revision", "")),
            memory=int(fields.get("Memory", 0)),
            cpu=float(fields.get("Cpu", 0.0)),
            operations=int(fields.get("Operations", 0)),
            has_job=str(fields.get("Job", "0")) not in ("", "0"),
            was_ready=entered >= started > 0.0,
            failed_too_often=refused,
        )

    @property
    def is_active(self) -> bool:
        """Whether it runs, or will run by itself."""
        return self.active in ("active", "activating", "reloading") or self.has_job

    @property
    def state(self) -> str:
        """The state as in `status.py`."""
        if self.active == "deactivating" and "watchdog" in self.sub:
            return status.HUNG
        idle = status.WAITING if self.has_job else status.EXITED
        return _STATES.get((self.active, self.sub)) or _ACTIVE_STATES.get(self.active, idle)

    @property
    def note(self) -> str:
        """The reason for the state."""
        if self.load == "not-found":
            return "its unit is missing"
        if self.load not in ("loaded", ""):
            return f"its unit is {self.load}"
        if self.active == "active" or self.result in ("success", ""):
            return ""
        return self._failure()

    def _failure(self) -> str:
        if self.failed_too_often or self.result == "start-limit-hit":
            return f"failed too often: {self._last_failure()}"
        return self._last_failure()

    def _last_failure(self) -> str:
        if self.result in ("exit-code", "signal", "core-dump", "start-limit-hit"):
            return self._exit()
        if self.result == "timeout" and self.was_ready:
            return "did not exit in time and was killed"
        return _RESULTS.get(self.result, self.result)

    def _exit(self) -> str:
        if self.code in _KILLED:
            try:
                return f"killed by {signal.Signals(int(self.exit_status)).name}"
            except ValueError:
                return f"killed by signal {self.exit_status}"
        return _EXITS.get(self.exit_status, f"exit code {self.exit_status}")


_EXITS = {
    "200": "its working folder is missing",
    "203": "its program cannot be executed",
    "209": "its log file cannot be opened",
    "214": "the user may not use real-time priorities",
    "0": "ended",
}
"""Exit codes of systemd itself before the program runs (systemd.exec(5))."""


@dataclass(frozen=True, slots=True)
class HostReport:
    """What is deployed on a host, and what runs. `versions` are stored, `current` is in force.

    `manifest` is the text of the current version; `units` are the texts of unit files; `router` is
    the hash of the router's settings.
    """

    current: str
    versions: tuple[int, ...]
    manifest: str | None
    units: Mapping[str, str]
    states: Mapping[str, UnitState]
    time: float
    router: str = ""

    @staticmethod
    def from_dict(fields: Mapping[str, Any]) -> HostReport:
        """From the reply of the script."""
        now = float(fields["monotonic"])
        return HostReport(
            str(fields["current"]),
            tuple(fields["versions"]),
            fields["manifest"],
            dict(fields["units"]),
            {u: UnitState.from_properties(p, now) for u, p in fields["states"].items()},
            float(fields["time"]),
            str(fields["router"]),
        )
