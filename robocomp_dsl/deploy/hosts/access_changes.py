"""Lets the routers of a running deployment pass one more connection.

In: the entry of a deployment over hosts, and a connection. Out: the settings of all its routers
have the access rules for it, and the routers have read them. The connections that were granted so
are listed on each host; the next `rcdeploy up` that writes the settings grants described ones only.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.check.passes import check_ddsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.deploy.engine import EngineError
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import open_fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_engine import run_async
from robocomp_dsl.deploy.hosts.host_network import PRIVATE
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.hosts.rollout import raise_failures
from robocomp_dsl.deploy.hosts.router_reload import reload_router
from robocomp_dsl.deploy.network.access_rules import access_rules
from robocomp_dsl.deploy.network.identities import router_name
from robocomp_dsl.deploy.network.port_uses import AddedConnection
from robocomp_dsl.deploy.placement.placed_deployment import with_hosts
from robocomp_dsl.deploy.units import names
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.deployment import THIS_MACHINE, UNPLACED, Deployment, Host

GRANTED = "granted.json"
"""The connections that were granted at run time, beside the settings of the router."""
_SETTINGS = re.compile(r"router-[0-9a-f]+\.json")


class CannotGrant(Exception):
    """The routers cannot be changed; the message says why. Nothing is connected."""


def grant(entry: HostedDeployment, connection: AddedConnection) -> bool:
    """Let all routers pass `connection`; whether anything had to change. Raises `CannotGrant`."""
    deployment = _deployment(entry)
    if access_rules(deployment, entry.domain) == access_rules(
        deployment, entry.domain, [connection]
    ):
        return False
    try:
        return run_async(_grant(entry, deployment, connection))
    except EngineError as error:
        raise CannotGrant(f"the routers do not pass the connection: {error}") from None


def _deployment(entry: HostedDeployment) -> Deployment:
    """The deployment in the file, with the hosts on which its components run."""
    report = Report()
    path = Path(entry.path)
    deployment = check_ddsl(path, Workspace(), report) if path.is_file() else None
    if deployment is None or report.has_errors:
        raise CannotGrant(
            f"the routers of `{entry.name}` pass described connections only; to add one, rcdeploy"
            f" needs the deployment: {entry.path} "
            + ("has errors" if path.is_file() else "does not exist here")
        )
    members = dict(entry.members)
    places = {
        name: host
        for process, host in entry.places
        for name in (process, *members.get(process, ()))
    }
    hosts = {host.name: host for host in (Host(THIS_MACHINE, THIS_MACHINE), *deployment.hosts)}
    return with_hosts(
        deployment,
        {
            instance.name: hosts[places[instance.full_name]]
            for instance in deployment.instances
            if instance.host is UNPLACED and places.get(instance.full_name) in hosts
        },
    )


@dataclass(frozen=True, slots=True)
class _RouterFile:
    """The settings that a router uses, and the connections that were granted in them before."""

    path: str
    data: dict[str, Any]
    granted: tuple[AddedConnection, ...]


async def _grant(
    entry: HostedDeployment, deployment: Deployment, connection: AddedConnection
) -> bool:
    """Change the settings of all routers; only if all of them can be read."""
    described = access_rules(deployment, entry.domain).to_zenoh()
    async with open_fleet(entry.hosts, entry.name) as fleet:
        raise_failures(fleet)
        files = await fleet.each(lambda agent: _read(agent, entry.name))
        raise_failures(fleet)
        # Where the described rules are in force, `up` has been run since.
        before = (f.granted for f in files.values() if f.data["access"] != described)
        granted = list(dict.fromkeys(each for some in before for each in some))
        granted += [connection] if connection not in granted else []
        access = access_rules(deployment, entry.domain, granted).to_zenoh()
        if all(file.data["access"] == access for file in files.values()):
            return False
        listed = [[g.source, g.source_port, g.target, g.target_port] for g in granted]

        async def write(agent: HostAgent) -> None:
            file = files[agent.host.name]
            await _write_json(agent, f"{_private(entry.name)}/{GRANTED}", listed)
            await _write_json(agent, file.path, {**file.data, "access": access})

        await fleet.each(write)
        raise_failures(fleet)
        for agent in fleet.agents.values():
            # It copies the settings of its version to the file that the router reads.
            unit = names.router_name(entry.name)
            await reload_router(agent, unit, router_name(agent.host))
    return True


async def _read(agent: HostAgent, deployment: str) -> _RouterFile:
    """The settings that the router of a host uses."""
    report = await agent.report()
    match = _SETTINGS.search(report.units.get(names.router_name(deployment), ""))
    if match is None:
        raise HostError(f"{agent.host.name}: no router of `{deployment}` is deployed there")
    path = f"{_private(deployment)}/{match[0]}"
    content = await agent.connection.read(path)
    listed = await agent.connection.read(f"{_private(deployment)}/{GRANTED}")
    try:
        granted = tuple(AddedConnection(*map(str, each)) for each in json.loads(listed or b"[]"))
        data = dict(json.loads(content or b""))
        return _RouterFile(path, {**data, "access": data["access"]}, granted)
    except (ValueError, TypeError, KeyError):
        text = f"{agent.host.name}: {path} is missing or damaged"
        raise HostError(text, "run `rcdeploy up` again") from None


async def _write_json(agent: HostAgent, path: str, data: object) -> None:
    await agent.connection.write(path, f"{json.dumps(data, indent=1)}\n".encode(), 0o600)


def _private(deployment: str) -> str:
    return f"{names.root_folder(deployment)}/{PRIVATE}"
