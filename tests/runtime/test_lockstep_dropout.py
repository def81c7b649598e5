"""Lock-step: components that stop, disconnect, block or restart."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

import pytest

from robocomp_dsl.runtime import ComponentSpec
from robocomp_dsl.runtime.component.lifecycle import LifecycleState
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.parameters import Parameters
from tests.runtime.lockstep_components import Base, Driver, Recorder, disconnect, running, stop
from tests.support.waiting import wait_until

DEADLINE = 120.0


@pytest.fixture(params=["inproc", "zenoh"])
def middleware(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.mark.parametrize(
    ("leave", "middleware", "message", "level"),
    [
        (stop, "inproc", "recorder stopped; the others continue", logging.INFO),
        (stop, "zenoh", "recorder stopped; the others continue", logging.INFO),
        (disconnect, "inproc", "recorder timed out or disconnected at", logging.WARNING),
        (disconnect, "zenoh", "recorder timed out or disconnected at", logging.WARNING),
    ],
)
def test_lockstep_reports_and_skips_lost_component(
    leave: Callable[[Runner], None],
    middleware: str,
    message: str,
    level: int,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # A lost component is dropped at once; the discovery timeout applies only at the start.
    module = "robocomp_dsl.runtime.connection.peer_selection"
    monkeypatch.setattr(f"{module}.DISCOVERY_TIMEOUT_S", 3 * DEADLINE)
    with (
        caplog.at_level(logging.INFO),
        running([Base, Driver, Recorder], middleware) as runners,
    ):
        base = runners["base"].worker
        base.end = 1e9
        wait_until(lambda: base.clock.now() > 0.2, "the first 0.2 s")
        leave(runners["recorder"])
        left_at = base.clock.now()
        wait_until(lambda: base.clock.now() > left_at + 0.5, "0.5 s without it")
        records = [record for record in caplog.records if message in record.getMessage()]
        assert [record.levelno for record in records] == [level]
        commands = base.commands
        wait_until(lambda: base.commands > commands + 5, "commands of the driver")


def test_lockstep_restarted_component_rejoins(
    middleware: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.INFO), running([Base, Recorder], middleware) as runners:
        base, before = runners["base"].worker, runners["recorder"]
        base.end = 0.5
        wait_until(
            lambda: runners["base"].state is LifecycleState.COMPUTE and base.source.paused,
            "the pause",
        )
        disconnect(before)
        restarted = Runner(Recorder, Parameters(), before.settings)
        restarted.start()
        try:
            wait_until(lambda: restarted.state is LifecycleState.COMPUTE, "the restarted component")
            base.end = 1e9
            base.source.resume()
            wait_until(lambda: "recorder rejoined at" in caplog.text, "the rejoin")
            assert "recorder timed out or disconnected at" in caplog.text
            wait_until(
                lambda: any("saw" in line for line in restarted.worker.lines), "published messages"
            )
        finally:
            stop(restarted)


class Blocked(Driver):
    """Blocks in one compute until `release` is set."""

    SPEC = ComponentSpec(name="blocked", period=25)
    release = threading.Event()
    computed = 0

    def compute(self) -> None:
        self.computed += 1
        if self.clock.now() >= 0.1 and not self.release.is_set():
            self.release.wait(DEADLINE)


def test_lockstep_skips_blocked_component_until_it_responds(
    caplog: pytest.LogCaptureFixture,
) -> None:
    Blocked.release.clear()
    with (
        caplog.at_level(logging.INFO),
        running([Base, Driver, Blocked], "zenoh", limit=2.0) as runners,
    ):
        base = runners["base"].worker
        base.end = 1e9
        try:
            wait_until(lambda: base.clock.now() > 0.5, "0.5 s of simulated time")
            assert "blocked timed out or disconnected at 0.1 s" in caplog.text
        finally:
            Blocked.release.set()
        wait_until(lambda: "blocked rejoined at" in caplog.text, "the rejoin")
        computed = runners["blocked"].worker.computed
        wait_until(lambda: runners["blocked"].worker.computed > computed + 3, "further computes")


def test_lockstep_source_stops_when_component_is_lost(caplog: pytest.LogCaptureFixture) -> None:
    with running([Base, Driver, Recorder], "inproc", more=",lost=stop") as runners:
        base = runners["base"].worker
        base.end = 1e9
        wait_until(lambda: base.clock.now() > 0.1, "the first 0.1 s")
        disconnect(runners["recorder"])
        ended: list[bool] = []
        threading.Thread(target=lambda: ended.append(runners["base"].wait()), daemon=True).start()
        wait_until(lambda: ended, "the end of the source")
        assert ended == [False]
        assert "recorder timed out or disconnected" in caplog.text
