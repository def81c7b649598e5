"""`rcdeploy start`: starts components of a running deployment. In: names. Out: their states."""

from __future__ import annotations

import click

from robocomp_dsl.cli.rcdeploy import components


@click.command()
@click.argument("words", nargs=-1, metavar="[APP.ddsl|NAME] [COMPONENT|GROUP]...")
def command(words: tuple[str, ...]) -> None:
    """Start components of a running deployment that do not run, and what they start after.

    Without names: all that do not run. They run the generated code and the command line of the
    description as they are now. Exit code 0: all are ready.
    """
    deployment, names = components.split_names(words)
    components.request(deployment, "start", names)
