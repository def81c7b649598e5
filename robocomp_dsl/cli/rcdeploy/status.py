"""`rcdeploy status`: shows a deployment's components. Out: a table or JSON.

The engine knows the processes; lifecycles and state machines are queried from the components.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy import status
from robocomp_dsl.deploy.engine import DeploymentStatus, Engine, EngineError
from robocomp_dsl.deploy.external_connection import format_connections

if TYPE_CHECKING:
    from robocomp_dsl.deploy.component_queries import ComponentState

CALL_TIMEOUT_S = 0.5
"""For all components together; a running component replies within milliseconds."""
HOSTS_TIMEOUT_S = 2.0
"""The same over several hosts, whose network may be slow."""


@click.command()
@running.which
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(which: str | None, output_format: str) -> None:
    """Show the components of one deployment, or of all that you run. Exit code 0: all are well.

    A component is well if it is ready or has exited. JSON: without a name, an array of deployments.
    """
    engines = [running.resolve_deployment(which)] if which else running.all_deployments()
    reports = [_report(engine) for engine in engines]
    if output_format == "json":
        data = [report.as_data() for report in reports]
        print(json.dumps(data[0] if which else data, indent=1))
    else:
        width = shutil.get_terminal_size().columns if sys.stdout.isatty() else 1000
        colours = options.use_colours(sys.stdout)
        print("\n\n".join("\n".join(r.as_text(width, colours=colours)) for r in reports))
    rows = [row for report in reports for row in report.status.rows]
    well = all(row.state in (status.READY, status.EXITED) for row in rows)
    if not well or any(report.status.problems for report in reports):
        raise CliError(EXIT_FINDINGS)


@dataclass(frozen=True, slots=True)
class DeploymentReport:
    """The status of one deployment, as the command shows it."""

    engine: Engine
    status: DeploymentStatus

    def as_data(self) -> dict[str, Any]:
        """For JSON."""
        found = self.status
        return {
            **self.engine.as_dict(),
            "components": [row.as_dict() for row in found.rows],
            "clock": found.clock.as_dict() if found.clock else None,
            "externals": [program.as_dict() for program in found.externals],
            "connections": [connection.as_dict() for connection in found.connections],
            "problems": list(found.problems),
            "last_lines": {name: list(lines) for name, lines in found.last_lines.items()},
        }

    def as_text(self, width: int, *, colours: bool) -> list[str]:
        """A heading and a table."""
        engine, found = self.engine, self.status
        lines = [f"{engine.name}: {engine.path}, {engine.summary()}"]
        lines += [found.clock.format()] if found.clock else []
        lines += status.format_table(found.rows, width, colours=colours)
        lines += [" ".join(program.format()) for program in found.externals]
        lines += ["", *format_connections(found.connections)] if found.connections else []
        lines += ["", *found.problems] if found.problems else []
        lines += _last_lines(found)
        return lines + status.format_hangs(found.rows, time.time())


def _last_lines(found: DeploymentStatus) -> Iterator[str]:
    for name, log_lines in found.last_lines.items():
        from robocomp_dsl.cli.output.render import strip_control_chars  # noqa: PLC0415 - seldom

        yield from ("", f"{name} failed; the end of its log:")
        yield from (f"    {strip_control_chars(line)}" for line in log_lines)


def _report(engine: Engine) -> DeploymentReport:
    try:
        found = engine.status()
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    rows = _with_component_state(engine, found.rows)
    return DeploymentReport(engine, replace(found, rows=rows))


def _with_component_state(
    engine: Engine, rows: list[status.ProcessStatus]
) -> list[status.ProcessStatus]:
    """`rows` with the information of the components themselves."""
    from robocomp_dsl.deploy import component_queries  # noqa: PLC0415 - loads a middleware

    names = [row.name for row in rows if row.life and not row.members]
    over_hosts = any(row.host for row in rows)
    timeout_s = HOSTS_TIMEOUT_S if over_hosts else CALL_TIMEOUT_S
    states = component_queries.fetch_states(engine.domain, names, timeout_s)
    if over_hosts and not states:
        return rows  # the network is out of reach, not each component; systemd knows their states
    return [_row(row, states.get(row.name), timeout_s) for row in rows]


def _row(
    row: status.ProcessStatus, state: ComponentState | None, timeout_s: float
) -> status.ProcessStatus:
    if row.members:
        return row  # a group answers nothing; its components do
    if state is None:
        silent = f"does not answer within {timeout_s:g} s"
        return replace(row, note=row.note or silent) if row.life else row
    info = state.info
    return replace(
        row,
        life=info.state.name.lower(),
        machine=tuple(info.states),
        overruns=state.overruns,
        note=row.note or info.reason,
    )
