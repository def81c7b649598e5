"""What a rollout changes: pure comparison of a manifest with the report of a host."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.hosts.differences import compare, format_changes, stored_manifest
from robocomp_dsl.deploy.hosts.host_report import HostReport, UnitState
from robocomp_dsl.deploy.hosts.manifest import HostedComponent, HostManifest, InvalidManifest
from robocomp_dsl.deploy.units.service import find_revision, service_unit
from robocomp_dsl.model.deployment import Host, ResourceLimits, Restart
from tests.deploy.units.unit_samples import PYTHON, hosted

RUNNING = UnitState("loaded", "active", "running", pid=7)


def manifest(**fields: Any) -> HostManifest:
    """`arm` and `eye` on `robot`; `fields` are those of the process `arm`."""
    units, components = {}, []
    for name, process in (("arm", hosted("arm", **fields)), ("eye", hosted("eye"))):
        unit = f"robocomp-patrol-{name}.service"
        units[unit] = service_unit(process, "patrol", frozenset())
        components.append(HostedComponent(name, "robot", unit, tree=f"{name}-tree"))
    trees = {"arm-tree": {"arm/a.py": "1", "arm/b.py": "1"}, "eye-tree": {}}
    hosts = (Host("robot", "10.0.0.2"),)
    return HostManifest("patrol", "patrol", "robot", hosts, tuple(components), units, trees)


def report(deployed: HostManifest | None, **states: UnitState) -> HostReport:
    """A host that runs `deployed`; `states` are by component and replace a running one."""
    units = deployed.units if deployed else {}
    found = {
        unit: replace(RUNNING, revision=find_revision(text)) for unit, text in units.items()
    } | {f"robocomp-patrol-{name}.service": state for name, state in states.items()}
    text = deployed.to_json() if deployed else None
    return HostReport("1" if deployed else "", (1,), text, units, found, 0.0)


def changes(described: HostManifest | None, found: HostReport) -> list[tuple[str, str, str]]:
    result = compare("robot", described, found)
    return [(change.component, change.verb, change.reason) for change in result.components]


def test_compare_finds_nothing_to_change() -> None:
    assert not compare("robot", manifest(), report(manifest()))


def test_compare_starts_what_is_new_or_does_not_run() -> None:
    new = "is new on this host"
    assert changes(manifest(), report(None)) == [("arm", "start", new), ("eye", "start", new)]
    failed = UnitState("loaded", "failed", "failed", "exit-code", code="1", exit_status="3")
    found = report(manifest(), arm=failed, eye=UnitState("loaded", "inactive", "dead"))
    assert changes(manifest(), found) == [
        ("arm", "start", "failed: exit code 3"),
        ("eye", "start", "does not run"),
    ]


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"argv": (PYTHON, "other.py")}, "changed: command line"),
        ({"env": (("MODE", "x"),)}, "changed: MODE"),
        ({"limits": ResourceLimits(5)}, "changed: memory limit"),
        ({"watchdog_s": 3.0}, "changed: watchdog"),
    ],
)
def test_compare_restarts_changed_component(fields: dict[str, Any], reason: str) -> None:
    result = compare("robot", manifest(**fields), report(manifest()))
    [change] = result.components
    assert (change.component, change.verb) == ("arm", "restart")
    assert change.reason == reason
    assert result.written == ("robocomp-patrol-arm.service",)


def test_compare_restarts_process_of_an_interrupted_rollout() -> None:
    # The unit files are new already, the process is not.
    old = replace(RUNNING, revision="0123456789abcdef")
    result = compare("robot", manifest(), report(manifest(), arm=old))
    assert [(c.component, c.verb) for c in result.components] == [("arm", "restart")]
    assert not result.written


def test_compare_lists_changed_files() -> None:
    before, after = manifest(), manifest(env=(("A", "b"),))
    after = replace(after, trees={"arm-tree": {"arm/a.py": "2", "arm/c.py": "1"}, "eye-tree": {}})
    [change] = compare("robot", after, report(before)).components
    assert change.files == ("~ arm/a.py", "- arm/b.py", "+ arm/c.py")
    assert format_changes([compare("robot", after, report(before))])[1:] == [
        "    ~ arm/a.py",
        "    - arm/b.py",
        "    + arm/c.py",
    ]


def test_compare_stops_what_is_no_longer_described() -> None:
    result = compare("robot", None, report(manifest()))
    assert [(c.component, c.verb) for c in result.components] == [("arm", "stop"), ("eye", "stop")]
    assert len(result.removed) == 2
    assert result.as_dict()["components"][0]["reason"] == "no longer on this host"


def test_compare_rewrites_units_without_restart() -> None:
    described = manifest(restart=Restart("always"), start_timeout_s=9.0, after=("base",))
    result = compare("robot", described, report(manifest()))
    assert not result.components
    assert result.written == ("robocomp-patrol-arm.service",)
    assert format_changes([result]) == ["robot: 1 unit file differs, nothing restarts"]


def test_manifest_survives_json() -> None:
    numbered = manifest().numbered(3, 12.5, "me@here")
    assert HostManifest.from_json(numbered.to_json()).to_json() == numbered.to_json()
    for text in ("", "[]", "{}", '{"hosts": 3}'):
        with pytest.raises(InvalidManifest):
            HostManifest.from_json(text)
    broken = HostReport("1", (1,), "{", {}, {}, 0.0)
    assert stored_manifest(broken) is None


@pytest.mark.parametrize(
    ("properties", "state", "note"),
    [
        ({"ActiveState": "active", "SubState": "running"}, status.READY, ""),
        ({"ActiveState": "activating", "SubState": "start-post"}, status.STARTING, ""),
        (
            {
                "ActiveState": "activating",
                "SubState": "auto-restart",
                "Result": "signal",
                "ExecMainCode": "2",
                "ExecMainStatus": "9",
            },
            status.BACKOFF,
            "killed by SIGKILL",
        ),
        ({"ActiveState": "deactivating", "SubState": "stop-watchdog"}, status.HUNG, ""),
        ({"ActiveState": "deactivating", "SubState": "stop-sigterm"}, status.STOPPING, ""),
        (
            {"ActiveState": "failed", "Result": "start-limit-hit", "ExecMainStatus": "1"},
            status.FAILED,
            "failed too often: exit code 1",
        ),
        ({"ActiveState": "failed", "Result": "timeout"}, status.FAILED, "not ready in time"),
        (
            {"ActiveState": "failed", "Result": "exit-code", "ExecMainStatus": "203"},
            status.FAILED,
            "its program cannot be executed",
        ),
        ({"ActiveState": "inactive", "Job": "5"}, status.WAITING, ""),
        ({"ActiveState": "inactive", "Result": "success"}, status.EXITED, ""),
        (
            {"LoadState": "not-found", "ActiveState": "inactive"},
            status.EXITED,
            "its unit is missing",
        ),
    ],
)
def test_unit_state_in_words(properties: dict[str, str], state: str, note: str) -> None:
    found = UnitState.from_properties({"LoadState": "loaded", **properties}, 10.0)
    assert (found.state, found.note) == (state, note)


def test_unit_state_has_uptime() -> None:
    fields = {"ActiveState": "active", "ActiveEnterTimestampMonotonic": "4000000"}
    assert UnitState.from_properties(fields, 10.0).up_s == 6.0
