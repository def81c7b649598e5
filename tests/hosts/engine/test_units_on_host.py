"""Units under a real manager: values, readiness of programs, watched limits."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.process import Process
from robocomp_dsl.deploy.units import names
from robocomp_dsl.deploy.units.host_units import host_units
from robocomp_dsl.deploy.units.hosted_process import HOME, HostedProcess
from robocomp_dsl.model.deployment import Readiness, ResourceLimits
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost
from tests.support.waiting import wait_until

ROOT = f"{HOME}/.local/share/robocomp/unit"
NASTY = ["50%", "%h", "$HOME", "${HOME}", "a b", "", ";", "-x", "@x", 'say "hi"', "it's", "a\\nb",
         "one\ntwo\tthree", "\x07", "né ✓", "#no", "a;b", "\\", "$$", "%%", "/@home/x"]  # fmt: skip


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    return module_hosts.start("robot")


def start(robot: SimulatedHost, name: str, argv: list[str], **fields: Any) -> None:
    """Start a unit as rcdeploy writes it; returns when it is ready."""
    robot.run(["mkdir", "-p", names.UNITS, f"{names.root_folder('unit')}/logs"])
    process = Process(name, "program", tuple(argv), Path(HOME), is_program=True, **fields)
    hosted = HostedProcess(process, "robot", ROOT, sys.executable)
    units = host_units([hosted], "unit", root=ROOT, python=sys.executable, controllers=())
    for unit, text in units.items():
        robot.run(["tee", f"{names.UNITS}/{unit}"], input=text)
    robot.systemctl("daemon-reload")
    limits = [unit for unit in units if unit == names.limits_name("unit")]
    robot.systemctl("start", names.service_name("unit", name), *limits)


def log(robot: SimulatedHost, name: str) -> str:
    return robot.run(["cat", f"{names.root_folder('unit')}/{names.log_file(name)}"]).stdout


def test_service_unit_values_reach_process(robot: SimulatedHost) -> None:
    script = "import json,os,sys; print(json.dumps([sys.argv[1:], os.environ['NASTY']]))"
    environment = (("NASTY", "%h $HOME ${X} \"q\" 'q' \\ é ;\nnew\tline"),)
    argv = ["/usr/bin/python3", "-c", script, *NASTY]
    start(robot, "nasty", argv, env=environment, readiness=Readiness(delay_s=0.2))
    lines = [json.loads(line) for line in log(robot, "nasty").splitlines()]
    assert lines[0]["message"] == "starting"
    expected = [value.replace("/@home", str(robot.home_path)) for value in NASTY]
    assert lines[1] == [expected, environment[0][1]]
    assert lines[2]["message"] == "ended: exited 0 (success)"


def test_service_unit_is_active_when_its_log_says_so(robot: SimulatedHost) -> None:
    script = "import time; time.sleep(0.5); print('listening on 7', flush=True); time.sleep(600)"
    argv = ["python3", "-c", script]
    start(robot, "server", argv, readiness=Readiness(pattern="^listening on [0-9]$"))
    assert "listening on 7" in log(robot, "server")
    assert robot.systemctl("is-active", names.service_name("unit", "server")).strip() == "active"


def test_service_unit_is_active_when_its_port_answers(robot: SimulatedHost) -> None:
    script = (
        "import socket,time; time.sleep(0.5); s=socket.create_server(('127.0.0.1', 7654));"
        "print('listening', flush=True); time.sleep(600)"
    )
    start(robot, "port", ["python3", "-c", script], readiness=Readiness(port=7654))
    assert "listening" in log(robot, "port")


def test_service_unit_is_killed_above_its_memory_limit(robot: SimulatedHost) -> None:
    script = "import time; print('big', flush=True); data = b'x' * 200_000_000; time.sleep(600)"
    limits = ResourceLimits(memory_bytes=50_000_000)
    start(robot, "big", ["python3", "-c", script], readiness=Readiness(delay_s=0.1), limits=limits)
    unit = names.service_name("unit", "big")
    wait_until(
        lambda: int(robot.systemctl("show", "-P", "NRestarts", unit)) > 0,
        "the process was not killed",
    )
    assert "its limit is 50 MB; it is killed" in log(robot, "big")
