"""`rcdeploy logs`: what was said. In: a running deployment. Out: its lines, old ones and new."""

from __future__ import annotations

import sys

import click

from robocomp_dsl.cli import options, rcdeploy_running
from robocomp_dsl.deploy import control, folder
from robocomp_dsl.deploy.logs import OWN, Record, as_text


@click.command()
@rcdeploy_running.which
@click.option("-f", "--follow", is_flag=True, help="Go on with what is said from now on.")
@click.option("-n", "--last", default=control.KEPT, metavar="N", help="Only the last N lines.")
@click.option("-c", "--component", multiple=True, metavar="NAME", help="Only this one; repeatable.")
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text")
def command(
    which: str | None, follow: bool, last: int, component: tuple[str, ...], form: str
) -> None:
    """Show what the components of a running deployment said."""
    one = rcdeploy_running.find(which)
    known = [OWN, *rcdeploy_running.components(one)] if component else []
    request = {
        "verb": "logs",
        "follow": follow,
        "last": max(last, 0),
        "components": [rcdeploy_running.meant(name, known) for name in component],
    }
    colours = options.colours_on(sys.stdout)
    width = 0
    try:
        for answer in control.ask(one.name, request):
            record = Record(**answer)
            width = max(width, len(record.component))
            text = record.as_json() if form == "json" else as_text(record, width, colours=colours)
            print(text, flush=follow)
    except folder.Unavailable as error:
        rcdeploy_running.fail(str(error))
