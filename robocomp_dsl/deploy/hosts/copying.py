"""Brings the trees of a deployment to its hosts, before anything that runs changes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts.connection import Upload
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.manifest import HostManifest
from robocomp_dsl.deploy.units import names


async def copy_trees(
    fleet: Fleet, described: Mapping[str, HostManifest], trees: Mapping[str, ContentTree]
) -> None:
    """Copy the trees that hosts lack."""
    by_hash = {tree.hash: tree for tree in trees.values()}

    async def copy(agent: HostAgent) -> None:
        manifest = described.get(agent.host.name)
        if manifest is None:
            return
        folder = f"{names.root_folder(manifest.deployment)}/trees"
        for tree in {component.tree for component in manifest.components}:
            exists = await agent.connection.run(["test", "-d", f"{folder}/{tree}"])
            if exists.code:
                new = f"{folder}/.{tree}.new"
                files = [
                    Upload(
                        Path(file.source), f"{new}/{file.path}", 0o755 if file.executable else 0o644
                    )
                    for file in by_hash[tree].files
                ]
                await agent.connection.run(["mkdir", "-p", new])
                await agent.connection.upload(files)
                await agent.connection.run(["mv", "-T", new, f"{folder}/{tree}"])

    await fleet.each(copy)
