"""`rcdeploy stats`: counts, times and losses. In: components. Out: a table or JSON."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import click

from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_components
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    InspectCommand,
    open_client,
    resolve_domain,
)

HEADS = ("OPERATION", "CALLS", "FAILED", "IN", "OUT", "LOST", "BAD", "LATE", "P50", "P99", "MAX")


@click.command(cls=InspectCommand)
@click.argument(
    "components", nargs=-1, metavar="[COMPONENT]...", shell_complete=complete_components
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def command(
    components: tuple[str, ...], *, as_json: bool, deployment: str | None, domain: str | None
) -> None:
    """Show periods, calls, bytes, losses and times of components; times in ms."""
    from robocomp_dsl.cli.rcdeploy.inspect.component_calls import (  # noqa: PLC0415
        component_names,
        connect,
    )
    from robocomp_dsl.cli.rcdeploy.inspect.text import to_json  # noqa: PLC0415
    from robocomp_dsl.client import struct_to_plain  # noqa: PLC0415

    domain_target = resolve_domain(deployment, domain)
    with open_client(domain_target) as client:
        names = [domain_target.component(name) for name in components] or component_names(
            client, domain_target
        )
        found = {name: struct_to_plain(connect(client, name).getStatistics()) for name in names}
    if as_json:
        print(to_json(found))
    else:
        print("\n\n".join("\n".join(_lines(name, data)) for name, data in found.items()))


def _lines(name: str, data: dict[str, Any]) -> Iterator[str]:
    from robocomp_dsl.cli.rcdeploy.inspect.table import format_columns  # noqa: PLC0415

    period = f"every {data['period']:g} ms" if data["period"] else "on events"
    yield (
        f"{name}: {period}, period p50 {data['periodP50']:.2f} p99 {data['periodP99']:.2f},"
        f" compute p50 {data['computeP50']:.2f} p99 {data['computeP99']:.2f},"
        f" {data['cycles']} cycles, {data['overruns']} overruns, {data['failures']} failures"
    )
    rows = [HEADS, *(_row(operation) for operation in data["operations"])]
    if len(rows) > 1:
        yield from format_columns(rows, right=range(1, len(HEADS)))


def _row(operation: dict[str, Any]) -> tuple[str, ...]:
    keys = ("calls", "failures", "bytesIn", "bytesOut", "drops", "malformed", "missed")
    times = (f"{operation[key]:.2f}" for key in ("p50", "p99", "longest"))
    name = f"{operation['port']}.{operation['operation']}"
    return (name, *(str(operation[key]) for key in keys), *times)
