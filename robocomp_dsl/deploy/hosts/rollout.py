"""Makes the hosts of a deployment as described: lock, copy, units, stop, start.

In: an open fleet, and what each host should have. Out: lines of text, and what failed. Everything
is copied before anything that runs changes. The hosts hold the truth: a rollout that was killed is
completed by the next.
"""

from __future__ import annotations

import getpass
import socket
import time
from collections.abc import Awaitable, Callable, Iterable, Mapping
from dataclasses import dataclass, field

from robocomp_dsl.deploy.hosts import codes
from robocomp_dsl.deploy.hosts.connection import Upload
from robocomp_dsl.deploy.hosts.differences import (
    RELOAD,
    RESTART,
    START,
    STOP,
    HostChanges,
    compare,
    stored_manifest,
)
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_report import HostReport
from robocomp_dsl.deploy.hosts.manifest import HostedComponent, HostManifest
from robocomp_dsl.deploy.hosts.router_reload import reload_router
from robocomp_dsl.deploy.hosts.unit_runner import UnitRunner
from robocomp_dsl.deploy.units import names

Report = Callable[[str], object]
Copy = Callable[[Fleet], Awaitable[None]]


@dataclass(slots=True)
class RolloutResult:
    """What a rollout did; `failed` maps components to reasons. `version` 0: nothing is deployed."""

    version: int
    changes: list[HostChanges]
    failed: dict[str, str] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """The number of components that were started, restarted or stopped."""
        return sum(len(changes.components) for changes in self.changes)


def describe_author() -> str:
    """The user and the machine of this deployer."""
    try:
        user = getpass.getuser()
    except (KeyError, OSError):
        user = "unknown"
    return f"{user}@{socket.gethostname()}"


async def lock_hosts(fleet: Fleet, *, may_fail: bool = False) -> None:
    """Lock the deployment on all hosts. Raises `HostError` if another deployer holds a lock.

    With `may_fail`, hosts may be out of reach.
    """
    since = time.strftime("%Y-%m-%d %H:%M:%S")
    holders = await fleet.each(lambda agent: agent.lock(f"{describe_author()} since {since}"))
    if not may_fail:
        raise_failures(fleet)
    for host, holder in holders.items():
        if holder:
            raise HostError(
                f"{host}: another rcdeploy changes this deployment: {holder}",
                "wait until it has ended",
                codes.BUSY,
            )


def raise_failures(fleet: Fleet) -> None:
    """Raise the error of a host that has failed."""
    for failure in fleet.failures.values():
        raise failure


def all_changes(
    described: Mapping[str, HostManifest], reports: Mapping[str, HostReport]
) -> list[HostChanges]:
    """The changes on all hosts that have something of the deployment."""
    changes = [compare(host, described.get(host), report) for host, report in reports.items()]
    return [each for each in changes if each]


async def roll_out(
    fleet: Fleet,
    described: Mapping[str, HostManifest],
    copy: Copy,
    report: Report,
    *,
    version: int = 0,
    is_complete: bool = True,
) -> RolloutResult:
    """Make the hosts as described; the caller holds the locks. Raises `HostError`.

    `version` is the number of a stored version; 0: a new one. `is_complete`: no host lacks a file.
    """
    reports = await fleet.reports()
    raise_failures(fleet)
    changes = all_changes(described, reports)
    current = max((int(r.current) for r in reports.values() if r.current.isdecimal()), default=0)
    if not changes and is_complete and (not version or version == current):
        return RolloutResult(current, [])
    await copy(fleet)
    raise_failures(fleet)
    if not version:
        # A start of what is deployed already is no new version.
        is_new = any(each.written or each.removed for each in changes)
        stored = (number for host in reports.values() for number in host.versions)
        version = max(stored, default=0) + 1 if is_new else current
        described = {
            host: manifest.numbered(version, time.time(), describe_author())
            for host, manifest in described.items()
        }
    await _write(fleet, described, version)
    result = RolloutResult(version, changes)
    await _stop_removed(fleet, reports, changes, report)
    await _remove(fleet, described, changes)
    await _start(fleet, described, result, report)
    return result


async def _write(fleet: Fleet, described: Mapping[str, HostManifest], version: int) -> None:
    """Store the version on its hosts, and write the units; nothing that runs changes."""

    async def write(agent: HostAgent) -> None:
        manifest = described.get(agent.host.name)
        if manifest is None:
            return
        root = names.root_folder(manifest.deployment)
        await agent.create_folders([component.name for component in manifest.components])
        await agent.connection.upload(
            [
                Upload(manifest.to_json().encode(), f"{root}/versions/{version}.json"),
                *(
                    Upload(text.encode(), f"{names.UNITS}/{unit}")
                    for unit, text in manifest.units.items()
                ),
            ]
        )
        await agent.connection.write(f"{root}/current", f"{version}\n".encode())
        await agent.systemctl("daemon-reload", [])

    await fleet.each(write)
    raise_failures(fleet)


async def _stop_removed(
    fleet: Fleet,
    reports: Mapping[str, HostReport],
    changes: Iterable[HostChanges],
    report: Report,
) -> None:
    """Stop what the description no longer has on a host."""
    removed: list[HostedComponent] = []
    for each in changes:
        stored = stored_manifest(reports[each.host])
        known = {c.name: c for c in stored.components} if stored else {}
        for change in each.components:
            if change.verb == STOP:
                unknown = HostedComponent(change.component, each.host, change.component)
                removed.append(known.get(change.component, unknown))
    while removed:
        # The same name on two hosts: one after the other.
        group = {component.name: component for component in removed}
        runner = UnitRunner(fleet.agents, group, report)
        await runner.watch()
        await runner.stop(list(group))
        removed = [c for c in removed if group[c.name] is not c]


async def _remove(
    fleet: Fleet, described: Mapping[str, HostManifest], changes: Iterable[HostChanges]
) -> None:
    """Delete unit files that the description no longer has."""
    removed = {each.host: each.removed for each in changes if each.removed}

    async def remove(agent: HostAgent) -> None:
        if units := removed.get(agent.host.name):
            others = [unit for unit in units if not unit.endswith(".service")]
            if agent.host.name not in described:
                await agent.systemctl("disable", [u for u in others if u.endswith(".target")])
            await agent.systemctl("stop", others)
            await agent.remove_units(units)
            await agent.systemctl("daemon-reload", [])

    await fleet.each(remove)
    raise_failures(fleet)


async def _start(
    fleet: Fleet, described: Mapping[str, HostManifest], result: RolloutResult, report: Report
) -> None:
    components = {c.name: c for manifest in described.values() for c in manifest.components}
    verbs = {
        change.component: change.verb
        for each in result.changes
        for change in each.components
        if change.verb in (START, RESTART)
    }
    runner = UnitRunner(fleet.agents, components, report)
    await start_helpers(fleet, described, result.changes)
    await _reload(fleet, described, result.changes, report)
    await runner.watch()
    ordered = [name for name in components if name in verbs]
    await runner.start(ordered, {name for name, verb in verbs.items() if verb == RESTART})
    result.failed.update(runner.failed)
    await enable(fleet, described)


async def _reload(
    fleet: Fleet,
    described: Mapping[str, HostManifest],
    changes: Iterable[HostChanges],
    report: Report,
) -> None:
    """Let routers read their settings again, before components need them."""
    for each in changes:
        deployed = described[each.host].components if each.host in described else ()
        units = {component.name: component.unit for component in deployed}
        for change in each.components:
            if change.verb == RELOAD:
                agent, router = fleet.agents[each.host], change.component
                await reload_router(agent, units[router], router)
                report(f"{change.component} ({each.host}): reloaded")


async def start_helpers(
    fleet: Fleet, described: Mapping[str, HostManifest], changes: Iterable[HostChanges] = ()
) -> None:
    """Start the units that are no components, such as the timer of the logs."""
    written = {each.host: each.written for each in changes}

    async def start(agent: HostAgent) -> None:
        if manifest := described.get(agent.host.name):
            own = {component.unit for component in manifest.components}
            target = names.target_name(manifest.deployment)
            once = names.log_trim_name(manifest.deployment, "service")
            helpers = [u for u in manifest.units if u not in own and u not in (target, once)]
            again = [unit for unit in helpers if unit in written.get(agent.host.name, ())]
            await agent.systemctl("restart", again)
            await agent.systemctl("start", [unit for unit in helpers if unit not in again])

    await fleet.each(start)
    raise_failures(fleet)


async def enable(fleet: Fleet, described: Mapping[str, HostManifest]) -> None:
    """Let the hosts start the deployment when they boot."""

    async def enable_target(agent: HostAgent) -> None:
        if manifest := described.get(agent.host.name):
            await agent.systemctl("enable", [names.target_name(manifest.deployment)])

    await fleet.each(enable_target)
    raise_failures(fleet)
