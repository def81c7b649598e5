"""`rcdeploy restart`: restarts components of a deployment. In: names. Out: their states."""

from __future__ import annotations

import click

from robocomp_dsl.cli.rcdeploy import components


@click.command()
@click.argument("words", nargs=-1, metavar="[APP.ddsl|NAME] [COMPONENT|GROUP]...")
def command(words: tuple[str, ...]) -> None:
    """Restart components of a running deployment in order; without names: all.

    They run the generated code and the command line of the description as they are now. Nothing
    stops if the description has errors. Exit code 0: all are ready.
    """
    deployment, names = components.split_names(words)
    components.request(deployment, "restart", names)
