"""Versions that are stored on hosts. In: a number. Out: manifests whose files still exist."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from robocomp_dsl.deploy.hosts import codes
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_report import HostReport
from robocomp_dsl.deploy.hosts.manifest import HostManifest, InvalidManifest
from robocomp_dsl.deploy.hosts.rollout import raise_failures
from robocomp_dsl.deploy.units import names


@dataclass(frozen=True, slots=True)
class StoredVersion:
    """A version that can be rolled back to. `created` in s since 1970."""

    version: int
    created: float
    author: str
    hosts: tuple[str, ...]
    is_current: bool


async def list_versions(
    fleet: Fleet, deployment: str, reports: Mapping[str, HostReport]
) -> list[StoredVersion]:
    """All versions that some host has, oldest first."""
    numbers = sorted({number for report in reports.values() for number in report.versions})
    current = {report.current for report in reports.values()}
    found = []
    for number in numbers:
        manifests = await fetch_version(fleet, deployment, number)
        if manifests:
            first = next(iter(manifests.values()))
            hosts = tuple(manifests)
            is_current = str(number) in current
            found.append(StoredVersion(number, first.created, first.author, hosts, is_current))
    return found


async def fetch_version(fleet: Fleet, deployment: str, version: int) -> dict[str, HostManifest]:
    """The manifests of a version, by host; a host without it had no component then."""
    path = f"{names.root_folder(deployment)}/versions/{version}.json"

    async def fetch(agent: HostAgent) -> HostManifest | None:
        text = await agent.connection.read(path)
        if text is None:
            return None
        try:
            return HostManifest.from_json(text.decode("utf-8", "replace"))
        except InvalidManifest as error:
            raise HostError(f"{agent.host.name}: {path}: {error}") from None

    found = await fleet.each(fetch)
    raise_failures(fleet)
    return {host: manifest for host, manifest in found.items() if manifest is not None}


async def check_trees(fleet: Fleet, described: Mapping[str, HostManifest]) -> None:
    """Check that the files of the components are still there. Raises `HostError`."""

    async def check(agent: HostAgent) -> None:
        manifest = described.get(agent.host.name)
        if manifest is None:
            return
        for component in (c for c in manifest.components if c.tree):
            tree = f"{names.root_folder(manifest.deployment)}/trees/{component.tree}"
            if (await agent.connection.run(["test", "-d", tree])).code:
                raise HostError(
                    f"{agent.host.name}: the files of `{component.name}` in version "
                    f"{manifest.version} were deleted",
                    "deploy that version again from its description: rcdeploy up",
                    codes.DISK,
                )

    await fleet.each(check)
    raise_failures(fleet)
