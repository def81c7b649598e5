"""Brings the trees of a deployment to its hosts, before anything that runs changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from robocomp_dsl.deploy.content.transfer import upload_trees
from robocomp_dsl.deploy.content.tree import ContentTree
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.deploy.hosts.manifest import HostManifest
from robocomp_dsl.deploy.units import names


async def copy_trees(
    fleet: Fleet,
    described: Mapping[str, HostManifest],
    trees: Mapping[str, ContentTree],
    say: Callable[[str], object],
) -> None:
    """Copy the files that hosts lack. A host that fails is in `fleet.failures`."""

    async def copy(agent: HostAgent) -> None:
        manifest = described.get(agent.host.name)
        if manifest is not None:
            here = {c.tree: trees[c.name] for c in manifest.components}
            root = names.root_folder(manifest.deployment)
            result = await upload_trees(agent.connection, root, list(here.values()))
            if result.files:
                size = f"{result.bytes / 1e6:.1f} MB"
                say(f"{agent.host.name}: copied {result.files} files, {size}")

    await fleet.each(copy)
