"""Inject faults into running deployments: `python -m tests.campaign [SECONDS]`.

Prints what was lost, doubled or blocked, and writes `build/campaign.json`. It takes at most about
SECONDS (default: 600).
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from tests.campaign import components, faults
from tests.campaign.mutated_bytes import mutated_bytes
from tests.campaign.running_deployment import RunningDeployment

KILLS_PER_SECOND = 0.5
MESSAGES_PER_SECOND = 100
BLOCK_GOAL_S = 0.05
READY_GOAL_S = 1.0
BYSTANDER_PERIOD_S = components.PERIODS_MS["bystander"] / 1000


class Campaign:
    """Runs the faults and collects their figures by section."""

    def __init__(self, folder: Path, seconds: float) -> None:
        self.folder, self.end = folder, time.monotonic() + seconds
        self.seconds = seconds
        self.figures: dict[str, Any] = {}
        self.failures: list[str] = []

    def section(self, name: str, inject: Callable[[], Any]) -> None:
        """Run one kind of fault, unless the time is over."""
        if time.monotonic() > self.end:
            self.figures[name] = "left out: the time is over"
            return
        print(f"-- {name}", flush=True)
        start = time.monotonic()
        try:
            result = inject()
        except Exception:
            result = {"error": traceback.format_exc(limit=-3)}
            self.failures.append(name)
        block = self.longest_block(start)
        if isinstance(result, dict) and block is not None:
            result["longest block of the bystander [ms]"] = block * 1000
        self.figures[name] = result
        for key, value in result.items() if isinstance(result, dict) else [("", result)]:
            print(
                f"   {key:<48} {value:.4g}" if isinstance(value, float) else f"   {key:<48} {value}"
            )

    def longest_block(self, since: float) -> float | None:
        """The longest call or delay of the bystander since a time [s]; None if it did not run."""
        with contextlib.suppress(OSError):
            lines = (self.folder / "journals/bystander").read_text().splitlines()
            rows = [tuple(map(float, line.split())) for line in lines[1:]]
            blocks = [max(gap - BYSTANDER_PERIOD_S, call) for end, gap, call in rows if end > since]
            return max(blocks, default=None)
        return None

    def run(self) -> None:
        """All faults."""
        with RunningDeployment(self.folder / "campaign.ddsl") as app:
            app.wait_ready()
            domain = domain_of(app)
            self.section("undisturbed", undisturbed)
            kills = max(8, int(self.seconds * KILLS_PER_SECOND / 3))
            self.section("kill -9 by turns", lambda: faults.kill_by_turns(app, kills))
            self.section("SIGSTOP by turns", lambda: faults.stop_by_turns(app, 2.0))
            self.section("start beside stopped peers", lambda: faults.start_beside_stopped(app))
            messages = int(self.seconds * MESSAGES_PER_SECOND)
            self.section(
                "malformed messages", lambda: faults.malformed_messages(app, domain, messages)
            )
            self.section("two of one name", lambda: faults.second_of_a_name(app, domain))
            self.section("end", lambda: {"exit code": app.stop()})
        self.figures["calls"] = components.count_calls(self.folder)
        print("-- calls", self.figures["calls"])
        self.section("stopped subscriber", lambda: faults.slow_and_stopped_subscriber(self.folder))
        self.section("mutated bytes", mutated_bytes)
        self.section("full disk", lambda: faults.full_disk(self.folder))
        for action in ("hang", *faults.ACTIONS):
            for hook in faults.HOOKS:
                inject = partial(faults.fail_in_hook, self.folder, hook, action)
                self.section(f"{action} in {hook}", inject)


def undisturbed() -> dict[str, Any]:
    """No fault for some seconds, to compare with."""
    time.sleep(5)
    return {}


def domain_of(app: RunningDeployment) -> str:
    """The domain of a running deployment, from its entry in the registry."""
    from robocomp_dsl.deploy import instances  # noqa: PLC0415 - after the environment is set

    return next(entry.domain for entry in instances.running() if entry.name == app.name)


def main(arguments: list[str]) -> int:
    """Run the campaign; 1 if a goal is missed."""
    seconds = float(arguments[0]) if arguments else 600.0
    with tempfile.TemporaryDirectory(prefix="rc-") as name:
        folder, runtime = Path(name, "campaign"), Path(name, "run")
        folder.mkdir()
        runtime.mkdir(mode=0o700)
        os.environ.update(components.environment(folder, runtime))
        components.build(folder)
        campaign = Campaign(folder, seconds)
        campaign.run()
    figures = campaign.figures
    calls, kills = figures["calls"], figures["kill -9 by turns"]
    goals = {
        "acknowledged calls lost": (calls["lost"], 0),
        "calls executed twice": (calls["doubled"], 0),
        "longest block of a bystander [s]": (
            max(
                section.get("longest block of the bystander [ms]", 0.0) / 1000
                for section in figures.values()
                if isinstance(section, dict)
            ),
            BLOCK_GOAL_S,
        ),
        "kill to ready, p99 [s]": (kills.get("kill to ready p99 [s]", float("inf")), READY_GOAL_S),
    }
    print("-- goals")
    for text, (value, goal) in goals.items():
        print(f"   {text:<48} {value:<8.4g} {'met' if value <= goal else 'MISSED'} (≤ {goal:g})")
    target = Path("build/campaign.json")
    target.parent.mkdir(exist_ok=True)
    target.write_text(json.dumps({"figures": figures, "goals": goals}, indent=1) + "\n")
    print(f"written to {target}")
    return int(bool(campaign.failures) or any(value > goal for value, goal in goals.values()))


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
