"""`rcdeploy stop`: stops a deployment or components of it. In: names. Out: an exit code."""

from __future__ import annotations

import os
import select

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import components
from robocomp_dsl.deploy import control, instances

EXIT_TIMEOUT_S = 5.0
"""Maximum time for rcdeploy to exit after all its components have exited."""


@click.command()
@click.argument("words", nargs=-1, metavar="[APP.ddsl|NAME] [COMPONENT|GROUP]...")
def command(words: tuple[str, ...]) -> None:
    """Stop a running deployment in order and wait until it has exited; returns its exit code.

    With names of components or groups: stop only these; the deployment continues.
    """
    deployment, names = components.split_names(words)
    if names:
        components.request(deployment, "stop", names)
        return
    ended = _handle(deployment.pid)
    try:
        answer = next(control.send_request(deployment.name, {"verb": "stop"}), None)
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if answer is None:
        raise CliError(
            EXIT_FINDINGS, f"`{deployment.name}` ended without a word; it may have been killed"
        )
    if ended is not None:
        select.select([ended], [], [], EXIT_TIMEOUT_S)  # so that its name is free afterwards
    print(f"{deployment.name}: {answer['reason']}")
    if code := int(answer["code"]):
        raise CliError(code)


def _handle(pid: int) -> int | None:
    try:
        return os.pidfd_open(pid)
    except OSError:
        return None
