"""Checks of hosts before a start, on real hosts with the faults that are checked."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest

from robocomp_dsl.deploy.hosts.connection import connect
from robocomp_dsl.deploy.hosts.errors import HostRefused
from robocomp_dsl.deploy.hosts.host_facts import HostFacts, fetch_facts
from robocomp_dsl.model.deployment import Host
from tests.hosts.rcdeploy_command import CommandOutcome, rcdeploy
from tests.hosts.rig.hosts import Hosts
from tests.hosts.rig.machine import SimulatedHost

HOLDER = """\
import fcntl, sys
file = open(sys.argv[1], "w")
fcntl.flock(file, fcntl.LOCK_EX)
file.write("ana@laptop")
file.flush()
print("locked", flush=True)
sys.stdin.read()
"""


@pytest.fixture(scope="module")
def robot(module_hosts: Hosts) -> SimulatedHost:
    return module_hosts.start("robot")


def app_of(folder: Path, *hosts: SimulatedHost | tuple[str, str]) -> Path:
    """A deployment with a program on each host; a host is a simulated one, or name and address."""
    lines = ["Deployment app", "{"]
    for host in hosts:
        name, address = host if isinstance(host, tuple) else (host.name, host.address)
        user = name if isinstance(host, tuple) else host.user
        lines.append(f'    host {name} {{ address "{address}"; user {user}; }};')
        lines.append(f'    program on_{name} on {name} {{ executable "sleep infinity"; }};')
    path = folder / "app.ddsl"
    path.write_text("\n".join([*lines, "}", ""]), "utf-8")
    return path


def codes(outcome: CommandOutcome) -> dict[str, list[str]]:
    """The codes of findings by host, of `--format json`."""
    hosts = json.loads(outcome.stdout)["hosts"]
    return {host["name"]: [finding["code"] for finding in host["findings"]] for host in hosts}


def facts_of(machine: SimulatedHost, deployment: str = "") -> HostFacts:
    async def fetch() -> HostFacts:
        connection = await connect(Host(machine.name, machine.address, machine.user))
        facts = await fetch_facts(connection, deployment)
        await connection.close()
        return facts

    return asyncio.run(asyncio.wait_for(fetch(), 120))


@pytest.mark.usefixtures("operator")
def test_host_facts_describe_the_host(module_hosts: Hosts, robot: SimulatedHost) -> None:
    module_hosts.trust()
    facts = facts_of(robot)
    assert (facts.hostname, facts.user, facts.uid) == ("robot", "robot", robot.uid)
    assert facts.home == "/home/robot"
    assert facts.manager == "running"
    assert facts.systemd >= 240
    assert facts.linger
    assert facts.home_writable
    assert facts.python
    assert facts.python.path.startswith("/usr")
    assert 0 < facts.free_bytes <= facts.disk_bytes
    assert 0 < facts.memory_available_bytes <= facts.memory_bytes
    assert facts.lock_holder == ""
    # Both see the same clock, and the offset is known as well as the way is short.
    assert abs(facts.clock.offset_s) <= facts.clock.uncertainty_s


@pytest.mark.usefixtures("operator")
def test_host_facts_ignore_output_of_the_login(module_hosts: Hosts, robot: SimulatedHost) -> None:
    module_hosts.trust()
    robot.run(["sh", "-c", "echo 'echo Welcome to robot' > .bashrc"])
    try:
        assert facts_of(robot).hostname == "robot"
        robot.run(["sh", "-c", "echo 'echo Maintenance until noon; exit 1' > .bashrc"])
        with pytest.raises(HostRefused, match="does not run there: Maintenance until noon"):
            facts_of(robot)
    finally:
        robot.run(["rm", ".bashrc"])


@pytest.mark.usefixtures("operator")
def test_host_lock_says_who_and_since_when(
    module_hosts: Hosts, robot: SimulatedHost, tmp_path: Path
) -> None:
    module_hosts.trust()
    folder = ".local/share/robocomp/app"
    robot.run(["mkdir", "-p", folder])
    holder = robot.popen(["python3", "-c", HOLDER, f"{folder}/lock"], stdin=-1, stdout=-1)
    assert holder.stdout.readline() == b"locked\n"
    outcome = rcdeploy("hosts", str(app_of(tmp_path, robot)))
    holder.communicate()
    assert outcome.code == 1
    assert "RC838" in outcome.stderr
    assert "another rcdeploy changes the deployment there: ana@laptop, since " in outcome.stderr
    # The file stays; the lock ended with its holder.
    assert rcdeploy("hosts", str(app_of(tmp_path, robot))).code == 0


@pytest.mark.usefixtures("operator")
def test_hosts_are_checked_together_with_one_finding_each(
    module_hosts: Hosts, robot: SimulatedHost, tmp_path: Path
) -> None:
    """All bad inputs in one deployment: each host has its finding, and nothing is changed."""
    hosts = module_hosts
    machines = [
        robot,
        hosts.start("silent", sshd=False),
        hosts.start("manless", manager=False, linger=False),
        hosts.start("logout", linger=False),
        hosts.start("full", disk_bytes=4_000_000),
        hosts.start("snakeless", hidden=["/usr/bin/python3", "/usr/bin/python3.11"]),
        hosts.start("unmanaged", hidden=["/usr/bin/systemctl"]),
        hosts.start("strange"),
        hosts.start("late"),
    ]
    hosts.by_name["late"].set_clock_offset(-3600)
    hosts.trust()
    hosts.by_name["strange"].replace_host_key()
    unknown = ("nowhere", "10.99.0.9")
    app = app_of(tmp_path, *machines, unknown)
    before = {m.name: m.run(["find", "."]).stdout for m in machines}
    outcome = rcdeploy("hosts", str(app), "--format", "json")
    assert codes(outcome) == {
        "robot": [],
        "silent": ["RC830"],
        "manless": ["RC834"],
        "logout": ["RC839"],
        "full": ["RC836"],
        "snakeless": ["RC835"],
        "unmanaged": ["RC834"],
        "strange": ["RC833"],
        "late": ["RC837"],
        "nowhere": ["RC830"],
    }
    assert outcome.code == 1
    assert {m.name: m.run(["find", "."]).stdout for m in machines} == before
    late = next(h for h in json.loads(outcome.stdout)["hosts"] if h["name"] == "late")
    assert late["facts"]["clock"]["offset_s"] == pytest.approx(-3600, abs=5)
    assert late["usable"]

    text = rcdeploy("hosts", str(app))
    rows = {line.split()[0]: line for line in text.stdout.splitlines()}
    assert rows["HOST"].split() == [
        *("HOST", "ADDRESS", "USER", "STATE", "SYSTEMD", "PYTHON", "FREE", "LOAD", "CLOCK")
    ]
    assert "usable" in rows["robot"]
    assert "running" in rows["robot"]
    assert "unreachable" in rows["silent"]
    assert "changed key" in rows["strange"]
    assert "-3600.0 ±" in rows["late"]
    for expected in (
        "`loginctl enable-linger manless`",
        "`full` (full@",
        "are needed",
        "there is no Python",
        "systemd is not installed",
        "install Python 3.11 or newer",
        "the systemd manager of user `manless` does not run",
        f"{app}:",  # located at the host
    ):
        assert expected in text.stderr


@pytest.mark.usefixtures("operator")
def test_clock_limit_is_an_option(
    module_hosts: Hosts, robot: SimulatedHost, tmp_path: Path
) -> None:
    module_hosts.trust()
    ahead = module_hosts.start("ahead")
    ahead.set_clock_offset(2.5)
    module_hosts.trust()
    app = app_of(tmp_path, ahead)
    outcome = rcdeploy("hosts", str(app))
    assert outcome.code == 0, outcome.stderr
    assert "RC837" in outcome.stderr
    assert "its clock differs by +2.5 ± 0.0 s (limit 50 ms)" in outcome.stderr
    assert "RC837" not in rcdeploy("hosts", str(app), "--clock-limit", "3000").stderr
