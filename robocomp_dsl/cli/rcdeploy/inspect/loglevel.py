"""`rcdeploy loglevel`: what a component logs. In: a component and a level. Out: the change."""

from __future__ import annotations

import click

from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_components
from robocomp_dsl.cli.rcdeploy.inspect.target import InspectCommand

LEVELS = ("debug", "info", "warning", "error", "critical")


@click.command(cls=InspectCommand)
@click.argument("component", shell_complete=complete_components)
@click.argument("level", type=click.Choice(LEVELS), metavar=f"{{{'|'.join(LEVELS)}}}")
def command(component: str, level: str, *, deployment: str | None, domain: str | None) -> None:
    """Set the log level of a running component, until it ends."""
    from robocomp_dsl.cli.rcdeploy.inspect.component_calls import component_proxy  # noqa: PLC0415

    with component_proxy(component, deployment, domain) as (proxy, name):
        proxy.setLogLevel(level)
    print(f"{name}: log level {level}")
