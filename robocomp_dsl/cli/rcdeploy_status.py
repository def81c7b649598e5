"""`rcdeploy status`: how the components are. In: a running deployment. Out: a table or JSON.

Processes are known to the engine; life cycles and state machines are asked of the components.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options, rcdeploy_running
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.deploy import control, folder, status

if TYPE_CHECKING:
    from robocomp_dsl.runtime.component_interface import ComponentInfo

PATIENCE_S = 1.0
"""A component answers within a millisecond, whatever its code does; one that is stopped never."""


@click.command()
@rcdeploy_running.which
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text")
def command(which: str | None, form: str) -> None:
    """Show the components of a running deployment. Exit code 0: all are ready or ended well."""
    one = rcdeploy_running.find(which)
    try:
        answer = next(control.ask(one.name, {"verb": "status"}))
    except (folder.Unavailable, StopIteration):
        rcdeploy_running.fail(f"`{one.name}` does not answer; it may be ending")
    rows = _told(one, [status.Row(**row | {"machine": ()}) for row in answer["rows"]])
    if form == "json":
        print(json.dumps(_data(one, rows) | {"clock": answer["clock"]}, indent=1))
    else:
        since = status.duration(time.time() - one.since)
        print(f"{one.name}: {one.path}, pid {one.pid}, domain {one.domain}, up {since}")
        if answer["clock"]:
            print(status.Time(**answer["clock"]).shown())
        width = shutil.get_terminal_size().columns if sys.stdout.isatty() else 1000
        print("\n".join(status.table(rows, width, colours=options.colours_on(sys.stdout))))
    if any(row.state not in (status.READY, status.ENDED) for row in rows):
        sys.exit(FINDINGS)


def _told(one: folder.Running, rows: list[status.Row]) -> list[status.Row]:
    """`rows` with what the components tell of themselves."""
    from robocomp_dsl.deploy import reach  # noqa: PLC0415 - loads a middleware

    infos = reach.infos(one.domain, [row.name for row in rows if row.life], PATIENCE_S)
    return [_row(row, infos.get(row.name)) for row in rows]


def _row(row: status.Row, info: ComponentInfo | None) -> status.Row:
    if info is None:
        silent = f"does not answer within {PATIENCE_S:g} s"
        return replace(row, note=row.note or silent) if row.life else row
    life, machine = info.state.name.lower(), tuple(info.states)
    return replace(row, life=life, machine=machine, note=row.note or info.reason)


def _data(one: folder.Running, rows: list[status.Row]) -> dict[str, Any]:
    return {**asdict(one), "components": [row.as_dict() for row in rows]}
