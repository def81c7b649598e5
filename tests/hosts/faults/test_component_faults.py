"""A component crashes, hangs, leaks, or ignores SIGTERM: systemd ends it, and rcdeploy says why."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.status import ProcessStatus
from tests.hosts.faults.loaded_app import LoadedApp, make_loaded_app
from tests.hosts.faults.rcdeploy_run import RcdeployRun
from tests.hosts.rig.hosts import Hosts
from tests.support.waiting import wait_until

RESTART = "restart on-failure max 3 in 600 s;"


@pytest.fixture(scope="module")
def faulty(module_hosts: Hosts, tmp_path_factory: pytest.TempPathFactory) -> LoadedApp:
    module_hosts.start("robot")
    return make_loaded_app(tmp_path_factory.mktemp("deployment") / "app", module_hosts, "faulty")


@pytest.fixture(autouse=True)
def operator(faulty: LoadedApp, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    faulty.enter(monkeypatch)
    yield
    faulty.engine("faulty").stop(faulty.lines.append)


def deploy(app: LoadedApp, fault: str, more: str = RESTART) -> None:
    """Bring a component with a fault, and one without, to its host."""
    app.describe({"faulty": f'robot set fault = "{fault}"; {more}', "source": "robot"})
    app.up()


def row_when(app: LoadedApp, condition: Callable[[ProcessStatus], bool]) -> ProcessStatus:
    """The status of the component as soon as `condition` holds."""
    return wait_until(
        lambda: row if condition(row := app.row("faulty")) else None,
        lambda: f"{app.row('faulty')}\n{app.lines}",
    )


def test_crash_loop_ends_as_failed(
    faulty: LoadedApp, record_property: Callable[[str, object], None]
) -> None:
    start = time.monotonic()
    deploy(faulty, "crashes")
    row = row_when(faulty, lambda row: row.state == status.FAILED)
    record_property("crash loop, 3 restarts: failed after [s]", round(time.monotonic() - start, 1))
    assert row.restarts == 3
    assert row.note == "failed too often: exit code 3"
    assert faulty.row("source").state == status.READY
    with RcdeployRun("status", "faulty") as run:
        assert run.wait() == 1
        assert "failed too often: exit code 3" in run.output
        assert "about to crash" in run.output


def test_hanging_component_is_restarted(
    faulty: LoadedApp, record_property: Callable[[str, object], None]
) -> None:
    deploy(faulty, "hangs", f"watchdog 1 s; {RESTART}")
    pid = faulty.unit("faulty").pid
    row = row_when(faulty, lambda row: row.restarts > 0 and row.pid not in (0, pid))
    assert row.state in (status.STARTING, status.READY)
    log = faulty.log("faulty")
    assert "watchdog: compute" in log
    assert "time.sleep(3600)" in log
    ended = faulty.logged("faulty", "ended:")
    ready = faulty.logged("faulty", "running every")
    hang = next(t for t in ended if t > ready[0]) - ready[0]
    record_property("hang, watchdog 1 s: ended after [s]", round(hang, 2))


def test_frozen_component_is_killed_by_watchdog(
    faulty: LoadedApp, record_property: Callable[[str, object], None]
) -> None:
    deploy(faulty, "", f"watchdog 1 s; {RESTART}")
    unit = faulty.unit("faulty")
    faulty.host_of("faulty").run(["kill", "-STOP", str(unit.pid)])
    stopped = time.monotonic()
    seconds = faulty.ready_again("faulty", stopped)
    assert faulty.unit("faulty").pid != unit.pid
    record_property("SIGSTOP, watchdog 1 s: ready again after [s]", round(seconds, 2))


def test_leaking_component_is_restarted(
    faulty: LoadedApp, record_property: Callable[[str, object], None]
) -> None:
    deploy(faulty, "leaks", f"memory 400 MB; {RESTART}")
    pid = faulty.unit("faulty").pid
    row = row_when(faulty, lambda row: row.restarts > 0 and row.pid not in (0, pid))
    assert row.state in (status.STARTING, status.READY)
    ended = faulty.logged("faulty", "ended:")
    ready = faulty.logged("faulty", "running every")
    leak = next(t for t in ended if t > ready[0]) - ready[0]
    record_property("leak of 400 MB/s, limit 400 MB: ended after [s]", round(leak, 2))
    assert "memory" in faulty.log("faulty")


def test_component_that_ignores_sigterm_is_killed(
    faulty: LoadedApp, record_property: Callable[[str, object], None]
) -> None:
    deploy(faulty, "ignores SIGTERM")
    start = time.monotonic()
    with RcdeployRun("stop", "faulty", "faulty") as run:
        assert run.wait() == 1
        assert "faulty (robot): did not exit in time and was killed" in run.output
    record_property("SIGTERM ignored: killed after [s]", round(time.monotonic() - start, 1))
    assert faulty.unit("faulty").pid == 0
    assert faulty.row("faulty").note == "did not exit in time and was killed"
    assert faulty.row("source").state == status.READY
