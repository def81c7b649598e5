"""`rcgen config where`: shows the search for a file. In: a name. Out: candidates in order."""

from __future__ import annotations

import json
import sys

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.config import lookup
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.runtime.config import (
    Candidate,
    InvalidName,
    existing_configs,
    search,
    search_paths,
    validate_context,
)


@click.command()
@click.argument("name", type=lookup.FILE)
@click.option("--context", default="", metavar="C", help="Also search this context.")
@lookup.output_format
def command(name: str, context: str, output_format: str) -> None:
    """List the folders in which `--from NAME` searches, in order; the first match wins."""
    folders = lookup.folders()
    robot = folders.around.robot
    try:
        validate_context(robot, "robot name (ROBOCOMP_ROBOT_NAME)")
        context = context and validate_context(context)
    except InvalidName as error:
        raise click.UsageError(str(error)) from None
    candidates = search(name, search_paths(folders.roots, robot, context))
    winner = next((candidate for candidate in candidates if candidate.is_usable), None)
    if output_format == "json":
        print(json.dumps([_data(candidate, winner) for candidate in candidates], indent=1))
    else:
        print("\n".join(_line(candidate, winner) for candidate in candidates))
        if winner is None:
            guess = did_you_mean(name, existing_configs(candidates))
            message = f"error: there is no `{name}` in any of them"
            print(f"{message}; {guess}" if guess else message, file=sys.stderr)
    if not winner:
        raise CliError(EXIT_FINDINGS)


def _data(candidate: Candidate, winner: Candidate | None) -> dict[str, object]:
    return {
        "path": str(candidate.path),
        "origin": candidate.search_path.root.origin.value,
        "within": candidate.search_path.subfolder,
        "there": candidate.is_usable,
        "wins": candidate is winner,
        "obstacle": candidate.skip_reason,
    }


def _line(candidate: Candidate, winner: Candidate | None) -> str:
    state = "wins" if candidate is winner else "shadowed" if candidate.is_usable else "-"
    obstacle = (
        f": {candidate.skip_reason}" if candidate.skip_reason not in ("", "not found") else ""
    )
    return f"{state:9} {lookup.display_path(candidate.path)}  ({candidate.search_path}){obstacle}"
