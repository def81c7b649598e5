"""Lets a router read its settings again. In: the agent of its host. Out: it has done so.

Routers reload one after the other. When the router at the other end of a link closes within 0.25 s
after the link was made, zenoh 1.10 may never pass on what was declared behind it: measured, 8 of 13
times; none of 19 with 0.5 s between them.
"""

from __future__ import annotations

import asyncio

from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.host_agent import HostAgent
from robocomp_dsl.runtime.router.router_settings import NOT_RELOADED, RELOADED

RELOAD_TIMEOUT_S = 30.0
PERIOD_S = 0.1
SETTLE_S = 1.5
"""Others connect again within 0.5 s."""


async def reload_router(agent: HostAgent, unit: str, router: str) -> None:
    """Reload the unit of `router`, and wait until links are made again. Raises `HostError`."""
    before = await _last_reload(agent, router)
    await agent.systemctl("reload", [unit])
    try:
        async with asyncio.timeout(RELOAD_TIMEOUT_S):
            while await _last_reload(agent, router) == before:
                await asyncio.sleep(PERIOD_S)
    except TimeoutError:
        text = f"{agent.host.name}: the router has not read its settings"
        raise HostError(f"{text} within {RELOAD_TIMEOUT_S:g} s") from None
    await asyncio.sleep(SETTLE_S)


async def _last_reload(agent: HostAgent, router: str) -> str:
    """The log line of the latest reload, which contains its time; "" if there is none."""
    lines = (await agent.tail(router)).splitlines()
    found = (line for line in reversed(lines) if RELOADED in line or NOT_RELOADED in line)
    return next(found, "")
