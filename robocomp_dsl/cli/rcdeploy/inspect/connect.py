"""`rcdeploy connect`: connects two running components. In: two ports. Out: the change."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    InspectCommand,
    open_client,
    resolve_domain,
)

_KEEP = "until {component} ends; to keep it, write into the deployment:\n    {statement}"


@click.command(cls=InspectCommand)
@click.argument(
    "source",
    metavar="COMPONENT.PORT",
    shell_complete=complete_ports("requires", "publishes", level="port"),
)
@click.argument(
    "peer",
    metavar="COMPONENT.PORT|NAME@M:ADDRESS",
    shell_complete=complete_ports("implements", "subscribesTo", level="port"),
)
@click.option("--over", metavar="M", default="", help="The middleware of the port from now on.")
def command(
    source: str, peer: str, *, over: str, deployment: str | None, domain: str | None
) -> None:
    """Connect a client to a server, or a publisher to a subscriber, while both run.

    A program that is no component is named by middleware and address.
    """
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415
    from robocomp_dsl.runtime.component.settings import EXTERNAL  # noqa: PLC0415

    target = resolve_domain(deployment, domain)
    with open_client(target) as client:
        if EXTERNAL.fullmatch(f"port={peer}"):
            found = [
                e for e in calls.find_ports(client, target, source) if e.role in calls.SEARCHING
            ]
            if len(found) != 1:
                raise CliError(
                    EXIT_FINDINGS, f"`{source}` is no required or subscribed port of a component"
                )
            own, name, connection = found[0], peer, f"{found[0].name} -> {peer}"
            statement = "an `extern` program, and a `connect` with it"
        else:
            ends = calls.find_ends(client, target, source, peer)
            own, name, connection = ends.searching, f"/{ends.found.name}", str(ends)
            statement = f"connect {connection}{f' over {over}' if over else ''};"
        proxy = calls.connections_proxy(client, own.component)
        with calls.refusals_of(own.component):
            proxy.connect(own.port, name, over)
    print(f"{connection}: connected")
    print(_KEEP.format(component=own.component, statement=statement))
