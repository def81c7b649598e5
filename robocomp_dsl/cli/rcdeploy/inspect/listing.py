"""`rcdeploy list`: ports and operations of running components, with types, units and docs.

In: components or a port. Out: a table, the details of a port, or JSON.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    ROLE_NAMES,
    InspectCommand,
    open_client,
    resolve_domain,
    resolve_port,
)

if TYPE_CHECKING:
    from robocomp_dsl.client import ComponentDescription, DescribedPort, DomainClient

DESCRIBE_TIMEOUT_S = 1.0


@click.command(cls=InspectCommand)
@click.argument(
    "targets",
    nargs=-1,
    metavar="[COMPONENT[.PORT]]...",
    shell_complete=complete_ports(*ROLE_NAMES, level="port"),
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, with all types.")
def command(
    targets: tuple[str, ...], *, as_json: bool, deployment: str | None, domain: str | None
) -> None:
    """List the ports of components, or operations and types of a port."""
    from robocomp_dsl.cli.rcdeploy.inspect import component_calls, port_details, text  # noqa: PLC0415

    domain_target = resolve_domain(deployment, domain)
    with open_client(domain_target) as client:
        names: list[str] = []
        blocks: list[str] = []
        data: list[Any] = []
        for target in targets:
            name, port = domain_target.split(target)
            if not port:
                names.append(name)
                continue
            found = resolve_port(client, domain_target, target, *ROLE_NAMES)
            blocks.append("\n".join(port_details.describe_port(found.description, found.port)))
            data.append(port_details.port_data(found.description, [found.port]))
        if names or not targets:
            selected = names or component_calls.component_names(client, domain_target)
            described = _describe_all(client, selected)
            blocks.append("\n".join(_table(described)))
            data += [
                port_details.port_data(each, each.ports)
                for each in described.values()
                if not isinstance(each, str)
            ]
        unavailable = [name for name in names if isinstance(described[name], str)] if names else []
    print(text.to_json(data) if as_json else "\n\n".join(blocks))
    if unavailable:
        raise CliError(EXIT_FINDINGS, "; ".join(str(described[name]) for name in unavailable))


def _describe_all(
    client: DomainClient, names: Sequence[str]
) -> dict[str, ComponentDescription | str]:
    """The description of each component, or why there is none."""
    from concurrent.futures import ThreadPoolExecutor  # noqa: PLC0415

    from robocomp_dsl.runtime.errors import MiddlewareError  # noqa: PLC0415

    def describe(name: str) -> ComponentDescription | str:
        try:
            return client.describe(name, DESCRIBE_TIMEOUT_S)
        except MiddlewareError as error:
            return str(error)

    with ThreadPoolExecutor(8) as pool:
        return dict(zip(names, pool.map(describe, names), strict=True))


def _table(described: dict[str, ComponentDescription | str]) -> Iterator[str]:
    from robocomp_dsl.cli.rcdeploy.inspect.table import format_columns  # noqa: PLC0415
    from robocomp_dsl.cli.rcdeploy.inspect.type_names import operations_of  # noqa: PLC0415

    rows = [("PORT", "ROLE", "INTERFACE", "OPERATIONS")]
    for name, component in described.items():
        if isinstance(component, str):
            rows.append((name, "", "", component))
            continue
        rows += [_row(name, port, operations_of(port)) for port in component.ports]
    yield from format_columns(rows)


def _row(component: str, port: DescribedPort, operations: str) -> tuple[str, str, str, str]:
    return f"{component}.{port.name}", port.role, port.interface.name, operations
