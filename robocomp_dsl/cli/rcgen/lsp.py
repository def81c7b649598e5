"""`rcgen lsp`: the language server. In: an editor's messages. Out: responses to it."""

from __future__ import annotations

import os
from pathlib import Path

import click

from robocomp_dsl.check.workspace.import_resolver import VARIABLE
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import CliError
from robocomp_dsl.extras import MissingExtra

HOST = "127.0.0.1"


@click.command()
@click.option(
    "--tcp", "port", type=click.IntRange(0, 65535), metavar="PORT", help="Listen on this TCP port."
)
@click.option(
    "--host", default=HOST, show_default=True, help="With --tcp: the address to listen on."
)
@click.option("--stdio", is_flag=True, help="Use stdin and stdout (the default).")
@options.folders
def command(port: int | None, host: str, stdio: bool, folders: tuple[Path, ...]) -> None:
    """Start the language server: diagnostics, completion, navigation and rename in editors."""
    if stdio and port is not None:
        raise click.UsageError("--stdio and --tcp exclude each other")
    if folders:
        listed = [*(str(folder.absolute()) for folder in folders), os.environ.get(VARIABLE, "")]
        os.environ[VARIABLE] = os.pathsep.join(filter(None, listed))
    try:
        from robocomp_dsl.language_server import server  # noqa: PLC0415 - needs an extra
    except ModuleNotFoundError as error:
        raise MissingExtra("the language server", "editor", error) from None
    if port is None:
        raise CliError(server.serve_stdio())
    try:
        code = server.serve_tcp(host, port)
    except OSError as error:
        reason = error.strerror or str(error)
        raise click.ClickException(f"cannot listen on {host}:{port}: {reason}") from None
    raise CliError(code)
