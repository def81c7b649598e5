"""The commands of rcdeploy for a deployment over simulated hosts."""

from __future__ import annotations

import json

import click
import pytest

from robocomp_dsl.cli.program import CliError
from robocomp_dsl.cli.rcdeploy.main import normalise_arguments, program
from robocomp_dsl.deploy.hosts import registry
from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rig.hosts import Hosts
from tests.support.waiting import wait_until

APP = """
    component arm on robot { set serial = "a"; ready within 100 s; };
    component eye on robot { after arm; ready within 100 s; };
"""


@pytest.fixture(scope="module")
def app(module_hosts: Hosts, tmp_path_factory: pytest.TempPathFactory) -> HostedApp:
    robot = module_hosts.start("robot")
    robot.run(["tee", ".bashrc"], input="echo Welcome to the robot\n")
    return make_app(tmp_path_factory.mktemp("deployment") / "app", module_hosts)


@pytest.fixture(autouse=True)
def operator(app: HostedApp, monkeypatch: pytest.MonkeyPatch) -> None:
    app.enter(monkeypatch)
    monkeypatch.chdir(app.folder)


@pytest.fixture
def deployed(app: HostedApp) -> HostedApp:
    """`arm` and `eye` run."""
    app.deploy(APP)
    return app


class Commands:
    """Runs commands in this process."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys

    def __call__(self, *words: str, code: int = 0) -> str:
        """The output of a command, which ends with `code`."""
        actual, message = 0, ""
        try:
            program.main(normalise_arguments(words), "rcdeploy", standalone_mode=False)
        except CliError as error:
            actual, message = error.code, str(error)
        except click.ClickException as error:
            actual, message = error.exit_code, error.message
        output = self._capsys.readouterr()
        text = f"{output.out}{output.err}{message}"
        assert actual == code, text
        return text


@pytest.fixture
def rcdeploy(capsys: pytest.CaptureFixture[str]) -> Commands:
    return Commands(capsys)


def test_rcdeploy_up_needs_keys(app: HostedApp, rcdeploy: Commands) -> None:
    app.write(APP)
    assert "rcdeploy keys app.ddsl" in rcdeploy("app.ddsl", code=1)
    assert list(registry.registered()) == []


def test_rcdeploy_up_returns_when_all_are_ready(app: HostedApp, rcdeploy: Commands) -> None:
    app.write(APP)
    rcdeploy("keys", "app.ddsl")
    text = rcdeploy("up", "app.ddsl")
    assert "app: version 1 is deployed, all components are ready" in text
    assert "nothing changes" in rcdeploy("up", "app.ddsl")
    assert "for deployments on one machine" in rcdeploy("up", "app.ddsl", "--duration", "3", code=2)


@pytest.mark.usefixtures("deployed")
def test_rcdeploy_status_shows_hosts(rcdeploy: Commands) -> None:
    text = rcdeploy("status", "app")
    assert "HOST" in text
    assert "router.robot" in text
    data = json.loads(rcdeploy("status", "app.ddsl", "--format", "json"))
    rows = {row["name"]: row for row in data["components"]}
    assert (rows["eye"]["host"], rows["eye"]["state"]) == ("robot", "ready")
    assert data["hosts"][0]["name"] == "robot"


@pytest.mark.usefixtures("deployed")
def test_rcdeploy_status_works_without_registry(rcdeploy: Commands) -> None:
    [entry] = registry.registered()
    registry.forget("app")
    assert "router.robot" in rcdeploy("status", "app.ddsl")
    assert "no deployment is running" in rcdeploy("status", code=1)
    registry.register(entry)


@pytest.mark.usefixtures("deployed")
def test_rcdeploy_inspects_over_hosts(rcdeploy: Commands) -> None:
    assert "eye" in rcdeploy("list")
    assert "rate" in rcdeploy("param", "list", "app", "arm")
    assert "dist" in rcdeploy("call", "arm.Laser.getLaserData")


@pytest.mark.usefixtures("deployed")
def test_rcdeploy_logs_select_by_component_and_text(rcdeploy: Commands) -> None:
    wait_until(lambda: "eye sees arm" in rcdeploy("logs"), "no logs")
    text = rcdeploy("logs", "app", "-c", "eye", "--grep", "sees", "-n", "1")
    assert len(text.splitlines()) == 1
    assert "robot eye | eye sees arm" in " ".join(text.split())
    record = json.loads(rcdeploy("logs", "app", "-c", "eye", "-n", "1", "--json"))
    assert (record["host"], record["component"]) == ("robot", "eye")
    assert rcdeploy("logs", "app", "--since", "0 s") == ""
    assert "use --since" in rcdeploy("logs", "app", "--run", "3", code=1)


def test_rcdeploy_diff_and_rollback(deployed: HostedApp, rcdeploy: Commands) -> None:
    assert "runs as described" in rcdeploy("diff", "app.ddsl")
    deployed.write(APP.replace('"a"', '"b"'))
    text = rcdeploy("diff", "app.ddsl", code=1)
    assert "robot: restart arm (changed: command line)" in text
    [host] = json.loads(rcdeploy("diff", "app.ddsl", "--format", "json", code=1))
    assert [change["component"] for change in host["components"]] == ["arm"]
    rcdeploy("up", "app.ddsl")
    assert "version 1 runs" in rcdeploy("rollback", "app")
    listed = rcdeploy("rollback", "app", "--list").splitlines()
    assert [line.endswith("current") for line in listed] == [True, False]
    assert "no version before" in rcdeploy("rollback", "app", code=1)
    assert "stored: 1, 2" in rcdeploy("rollback", "app", "9", code=1)
    assert "version 2 runs" in rcdeploy("rollback", "app", "2")


def test_rcdeploy_up_on_one_machine_needs_a_free_name(
    deployed: HostedApp, rcdeploy: Commands
) -> None:
    deployed.write(APP.replace("on robot", ""))
    once = ("--duration", "0")  # ends if the name is free
    assert "`app` runs on robot; stop it" in rcdeploy("up", "app.ddsl", *once, code=1)


@pytest.mark.usefixtures("deployed")
def test_rcdeploy_stop_and_start(rcdeploy: Commands) -> None:
    assert "eye (robot): stopped" in rcdeploy("stop", "app", "eye")
    assert "no component or group" in rcdeploy("stop", "app", "eey", code=1)
    assert "eye (robot): ready" in rcdeploy("start", "app", "eye")
    assert "arm (robot): ready" in rcdeploy("restart", "arm")
    assert "app: stopped" in rcdeploy("stop")
    assert "no deployment is running" in rcdeploy("status", code=1)
    assert "exited" in rcdeploy("status", "app")
    assert "eye (robot): ready" in rcdeploy("start", "app")
    assert "app: stopped" in rcdeploy("stop", "app.ddsl")


def test_rcdeploy_up_runs_group_in_one_process(app: HostedApp, rcdeploy: Commands) -> None:
    app.write(f"group pair on robot {{ inprocess; {APP.replace('on robot', '')} }};")
    rcdeploy("keys", "app.ddsl")
    assert "pair (robot): ready" in rcdeploy("up", "app.ddsl")
    rows = json.loads(rcdeploy("status", "app", "--format", "json"))["components"]
    [group] = [row for row in rows if row["name"] == "pair"]
    assert [name for name, _ in group["members"]] == ["pair-arm", "pair-eye"]
    wait_until(lambda: "eye sees arm" in rcdeploy("logs", "app", "-c", "pair-eye"), "no logs")
    assert "dist" in rcdeploy("call", "pair-arm.Laser.getLaserData")
    rcdeploy("stop", "app")
