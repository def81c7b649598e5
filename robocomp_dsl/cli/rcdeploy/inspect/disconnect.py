"""`rcdeploy disconnect`: removes a connection. In: two ports. Out: the change."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect import ddsl_changes
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.target import InspectCommand, open_client, resolve_domain


@click.command(cls=InspectCommand)
@click.argument(
    "source",
    metavar="COMPONENT.PORT",
    shell_complete=complete_ports("requires", "publishes", level="port"),
)
@click.argument(
    "peer",
    metavar="COMPONENT.PORT|NAME",
    shell_complete=complete_ports("implements", "subscribesTo", level="port"),
)
@ddsl_changes.option
def command(
    source: str, peer: str, *, ddsl: bool, deployment: str | None, domain: str | None
) -> None:
    """Remove the connection of two ports while the components run.

    The peer may have ended, or be a program that is no component; then the first port
    looks for it.
    """
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415

    target = resolve_domain(deployment, domain)
    ddsl_changes.check_target(target, ddsl=ddsl)
    ends = None
    with open_client(target) as client:
        searching = [
            end for end in calls.find_ports(client, target, source) if end.role in calls.SEARCHING
        ]
        try:
            ends = calls.find_ends(client, target, source, peer)
            own, name, connection = ends.searching, f"/{ends.found.name}", str(ends)
        except CliError:
            if len(searching) != 1:
                raise
            own, name = searching[0], f"/{peer.removeprefix('/')}"
            connection = f"{own.name} -> {peer}"
        proxy = calls.connections_proxy(client, own.component)
        with calls.refusals_of(own.component):
            proxy.disconnect(own.port, name)
    if not ddsl:
        print(f"{connection}: disconnected until {own.component} ends; the deployment is unchanged")
        return
    print(f"{connection}: disconnected")
    if ends is None:
        raise CliError(EXIT_FINDINGS, f"remove the connection with `{peer}` from the file yourself")
    from robocomp_dsl.deploy.ddsl_connections import remove_connection  # noqa: PLC0415

    names = ddsl_changes.connection_names(ends)
    ddsl_changes.write(target, lambda path: remove_connection(path, names))
