"""`rcdeploy logs`: prints logs. In: a running deployment. Out: its log lines, old and new."""

from __future__ import annotations

import sys

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy import control, instances
from robocomp_dsl.deploy.logs import RCDEPLOY, LogRecord, format_record


@click.command()
@running.which
@click.option("-f", "--follow", is_flag=True, help="Also print new lines as they appear.")
@click.option(
    "-n", "--last", default=control.JOURNAL_SIZE, metavar="N", help="Only the last N lines."
)
@click.option(
    "-c", "--component", multiple=True, metavar="NAME", help="Only this component; repeatable."
)
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(
    which: str | None, follow: bool, last: int, component: tuple[str, ...], output_format: str
) -> None:
    """Show the logs of a running deployment."""
    deployment = running.resolve_deployment(which)
    known = [RCDEPLOY, *running.components(deployment)] if component else []
    request = {
        "verb": "logs",
        "follow": follow,
        "last": max(last, 0),
        "components": [running.resolve_component(name, known) for name in component],
    }
    colours = options.use_colours(sys.stdout)
    width = 0
    try:
        for answer in control.send_request(deployment.name, request):
            record = LogRecord(**answer)
            width = max(width, len(record.component))
            text = (
                record.to_json()
                if output_format == "json"
                else format_record(record, width, colours=colours)
            )
            print(text, flush=follow)
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
