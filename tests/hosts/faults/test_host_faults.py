"""A host loses packets, has a full disk, a wrong clock, or no free port: what runs goes on."""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from statistics import median

import pytest

from robocomp_dsl.deploy.network.identities import router_port
from robocomp_dsl.deploy.units import names
from tests.hosts.faults.loaded_app import UNDER_LOAD, LoadedApp, percentile, show_unit
from tests.hosts.faults.rcdeploy_run import RcdeployRun
from tests.support.waiting import wait_until

PLACES = {"ledger": "robot", "caller": "base", "source": "base", "sink": "robot"}
LOSS, DELAY_MS = 0.1, 100.0
LISTEN = """
import socket, sys
taken = socket.create_server(("0.0.0.0", int(sys.argv[1])))
print("listens", flush=True)
sys.stdin.read()
"""
Record = Callable[[str, object], None]


@pytest.fixture
def loaded(app: LoadedApp) -> LoadedApp:
    """Calls from `base` to `robot`, and publications on the same way."""
    app.describe(PLACES)
    assert not app.up().failed, app.lines
    return app


def durations(app: LoadedApp, count: int, since: float) -> list[float]:
    """The times between `count` acknowledged calls after `since` [s]."""

    def times() -> list[float]:
        return [t for _, _, t in app.journal("caller", "acknowledged") if t > since]

    wait_until(lambda: len(times()) > count, lambda: f"{len(times())} calls\n{app.last_lines()}")
    found = times()[: count + 1]
    return [after - before for before, after in pairwise(found)]


def missed_numbers(app: LoadedApp, since: float) -> tuple[int, int]:
    """How many publications arrived after `since`, and how many between them did not."""
    numbers = [n for _, n, t in app.journal("sink", "received") if t > since]
    return len(numbers), numbers[-1] - numbers[0] + 1 - len(numbers)


OUT_OF_REACH = ("no answer", "no way to the address", "the connection was lost")


def seconds_until_done(*words: str | Path) -> tuple[float, int]:
    """How long a command of rcdeploy took that succeeded, and how many attempts there were.

    A link that loses packets may be silent for longer than any limit: rcdeploy says so, and its
    user runs it again.
    """
    start, outputs = time.monotonic(), []

    def succeeds() -> bool:
        with RcdeployRun(*words) as run:
            code = run.wait()
            outputs.append(run.output)
        assert code == 0 or any(text in outputs[-1] for text in OUT_OF_REACH), outputs[-1]
        return code == 0

    wait_until(succeeds, lambda: "\n".join(outputs))
    return time.monotonic() - start, len(outputs)


def test_lossy_slow_link_slows_down_only(loaded: LoadedApp, record_property: Record) -> None:
    robot = loaded.hosts.by_name["robot"]
    before = loaded.unit_pids()
    loaded.first_after("caller", "acknowledged", time.monotonic())
    with robot.netem(loss=LOSS, delay_ms=DELAY_MS):
        since = time.monotonic()
        calls = durations(loaded, 20, since)
        received, missed = missed_numbers(loaded, since)
        shown, _ = seconds_until_done("status", loaded.name)
        worker = loaded.folder / "sink/specificworker.py"
        worker.write_text(f"{worker.read_text('utf-8')}\n# {time.monotonic_ns()}\n", "utf-8")
        deployed, attempts = seconds_until_done("up", loaded.path)
    after = loaded.unit_pids()
    assert [name for name in UNDER_LOAD if after[name] != before[name]] == ["sink"]
    assert loaded.lost_calls() == set()
    label = f"loss {LOSS:.0%}, delay {DELAY_MS:g} ms each way:"
    record_property(
        f"{label} time of a call: p50, p99 [s]",
        f"{median(calls):.2f}, {percentile(calls, 0.99):.2f}",
    )
    record_property(f"{label} publications received, missed", f"{received}, {missed}")
    record_property(
        f"{label} status, up with one change [s], attempts of up",
        f"{shown:.1f}, {deployed:.1f}, {attempts}",
    )


def test_clock_one_hour_off_is_reported(loaded: LoadedApp, record_property: Record) -> None:
    robot = loaded.hosts.by_name["robot"]
    before = loaded.unit_pids()
    robot.set_clock_offset(-3600.0)
    try:
        with RcdeployRun("up", loaded.path) as run:
            assert run.wait() == 0, run.output
            assert "-3600" in run.output
            assert "warning" in run.output
        with RcdeployRun("up", "--clock-limit", "4000000", loaded.path) as run:
            assert run.wait() == 0, run.output
            assert "-3600" not in run.output
        assert loaded.unit_pids() == before
        loaded.first_after("caller", "acknowledged", time.monotonic())
        killed = loaded.kill("ledger")
        loaded.ready_again("ledger", killed)
        loaded.first_after("caller", "acknowledged", killed)
    finally:
        robot.set_clock_offset(0.0)
    assert loaded.lost_calls() == set()
    record_property("clock of a host 1 h behind: components that ended", 0)


def test_taken_port_of_router_is_reported(app: LoadedApp, record_property: Record) -> None:
    app.describe({"ledger": "robot", "caller": "base"})
    app.engine(app.name).stop(app.lines.append)
    robot = app.hosts.by_name["robot"]
    deployment = app.checked().deployment
    assert deployment
    host = next(host for host in deployment.hosts if host.name == "robot")
    port = router_port(deployment.name, host)
    taker = robot.popen(["python3", "-c", LISTEN, str(port)], stdin=-1, stdout=-1)
    try:
        assert taker.stdout
        assert taker.stdout.readline() == b"listens\n"
        start = time.monotonic()
        with RcdeployRun("up", app.path) as run:
            assert run.wait() == 1, run.output
            text = run.output
        seconds = time.monotonic() - start
        assert f"port {port}" in text
        assert "another program uses the port" in text
        assert "RC870" in text
        assert f"{app.path.name}:" in text
        assert "nothing was changed" in text
        assert {unit.pid for unit in app.units().values()} == {0}, text
    finally:
        taker.communicate()
    record_property("port of the router taken: up fails after [s]", round(seconds, 1))
    assert not app.up().failed, app.lines


def test_full_disk_is_reported_before_anything_changes(
    app: LoadedApp, record_property: Record
) -> None:
    app.describe(PLACES)
    assert not app.up().failed, app.lines
    robot = app.hosts.by_name["robot"]
    before = app.unit_pids()
    worker = app.folder / "ledger/specificworker.py"
    worker.write_text(f"{worker.read_text('utf-8')}\n# {time.monotonic_ns()}\n", "utf-8")
    robot.limit_disk(0)
    try:
        with RcdeployRun("up", app.path) as run:
            assert run.wait() == 1, run.output
            assert "RC8" in run.output
            assert "nothing was changed" in run.output
            assert "Traceback" not in run.output
        assert app.unit_pids() == before
        killed = app.kill("sink")
        restarted = killed + app.ready_again("sink", killed)
        app.first_after("sink", "received", restarted)
        app.first_after("caller", "acknowledged", restarted)
        assert app.row("ledger").state == "ready"
    finally:
        robot.limit_disk(1_000_000_000)
    wait_until(lambda: not app.up().failed, lambda: "\n".join(app.lines))
    assert not app.diff()
    router = show_unit(robot, names.router_name(app.name))
    assert (router.active, router.restarts) == ("active", 0)
    record_property("full disk: components that ended", 0)
