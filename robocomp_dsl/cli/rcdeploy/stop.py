"""`rcdeploy stop`: stops a running deployment. In: which one. Out: its exit code."""

from __future__ import annotations

import os
import select

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy import control, instances

EXIT_TIMEOUT_S = 5.0
"""Maximum time for rcdeploy to exit after all its components have exited."""


@click.command()
@running.which
def command(which: str | None) -> None:
    """Stop a running deployment in order and wait until it has exited; returns its exit code."""
    deployment = running.resolve_deployment(which)
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
