"""`--ddsl` of `connect`, `disconnect` and `qos`: writes the change into the deployment's file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError

if TYPE_CHECKING:
    from robocomp_dsl.cli.rcdeploy.inspect.connection_calls import ConnectionEnds
    from robocomp_dsl.cli.rcdeploy.inspect.target import DomainTarget
    from robocomp_dsl.deploy.ddsl_connections import ConnectionNames

option = click.option("--ddsl", is_flag=True, help="Write the change into the deployment's file.")


def check_target(target: DomainTarget, *, ddsl: bool) -> None:
    """Raise `click.UsageError` if there is no file to write."""
    if ddsl and not target.path:
        raise click.UsageError("--ddsl needs a deployment; --domain has no file")


def connection_names(ends: ConnectionEnds) -> ConnectionNames:
    """The connection with the names of the file."""
    from robocomp_dsl.deploy.ddsl_connections import ConnectionNames  # noqa: PLC0415 - loads the parser

    source, target = ends.source, ends.target
    return ConnectionNames(source.component, source.port, target.component, target.port)


def write(target: DomainTarget, change: Callable[[Path], None]) -> None:
    """Apply a change to the file of the deployment. Raises `CliError`: it runs, but is not kept."""
    from robocomp_dsl.deploy.ddsl_settings import CannotEdit  # noqa: PLC0415

    try:
        change(Path(target.path))
    except CannotEdit as error:
        text = f"the change is in force until the component ends, and not written: {error}"
        raise CliError(EXIT_FINDINGS, text) from None
    print(f"written to {target.path}")
