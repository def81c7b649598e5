"""A run of the supervisor that reacts to its log records, for the tests of the supervisor."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable
from pathlib import Path

from robocomp_dsl.deploy.logs import LogRecord
from robocomp_dsl.deploy.plan import Process
from robocomp_dsl.deploy.status import ProcessStatus
from robocomp_dsl.deploy.supervisor.reaper import find_processes
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.deploy.supervisor.supervisor import Supervisor
from tests.deploy.scripted_processes import FifoLifecycleMonitor, make_plan

TIMEOUT_S = 120.0


class SupervisorRun:
    """A run of the supervisor in this process; its log records trigger reactions of the test."""

    def __init__(self, tmp_path: Path, *processes: Process, options: Options | None = None) -> None:
        self.plan = make_plan(tmp_path, *processes)
        self.monitor = FifoLifecycleMonitor(tmp_path / "fifo")
        self.options = options or Options(grace_s=5.0)
        self.records: list[LogRecord] = []
        self.changed: Callable[[], None] = lambda: None
        self.reactions: list[tuple[str, Callable[[SupervisorRun], object]]] = []

    def on(self, text: str, reaction: Callable[[SupervisorRun], object]) -> SupervisorRun:
        """Call `reaction` at the first record that contains `text`."""
        self.reactions.append((text, reaction))
        return self

    def emit(self, record: LogRecord) -> None:
        self.records.append(record)
        for reaction in [r for r in self.reactions if r[0] in f"{record.component}: {record.text}"]:
            self.reactions.remove(reaction)
            reaction[1](self)

    def run(self) -> Outcome:
        token = f"{self.plan.domain}.{os.getpid()}"

        async def supervised() -> Outcome:
            self.engine = Supervisor(
                self.plan, token, self.monitor,
                emit=self.emit, changed=self.changed, options=self.options,
            )  # fmt: skip
            return await asyncio.wait_for(self.engine.run(), TIMEOUT_S)

        outcome = asyncio.run(supervised())
        assert find_processes(token) == []
        assert self.reactions == []
        return outcome

    def row(self, name: str) -> ProcessStatus:
        return next(row for row in self.engine.statuses() if row.name == name)

    def texts(self, component: str) -> list[str]:
        return [r.text for r in self.records if r.component == component]

    def at(self, text: str) -> int:
        """Position of the first record that contains `text`."""
        return next(i for i, r in enumerate(self.records) if text in f"{r.component}: {r.text}")


def stop(run: SupervisorRun) -> None:
    run.engine.stop("test")
