"""`rcdeploy plan`: what would be started. In: a DDSL file. Out: commands to read or to paste."""

from __future__ import annotations

import json
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.cli import options, rcdeploy_app
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.cli.render import harmless
from robocomp_dsl.deploy.plan import Plan, Process, waves
from robocomp_dsl.deploy.preflight import short


@click.command()
@rcdeploy_app.app
@options.folders
@rcdeploy_app.group
@click.option("--name", metavar="NAME", help="Run under this name; default: that of the file.")
@click.option("--domain", metavar="NAME", help="Isolate it under this name; default: a new one.")
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text")
def command(
    app: Path,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    form: str,
) -> None:
    """Show what `up` would start, in which order, with which wiring; start nothing.

    Exit code 1: it could not be started now; why is told on standard error.
    """
    checked = rcdeploy_app.check(app, folders, name, domain, group)
    options.show(checked.findings, "full", sys.stderr)
    if checked.plan is None:
        sys.exit(FINDINGS)
    if form == "json":
        print(json.dumps(as_data(checked.plan), indent=1))
    else:
        print("\n".join(map(harmless, as_text(checked.plan))))
    sys.exit(0 if checked.ready else FINDINGS)


def as_data(plan: Plan) -> dict[str, Any]:
    """The plan for programs."""
    return {
        "name": plan.name,
        "file": str(plan.path.resolve()),
        "domain": plan.domain,
        "middleware": plan.middleware,
        "clock": plan.clock,
        "processes": [_process(one) for one in plan.processes],
        "stop": plan.stop_waves(),
    }


def _process(one: Process) -> dict[str, Any]:
    return {
        "name": one.name,
        "component": one.component,
        "host": one.host,
        "group": one.group,
        "argv": list(one.argv),
        "cwd": str(one.cwd.resolve()),
        "env": dict(one.env),
        "after": list(one.after),
        "restart": {
            "policy": one.restart.policy,
            "max": one.restart.max,
            "window_s": one.restart.window_s,
        },
        "ready_within_s": one.ready_within_s,
        "port": one.port,
        "devices": list(one.devices),
    }


def as_text(plan: Plan) -> Iterator[str]:
    """The plan for people: commands that a shell understands."""
    yield f"{plan.name}: {len(plan.processes)} components on {plan.middleware}"
    yield f"domain {plan.domain}"
    yield f"clock {plan.clock}"
    for wave, names in enumerate(waves({p.name: set(p.after) for p in plan.processes}), start=1):
        for one in (p for p in plan.processes if p.name in names):
            yield ""
            yield from _described(one, wave)
    yield ""
    yield "stops: " + ", then ".join(" and ".join(wave) for wave in plan.stop_waves())


def _described(one: Process, wave: int) -> Iterator[str]:
    after = f" after {', '.join(one.after)}" if one.after else ""
    restart = one.restart.policy
    if restart != "never":
        restart += f" at most {one.restart.max} times in {one.restart.window_s:g} s"
    place = f" on {one.host}" if one.host else ""
    group = f" in group {one.group}" if one.group else ""
    yield f"{wave}. {one.name} ({one.component}){group}{place}{after}"
    yield f"   ready within {one.ready_within_s:g} s, restart {restart}"
    yield from (
        f"   {'devices' if not i else '       '} {line}" for i, line in enumerate(one.devices)
    )
    variables = [f"{key}={shlex.quote(value)}" for key, value in one.env]
    yield f"   cd {shlex.quote(short(one.cwd))} && " + " ".join([*variables, shlex.join(one.argv)])
