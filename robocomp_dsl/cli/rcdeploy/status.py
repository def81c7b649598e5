"""`rcdeploy status`: shows a deployment's components. In: a running one. Out: a table or JSON.

The supervisor knows the processes; lifecycles and state machines are queried from the components.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy import control, instances, status

if TYPE_CHECKING:
    from robocomp_dsl.deploy.component_queries import ComponentState

CALL_TIMEOUT_S = 0.5
"""For all components together; a running component replies within milliseconds."""


@click.command()
@running.which
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(which: str | None, output_format: str) -> None:
    """Show the components of a running deployment. Exit code 0: all are ready or exited."""
    deployment = running.resolve_deployment(which)
    try:
        answer = next(control.send_request(deployment.name, {"verb": "status"}))
    except (instances.Unavailable, StopIteration):
        raise CliError(
            EXIT_FINDINGS, f"`{deployment.name}` does not answer; it may be ending"
        ) from None
    rows = _with_component_state(
        deployment, [status.ProcessStatus.from_dict(row) for row in answer["rows"]]
    )
    if output_format == "json":
        print(json.dumps(_data(deployment, rows) | {"clock": answer["clock"]}, indent=1))
    else:
        since = status.format_duration(time.time() - deployment.since)
        process = f"pid {deployment.pid}, domain {deployment.domain}, up {since}"
        print(f"{deployment.name}: {deployment.path}, {process}")
        if answer["clock"]:
            print(status.SimulatedTime(**answer["clock"]).format())
        width = shutil.get_terminal_size().columns if sys.stdout.isatty() else 1000
        table = status.format_table(rows, width, colours=options.use_colours(sys.stdout))
        print("\n".join([*table, *status.format_hangs(rows, time.time())]))
    if any(row.state not in (status.READY, status.EXITED) for row in rows):
        raise CliError(EXIT_FINDINGS)


def _with_component_state(
    deployment: instances.RunningDeployment, rows: list[status.ProcessStatus]
) -> list[status.ProcessStatus]:
    """`rows` with the information of the components themselves."""
    from robocomp_dsl.deploy import component_queries  # noqa: PLC0415 - loads a middleware

    states = component_queries.fetch_states(
        deployment.domain, [row.name for row in rows if row.life], CALL_TIMEOUT_S
    )
    return [_row(row, states.get(row.name)) for row in rows]


def _row(row: status.ProcessStatus, state: ComponentState | None) -> status.ProcessStatus:
    if state is None:
        silent = f"does not answer within {CALL_TIMEOUT_S:g} s"
        return replace(row, note=row.note or silent) if row.life else row
    info = state.info
    return replace(
        row,
        life=info.state.name.lower(),
        machine=tuple(info.states),
        overruns=state.overruns,
        note=row.note or info.reason,
    )


def _data(
    deployment: instances.RunningDeployment, rows: list[status.ProcessStatus]
) -> dict[str, Any]:
    return {**asdict(deployment), "components": [row.as_dict() for row in rows]}
