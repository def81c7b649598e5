"""`rcdeploy stop`: end a running deployment. In: which. Out: nothing is left of it."""

from __future__ import annotations

import os
import select
import sys

import click

from robocomp_dsl.cli import rcdeploy_running
from robocomp_dsl.deploy import control, folder

LAST_WORDS_S = 5.0
"""How long rcdeploy takes, at most, to leave after all its components have ended."""


@click.command()
@rcdeploy_running.which
def command(which: str | None) -> None:
    """Stop a running deployment in order, and wait until it has ended; its exit code is ours."""
    one = rcdeploy_running.find(which)
    ended = _handle(one.pid)
    try:
        answer = next(control.ask(one.name, {"verb": "stop"}), None)
    except folder.Unavailable as error:
        rcdeploy_running.fail(str(error))
    if answer is None:
        rcdeploy_running.fail(f"`{one.name}` ended without a word; it may have been killed")
    if ended is not None:
        select.select([ended], [], [], LAST_WORDS_S)  # so that its name is free when we return
    print(f"{one.name}: {answer['reason']}")
    sys.exit(int(answer["code"]))


def _handle(pid: int) -> int | None:
    try:
        return os.pidfd_open(pid)
    except OSError:
        return None
