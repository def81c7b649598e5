"""Migrated files of YARP run: programs whose connection carries data, and a simulated robot."""

from __future__ import annotations

import json
import math
import sys
import uuid
from collections.abc import Callable
from pathlib import Path

import pytest

from robocomp_dsl.cli import program
from robocomp_dsl.cli.rcdeploy.main import program as rcdeploy_program
from robocomp_dsl.client import DomainClient
from robocomp_dsl.runtime.middleware.yarp.name_server import NameServer
from tests.deploy.rcdeploy_process import start_rcdeploy
from tests.migrate.conftest import Run, rcgen
from tests.migrate.yarp.robot_files import ARM
from tests.migrate.yarp.yarp_programs import write_programs
from tests.support.waiting import wait_until

__all__ = ["rcgen"]
HOME = (math.radians(15), math.radians(45), 0.15, math.radians(45))
"""`startupPosition` of the calibrator; the last one is limited."""
LOOPBACK = "127.0.0.1"
APPLICATION = """\
<application>
    <name>Two Programs</name>
    <module>
        <name>{python}</name>
        <parameters>{folder}/listener.py view</parameters>
        <tag>view</tag>
        <dependencies><port timeout="120">/camera/Scan:o</port></dependencies>
    </module>
    <module>
        <name>{python}</name>
        <parameters>{folder}/speaker.py camera</parameters>
        <tag>camera</tag>
        <node>localhost</node>
    </module>
    <connection>
        <from>/camera/Scan:o</from>
        <to>/view/Scan:i</to>
        <protocol>fast_tcp</protocol>
    </connection>
</application>
"""


@pytest.fixture
def rcdeploy(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., Run]:
    """`rcdeploy("plan", "x.ddsl")` in this process."""

    def run(*arguments: str) -> Run:
        monkeypatch.setattr(sys, "argv", ["rcdeploy", *arguments])
        try:
            code = program._exit_code(rcdeploy_program, "rcdeploy")
        except SystemExit as leaving:
            code = leaving.code if isinstance(leaving.code, int) else 1
        shown = capsys.readouterr()
        return Run(code, shown.out, shown.err)

    return run


@pytest.fixture
def name_server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> NameServer:
    """A name server that programs find by `yarp.conf`."""
    server = NameServer((LOOPBACK, 0))
    (tmp_path / "yarp.conf").write_text(f"{LOOPBACK} {server.number} yarp\n")
    monkeypatch.setenv("YARP_CONFIG_HOME", str(tmp_path))
    monkeypatch.delenv("YARP_NAMESPACE", raising=False)
    return server


def test_migrated_application_runs_and_its_connection_carries_data(
    rcgen, rcdeploy, tmp_path: Path, name_server: NameServer
) -> None:
    write_programs(tmp_path)
    text = APPLICATION.format(python=sys.executable, folder=tmp_path)
    (tmp_path / "demo.xml").write_text(text)
    out = tmp_path / "out"
    done = rcgen("migrate", tmp_path / "demo.xml", "-o", out)
    assert done.code == 0, done.err
    assert rcgen("check", out).code == 0
    planned = rcdeploy("plan", str(out / "demo.ddsl"))
    assert "/camera/Scan:o -> /view/Scan:i over yarp (fast_tcp)" in planned.out, planned.err
    name = f"demo-{uuid.uuid4().hex[:8]}"
    connected = {
        "middleware": "yarp",
        "source": "/camera/Scan:o",
        "target": "/view/Scan:i",
        "carrier": "fast_tcp",
        "state": "connected",
        "reason": "",
    }
    with start_rcdeploy("up", str(out / "demo.ddsl"), "--name", name, "--no-table") as app:
        app.until("connected /camera/Scan:o -> /view/Scan:i", "heard [1.5, 2.5]")
        status = json.loads(rcdeploy("status", name, "--format", "json").out)
        assert status["connections"] == [connected]
        line = "/camera/Scan:o -> /view/Scan:i over yarp (fast_tcp): connected"
        assert line in rcdeploy("status", name).out
        listed = json.loads(rcdeploy("connections", "-d", name, "--json").out)
        assert listed == [{"component": ""} | connected]
        shown = rcdeploy("connections", "-d", name).out.splitlines()
        words = ["/camera/Scan:o", "external", "/view/Scan:i", "yarp", "(fast_tcp)", "connected"]
        assert shown[1].split()[:6] == words
        app.process.terminate()
        assert app.end() == 0, app.lines
    name_server.close()


def test_migrated_robot_calibrates_its_simulated_joints(rcgen, rcdeploy, tmp_path: Path) -> None:
    for name, text in ARM.items():
        (tmp_path / "robot" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "robot" / name).write_text(text)
    out = tmp_path / "out"
    done = rcgen("migrate", tmp_path / "robot" / "arm.xml", "-o", out)
    assert done.code == 0, done.err
    assert rcgen("check", out).code == 0
    planned = rcdeploy("plan", str(out / "arm.ddsl"))
    assert "startup 10: calibrate arm_mc_wrapper by arm_calib" in planned.out, planned.err
    domain = f"arm-{uuid.uuid4().hex[:8]}"
    options = ("--name", domain, "--domain", domain, "--no-table")
    with start_rcdeploy("up", str(out / "arm.ddsl"), *options) as app:
        app.until("the component is ready")
        with DomainClient(domain, name="test") as client:
            port = client.describe("arm_simulator").port("arm", "implements")
            board = client.operations(port.interface, "arm_simulator", "arm")

            def is_calibrated() -> bool:
                return all(mode.name == "Position" for mode in board.getState().modes)

            wait_until(is_calibrated)
            positions = [float(each) for each in board.getState().position]
            assert positions == pytest.approx(HOME, abs=0.03)
        app.process.terminate()
        assert app.end() == 0, app.lines
        assert not app.has("failed"), app.lines
