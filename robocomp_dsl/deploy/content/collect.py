"""Deletes what no version of a deployment uses any more from a host."""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.deploy.content.host_session import HostSession
from robocomp_dsl.deploy.hosts.connection import HostConnection

KEPT_VERSIONS = 3


@dataclass(frozen=True, slots=True)
class GarbageResult:
    """What a collection freed; `outputs` are files of components in unused trees, which stay."""

    freed_bytes: int
    outputs: tuple[str, ...]


async def collect_garbage(
    connection: HostConnection, root: str, *, python: str = "python3", keep: int = KEPT_VERSIONS
) -> GarbageResult:
    """Delete what the newest `keep` versions (at least 3) and the current one do not use.

    A version is `versions/N.json` below `root`; it uses the trees and environments whose paths are
    in its text. `current` has the number of the current one. Raises `HostError`.
    """
    async with HostSession(connection, root, python) as session:
        answer = await session.call("collect_garbage", {"keep": keep})
    return GarbageResult(answer["freed_bytes"], tuple(answer["outputs"]))
