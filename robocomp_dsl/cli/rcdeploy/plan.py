"""`rcdeploy plan`: shows the processes to start. In: a DDSL file. Out: shell commands."""

from __future__ import annotations

import json
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.output.render import strip_control_chars
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.deploy.external_connection import describe_connection
from robocomp_dsl.deploy.plan import Plan, Process, batches
from robocomp_dsl.deploy.plan_text import format_readiness
from robocomp_dsl.model.deployment import ExternalConnection
from robocomp_dsl.model.limits_text import format_limits


@click.command()
@rcdeploy_app.app
@options.folders
@rcdeploy_app.group
@click.option(
    "--name", metavar="NAME", help="Name of the running deployment; default: its name in the file."
)
@click.option("--domain", metavar="NAME", help="Communication domain; default: a new domain.")
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(
    app: Path,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    output_format: str,
) -> None:
    """Show the processes that `up` would start, their order and connections; start nothing.

    The command lines can be pasted into a shell. If the deployment is running, they join it.
    Exit code 1: it cannot be started now; standard error has the reasons.
    """
    checked = rcdeploy_app.check(app, folders, name, domain, group)
    options.print_findings(checked.findings, "full", sys.stderr)
    if checked.plan is None:
        raise CliError(EXIT_FINDINGS)
    if output_format == "json":
        print(json.dumps(as_data(checked.plan), indent=1))
    else:
        print("\n".join(map(strip_control_chars, as_text(checked.plan))))
    if not checked.ready:
        raise CliError(EXIT_FINDINGS)


def as_data(plan: Plan) -> dict[str, Any]:
    """The plan as JSON data."""
    return {
        "name": plan.name,
        "file": str(plan.path.resolve()),
        "domain": plan.domain,
        "middlewares": list(plan.middlewares),
        "clock": plan.clock,
        "processes": [_process(process) for process in plan.processes],
        "groups": [group.as_dict() for group in plan.groups],
        "externals": [program.as_dict() for program in plan.externals],
        "external_connections": [_connection(each) for each in plan.external_connections],
        "stop": plan.shutdown_batches(),
    }


def _connection(connection: ExternalConnection) -> dict[str, str]:
    return {
        "middleware": connection.middleware,
        "source": connection.source,
        "target": connection.target,
        "carrier": connection.carrier,
    }


def _process(process: Process) -> dict[str, Any]:
    return {
        "name": process.name,
        "component": process.component,
        "host": process.host,
        "group": process.group,
        "argv": list(process.argv),
        "cwd": str(process.cwd.resolve()),
        "env": dict(process.env),
        "after": list(process.after),
        "restart": {
            "policy": process.restart.policy,
            "max": process.restart.max,
            "window_s": process.restart.window_s,
        },
        "start_timeout_s": process.start_timeout_s,
        "ready": format_readiness(process.readiness),
        "limits": {
            "memory_bytes": process.limits.memory_bytes,
            "cpu": process.limits.cpu,
            "cores": list(process.limits.cores),
            "realtime": process.limits.realtime,
        },
        "port": process.port,
        "devices": list(process.devices),
        "members": [_process(member) for member in process.members],
    }


def as_text(plan: Plan) -> Iterator[str]:
    """The plan as text with shell commands."""
    over = f" over {', '.join(plan.middlewares)}" if plan.middlewares else ""
    count = len(plan.components)
    yield f"{plan.name}: {count} component{'s' * (count != 1)}{over}"
    yield f"domain {plan.domain}"
    yield f"clock {plan.clock}"
    by_name = {process.name: process for process in plan.processes}
    for wave, names in enumerate(batches({p.name: set(p.after) for p in plan.processes}), start=1):
        for name in names:
            yield ""
            yield from _described(by_name[name], wave)
    for group in plan.groups:
        yield from ("", *group.format())
    for program in plan.externals:
        port, connected = program.format()
        yield from ("", port, f"   {connected}")
    if plan.external_connections:
        yield ""
        yield "connections that rcdeploy makes and keeps:"
    for connection in plan.external_connections:
        yield f"   {describe_connection(connection)}"
    if not plan.processes:
        return
    yield ""
    yield "stops: " + ", then ".join(" and ".join(wave) for wave in plan.shutdown_batches())


def _described(process: Process, wave: int) -> Iterator[str]:
    after = f" after {', '.join(process.after)}" if process.after else ""
    restart = process.restart.policy
    if restart != "never":
        restart += f" at most {process.restart.max} times in {process.restart.window_s:g} s"
    place = f" on {process.host}" if process.host else ""
    group = f" in group {process.group}" if process.group else ""
    yield f"{wave}. {process.name} ({process.component}){group}{place}{after}"
    ready = " ".join(filter(None, ["ready", format_readiness(process.readiness)]))
    yield f"   {ready} within {process.start_timeout_s:g} s, restart {restart}"
    for member in process.members:
        after = f" after {', '.join(member.after)}" if member.after else ""
        yield f"   runs {member.name} ({member.component}){after}"
    if limits := format_limits(process.limits):
        yield f"   {limits}"
    yield from (
        f"   {'devices' if not i else '       '} {line}" for i, line in enumerate(process.devices)
    )
    variables = [f"{key}={shlex.quote(value)}" for key, value in process.env]
    # In a subshell with an absolute path, so that the lines can be pasted one after the other.
    command = " ".join([*variables, shlex.join(process.argv)])
    yield f"   (cd {shlex.quote(str(process.cwd.resolve()))} && {command})"
