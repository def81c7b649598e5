"""`rcdeploy logs` of a deployment over hosts. In: filters. Out: log lines of all hosts."""

from __future__ import annotations

import asyncio
import sys
from collections import deque
from collections.abc import Callable
from contextlib import aclosing

from robocomp_dsl.cli.program import EXIT_FINDINGS, EXIT_INTERRUPTED, CliError
from robocomp_dsl.deploy.hosts.errors import HostError
from robocomp_dsl.deploy.hosts.host_logs import (
    HostLogReader,
    LogRequest,
    follow_logs,
    read_past,
)
from robocomp_dsl.deploy.hosts.registry import HostedDeployment
from robocomp_dsl.deploy.log_filter import LogFilter
from robocomp_dsl.deploy.logs import LogRecord

Show = Callable[[LogRecord], object]


def print_logs(
    deployment: HostedDeployment,
    chosen: LogFilter,
    show: Show,
    *,
    last: int | None,
    follow: bool,
) -> None:
    """Print the stored records, and with `follow` what comes until Ctrl-C. Raises `CliError`."""
    is_plain = not (chosen.level or chosen.pattern)
    # Lines of a group are those of all its components.
    is_plain &= not deployment.members
    lines = last if last is not None and is_plain else -1
    request = LogRequest(chosen.components, chosen.since, lines, dict(deployment.members))
    readers = [HostLogReader(host, deployment.name, request) for host in deployment.hosts]
    unreachable: list[HostError] = []
    try:
        records = asyncio.run(read_past(readers, unreachable.append))
        matching = [record for record in records if chosen.matches(record)]
        for record in matching if last is None else deque(matching, last):
            show(record)
        for error in unreachable:
            print(f"{error.message}", file=sys.stderr)
        if follow:
            asyncio.run(_follow(readers, chosen, show))
    except KeyboardInterrupt:
        raise CliError(EXIT_INTERRUPTED) from None
    if unreachable and not follow:
        raise CliError(EXIT_FINDINGS)


async def _follow(readers: list[HostLogReader], chosen: LogFilter, show: Show) -> None:
    lost: set[str] = set()

    def on_error(error: HostError) -> None:
        if error.message not in lost:
            lost.add(error.message)
            print(f"{error.message}; connecting again", file=sys.stderr)

    async with aclosing(follow_logs(readers, on_error)) as records:
        async for record in records:
            lost.clear()
            if chosen.matches(record):
                show(record)
