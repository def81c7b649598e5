"""`rcdeploy stop`: stops a deployment or components of it. In: names. Out: an exit code."""

from __future__ import annotations

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import components, running
from robocomp_dsl.deploy.engine import EngineError


@click.command()
@click.argument("words", nargs=-1, metavar="[APP.ddsl|NAME] [COMPONENT|GROUP]...")
def command(words: tuple[str, ...]) -> None:
    """Stop a running deployment in order and wait until it has exited; returns its exit code.

    With names of components or groups: stop only these; the deployment continues.
    """
    engine, names = components.split_names(words)
    if names:
        components.request(engine, "stop", names)
        return
    try:
        result = engine.stop(running.say)
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    print(f"{engine.name}: {result.reason}")
    if result.code:
        raise CliError(result.code)
