"""Brings the keys of a deployment to its hosts, before anything that runs changes."""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.deploy.hosts.connection import Upload
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.host_network import PRIVATE, HostNetwork
from robocomp_dsl.deploy.units import names


async def copy_private_files(
    fleet: Fleet, deployment: str, networks: Mapping[str, HostNetwork]
) -> None:
    """Copy keys and network settings. Only the user of the host can read them."""

    async def copy(agent: HostAgent) -> None:
        if network := networks.get(agent.host.name):
            root = names.root_folder(deployment)
            folder = f"{root}/{PRIVATE}"
            await agent.connection.run(["mkdir", "-p", "-m", "700", folder])
            await agent.connection.run(["chmod", "700", folder])
            await agent.connection.upload(
                [
                    Upload(content, f"{root}/{path}", 0o600)
                    for path, content in network.files.items()
                ]
            )

    await fleet.each(copy)
