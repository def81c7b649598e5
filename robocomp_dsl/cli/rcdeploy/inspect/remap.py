"""`rcdeploy remap`: renames a port of a running component. In: a port, a name. Out: the change."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_ports
from robocomp_dsl.cli.rcdeploy.inspect.granted_connections import has_routers
from robocomp_dsl.cli.rcdeploy.inspect.target import (
    ROLE_NAMES,
    InspectCommand,
    open_client,
    resolve_domain,
)


@click.command(cls=InspectCommand)
@click.argument(
    "port", metavar="COMPONENT.PORT", shell_complete=complete_ports(*ROLE_NAMES, level="port")
)
@click.argument("name")
def command(port: str, name: str, *, deployment: str | None, domain: str | None) -> None:
    """Rename a port for others; a required or subscribed port looks for that name."""
    from robocomp_dsl.cli.rcdeploy.inspect import connection_calls as calls  # noqa: PLC0415

    target = resolve_domain(deployment, domain)
    if has_routers(target):
        text = "the routers between the hosts pass the described names of ports only"
        raise CliError(EXIT_FINDINGS, f"`{port}` is not renamed: {text}")
    with open_client(target) as client:
        component, own = target.split(port)
        if not own:
            raise CliError(EXIT_FINDINGS, f"which port of `{component}`? Write {component}.PORT")
        calls.find_ports(client, target, port)
        with calls.refusals_of(component):
            calls.connections_proxy(client, component).remap(own, name)
    print(f"{component}.{own}: named {name} until {component} ends; the deployment is unchanged")
