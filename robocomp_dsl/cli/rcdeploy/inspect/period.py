"""`rcdeploy period`: how often `compute` runs. In: a component and ms. Out: the change."""

from __future__ import annotations

import click

from robocomp_dsl.cli.rcdeploy.inspect.completion import complete_components
from robocomp_dsl.cli.rcdeploy.inspect.target import InspectCommand


@click.command(cls=InspectCommand)
@click.argument("component", shell_complete=complete_components)
@click.argument("period", type=click.IntRange(0, 3_600_000), metavar="MS")
def command(component: str, period: int, *, deployment: str | None, domain: str | None) -> None:
    """Set the period of `compute` of a running component in ms; 0: only on events."""
    from robocomp_dsl.cli.rcdeploy.inspect.component_calls import component_proxy  # noqa: PLC0415

    with component_proxy(component, deployment, domain) as (proxy, name):
        proxy.setPeriod(period)
    print(f"{name}: " + (f"every {period} ms" if period else "on events"))
