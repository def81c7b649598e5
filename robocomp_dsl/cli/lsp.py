"""`rcgen lsp`: the language server. In: an editor's messages. Out: answers, until it leaves."""

from __future__ import annotations

import sys

import click

HOST = "127.0.0.1"


@click.command()
@click.option("--tcp", "port", type=click.IntRange(0, 65535), metavar="PORT", help="Listen there.")
@click.option("--host", default=HOST, show_default=True, help="With --tcp: on which address.")
@click.option("--stdio", is_flag=True, help="Use stdin and stdout, as without any option.")
def command(port: int | None, host: str, stdio: bool) -> None:
    """Serve an editor: findings as you type, completion, navigation, renaming."""
    if stdio and port is not None:
        raise click.UsageError("--stdio and --tcp exclude each other")
    try:
        from robocomp_dsl.editor import server  # noqa: PLC0415 - needs an extra
    except ModuleNotFoundError as error:
        raise click.ClickException(
            f"the language server needs {error.name}: pip install 'robocomp_dsl[editor]'"
        ) from None
    if port is None:
        sys.exit(server.serve_stdio())
    try:
        code = server.serve_tcp(host, port)
    except OSError as error:
        reason = error.strerror or str(error)
        raise click.ClickException(f"cannot listen on {host}:{port}: {reason}") from None
    sys.exit(code)
