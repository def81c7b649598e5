"""A component crashes, hangs, leaks, or ignores SIGTERM: systemd ends it, and rcdeploy says why."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.status import ProcessStatus
from tests.hosts.faults.loaded_app import LoadedApp
from tests.hosts.faults.rcdeploy_run import RcdeployRun
from tests.support.waiting import wait_until

RESTART = "restart on-failure max 3 in 600 s;"
Record = Callable[[str, object], None]


@pytest.fixture
def since() -> float:
    """The time before the test [s since 1970]."""
    return time.time()


def deploy(app: LoadedApp, component: str, more: str) -> None:
    """Bring a component with a fault to a host, and one without."""
    app.describe({component: f"robot {more} {RESTART}", "source": "robot"})
    app.up()


def row_when(
    app: LoadedApp, component: str, condition: Callable[[ProcessStatus], bool]
) -> ProcessStatus:
    """The status of a component as soon as `condition` holds."""
    rows: list[ProcessStatus] = []

    def holds() -> bool:
        rows.append(app.row(component))
        return condition(rows[-1])

    wait_until(holds, lambda: f"{rows[-1]}\n{app.lines}")
    return rows[-1]


def was_restarted(row: ProcessStatus) -> bool:
    return row.restarts > 0 and row.state in (status.STARTING, status.READY)


def first_run(app: LoadedApp, since: float) -> float:
    """How long the first process of `faulty` was ready before it ended [s]."""
    ready = app.logged("faulty", "running every", since)[0]
    ended = app.logged("faulty", "ended:", ready)[0]
    return round(ended - ready, 2)


def test_crash_loop_ends_as_failed(app: LoadedApp, since: float, record_property: Record) -> None:
    deploy(app, "faulty", 'set fault = "crashes";')
    row = row_when(app, "faulty", lambda row: row.state == status.FAILED)
    assert row.restarts == 3
    assert row.note == "failed too often: exit code 3"
    assert app.row("source").state == status.READY
    starts, ends = app.logged("faulty", "starting", since), app.logged("faulty", "ended:", since)
    assert len(starts) == 4
    record_property("crash loop, 3 restarts: failed after [s]", round(ends[-1] - starts[0], 1))
    with RcdeployRun("status", app.name) as run:
        assert run.wait() == 1
        assert "failed too often: exit code 3" in run.output
        _, _, last_lines = run.output.partition("faulty failed; the end of its log:\n")
        assert "about to crash" in last_lines


def test_hanging_component_is_restarted(
    app: LoadedApp, since: float, record_property: Record
) -> None:
    deploy(app, "faulty", 'set fault = "hangs"; watchdog 1 s;')
    row_when(app, "faulty", was_restarted)
    log = app.log("faulty")
    assert "watchdog: compute" in log
    assert "time.sleep(3600)" in log
    record_property("compute hangs, watchdog 1 s: ended after [s]", first_run(app, since))


def test_frozen_component_is_killed_by_watchdog(app: LoadedApp, record_property: Record) -> None:
    deploy(app, "faulty", 'set fault = ""; watchdog 1 s;')
    unit = app.unit("faulty")
    app.host_of("faulty").run(["kill", "-STOP", str(unit.pid)])
    seconds = app.ready_again("faulty", time.monotonic())
    assert app.unit("faulty").pid != unit.pid
    record_property("SIGSTOP, watchdog 1 s: ready again after [s]", round(seconds, 2))


def test_leaking_component_is_restarted(
    app: LoadedApp, since: float, record_property: Record
) -> None:
    deploy(app, "faulty", 'set fault = "leaks"; memory 300 MB;')
    row_when(app, "faulty", was_restarted)
    assert "memory" in app.log("faulty")
    record_property("leak of 100 MB/s, memory 300 MB: ended after [s]", first_run(app, since))


def test_component_that_ignores_sigterm_is_killed(app: LoadedApp, record_property: Record) -> None:
    deploy(app, "stubborn", "")
    start = time.monotonic()
    with RcdeployRun("stop", app.name, "stubborn") as run:
        assert run.wait() == 1, run.output
        assert "stubborn (robot): did not exit in time and was killed" in run.output
    record_property("SIGTERM ignored: killed after [s]", round(time.monotonic() - start, 1))
    assert app.unit("stubborn").pid == 0
    assert app.row("stubborn").note == "did not exit in time and was killed"
    assert app.row("source").state == status.READY
