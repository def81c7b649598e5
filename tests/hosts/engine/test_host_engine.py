"""A deployment over simulated hosts: real OpenSSH, real systemd of a user."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.deploy import status
from tests.hosts.engine.hosted_app import HostedApp, make_app
from tests.hosts.rig.hosts import Hosts

APP = """
    component arm on robot { set serial = "a"; ready within 100 s; };
    component eye on base { after arm; ready within 100 s; };
"""


@pytest.fixture
def app(hosts: Hosts, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> HostedApp:
    hosts.start("robot")
    hosts.start("base")
    app = make_app(tmp_path / "app", hosts, monkeypatch)
    app.write(APP)
    return app


def test_host_engine_deploys_and_stops(app: HostedApp) -> None:
    result = app.up()
    print("\n".join(app.lines))
    assert not result.failed
    rows = app.rows()
    print(rows)
    assert {name: row.state for name, row in rows.items()} == {"arm": "ready", "eye": "ready"}
    pids = app.pids()
    assert not app.up().changes
    assert app.pids() == pids
