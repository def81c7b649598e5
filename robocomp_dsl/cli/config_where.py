"""`rcgen config where`: the search for one file, shown. In: a name. Out: candidates in order."""

from __future__ import annotations

import json
import sys

import click

from robocomp_dsl.cli import config_search as searching
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.runtime.config import (
    Tried,
    WrongName,
    checked_context,
    files_beside,
    places,
    search,
)


@click.command()
@click.argument("name", type=searching.FILE)
@click.option("--context", default="", metavar="C", help="Search this context, too.")
@searching.output_format
def command(name: str, context: str, form: str) -> None:
    """All places in which `--from NAME` looks, in order; the first that has it wins."""
    folders = searching.folders()
    robot = folders.around.robot
    try:
        checked_context(robot, "robot name (ROBOCOMP_ROBOT_NAME)")
        context = context and checked_context(context)
    except WrongName as error:
        raise click.UsageError(str(error)) from None
    tried = search(name, places(folders.roots, robot, context))
    winner = next((one for one in tried if one.there), None)
    if form == "json":
        print(json.dumps([_data(one, winner) for one in tried], indent=1))
    else:
        print("\n".join(_line(one, winner) for one in tried))
        if winner is None:
            guess = did_you_mean(name, files_beside(tried))
            said = f"error: there is no `{name}` in any of them"
            print(f"{said}; {guess}" if guess else said, file=sys.stderr)
    sys.exit(0 if winner else FINDINGS)


def _data(one: Tried, winner: Tried | None) -> dict[str, object]:
    return {
        "path": str(one.path),
        "origin": one.place.root.origin.value,
        "within": one.place.within,
        "there": one.there,
        "wins": one is winner,
        "obstacle": one.obstacle,
    }


def _line(one: Tried, winner: Tried | None) -> str:
    state = "wins" if one is winner else "shadowed" if one.there else "-"
    obstacle = f": {one.obstacle}" if one.obstacle not in ("", "not there") else ""
    return f"{state:9} {searching.shown(one.path)}  ({one.place}){obstacle}"
