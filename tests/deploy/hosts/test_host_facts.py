"""What is known of a host, and which of it is a finding."""

from __future__ import annotations

import ast
import asyncio
import copy
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from robocomp_dsl.deploy.hosts import fact_script
from robocomp_dsl.deploy.hosts.clock_offset import ClockOffset, TimeExchange, best_offset
from robocomp_dsl.deploy.hosts.connection import connect
from robocomp_dsl.deploy.hosts.errors import HostError, HostRefused
from robocomp_dsl.deploy.hosts.host_checks import HostLimits, check_facts, format_bytes
from robocomp_dsl.deploy.hosts.host_facts import SCRIPT, HostFacts, fetch_facts, parse_facts
from robocomp_dsl.diagnostics import Severity
from robocomp_dsl.model.deployment import Host
from robocomp_dsl.source import Source

SYNCHRONIZED = ClockOffset(0.0, 0.001)
ROBOT = Host("robot", "10.0.0.2", "nao")
SPAN = Source(Path("app.ddsl"), "host robot").span_at(1, 6, 5)
DATA: dict[str, Any] = {
    "hostname": "robot",
    "user": "nao",
    "uid": 1000,
    "home": "/home/nao",
    "boot": "b",
    "machine": "aarch64",
    "system": "Linux",
    "glibc": "2.31",
    "pythons": [
        {"path": "/usr/bin/python3", "version": "3.8.10"},
        {"path": "/opt/bin/python3.12", "version": "3.12.1"},
    ],
    "systemd": {"version": 249, "manager": "running", "problem": "", "controllers": ["memory"]},
    "linger": True,
    "cpus": 4,
    "load": [0.5, 0.25, 0.1],
    "memory": {"total": 8_000_000_000, "available": 4_000_000_000},
    "disk": {"size": 64_000_000_000, "free": 32_000_000_000, "files": 1000},
    "writable": True,
    "lock": {},
}


def facts_with(clock: ClockOffset = SYNCHRONIZED, **changes: Any) -> HostFacts:
    return parse_facts(copy.deepcopy(DATA) | changes, clock)


def test_host_facts_are_parsed() -> None:
    facts = facts_with()
    assert facts.python
    assert str(facts.python) == "3.12.1 (/opt/bin/python3.12)"
    assert facts.load == (0.5, 0.25, 0.1)
    assert facts.as_dict()["clock"] == {"offset_s": 0.0, "uncertainty_s": 0.001}
    assert json.loads(json.dumps(facts.as_dict()))["controllers"] == ["memory"]
    assert facts_with(disk={"size": 10, "free": 10, "files": 0}).free_bytes == 0, "no inodes left"
    assert not list(check_facts(ROBOT, facts, SPAN, HostLimits()))


SYSTEMD = DATA["systemd"]


@pytest.mark.parametrize(
    ("changes", "code", "message", "remedy"),
    [
        (
            {"pythons": DATA["pythons"][:1]},
            "RC835",
            "no Python 3.11 or newer; found: 3.8.10 (/usr/bin/python3)",
            "install Python 3.11",
        ),
        ({"pythons": []}, "RC835", "found: none", "install Python 3.11"),
        ({"systemd": SYSTEMD | {"version": 0}}, "RC834", "systemd is not installed", "export"),
        ({"systemd": SYSTEMD | {"version": 237}}, "RC834", "systemd 237 is too old", "update"),
        (
            {"systemd": SYSTEMD | {"manager": "", "problem": "Failed to connect to bus"}},
            "RC834",
            "manager of user `nao` does not run (Failed to connect to bus)",
            "`loginctl enable-linger nao`",
        ),
        ({"linger": False}, "RC839", "stop at logout", "`loginctl enable-linger nao`"),
        (
            {"disk": {"size": 10, "free": 5_000_000, "files": 9}},
            "RC836",
            "5.0 MB of /home/nao are free, 300.0 MB are needed",
            "delete",
        ),
        ({"writable": False}, "RC836", "`nao` may not write in /home/nao", "home folder"),
        (
            {"lock": {"holder": "ana@laptop", "age": 200.0}},
            "RC838",
            "changes the deployment there: ana@laptop, since 3 min 20 s",
            "wait",
        ),
        (
            {"clock": ClockOffset(-0.2, 0.01)},
            "RC837",
            "its clock differs by -200.0 ± 10.0 ms (limit 50 ms)",
            "timedatectl",
        ),
    ],
)
def test_host_facts_are_checked(
    changes: dict[str, Any], code: str, message: str, remedy: str
) -> None:
    limits = HostLimits(free_bytes={"robot": 300_000_000})
    findings = list(check_facts(ROBOT, facts_with(**changes), SPAN, limits))
    assert [finding.code.id for finding in findings] == [code]
    assert findings[0].message.startswith("`robot` (nao@10.0.0.2): ")
    assert message in findings[0].message
    assert remedy in findings[0].help
    assert (findings[0].severity is Severity.WARNING) == (code in {"RC837", "RC839"})


def test_clock_within_its_uncertainty_is_no_finding() -> None:
    slow = facts_with(ClockOffset(0.3, 0.28))
    assert not list(check_facts(ROBOT, slow, SPAN, HostLimits()))
    assert list(check_facts(ROBOT, slow, SPAN, HostLimits(clock_s=0.01)))


def test_clock_offset_is_that_of_the_shortest_round_trip() -> None:
    exchanges = [
        TimeExchange(sent=1_000, remote=900_000_000, received=400_001_000),
        TimeExchange(sent=2_000_000_000, remote=2_060_000_000, received=2_020_000_000),
    ]
    offset = best_offset(exchanges)
    assert (offset.offset_s, offset.uncertainty_s) == (0.05, 0.01)
    assert offset.format() == "+50.0 ± 10.0 ms"
    assert ClockOffset(-3600.0, 0.001).format() == "-3600.0 ± 0.0 s"


def test_fact_script_is_python_3_6() -> None:
    text = SCRIPT.read_text("utf-8")
    tree = ast.parse(text, feature_version=(3, 6))
    imports = {
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.Import)
        for alias in node.names
    }
    assert imports <= sys.stdlib_module_names
    assert "__future__" not in text, "annotations as a feature are Python 3.7"


def test_fact_script_reports_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}:/bin")
    command = [sys.executable, "-I", "-S", str(SCRIPT), "app"]
    output = subprocess.run(command, input=b"\n\n", capture_output=True, check=True).stdout
    first, *times = output.splitlines()
    facts = parse_facts(json.loads(first.removeprefix(b"robocomp-facts ")), ClockOffset(0, 0))
    assert facts.cpus > 0
    assert facts.free_bytes > 0
    assert facts.home
    assert len(times) == 2
    assert int(times[0]) <= int(times[1])


def test_fact_script_tolerates_missing_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nonexistent")
    facts = parse_facts(fact_script.facts(""), ClockOffset(0, 0))
    assert (facts.systemd, facts.manager, facts.pythons) == (0, "", ())


def test_host_facts_are_fetched_from_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}:/bin")
    async def fetch() -> HostFacts:
        return await fetch_facts(await connect(Host("here", "localhost")), "app")

    facts = asyncio.run(fetch())
    assert facts.pythons
    assert abs(facts.clock.offset_s) <= facts.clock.uncertainty_s


def failure_with(folder: Path, monkeypatch: pytest.MonkeyPatch, script: str) -> HostError:
    """The error with a `python3` that is this shell script."""
    for name in ("python3", *(f"python3.{n}" for n in range(11, 16))):
        (folder / name).write_text(f"#!/bin/sh\n{script}\n", "utf-8")
        (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")

    async def fetch() -> None:
        await fetch_facts(await connect(Host("here", "localhost")))

    with pytest.raises(HostRefused) as caught:
        asyncio.run(fetch())
    return caught.value


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("exit 127", "there is no Python"),
        ("echo broken >&2; exit 3", "Python does not run there: broken"),
        ("exit 3", "Python does not run there: exit code 3"),
        ("echo robocomp-facts {}; cat", "its report is not understood"),
        ("echo robocomp-facts [; echo 5; cat", "its report is not understood"),
    ],
)
def test_host_facts_report_broken_pythons(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str, message: str
) -> None:
    assert message in str(failure_with(tmp_path, monkeypatch, script))


@pytest.mark.parametrize(
    ("count", "text"), [(999, "999 B"), (2_500, "2.5 kB"), (3_210_000_000, "3.2 GB")]
)
def test_bytes_are_formatted(count: int, text: str) -> None:
    assert format_bytes(count) == text
