"""`rcdeploy qos`: changes the quality of service of a running connection, or of a port.

In: one or two ports, and items. Out: what is in force at each end.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect import ddsl_changes
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    ROLE_NAMES,
    InspectCommand,
    open_client,
    resolve_domain,
)

if TYPE_CHECKING:
    from robocomp_dsl.cli.rcdeploy.inspect.connection_calls import ConnectionEnd, ConnectionEnds
    from robocomp_dsl.client import DomainClient

SENDER_ITEMS = ("priority", "reliable", "best_effort", "keep_all", "latched")
"""Items that concern the sender of messages; the others concern the receiver only."""
_NOT_FOR_RECEIVERS = ("priority",)
_SERVER_ITEMS = ("thread_priority",)


@click.command(cls=InspectCommand)
@click.argument(
    "words",
    nargs=-1,
    required=True,
    metavar="COMPONENT.PORT [COMPONENT.PORT] ITEM...",
    shell_complete=complete_ports(*ROLE_NAMES, level="port"),
)
@ddsl_changes.option
def command(
    words: tuple[str, ...], *, ddsl: bool, deployment: str | None, domain: str | None
) -> None:
    """Change the quality of service of a connection, or of all connections of a port.

    Items: reliable, best_effort, keep_all, latched, depth=N, priority=high, deadline=MS,
    liveliness=MS, thread_priority=N. `ITEM=off` removes an item.
    """
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415
    from robocomp_dsl.runtime.component import qos_settings  # noqa: PLC0415
    from robocomp_dsl.runtime.component.invalid_setting import InvalidSetting  # noqa: PLC0415
    from robocomp_dsl.runtime.connection.endpoint import Qos  # noqa: PLC0415

    ports = [word for word in words if "=" not in word and word not in qos_settings.FLAGS]
    items = [word for word in words if word not in ports]
    if not 1 <= len(ports) <= 2 or not items:
        raise click.UsageError(
            f"write one or two ports and then items, such as arm.Laser eye.Laser depth=2; items:"
            f" {qos_settings.ITEMS}"
        )
    try:
        qos_settings.change_items(",".join(items), Qos())
    except InvalidSetting as error:
        raise click.UsageError(str(error)) from None
    target = resolve_domain(deployment, domain)
    ddsl_changes.check_target(target, ddsl=ddsl)
    if ddsl and len(ports) == 1:
        raise click.UsageError("--ddsl changes one connection: name both of its ports")
    ends: ConnectionEnds | None = None
    with open_client(target) as client:
        if len(ports) == 1:
            found = {end.port: end for end in calls.find_ports(client, target, ports[0])}
            if len(found) != 1:
                raise CliError(EXIT_FINDINGS, f"which port? {', '.join(found)}")
            end = next(iter(found.values()))
            _change(client, end, "", items)
        else:
            ends = calls.find_ends(client, target, *ports)
            for end, chosen in _distribute(ends, items):
                peer = ends.found if end is ends.searching else ends.searching
                # A served port has one quality of service for all its clients.
                _change(client, end, "" if end.role == "implements" else peer.name, chosen)
    if not ddsl or ends is None:
        print("until the components end; to keep it, add --ddsl, or write it into the deployment")
        return
    from robocomp_dsl.deploy.ddsl_connections import write_connection_qos  # noqa: PLC0415

    names = ddsl_changes.connection_names(ends)
    ddsl_changes.write(target, lambda path: write_connection_qos(path, names, items))


def _distribute(
    ends: ConnectionEnds, items: Sequence[str]
) -> list[tuple[ConnectionEnd, list[str]]]:
    """Each end with its items; the receiver first, which refuses more."""
    is_topic = ends.source.role == "publishes"
    names = {item: item.partition("=")[0] for item in items}
    if is_topic:
        receiver = [i for i in items if names[i] not in _NOT_FOR_RECEIVERS]
        sender = [i for i in items if names[i] in SENDER_ITEMS]
    else:
        receiver = [i for i in items if names[i] in _SERVER_ITEMS]
        sender = [i for i in items if names[i] not in _SERVER_ITEMS]
    pairs = ((ends.target, receiver), (ends.source, sender))
    return [(end, chosen) for end, chosen in pairs if chosen]


def _change(client: DomainClient, end: ConnectionEnd, peer: str, items: Sequence[str]) -> None:
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415

    proxy = calls.connections_proxy(client, end.component)
    with calls.refusals_of(end.component):
        qos = proxy.setQos(end.port, peer, ",".join(items))
    print(f"{end.name}{f' with {peer}' if peer else ''}: {qos or 'the defaults'}")
