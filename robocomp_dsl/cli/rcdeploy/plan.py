"""`rcdeploy plan`: shows the processes to start. In: a DDSL file. Out: shell commands."""

from __future__ import annotations

import dataclasses
import json
import shlex
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.output.render import strip_control_chars
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.deploy.external_connection import describe_connection
from robocomp_dsl.deploy.plan import Plan, Process, batches
from robocomp_dsl.deploy.plan_text import format_readiness
from robocomp_dsl.deploy.units.names import service_name
from robocomp_dsl.model.deployment import ExternalConnection
from robocomp_dsl.model.limits_text import format_limits

if TYPE_CHECKING:
    from robocomp_dsl.deploy.checked_deployment import CheckedDeployment
    from robocomp_dsl.deploy.placement.placement_choice import PlacementChoice


@click.command()
@rcdeploy_app.app
@options.folders
@rcdeploy_app.group
@click.option(
    "--name", metavar="NAME", help="Name of the running deployment; default: its name in the file."
)
@click.option("--domain", metavar="NAME", help="Communication domain; default: a new domain.")
@click.option("--access", is_flag=True, help="Show who may use which ports over hosts.")
@click.option(
    "--hosts",
    "ask_hosts",
    is_flag=True,
    help="Ask the hosts for their load, and choose those of components without a host.",
)
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
def command(
    app: Path,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    access: bool,
    ask_hosts: bool,
    output_format: str,
) -> None:
    """Show the processes that `up` would start, their order and connections; start nothing.

    The command lines can be pasted into a shell. If the deployment is running, they join it. Over
    several hosts the units of systemd are shown.
    Without --hosts nothing is asked: hosts of `on label` and `place by load` are chosen by `up`.
    Exit code 1: it cannot be started now; standard error has the reasons.
    """
    checked = rcdeploy_app.check(app, folders, name, domain, group)
    options.print_findings(checked.findings, "full", sys.stderr)
    if checked.plan is None:
        raise CliError(EXIT_FINDINGS)
    plan = checked.plan
    choices: tuple[PlacementChoice, ...] = ()
    if ask_hosts and checked.ready:
        from robocomp_dsl.cli.rcdeploy.plan_hosts import placed_plan  # noqa: PLC0415 - loads asyncssh

        if placed := placed_plan(checked):
            plan, choices = placed.plan, tuple(placed.choices)
    if access:
        _print_access(checked, output_format)
    elif output_format == "json":
        print(json.dumps(as_data(plan, choices), indent=1))
    else:
        lines = [*as_text(plan, hosted=checked.hosted), *_chosen(choices)]
        print("\n".join(map(strip_control_chars, lines)))
    if not checked.ready:
        raise CliError(EXIT_FINDINGS)


def _print_access(checked: CheckedDeployment, output_format: str) -> None:
    from robocomp_dsl.deploy.network.access_rules import access_rules  # noqa: PLC0415
    from robocomp_dsl.deploy.network.access_text import access_data, access_text  # noqa: PLC0415
    from robocomp_dsl.deploy.network.identities import needs_network  # noqa: PLC0415

    assert checked.deployment is not None  # noqa: S101 - there is a plan
    assert checked.plan is not None  # noqa: S101
    if not needs_network(checked.deployment):
        print("all components are on this machine: its user may use everything")
        return
    rules = access_rules(checked.deployment, checked.plan.domain)
    if output_format == "json":
        print(json.dumps(access_data(rules), indent=1))
    else:
        print("\n".join(map(strip_control_chars, access_text(rules))))


def _chosen(choices: Sequence[PlacementChoice]) -> Iterator[str]:
    """How the hosts were chosen, with the numbers."""
    if not choices:
        return
    from robocomp_dsl.deploy.placement.placement_text import placement_lines  # noqa: PLC0415

    yield ""
    yield "hosts, as chosen now:"
    yield from (f"   {line}" for line in placement_lines(choices))


def as_data(plan: Plan, choices: Sequence[PlacementChoice] = ()) -> dict[str, Any]:
    """The plan as JSON data; `choices` of hosts with their numbers."""
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
        "placement": [dataclasses.asdict(choice) for choice in choices],
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
        "placement": process.placement,
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


def as_text(plan: Plan, *, hosted: bool = False) -> Iterator[str]:
    """The plan as text with shell commands; `hosted`: with units of systemd on several hosts."""
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
            unit = service_name(plan.name, name)
            yield _unit_line(by_name[name], unit) if hosted else _shell_line(by_name[name])
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
    if process.placement:
        place = f" {process.placement}, placed when started"
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


def _shell_line(process: Process) -> str:
    # In a subshell with an absolute path, so that the lines can be pasted one after the other.
    variables = [f"{key}={shlex.quote(value)}" for key, value in process.env]
    command = " ".join([*variables, shlex.join(process.argv)])
    return f"   (cd {shlex.quote(str(process.cwd.resolve()))} && {command})"


def _unit_line(process: Process, unit: str) -> str:
    """The unit and its command line, in which the host has paths of its own."""
    words = ["python3" if word == sys.executable else word for word in process.argv]
    variables = [f"{key}={shlex.quote(value)}" for key, value in process.env]
    return f"   {unit}: {' '.join([*variables, shlex.join(words)])}"
