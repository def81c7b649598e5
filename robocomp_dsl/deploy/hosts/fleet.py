"""Connections to all hosts of a deployment at once.

In: hosts. Out: an agent for each host that answers in time, and the error of each that does not.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Iterable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import TypeVar

from robocomp_dsl.deploy.hosts.commands import CONNECT_SILENCE_S
from robocomp_dsl.deploy.hosts.connection import HostConnection, connect
from robocomp_dsl.deploy.hosts.errors import HostError, HostUnreachable
from robocomp_dsl.deploy.hosts.host_agent import HostAgent, open_agent
from robocomp_dsl.deploy.hosts.host_facts import HostFacts, fetch_facts
from robocomp_dsl.deploy.hosts.host_report import HostReport
from robocomp_dsl.model.deployment import Host

CLOSE_TIMEOUT_S = 2.0
Result = TypeVar("Result")


@dataclass(slots=True)
class Fleet:
    """The agents of hosts by name, and why others have none; `facts` if they were requested."""

    agents: dict[str, HostAgent] = field(default_factory=dict)
    facts: dict[str, HostFacts] = field(default_factory=dict)
    failures: dict[str, HostError] = field(default_factory=dict)

    async def each(self, action: Callable[[HostAgent], Awaitable[Result]]) -> dict[str, Result]:
        """`action` of all agents at the same time; a host that fails moves to `failures`."""
        names = list(self.agents)
        results = await asyncio.gather(
            *(action(self.agents[name]) for name in names), return_exceptions=True
        )
        found: dict[str, Result] = {}
        for name, result in zip(names, results, strict=True):
            if isinstance(result, HostError):
                self.failures[name] = result
            elif isinstance(result, BaseException):
                raise result
            else:
                found[name] = result
        return found

    async def reports(self, *, usage: bool = False) -> dict[str, HostReport]:
        """What is deployed on each host."""
        return await self.each(lambda agent: agent.report(usage=usage))


@asynccontextmanager
async def open_fleet(
    hosts: Iterable[Host],
    deployment: str,
    silence_s: float = CONNECT_SILENCE_S,
    *,
    with_facts: bool = False,
) -> AsyncIterator[Fleet]:
    """Connect to all hosts at the same time.

    A host that answers nothing for `silence_s` seconds has a failure instead of an agent.
    """
    fleet = Fleet()
    connections: list[HostConnection] = []

    async def open_host(host: Host) -> None:
        try:
            connection = await connect(host, silence_s)
            connections.append(connection)
            if with_facts:
                fleet.facts[host.name] = await fetch_facts(connection, deployment)
            async with asyncio.timeout(silence_s):
                fleet.agents[host.name] = await open_agent(connection, deployment)
        except HostError as error:
            fleet.failures[host.name] = error
        except TimeoutError:
            text = f"{host.name} ({host.address}): no answer within {silence_s:g} s"
            fleet.failures[host.name] = HostUnreachable(text)

    try:
        await asyncio.gather(*map(open_host, hosts))
        yield fleet
    finally:
        await asyncio.shield(_close(fleet, connections))


async def _close(fleet: Fleet, connections: list[HostConnection]) -> None:
    agents = (agent.close() for agent in fleet.agents.values())
    await asyncio.gather(*agents, return_exceptions=True)
    closing = (asyncio.wait_for(each.close(), CLOSE_TIMEOUT_S) for each in connections)
    await asyncio.gather(*closing, return_exceptions=True)
