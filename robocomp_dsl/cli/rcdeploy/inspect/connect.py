"""`rcdeploy connect`: connects two running components. In: two ports. Out: the change."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect import ddsl_changes
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.granted_connections import grant_connection
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    CALL_TIMEOUT_S,
    DomainTarget,
    InspectCommand,
    open_client,
    resolve_domain,
)


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
@ddsl_changes.option
def command(
    source: str,
    peer: str,
    *,
    over: str,
    ddsl: bool,
    deployment: str | None,
    domain: str | None,
) -> None:
    """Connect a client to a server, or a publisher to a subscriber, while both run.

    A program that is no component is named by middleware and address. Exit code 1: the connection
    is not usable, for the reason that is printed.
    """
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415
    from robocomp_dsl.runtime.component.settings import EXTERNAL  # noqa: PLC0415

    target = resolve_domain(deployment, domain)
    ddsl_changes.check_target(target, ddsl=ddsl)
    if EXTERNAL.fullmatch(f"port={peer}"):
        if ddsl:
            raise click.UsageError("--ddsl: an external program needs an `extern` in the file")
        _connect_external(target, source, peer, over)
        return
    with open_client(target) as client:
        ends = calls.find_ends(client, target, source, peer)
    own = ends.searching
    # Routers that read new settings close the links of their clients, also that of this command.
    is_granted = grant_connection(target, ends)
    with open_client(target) as client:
        timeout = calls.RECONNECT_TIMEOUT_S if is_granted else CALL_TIMEOUT_S
        proxy = calls.connections_proxy(client, own.component, timeout)
        if is_granted:
            calls.wait_until_answering(proxy)
        with calls.refusals_of(own.component):
            proxy.connect(own.port, f"/{ends.found.name}", over)
        state = calls.wait_until_connected(proxy, own.port, ends.found.name)
    statement = f"connect {ends}{f' over {over}' if over else ''};"
    if state:
        raise CliError(EXIT_FINDINGS, f"{ends}: accepted, but not connected: {state}")
    print(f"{ends}: connected")
    if ddsl:
        from robocomp_dsl.deploy.ddsl_connections import write_connection  # noqa: PLC0415

        names = ddsl_changes.connection_names(ends)
        ddsl_changes.write(target, lambda path: write_connection(path, names, over))
    else:
        print(f"until {own.component} ends; to keep it, add --ddsl, or write\n    {statement}")


def _connect_external(target: DomainTarget, source: str, peer: str, over: str) -> None:
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415

    with open_client(target) as client:
        found = [e for e in calls.find_ports(client, target, source) if e.role in calls.SEARCHING]
        if len(found) != 1:
            raise CliError(
                EXIT_FINDINGS, f"`{source}` is no required or subscribed port of a component"
            )
        own = found[0]
        with calls.refusals_of(own.component):
            calls.connections_proxy(client, own.component).connect(own.port, peer, over)
    print(f"{own.name} -> {peer}: connected")
    print(
        f"until {own.component} ends; to keep it, write an `extern` program and a `connect` with it"
    )
