"""Compares what a host should have with what it has. Pure.

In: a manifest, and the report of the host. Out: which units change, and which components start,
stop and restart, each with its reason.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.hosts.host_report import HostReport, UnitState
from robocomp_dsl.deploy.hosts.manifest import HostManifest, InvalidManifest
from robocomp_dsl.deploy.units.service import find_revision, find_settings

START, RESTART, RELOAD, STOP = "start", "restart", "reload", "stop"
_LISTED_FILES = 5


@dataclass(frozen=True, slots=True)
class ComponentChange:
    """A component that starts, restarts or stops. `files` are those that differ, as in a diff."""

    component: str
    host: str
    verb: str
    reason: str
    files: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


@dataclass(frozen=True, slots=True)
class HostChanges:
    """What changes on one host. `written` and `removed` are names of unit files."""

    host: str
    components: tuple[ComponentChange, ...] = ()
    written: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "host": self.host,
            "components": [change.as_dict() for change in self.components],
            "written": list(self.written),
            "removed": list(self.removed),
        }

    def __bool__(self) -> bool:
        return bool(self.components or self.written or self.removed)


def stored_manifest(report: HostReport) -> HostManifest | None:
    """The version in force on a host; None if there is none."""
    if not report.manifest:
        return None
    try:
        return HostManifest.from_json(report.manifest)
    except InvalidManifest:
        return None


def compare(host: str, described: HostManifest | None, report: HostReport) -> HostChanges:
    """The changes that make `host` as described; None: nothing of the deployment stays there."""
    units = described.units if described else {}
    stored = stored_manifest(report)
    written = tuple(name for name, text in units.items() if report.units.get(name) != text)
    removed = tuple(name for name in report.units if name not in units)
    changes: list[ComponentChange] = []
    if described:
        changes += _component_changes(described, stored, report)
    gone = {c.unit: c.name for c in (stored.components if stored else ()) if c.unit in removed}
    for unit in removed:
        state = report.states.get(unit)
        if unit.endswith(".service") and state and (unit in gone or state.is_active):
            name = gone.get(unit, unit)
            changes.append(ComponentChange(name, host, STOP, "no longer on this host"))
    return HostChanges(host, tuple(changes), written, removed)


def _component_changes(
    described: HostManifest, stored: HostManifest | None, report: HostReport
) -> Iterator[ComponentChange]:
    for component in described.components:
        name, unit = component.name, component.unit
        if change := _change(unit, described.units, report, report.states.get(unit)):
            verb, reason = change
            files = _changed_files(name, stored, described) if verb == RESTART else ()
            yield ComponentChange(name, described.host, verb, reason, files)


def _change(
    unit: str, units: Mapping[str, str], report: HostReport, state: UnitState | None
) -> tuple[str, str] | None:
    """The verb and the reason; None if the component runs as described."""
    if unit not in report.units:
        return START, "is new on this host"
    if state is None or not state.is_active:
        note = state.note if state else ""
        reason = f"{state.state}: {note}" if state and note else "does not run"
        return START, reason
    described = find_revision(units[unit])
    running = state.revision or find_revision(report.units[unit])
    if running != described:
        return RESTART, _reason(report.units[unit], units[unit])
    if (settings := find_settings(units[unit])) and (
        settings != find_settings(report.units[unit])
        or not settings.startswith(f"{report.router}-")
    ):
        return RELOAD, "changed: access rules, addresses or certificate"
    if state.state == status.BACKOFF:
        return RESTART, f"restarting: {state.note}" if state.note else "restarting"
    return None


def _reason(old: str, new: str) -> str:
    """What differs between two texts of a unit."""
    before, after = _settings(old), _settings(new)
    parts = {
        "Tree": "files",
        "Environment": "Python packages",
        "Certificate": "network settings or certificate",
    }
    identity = [
        text
        for key, text in parts.items()
        if before.get(("X-RoboComp", key)) != after.get(("X-RoboComp", key))
    ]
    # The paths of the tree and of Python follow from them.
    hidden = {"ExecStart", "WorkingDirectory", "ExecStartPost"} if identity else set()
    keys = {
        key
        for section, key in before.keys() | after.keys()
        if section == "Service"
        and key not in hidden
        and key not in _NOT_SHOWN
        and before.get((section, key)) != after.get((section, key))
    }
    texts = [*identity, *sorted(_NAMES.get(key, key) for key in keys)]
    return f"changed: {', '.join(texts)}" if texts else "runs an earlier version"


_NOT_SHOWN = {"ROBOCOMP_UNIT", "WatchdogSignal", "MemorySwapMax", "CPUSchedulingPolicy"}
_NAMES = {
    "ExecStart": "command line",
    "Type": "readiness",
    "ExecStartPost": "readiness",
    "WatchdogSec": "watchdog",
    "MemoryMax": "memory limit",
    "CPUQuota": "CPU limit",
    "CPUAffinity": "cores",
    "CPUSchedulingPriority": "real-time priority",
}


def _settings(text: str) -> dict[tuple[str, str], str]:
    """The settings of a unit by section and key; environment variables by their names."""
    section, found = "", {}
    for line in text.splitlines():
        if line.startswith("["):
            section = line.strip("[]")
        elif "=" in line:
            key, value = line.split("=", 1)
            if key == "Environment" and section == "Service":
                key, _, value = value.strip('"').partition("=")
            found[section, key] = value
    return found


def _changed_files(
    component: str, stored: HostManifest | None, described: HostManifest
) -> tuple[str, ...]:
    """The files of a component that differ: `+ new`, `- removed`, `~ changed`."""
    old = _files(component, stored) if stored else {}
    new = _files(component, described)
    lines = [
        f"{'+' if path not in old else '-' if path not in new else '~'} {path}"
        for path in sorted(old.keys() | new.keys())
        if old.get(path) != new.get(path)
    ]
    return tuple(lines)


def _files(component: str, manifest: HostManifest) -> Mapping[str, str]:
    tree = next((c.tree for c in manifest.components if c.name == component), "")
    return manifest.trees.get(tree, {})


def format_changes(all_changes: Iterable[HostChanges]) -> list[str]:
    """Text lines, by host."""
    lines = []
    for changes in all_changes:
        for change in changes.components:
            lines.append(f"{change.host}: {change.verb} {change.component} ({change.reason})")
            lines += [f"    {file}" for file in change.files[:_LISTED_FILES]]
            if (more := len(change.files) - _LISTED_FILES) > 0:
                lines.append(f"    … and {more} more")
        units = [*changes.written, *changes.removed]
        if units and not changes.components:
            files = "unit file differs" if len(units) == 1 else "unit files differ"
            lines.append(f"{changes.host}: {len(units)} {files}, nothing restarts")
    return lines
