"""Monitors in lock-step: events expire at exact simulated times, the same in every run."""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest

from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.connection.monitor_settings import ConnectionMonitors
from robocomp_dsl.runtime.connection.parse_monitors import parse_monitors
from tests.runtime.lockstep_components import Base, Driver, Recorder, running
from tests.support.waiting import wait_until

MONITORS = dedent("""
    from robocomp_dsl.runtime import Monitor

    class EveryFifth(Monitor):
        count = 0

        def accept_seen(self, x: float) -> bool:
            if self.count % 5 == 0:
                self.set_event("e_new", 0.015)
            self.count += 1
            return True

    class Slow(Monitor):
        def update_go(self, speed: float) -> float:
            return max(-0.1, min(0.1, speed))
    """)


def parsed(*entries: dict[str, Any]) -> tuple[ConnectionMonitors, ...]:
    return parse_monitors(json.dumps(entries))


@pytest.mark.parametrize("middleware", ["inproc", "zenoh"])
def test_monitored_lockstep_expires_events_in_simulated_time(
    middleware: str, tmp_path: Path
) -> None:
    file = tmp_path / "monitors.py"
    file.write_text(MONITORS)
    fifth, slow = ({"file": str(file), "class": name} for name in ("EveryFifth", "Slow"))
    seen = {"port": "Seen", "at": "receiver", "peer": "base.Seen", "when": "e_new"}
    drive = {"port": "Drive", "at": "receiver", "peer": "driver.Drive", "monitors": [slow]}
    monitors = {
        "recorder": parsed(seen | {"monitors": [fifth]}),
        "base": parsed(drive),
        "driver": parsed({"port": "Drive", "at": "identify", "peer": "base.Drive"}),
    }
    with running([Base, Driver, Recorder], middleware, monitors=monitors) as runners:
        base = runners["base"].worker
        wait_until(
            lambda: runners["base"].state is LifecycleState.COMPUTE and base.source.paused,
            "the end of the run",
        )
        wait_until(lambda: base.commands == 81, "the commands due at the end")
        lines = [line.split(" ") for line in runners["recorder"].worker.lines]
        times = [round(float(time) * 100) for time, verb, _ in lines if verb == "saw"]
        assert times == [step for step in range(201) if step % 5 < 2]
        (status,) = runners["base"].monitors.statuses()
        assert (status.passed, status.rejected) == (162, 0)
        assert abs(base.speed) <= 0.1
