"""A deployment over simulated hosts: real OpenSSH, real systemd of a user."""

from __future__ import annotations

import os

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.component_queries import fetch_states
from robocomp_dsl.deploy.hosts import registry
from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rig.hosts import Hosts
from tests.support.waiting import wait_until

ARM = 'component arm on robot { set serial = "a"; ready within 100 s; };\n'
EYE = "component eye on base { after arm; ready within 100 s; };\n"


@pytest.fixture(scope="module")
def environment() -> dict[str, str]:
    return dict(os.environ)


@pytest.fixture(scope="module")
def app(module_hosts: Hosts, tmp_path_factory: pytest.TempPathFactory) -> HostedApp:
    module_hosts.start("robot")
    module_hosts.start("base")
    return make_app(tmp_path_factory.mktemp("deployment") / "app", module_hosts)


@pytest.fixture(autouse=True)
def operator(app: HostedApp, monkeypatch: pytest.MonkeyPatch) -> None:
    app.enter(monkeypatch)


def kill(app: HostedApp, host: str, component: str) -> None:
    pid = app.rows()[component].pid
    app.hosts.by_name[host].run(["kill", "-9", str(pid)])


def test_host_engine_deploys_in_order(app: HostedApp) -> None:
    app.write(ARM + EYE)
    app.make_keys()
    result = app.up()
    assert not result.failed, "\n".join(app.lines)
    ready = [line.split(" ")[0] for line in app.lines if "ready" in line]
    assert sorted(ready[:2]) == ["router.base", "router.robot"]
    assert ready[2:] == ["arm", "eye"]
    rows = app.rows()
    assert {(r.name, r.host, r.state, r.life) for r in rows.values()} == {
        ("router.base", "base", "ready", ""),
        ("router.robot", "robot", "ready", ""),
        ("arm", "robot", "ready", "compute"),
        ("eye", "base", "ready", "compute"),
    }
    assert all(row.memory > 1_000_000 and row.up_s > 0 for row in rows.values())


def test_host_engine_connects_components_over_hosts(app: HostedApp) -> None:
    expected = ("base", "eye", f"eye sees arm {app.pids()['arm']}")
    wait_until(
        lambda: expected in [(r.host, r.component, r.text) for r in app.logs()],
        "eye did not call arm",
    )
    times = [record.time for record in app.logs()]
    assert times == sorted(times)
    state = fetch_states("app", ["arm", "eye"], 10.0)
    assert {name: each.info.state.name for name, each in state.items()} == {
        "arm": "Compute",
        "eye": "Compute",
    }


def test_host_engine_second_rollout_changes_nothing(app: HostedApp) -> None:
    pids = app.pids()
    result = app.up()
    assert not result.changes
    assert result.version == 1
    assert app.pids() == pids


def test_host_engine_restarts_only_what_changed(app: HostedApp) -> None:
    pids = app.pids()
    worker = app.folder / "eye/specificworker.py"
    worker.write_text(worker.read_text() + "\n# another version\n")
    changes = app.diff()
    [change] = changes[0].components
    assert (change.verb, change.component, change.files) == (
        "restart",
        "eye",
        ("~ eye/specificworker.py",),
    )
    result = app.up()
    assert [c.component for each in result.changes for c in each.components] == ["eye"]
    assert result.version == 2
    after = app.pids()
    assert after["arm"] == pids["arm"]
    assert after["eye"] != pids["eye"]
    assert not app.diff()


def test_host_engine_rolls_back(app: HostedApp) -> None:
    pids = app.pids()
    result = app.roll_back()
    assert result.version == 1
    assert [c.component for each in result.changes for c in each.components] == ["eye"]
    assert app.pids()["arm"] == pids["arm"]
    [change] = app.diff()[0].components
    assert change.component == "eye"
    assert not app.up().failed


def test_host_engine_reloads_routers(app: HostedApp) -> None:
    pids = app.pids()
    statements = ARM + EYE.replace("component eye", "component eye2 : eye")
    app.write(ARM + EYE + statements.partition("\n")[2])
    app.make_keys()
    changes = {c.component: c.verb for each in app.diff() for c in each.components}
    assert changes == {"router.base": "reload", "router.robot": "reload", "eye2": "start"}
    assert not app.up().failed
    after = app.pids()
    assert after.pop("eye2")
    assert after == pids
    app.write(ARM + EYE)
    assert not app.up().failed
    assert "eye2" not in app.rows()
    assert app.pids() == pids


def test_host_engine_restarts_killed_component(app: HostedApp) -> None:
    before = app.pids()["arm"]
    kill(app, "robot", "arm")
    wait_until(
        lambda: app.rows()["arm"].state == "ready" and app.pids()["arm"] not in (0, before),
        "the component was not restarted",
    )
    assert app.rows()["arm"].restarts == 1


def test_host_engine_stops_and_starts_components(app: HostedApp) -> None:
    lines: list[str] = []
    engine = app.engine()
    assert engine.change("stop", ["arm"], lines.append) == 0
    assert lines == ["arm (robot): stopped", "still running without it: eye"]
    assert app.rows()["arm"].state == status.EXITED
    assert engine.change("start", ["arm"], lines.append) == 0
    before = app.pids()
    assert engine.change("restart", ["eye"], lines.append) == 0
    after = app.pids()
    assert after["arm"] == before["arm"]
    assert after["eye"] != before["eye"]


def test_host_engine_survives_reboot(app: HostedApp) -> None:
    app.hosts.by_name["robot"].reboot()
    wait_until(lambda: app.rows()["arm"].state == "ready", "arm did not come up by itself")
    assert not app.diff()


def test_host_engine_shows_unreachable_host(app: HostedApp) -> None:
    robot = app.hosts.by_name["robot"]
    robot.cut_link()
    try:
        found = app.engine().status()
    finally:
        robot.restore_link()
    rows = {row.name: row for row in found.rows}
    assert rows["eye"].state == "ready"
    assert rows["arm"].state == status.UNKNOWN
    assert "robot" in found.problems[0]


def test_host_engine_moves_component(app: HostedApp) -> None:
    app.write(ARM.replace("robot", "base") + EYE)
    result = app.up()
    assert not result.failed
    assert app.rows()["arm"].host == "base"
    robot = app.hosts.by_name["robot"]
    wait_until(lambda: not robot_units(app), "units stayed behind")
    assert "app" in robot.run(["ls", ".local/share/robocomp"]).stdout


def robot_units(app: HostedApp) -> str:
    return (
        app.hosts.by_name["robot"]
        .run(["find", ".config/systemd/user", "-name", "robocomp-*"])
        .stdout
    )


def test_host_engine_stops_deployment(app: HostedApp) -> None:
    lines: list[str] = []
    result = app.engine().stop(lines.append)
    assert (result.code, result.reason) == (0, "stopped")
    assert lines == [f"{name} (base): stopped" for name in ("eye", "arm", "router.base")]
    assert all(row.state == status.EXITED for row in app.rows().values())
    assert [entry.is_stopped for entry in registry.registered()] == [True]
    base = app.hosts.by_name["base"]
    base.reboot()
    wait_until(lambda: "arm" in app.rows(), "the host did not come up")
    assert app.rows()["arm"].state == status.EXITED
