"""The engine of several hosts: systemd on each of them, asked over short connections.

In: a registered deployment. Out: see `Engine`. Nothing of rcdeploy stays running; every method
connects, and what a host does not answer is shown as such.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Collection, Coroutine, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.engine import DeploymentStatus, EngineError, StopResult
from robocomp_dsl.deploy.hosts import registry
from robocomp_dsl.deploy.hosts.commands import CONNECT_SILENCE_S
from robocomp_dsl.deploy.hosts.denials import latest_denials
from robocomp_dsl.deploy.hosts.description import all_components
from robocomp_dsl.deploy.hosts.differences import stored_manifest
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import Fleet, open_fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_report import UnitState
from robocomp_dsl.deploy.hosts.host_rows import host_rows
from robocomp_dsl.deploy.hosts.last_lines import fetch_last_lines, show_last_lines
from robocomp_dsl.deploy.hosts.manifest import HostedComponent, HostManifest, host_as_dict
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.hosts.rollout import (
    RolloutResult,
    enable,
    lock_hosts,
    raise_failures,
    roll_out,
    start_helpers,
)
from robocomp_dsl.deploy.hosts.stored_versions import (
    StoredVersion,
    check_trees,
    fetch_version,
    list_versions,
)
from robocomp_dsl.deploy.hosts.unit_runner import UnitRunner, with_requirements
from robocomp_dsl.deploy.selection import NoSuchComponent, select_names
from robocomp_dsl.deploy.status import ProcessStatus, format_duration
from robocomp_dsl.deploy.units import names as unit_names

STATUS_SILENCE_S = 5.0
"""A host that answers nothing for so long is shown as unreachable."""
Result = TypeVar("Result")
Report = Callable[[str], object]


class HostEngine:
    """A deployment over hosts. See `Engine`."""

    def __init__(self, deployment: HostedDeployment) -> None:
        self.deployment = deployment
        self.name, self.path, self.domain = deployment.name, deployment.path, deployment.domain

    def summary(self) -> str:
        """See `Engine`."""
        listed = ", ".join(host.name for host in self.deployment.hosts)
        since = self.deployment.since
        age = f", deployed {format_duration(time.time() - since)} ago" if since else ""
        return f"on {listed}, domain {self.domain}{age}"

    def as_dict(self) -> dict[str, Any]:
        """See `Engine`."""
        return {
            "name": self.name,
            "path": self.path,
            "domain": self.domain,
            "hosts": [host_as_dict(host) for host in self.deployment.hosts],
            "since": self.deployment.since,
        }

    def components(self) -> list[str]:
        """See `Engine`."""
        members = dict(self.deployment.members)
        return [
            each for name, _ in self.deployment.places for each in (name, *members.get(name, ()))
        ]

    def answering_components(self) -> list[str]:
        """See `Engine`."""
        members = dict(self.deployment.members)
        return [
            each
            for name, _ in self.deployment.places
            if name not in self.deployment.programs
            for each in members.get(name, (name,))
        ]

    def status(self) -> DeploymentStatus:
        """See `Engine`."""
        return run_async(self._status())

    async def _status(self) -> DeploymentStatus:
        async with self._fleet(STATUS_SILENCE_S) as fleet:
            reports = await fleet.reports(usage=True)
            denials = await latest_denials(fleet, reports)
            rows = [row for report in reports.values() for row in host_rows(report)]
            last_lines = await fetch_last_lines(fleet, rows)
        order = {name: i for i, name in enumerate(self.components())}
        rows = [replace(row, note=row.note or denials.get(row.name, "")) for row in rows]
        for host in fleet.failures:
            rows += [
                ProcessStatus(name, status.UNKNOWN, note="its host does not answer", host=host)
                for name, place in self.deployment.places
                if place == host
            ]
        rows.sort(key=lambda row: order.get(row.name, len(order)))
        problems = [_describe_failure(error) for error in fleet.failures.values()]
        return DeploymentStatus(rows, problems=problems, last_lines=last_lines)

    def change(self, verb: str, names: Sequence[str], report: Report) -> int:
        """See `Engine`."""
        return run_async(self._change(verb, names, report))

    async def _change(self, verb: str, names: Sequence[str], report: Report) -> int:
        async with self._fleet() as fleet:
            manifests, states = await self._deployed(fleet)
            components = {c.name: c for m in manifests.values() for c in m.components}
            try:
                selected = select_names(names, [*components.values()]) if names else None
            except NoSuchComponent as error:
                raise EngineError(str(error)) from None
            chosen = list(components) if selected is None else selected
            self._require_hosts(fleet, (components[name].host for name in chosen))
            running = {name for name, state in states.items() if state.is_active}
            if verb == "stop":
                return await self._stop(fleet, components, chosen, running, report)
            started = chosen if verb == "restart" else [n for n in chosen if n not in running]
            for name in chosen if verb == "start" and names else ():
                if name in running:
                    report(f"{name}: is already running")
            started = with_requirements(started, components, running)
            await start_helpers(fleet, manifests)
            runner = UnitRunner(fleet.agents, components, report)
            await runner.watch()
            again = [name for name in started if name in running]
            await runner.stop(again, quiet=True)
            succeeded = await runner.start(started)
            for name in runner.failed:
                await show_last_lines(fleet, components[name], report)
            if not names:
                await enable(fleet, manifests)
                self._register(is_stopped=False)
            return 0 if succeeded else 1

    async def _stop(
        self,
        fleet: Fleet,
        components: Mapping[str, HostedComponent],
        chosen: Sequence[str],
        running: Collection[str],
        report: Report,
    ) -> int:
        runner = UnitRunner(fleet.agents, components, report)
        await runner.watch()
        for name in chosen:
            if name not in running:
                report(f"{name}: was not running")
        succeeded = await runner.stop([name for name in chosen if name in running])
        users = [
            c.name
            for c in components.values()
            if c.name not in chosen and c.name in running and set(c.after) & set(chosen)
        ]
        if users:
            report(f"still running without it: {', '.join(users)}")
        return 0 if succeeded else 1

    def stop(self, report: Report) -> StopResult:
        """See `Engine`."""
        return run_async(self._stop_all(report))

    async def _stop_all(self, report: Report) -> StopResult:
        async with self._fleet() as fleet:
            manifests, states = await self._deployed(fleet)
            components = {c.name: c for m in manifests.values() for c in m.components}
            running = [name for name in components if name in states and states[name].is_active]
            # What is stopped stays so when the host boots.
            await fleet.each(self._disable)
            runner = UnitRunner(fleet.agents, components, report)
            await runner.watch()
            succeeded = await runner.stop(running)
            await fleet.each(self._stop_helpers)
            failures = [_describe_failure(error) for error in fleet.failures.values()]
        for text in failures:
            report(text)
        self._register(is_stopped=not failures)
        if failures:
            return StopResult(1, "stopped, except on the hosts that do not answer")
        return StopResult(0 if succeeded else 1, "stopped")

    async def _disable(self, agent: HostAgent) -> None:
        await agent.systemctl("disable", [unit_names.target_name(self.name)])

    async def _stop_helpers(self, agent: HostAgent) -> None:
        report = await agent.report()
        await agent.systemctl("stop", list(report.units))

    def versions(self) -> list[StoredVersion]:
        """The stored versions, oldest first. Raises `EngineError`."""
        return run_async(self._versions())

    async def _versions(self) -> list[StoredVersion]:
        async with self._fleet() as fleet:
            reports = await fleet.reports()
            raise_failures(fleet)
            return await list_versions(fleet, self.name, reports)

    def roll_back(self, version: int, report: Report) -> RolloutResult:
        """Run another stored version; 0: the one before. Raises `EngineError`."""
        return run_async(self._roll_back(version, report))

    async def _roll_back(self, version: int, report: Report) -> RolloutResult:
        async with self._fleet() as fleet:
            await lock_hosts(fleet)
            reports = await fleet.reports()
            raise_failures(fleet)
            stored = {number for each in reports.values() for number in each.versions}
            current = max((int(r.current or 0) for r in reports.values()), default=0)
            version = version or max((n for n in stored if n < current), default=0)
            if version not in stored:
                known = ", ".join(map(str, sorted(stored))) or "none"
                what = f"version {version}" if version else "no version before the current one"
                raise EngineError(f"`{self.name}` has {what}; stored: {known}")
            described = await fetch_version(fleet, self.name, version)
            await check_trees(fleet, described)
            result = await roll_out(fleet, described, _copy_nothing, report, version=version)
            for name in result.failed:
                component = all_components(described.values())[name]
                await show_last_lines(fleet, component, report)
        return result

    def _fleet(self, silence_s: float = CONNECT_SILENCE_S) -> Any:
        return open_fleet(self.deployment.hosts, self.name, silence_s)

    async def _deployed(self, fleet: Fleet) -> tuple[dict[str, HostManifest], dict[str, UnitState]]:
        """What is deployed on the hosts that answer, and the states of components; locks them."""
        await lock_hosts(fleet, may_fail=True)
        reports = await fleet.reports()
        if not reports:
            raise_failures(fleet)
        manifests = {h: m for h, r in reports.items() if (m := stored_manifest(r))}
        if not manifests:
            raise EngineError(f"`{self.name}` is not deployed on {', '.join(reports)}")
        states = {
            component.name: reports[host].states[component.unit]
            for host, manifest in manifests.items()
            for component in manifest.components
            if component.unit in reports[host].states
        }
        return manifests, states

    def _require_hosts(self, fleet: Fleet, hosts: Iterable[str]) -> None:
        """Raise the error of the first host that is needed and does not answer."""
        for host in hosts:
            if host in fleet.failures:
                raise fleet.failures[host]

    def _register(self, *, is_stopped: bool) -> None:
        self.deployment = replace(self.deployment, is_stopped=is_stopped)
        registry.register(self.deployment)


async def _copy_nothing(fleet: Fleet) -> None:
    """A stored version has its files on the hosts."""


def run_async(work: Coroutine[Any, Any, Result]) -> Result:
    """Run `work`; errors of hosts become `EngineError`."""
    try:
        return asyncio.run(work)
    except HostError as error:
        raise EngineError(_describe_failure(error)) from None


def _describe_failure(error: HostError) -> str:
    return f"{error.message}; {error.help}" if error.help else error.message
