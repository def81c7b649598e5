"""`rcdeploy status`: shows a deployment's components. Out: a table or JSON.

The supervisor knows the processes; lifecycles and state machines are queried from the components.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy import control, instances, status
from robocomp_dsl.deploy.external_connection import ConnectionStatus, format_connections
from robocomp_dsl.deploy.external_program import ExternalProgram

if TYPE_CHECKING:
    from robocomp_dsl.deploy.component_queries import ComponentState

CALL_TIMEOUT_S = 0.5
"""For all components together; a running component replies within milliseconds."""


@click.command()
@running.which
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(which: str | None, output_format: str) -> None:
    """Show the components of one deployment, or of all that you run. Exit code 0: all are well.

    A component is well if it is ready or has exited. JSON: without a name, an array of deployments.
    """
    deployments = [running.resolve_deployment(which)] if which else running.all_deployments()
    reports = [_report(deployment) for deployment in deployments]
    if output_format == "json":
        data = [report.as_data() for report in reports]
        print(json.dumps(data[0] if which else data, indent=1))
    else:
        width = shutil.get_terminal_size().columns if sys.stdout.isatty() else 1000
        colours = options.use_colours(sys.stdout)
        print("\n\n".join("\n".join(r.as_text(width, colours=colours)) for r in reports))
    rows = [row for report in reports for row in report.rows]
    if any(row.state not in (status.READY, status.EXITED) for row in rows):
        raise CliError(EXIT_FINDINGS)


@dataclass(frozen=True, slots=True)
class DeploymentReport:
    """The status of one deployment; `clock` is None without a simulated clock.

    `connections` are those between external programs. rcdeploy starts no external program, so it
    knows no state of it.
    """

    deployment: instances.RunningDeployment
    rows: list[status.ProcessStatus]
    clock: dict[str, Any] | None
    externals: list[ExternalProgram]
    connections: list[ConnectionStatus]

    def as_data(self) -> dict[str, Any]:
        """For JSON."""
        return {
            **asdict(self.deployment),
            "components": [row.as_dict() for row in self.rows],
            "clock": self.clock,
            "externals": [program.as_dict() for program in self.externals],
            "connections": [connection.as_dict() for connection in self.connections],
        }

    def as_text(self, width: int, *, colours: bool) -> list[str]:
        """A heading and a table."""
        deployment = self.deployment
        since = status.format_duration(time.time() - deployment.since)
        process = f"pid {deployment.pid}, domain {deployment.domain}, up {since}"
        lines = [f"{deployment.name}: {deployment.path}, {process}"]
        lines += [status.SimulatedTime(**self.clock).format()] if self.clock else []
        lines += status.format_table(self.rows, width, colours=colours)
        lines += [" ".join(program.format()) for program in self.externals]
        lines += ["", *format_connections(self.connections)] if self.connections else []
        return lines + status.format_hangs(self.rows, time.time())


def _report(deployment: instances.RunningDeployment) -> DeploymentReport:
    try:
        answer = next(control.send_request(deployment.name, {"verb": "status"}))
    except (instances.Unavailable, StopIteration):
        raise CliError(
            EXIT_FINDINGS, f"`{deployment.name}` does not answer; it may be ending"
        ) from None
    rows = [status.ProcessStatus.from_dict(row) for row in answer["rows"]]
    externals = [ExternalProgram.from_dict(fields) for fields in answer.get("externals", ())]
    links = [ConnectionStatus(**link) for link in answer.get("connections", ())]
    rows = _with_component_state(deployment, rows)
    return DeploymentReport(deployment, rows, answer["clock"], externals, links)


def _with_component_state(
    deployment: instances.RunningDeployment, rows: list[status.ProcessStatus]
) -> list[status.ProcessStatus]:
    """`rows` with the information of the components themselves."""
    from robocomp_dsl.deploy import component_queries  # noqa: PLC0415 - loads a middleware

    states = component_queries.fetch_states(
        deployment.domain,
        [row.name for row in rows if row.life and not row.members],
        CALL_TIMEOUT_S,
    )
    return [_row(row, states.get(row.name)) for row in rows]


def _row(row: status.ProcessStatus, state: ComponentState | None) -> status.ProcessStatus:
    if row.members:
        return row  # a group answers nothing; its components do
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
