"""Connections of a deployment over hosts that change while it runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rcdeploy_command import rcdeploy
from tests.hosts.rig.hosts import Hosts
from tests.support.waiting import wait_until

STATEMENTS = """
    component arm on robot { set serial = "a"; ready within 100 s; };
    component near : arm on base { set serial = "b"; ready within 100 s; };
    component eye on base { after near; ready within 100 s; };
    connect eye.Laser -> near.Laser;
"""


@pytest.fixture
def app(hosts: Hosts, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> HostedApp:
    hosts.start("robot")
    hosts.start("base")
    hosted = make_app(tmp_path / "app", hosts)
    hosted.enter(monkeypatch)
    return hosted


def test_connect_grants_connection_over_hosts(app: HostedApp) -> None:
    app.write(STATEMENTS)
    app.make_keys()
    assert not app.up().failed
    pids = app.pids()

    def sees(name: str) -> bool:
        return any(f"eye sees arm {pids[name]}" in record.text for record in app.logs())

    wait_until(lambda: sees("near"), "eye calls near")
    removed = rcdeploy("disconnect", "app", "eye.Laser", "near.Laser")
    assert removed.code == 0, removed.stderr
    connected = rcdeploy("connect", "app", "eye.Laser", "arm.Laser")
    assert connected.code == 0, connected.stderr
    assert "the routers of all hosts pass the connection" in connected.stdout
    assert "eye.Laser -> arm.Laser: connected" in connected.stdout
    wait_until(lambda: sees("arm"), "eye calls arm")
    changed = rcdeploy("qos", "app", "eye.Laser", "arm.Laser", "priority=high")
    assert changed.stdout.startswith("eye.Laser with arm.Laser: priority=high"), changed.stderr
    rows = rcdeploy("connections", "app", "eye").stdout
    assert "arm.Laser" in rows
    assert "priority=high" in rows
    assert app.pids() == pids
    renamed = rcdeploy("remap", "app", "arm.Laser", "Scan")
    assert renamed.code == 1
    assert "the routers between the hosts pass the described names" in renamed.stderr
    again = rcdeploy("disconnect", "app", "eye.Laser", "arm.Laser")
    assert again.code == 0, again.stderr
