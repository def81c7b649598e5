"""Placement by load on simulated hosts: `rcdeploy plan --hosts`, and what runs is not moved."""

from __future__ import annotations

import json
import re

import pytest

from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rcdeploy_command import rcdeploy
from tests.hosts.rig.hosts import Hosts

ARM = 'component arm { place by load on HOSTS; set serial = "a"; ready within 100 s; };\n'


@pytest.fixture(scope="module")
def app(module_hosts: Hosts, tmp_path_factory: pytest.TempPathFactory) -> HostedApp:
    module_hosts.start("robot")
    module_hosts.start("base")
    return make_app(tmp_path_factory.mktemp("placement") / "app", module_hosts)


@pytest.fixture(autouse=True)
def operator(app: HostedApp, monkeypatch: pytest.MonkeyPatch) -> None:
    app.enter(monkeypatch)


def test_plan_asks_hosts_for_their_load(app: HostedApp) -> None:
    app.write(ARM.replace("HOSTS", "robot, base"), "plans")
    offline = rcdeploy("plan", str(app.path))
    assert "arm (arm) by load on robot, base, placed when started" in offline.stdout
    shown = rcdeploy("plan", "--hosts", str(app.path))
    assert shown.code == 0, shown.stderr
    # Both are this machine, whose load may change between the two questions.
    placed = re.search(r"^ *1\. arm \(arm\) on (robot|base)\b", shown.stdout, re.MULTILINE)
    assert placed, shown.stdout
    assert f"arm on {placed[1]}: lowest score" in shown.stdout
    assert "load 1 min" in shown.stdout
    data = json.loads(rcdeploy("plan", "--hosts", "--format", "json", str(app.path)).stdout)
    (choice,) = data["placement"]
    candidates = choice["candidates"]
    assert [candidate["host"] for candidate in candidates] == ["robot", "base"]
    assert all(candidate["load"]["cpus"] >= 1 for candidate in candidates)
    lowest = min(candidates, key=lambda candidate: candidate["score"])  # of two, the first
    assert [candidate for candidate in candidates if candidate["chosen"]] == [lowest]


def test_plan_names_host_that_does_not_answer(app: HostedApp) -> None:
    app.write(ARM.replace("HOSTS", "robot, gone").replace("gone", "base"), "plans")
    text = app.path.read_text().replace(app.hosts.by_name["base"].address, "10.255.255.1")
    app.path.write_text(text)
    shown = rcdeploy("plan", "--hosts", str(app.path))
    assert shown.code == 1
    assert "base" in shown.stderr
    assert "app.ddsl" in shown.stderr


def test_up_does_not_move_component_that_runs(app: HostedApp) -> None:
    app.write(ARM.replace("HOSTS", "base"), "stays")
    app.make_keys()
    app.up()
    pids = app.engine("stays").status().rows
    app.write(ARM.replace("HOSTS", "robot, base"), "stays")
    shown = rcdeploy("plan", "--hosts", str(app.path))
    assert "arm on base: runs there" in shown.stdout
    app.make_keys()
    result = app.up()
    assert not result.failed
    assert [row.pid for row in app.engine("stays").status().rows] == [row.pid for row in pids]
