"""The last log lines of components that failed. In: agents of hosts. Out: lines of text."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Iterable

from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.fleet import Fleet
from robocomp_dsl.deploy.hosts.manifest import HostedComponent
from robocomp_dsl.deploy.status import ProcessStatus

COUNT = 10
STATUS_COUNT = 5
"""Lines of each component below the table of `rcdeploy status`."""


async def fetch_last_lines(fleet: Fleet, rows: Iterable[ProcessStatus]) -> dict[str, list[str]]:
    """The last log lines of the components that have failed, by name."""
    failed = [row for row in rows if row.state == status.FAILED]
    found = await asyncio.gather(
        *(_last_lines(fleet, row.name, row.host, STATUS_COUNT) for row in failed)
    )
    return {row.name: lines for row, lines in zip(failed, found, strict=True) if lines}


async def show_last_lines(
    fleet: Fleet, component: HostedComponent, report: Callable[[str], object]
) -> None:
    """Report the last log lines of a component that failed."""
    for line in await _last_lines(fleet, component.name, component.host, COUNT):
        report(f"    {line}")


async def _last_lines(fleet: Fleet, name: str, host: str, count: int) -> list[str]:
    """The last lines of a log; none if its host does not answer."""
    from robocomp_dsl.deploy.hosts.log_records import FileRecords  # noqa: PLC0415 - for failures
    from robocomp_dsl.deploy.logs import format_record  # noqa: PLC0415

    agent = fleet.agents.get(host)
    if agent is None:
        return []
    try:
        text = await agent.tail(name)
    except HostError:
        return []
    records = FileRecords(name, host).feed(text.encode(), time.time())
    return [format_record(record, len(name), colours=False) for record in records[-count:]]
