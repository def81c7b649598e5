"""`rcdeploy connections`: the connections of running components. In: components. Out: a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_components
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    DomainTarget,
    InspectCommand,
    open_client,
    resolve_domain,
)

if TYPE_CHECKING:
    from robocomp_dsl.deploy.external_connection import ConnectionStatus

_HEAD = ("PORT", "ROLE", "PEER", "OVER", "STATE", "QOS", "CALLS", "LOST", "HELD", "LATE")
_RIGHT = (6, 7, 8, 9)


@click.command(cls=InspectCommand)
@click.argument("components", nargs=-1, shell_complete=complete_components)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def command(
    components: tuple[str, ...], *, as_json: bool, deployment: str | None, domain: str | None
) -> None:
    """List connections: with whom, over what, in which state, what was lost.

    CALLS, LOST, HELD and LATE are calls or messages, lost messages, messages that waited for room
    in a full queue, and missed deadlines of the port. Connections between external programs, which
    rcdeploy makes, have the role `external`.
    """
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls, text  # noqa: PLC0415
    from robocomp_dsl.cli.rcdeploy.inspect.component_calls import component_names  # noqa: PLC0415
    from robocomp_dsl.cli.rcdeploy.inspect.table import format_columns  # noqa: PLC0415
    from robocomp_dsl.client import struct_to_plain  # noqa: PLC0415
    from robocomp_dsl.runtime.connection.connections_interface import (  # noqa: PLC0415
        ConnectionInfo,
    )

    def row(component: str, info: ConnectionInfo) -> tuple[str, ...]:
        state = f"{info.state.name.lower()}{f' ({info.reason})' if info.reason else ''}"
        if info.monitors:
            state += f", {'+'.join(info.monitors)} {info.monitorState}"
        if info.condition:
            state += f", when {info.condition}{' (delivers)' if info.winner else ''}"
        counts = (info.calls, info.drops, info.held, info.missed)
        return (
            f"{component}.{info.port}",
            info.role,
            info.peer or "any",
            info.middleware,
            state,
            info.qos or "-",
            *map(str, counts),
        )

    target = resolve_domain(deployment, domain)
    rows: list[tuple[str, ...]] = [_HEAD]
    data: list[dict[str, object]] = []
    problems: list[str] = []
    with open_client(target) as client:
        names = [target.component(name) for name in components]
        for name in names or component_names(client, target):
            try:
                infos = connection_calls.connections_proxy(client, name).getConnections()
            except CliError as error:
                problems.append(str(error))
                continue
            rows += [row(name, info) for info in infos]
            data += [{"component": name, **struct_to_plain(info)} for info in infos]
    for link in [] if components else _external_connections(target):
        state = f"{link.state}{f' ({link.reason})' if link.reason else ''}"
        over = f"{link.middleware}{f' ({link.carrier})' if link.carrier else ''}"
        rows.append((link.source, "external", link.target, over, state, *["-"] * 5))
        data.append({"component": "", **link.as_dict()})
    print(text.to_json(data) if as_json else "\n".join(format_columns(rows, _RIGHT)))
    if problems:
        raise CliError(EXIT_FINDINGS, "; ".join(problems))


def _external_connections(target: DomainTarget) -> list[ConnectionStatus]:
    """The connections between external programs that the rcdeploy of a deployment keeps."""
    if not target.deployment:
        return []
    from robocomp_dsl.deploy import deployments  # noqa: PLC0415 - not for --help
    from robocomp_dsl.deploy.engine import EngineError  # noqa: PLC0415

    try:
        running = deployments.running_deployments()
        engine = next(engine for engine in running if engine.name == target.deployment)
        return list(engine.status().connections)
    except (EngineError, StopIteration):
        return []
