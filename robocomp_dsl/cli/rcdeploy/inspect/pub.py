"""`rcdeploy pub`: publishes a message. In: a port, the message as YAML. Out: messages.

Subscribers take it for a message of the component that publishes on the port.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    InspectCommand,
    PortTarget,
    open_client,
    resolve_domain,
    resolve_port,
    split_operation,
)

if TYPE_CHECKING:
    from robocomp_dsl.client import DomainClient
    from robocomp_dsl.runtime.connection.ports import Channel

MATCH_TIMEOUT_S = 2.0


@click.command(cls=InspectCommand, context_settings={"ignore_unknown_options": True})
@click.argument(
    "target",
    metavar="COMPONENT.PORT[.OPERATION]",
    shell_complete=complete_ports("publishes", "subscribesTo", level="operation"),
)
@click.argument("arguments", nargs=-1, metavar="YAML...", type=click.UNPROCESSED)
@click.option(
    "--rate",
    type=click.FloatRange(0, 10_000, min_open=True),
    metavar="HZ",
    help="Publish again at this rate.",
)
@click.option("-n", "count", type=click.IntRange(1), help="Publish so many times. Default: 1.")
def command(
    target: str,
    arguments: tuple[str, ...],
    *,
    rate: float | None,
    count: int | None,
    deployment: str | None,
    domain: str | None,
) -> None:
    """Publish a message to the subscribers of a port, or to one subscribing port."""
    from robocomp_dsl.cli.rcdeploy.inspect.arguments import parse_arguments  # noqa: PLC0415 - numpy
    from robocomp_dsl.cli.rcdeploy.inspect.messages import published_operations  # noqa: PLC0415

    domain_target = resolve_domain(deployment, domain)
    with open_client(domain_target) as client:
        found = resolve_port(client, domain_target, target, "publishes", "subscribesTo")
        name, rest = split_operation(found)
        operations = published_operations(found, name or rest)
        if len(operations) > 1:
            names = ", ".join(operation.name for operation in operations)
            raise click.UsageError(f"which operation of `{target}`? There are {names}")
        operation = operations[0]
        info = found.port.operation_info(operation.name)
        values = parse_arguments(operation, info, arguments, f"rcdeploy pub {target}")
        channel = _publisher(client, found)
        publish = channel.bind(operation)
        _wait_for_subscriber(channel, found)
        limit = count or (None if rate else 1)
        sent, start = 0, time.monotonic()
        while limit is None or sent < limit:
            publish(*values)
            sent += 1
            if rate and sent != limit:
                time.sleep(max(0.0, start + sent / rate - time.monotonic()))


def _publisher(client: DomainClient, found: PortTarget) -> Channel:
    """A publisher that the subscribers of the port listen to."""
    port = found.port
    if port.role == "publishes":
        return client.publisher(port.interface, found.component, port.name)
    # A connected port hears only its peers; any other hears components of its branch.
    namespace, slash, _ = found.component.rpartition("/")
    peer = port.peers[0] if port.peers else "*"
    component, _, peer_port = peer.partition(".")
    if component == "*":
        component = f"{namespace}{slash}rcdeploy"
    return client.publisher(port.interface, component.removeprefix("/"), peer_port or port.name)


def _wait_for_subscriber(channel: Channel, found: PortTarget) -> None:
    """Wait until somebody subscribes. Raises `CliError`."""
    deadline = time.monotonic() + MATCH_TIMEOUT_S
    while not channel.has_subscribers():
        if time.monotonic() > deadline:
            name = f"{found.component}.{found.port.name}"
            raise CliError(
                EXIT_FINDINGS,
                f"nobody subscribes to {found.port.interface.name} of `{name}`"
                f" ({MATCH_TIMEOUT_S:g} s); see `rcdeploy list`",
            )
        time.sleep(0.005)
