"""`rcdeploy hosts` without simulated hosts."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest

from robocomp_dsl.cli.rcdeploy import hosts_deployment
from robocomp_dsl.deploy.hosts.host_checks import CheckedHosts, check_hosts, used_hosts
from robocomp_dsl.model.deployment import Deployment, Host
from robocomp_dsl.source import Source, Span
from tests.hosts.rcdeploy_command import rcdeploy

APP = """\
Deployment app
{
    host robot { address "10.99.0.2"; labels gpu; };
    program mind { executable "true"; };
    program eye on label gpu { executable "true"; };
}
"""


@pytest.fixture
def app(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    path = tmp_path / "app.ddsl"
    path.write_text(APP, "utf-8")
    return path


@pytest.mark.parametrize("command", [("hosts",), ("hosts", "trust")])
def test_hosts_command_says_that_there_is_none(app: Path, command: tuple[str, ...]) -> None:
    app.write_text('Deployment app { program mind { executable "true"; }; }\n', "utf-8")
    outcome = rcdeploy(*command, str(app))
    assert (outcome.code, outcome.stderr) == (0, "")
    assert "all components run on this machine" in outcome.stdout
    if command == ("hosts",):
        text = rcdeploy(*command, str(app), "--format", "json").stdout
        assert json.loads(text) == {"hosts": []}


def test_hosts_command_reports_errors_of_the_file(app: Path) -> None:
    app.write_text(APP.replace("on label gpu", "on robo"), "utf-8")
    outcome = rcdeploy("hosts", str(app))
    assert outcome.code == 1
    assert "did you mean `robot`" in outcome.stderr
    assert rcdeploy("hosts", "trust", str(app.with_name("no.ddsl"))).code == 1


def test_hosts_command_suggests_names(app: Path) -> None:
    assert "did you mean `robot`" in rcdeploy("hosts", "trust", str(app), "robt").stderr
    assert "no command `shwo`" in rcdeploy("hosts", "shwo", str(app)).stderr


def test_hosts_are_asked_at_the_same_time(app: Path) -> None:
    """Each server answers when all have been asked; one after the other would never end well."""
    everyone_asked = asyncio.Event()
    count = 5

    async def check() -> CheckedHosts:
        asked = []

        async def serve(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            asked.append(writer)
            if len(asked) == count:
                everyone_asked.set()
            await everyone_asked.wait()
            writer.close()

        servers = [await asyncio.start_server(serve, "127.0.0.1", 0) for _ in range(count)]
        ports = [server.sockets[0].getsockname()[1] for server in servers]
        hosts = [Host(f"h{port}", "127.0.0.1", ssh_port=port) for port in ports]
        checked = await check_hosts(deployment_of(app), "app", hosts)
        for server in servers:
            server.close()
        return checked

    checked = asyncio.run(check())
    assert not checked.can_start
    messages = [finding.message for finding in checked.findings]
    assert len(messages) == count
    assert all("the connection was closed before the login" in text for text in messages)


def deployment_of(app: Path) -> Deployment:
    span = Span(Source(app, APP), 0, 10)
    return Deployment("app", app, span, "", instances=(), connections=())


PLACED_BY_LOAD = """\
Deployment app
{
    host robot { address "10.99.0.2"; };
    host desk { address "10.99.0.3"; };
    program mind { executable "true"; };
    program eye { executable "true"; place by load on robot, desk; };
}
"""


def test_hosts_of_deployment_include_candidates(app: Path) -> None:
    app.write_text(PLACED_BY_LOAD, "utf-8")
    deployment = hosts_deployment.load(app, ())
    assert [host.address for host in used_hosts(deployment)] == ["127.0.0.1"]
    names = [host.name for host in hosts_deployment.hosts_of(deployment)]
    assert names == ["", "robot", "desk"]
