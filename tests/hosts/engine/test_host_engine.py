"""A deployment over simulated hosts: real OpenSSH, real systemd of a user."""

from __future__ import annotations

import time

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.component_queries import fetch_states
from robocomp_dsl.deploy.hosts import registry
from robocomp_dsl.deploy.status import ProcessStatus
from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rig.hosts import Hosts
from tests.support.waiting import wait_until

ARM = 'component arm on robot { set serial = "a"; ready within 100 s; };\n'
EYE = "component eye on base { after arm; ready within 100 s; };\n"


@pytest.fixture(scope="module")
def app(module_hosts: Hosts, tmp_path_factory: pytest.TempPathFactory) -> HostedApp:
    module_hosts.start("robot")
    module_hosts.start("base")
    return make_app(tmp_path_factory.mktemp("deployment") / "app", module_hosts)


@pytest.fixture(autouse=True)
def operator(app: HostedApp, monkeypatch: pytest.MonkeyPatch) -> None:
    app.enter(monkeypatch)


@pytest.fixture
def deployed(app: HostedApp) -> HostedApp:
    """`arm` and `eye` run."""
    app.deploy(ARM + EYE)
    return app


def change_eye(app: HostedApp) -> None:
    """Make another version of `eye`."""
    worker = app.folder / "eye/specificworker.py"
    worker.write_text(f"{worker.read_text()}\n# {time.monotonic_ns()}\n")


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


def test_host_engine_connects_components_over_hosts(deployed: HostedApp) -> None:
    expected = ("base", "eye", f"eye sees arm {deployed.pids()['arm']}")
    wait_until(
        lambda: expected in [(r.host, r.component, r.text) for r in deployed.logs()],
        "eye did not call arm",
    )
    times = [record.time for record in deployed.logs()]
    assert times == sorted(times)
    state = fetch_states("app", ["arm", "eye"], 10.0)
    assert {name: each.info.state.name for name, each in state.items()} == {
        "arm": "Compute",
        "eye": "Compute",
    }


def test_host_engine_second_rollout_changes_nothing(deployed: HostedApp) -> None:
    pids, version = deployed.pids(), deployed.engine().versions()[-1].version
    result = deployed.up()
    assert not result.changes
    assert result.version == version
    assert deployed.pids() == pids


def test_host_engine_restarts_only_what_changed(deployed: HostedApp) -> None:
    pids = deployed.pids()
    change_eye(deployed)
    changes = deployed.diff()
    [change] = changes[0].components
    assert (change.verb, change.component, change.files) == (
        "restart",
        "eye",
        ("~ eye/specificworker.py",),
    )
    result = deployed.up()
    assert [c.component for each in result.changes for c in each.components] == ["eye"]
    after = deployed.pids()
    assert after["arm"] == pids["arm"]
    assert after["eye"] != pids["eye"]
    assert not deployed.diff()


def test_host_engine_rolls_back(deployed: HostedApp) -> None:
    before = deployed.up().version
    change_eye(deployed)
    assert deployed.up().version > before
    pids = deployed.pids()
    result = deployed.roll_back()
    assert result.version == before
    assert [c.component for each in result.changes for c in each.components] == ["eye"]
    assert deployed.pids()["arm"] == pids["arm"]
    [change] = deployed.diff()[0].components
    assert change.component == "eye"
    assert not deployed.up().failed


def test_host_engine_reloads_routers(deployed: HostedApp) -> None:
    pids = deployed.pids()
    statements = ARM + EYE.replace("component eye", "component eye2 : eye")
    deployed.write(ARM + EYE + statements.partition("\n")[2])
    deployed.make_keys()
    changes = {c.component: c.verb for each in deployed.diff() for c in each.components}
    assert changes == {"router.base": "reload", "router.robot": "reload", "eye2": "start"}
    assert not deployed.up().failed
    after = deployed.pids()
    assert after.pop("eye2")
    assert after == pids
    deployed.write(ARM + EYE)
    assert not deployed.up().failed
    assert "eye2" not in deployed.rows()
    assert deployed.pids() == pids


def test_host_engine_restarts_killed_component(deployed: HostedApp) -> None:
    before = deployed.rows()["arm"]
    kill(deployed, "robot", "arm")

    def restarted() -> ProcessStatus | None:
        row = deployed.rows()["arm"]
        return row if row.state == "ready" and row.pid not in (0, before.pid) else None

    assert wait_until(restarted, "not restarted").restarts == before.restarts + 1


def test_host_engine_stops_and_starts_components(deployed: HostedApp) -> None:
    lines: list[str] = []
    engine = deployed.engine()
    assert engine.change("stop", ["arm"], lines.append) == 0
    assert lines == ["arm (robot): stopped", "still running without it: eye"]
    assert deployed.rows()["arm"].state == status.EXITED
    assert engine.change("start", ["arm"], lines.append) == 0
    before = deployed.pids()
    assert engine.change("restart", ["eye"], lines.append) == 0
    after = deployed.pids()
    assert after["arm"] == before["arm"]
    assert after["eye"] != before["eye"]


def test_host_engine_survives_reboot(deployed: HostedApp) -> None:
    deployed.hosts.by_name["robot"].reboot()
    wait_until(lambda: deployed.rows()["arm"].state == "ready", "arm did not come up by itself")
    assert not deployed.diff()


def test_host_engine_shows_unreachable_host(deployed: HostedApp) -> None:
    robot = deployed.hosts.by_name["robot"]
    robot.cut_link()
    try:
        found = deployed.engine().status()
    finally:
        robot.restore_link()
    rows = {row.name: row for row in found.rows}
    assert rows["eye"].state == "ready"
    assert rows["arm"].state == status.UNKNOWN
    assert "robot" in found.problems[0]


def test_host_engine_moves_component(deployed: HostedApp) -> None:
    deployed.write(ARM.replace("robot", "base") + EYE)
    result = deployed.up()
    assert not result.failed
    assert deployed.rows()["arm"].host == "base"
    robot = deployed.hosts.by_name["robot"]
    wait_until(lambda: not robot_units(deployed), "units stayed behind")
    assert "app" in robot.run(["ls", ".local/share/robocomp"]).stdout


def robot_units(app: HostedApp) -> str:
    return (
        app.hosts.by_name["robot"]
        .run(["find", ".config/systemd/user", "-name", "robocomp-*"])
        .stdout
    )


def test_host_engine_stops_deployment(deployed: HostedApp) -> None:
    lines: list[str] = []
    result = deployed.engine().stop(lines.append)
    assert (result.code, result.reason) == (0, "stopped")
    places = {"eye": "base", "arm": "robot", "router.base": "base", "router.robot": "robot"}
    assert set(lines) == {f"{name} ({host}): stopped" for name, host in places.items()}
    order = [line.split()[0] for line in lines]
    for user, used in (("eye", "arm"), ("eye", "router.base"), ("arm", "router.robot")):
        assert order.index(user) < order.index(used)
    assert all(row.state == status.EXITED for row in deployed.rows().values())
    assert [entry.is_stopped for entry in registry.registered()] == [True]
    base = deployed.hosts.by_name["base"]
    base.reboot()
    wait_until(lambda: deployed.rows()["eye"].state != status.UNKNOWN, "the host did not come up")
    assert deployed.rows()["eye"].state == status.EXITED
