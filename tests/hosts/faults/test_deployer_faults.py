"""The deployer is killed, cut off, or one of two: what runs goes on."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.deploy.units import names
from tests.hosts.faults.loaded_app import UNDER_LOAD, LoadedApp
from tests.hosts.faults.rcdeploy_run import RcdeployRun
from tests.support.waiting import wait_until

CUT_S = float(os.environ.get("FAULT_CUT_S", "12"))
"""Longer than it takes to notice that a link is cut."""
CHANGED, UNCHANGED = ("ledger", "caller"), ("source", "sink")


@pytest.fixture
def deployed(app: LoadedApp) -> LoadedApp:
    """A deployment that runs on one host."""
    app.describe(dict.fromkeys(UNDER_LOAD, "robot"))
    assert not app.up().failed, app.lines
    return app


def change_workers(app: LoadedApp) -> None:
    """Make another version of some components."""
    for name in CHANGED:
        worker = app.folder / name / "specificworker.py"
        worker.write_text(f"{worker.read_text('utf-8')}\n# {time.monotonic_ns()}\n", "utf-8")


def root_of(app: LoadedApp) -> Path:
    """The folder of the deployment on its host."""
    return app.host_of("ledger").home / names.root_folder(app.name)


def count(folder: Path) -> int:
    """The number of entries of a folder."""
    return len(list(folder.iterdir())) if folder.exists() else 0


def is_locked(app: LoadedApp) -> bool:
    """Whether a deployer holds the lock of the deployment on its host."""
    lock = (root_of(app) / "lock").stat()
    file = f"{os.major(lock.st_dev):02x}:{os.minor(lock.st_dev):02x}:{lock.st_ino}"
    locks = Path("/proc/locks").read_text("ascii").splitlines()
    return any(file in line.split() for line in locks if "FLOCK" in line)


Moment = Callable[[LoadedApp, RcdeployRun], Callable[[], object]]


def when_locked(app: LoadedApp, run: RcdeployRun) -> Callable[[], object]:
    lock, text = root_of(app) / "lock", (root_of(app) / "lock").read_text("utf-8")
    stamp = lock.stat().st_mtime_ns
    return lambda: lock.stat().st_mtime_ns != stamp or lock.read_text("utf-8") != text


def when_copying(app: LoadedApp, run: RcdeployRun) -> Callable[[], object]:
    before = count(root_of(app) / "trees")
    return lambda: count(root_of(app) / "trees") > before


def when_stored(app: LoadedApp, run: RcdeployRun) -> Callable[[], object]:
    before = count(root_of(app) / "versions")
    return lambda: count(root_of(app) / "versions") > before


def when_current(app: LoadedApp, run: RcdeployRun) -> Callable[[], object]:
    current = root_of(app) / "current"
    before = current.read_text("ascii")
    return lambda: current.read_text("ascii") != before


def when_ready(app: LoadedApp, run: RcdeployRun) -> Callable[[], object]:
    return lambda: ": ready after" in run.output


@pytest.mark.parametrize(
    "moment", [when_locked, when_copying, when_stored, when_current, when_ready]
)
def test_killed_deployer_leaves_deployment_running(
    deployed: LoadedApp, moment: Moment, record_property: Callable[[str, object], None]
) -> None:
    before = deployed.unit_pids()
    change_workers(deployed)
    # A rollout in which one component is not ready yet cannot end before the moment.
    with deployed.held("caller"), RcdeployRun("up", deployed.path) as run:
        run.kill_when(moment(deployed, run), moment.__name__)
    killed = time.monotonic()
    wait_until(lambda: not is_locked(deployed), "the lock of the killed deployer stays")
    unlocked = time.monotonic() - killed
    states = deployed.units()
    assert {u.active for u in states.values()} <= {"active", "activating"}, states
    assert {name: states[name].pid for name in UNCHANGED} == {n: before[n] for n in UNCHANGED}
    result = deployed.up()
    assert not result.failed, deployed.lines
    assert not deployed.diff()
    after = deployed.unit_pids()
    assert {name: after[name] for name in UNCHANGED} == {name: before[name] for name in UNCHANGED}
    assert all(after[name] != before[name] for name in CHANGED)
    label = moment.__name__.replace("_", " ")
    record_property(f"deployer killed {label}: lock free after [s]", round(unlocked, 2))


def test_second_deployer_is_refused(deployed: LoadedApp) -> None:
    before = deployed.unit_pids()
    change_workers(deployed)
    with RcdeployRun("up", deployed.path) as first:
        with deployed.held("ledger"):
            wait_until(when_locked(deployed, first), lambda: first.output)
            with RcdeployRun("up", deployed.path) as second:
                assert second.wait() == 1, f"{first.output}\n{second.output}"
                assert "another rcdeploy changes the deployment there" in second.output
                assert "nothing was changed" in second.output
        assert first.wait() == 0, first.output
    after = deployed.unit_pids()
    assert all(after[name] != before[name] for name in CHANGED)
    assert {name: after[name] for name in UNCHANGED} == {name: before[name] for name in UNCHANGED}


def test_deployer_with_unreachable_host_changes_nothing(deployed: LoadedApp) -> None:
    before = deployed.unit_pids()
    base = deployed.hosts.by_name["base"]
    deployed.describe({**dict.fromkeys(UNDER_LOAD, "robot"), "faulty": "base"})
    change_workers(deployed)
    base.cut_link()
    try:
        with RcdeployRun("up", deployed.path) as run:
            assert run.wait() == 1
            text = run.output
        assert "base" in text
        assert f"{deployed.path.name}:" in text
        assert "Traceback" not in text
        after = deployed.unit_pids()
        assert {name: after[name] for name in before} == before
    finally:
        base.restore_link()
        deployed.describe(dict.fromkeys(UNDER_LOAD, "robot"))
    assert not deployed.up().failed


NUMBER = re.compile(r"\bnumber (\d+)")


def numbers(text: str) -> list[int]:
    """The numbers that `source` has logged."""
    return [int(number) for number in NUMBER.findall(text)]


def test_followed_logs_have_no_gap_after_link_cut(
    deployed: LoadedApp, record_property: Callable[[str, object], None]
) -> None:
    robot = deployed.host_of("source")
    log = root_of(deployed) / names.log_file("source")
    before = deployed.unit_pids()
    with RcdeployRun("logs", deployed.name, "--component", "source", "--follow") as run:
        wait_until(
            lambda: len(numbers(run.output)) > 50, lambda: f"nothing is followed: {run.output}"
        )
        robot.cut_link()
        cut = time.monotonic()
        known = len(numbers(run.output))
        time.sleep(CUT_S)  # the fault itself
        robot.restore_link()
        restored = time.monotonic()
        missed = numbers(log.read_text("utf-8"))[-1]
        wait_until(lambda: numbers(run.output)[-1] >= missed, "the logs do not catch up")
        seconds = time.monotonic() - restored
        found = numbers(run.output)
    assert found == list(range(found[0], found[-1] + 1))
    assert len(found) > known
    assert deployed.unit_pids() == before
    record_property(
        f"link cut for {restored - cut:.0f} s: lines missed, doubled; caught up after [s]",
        f"0, 0; {seconds:.1f}",
    )
