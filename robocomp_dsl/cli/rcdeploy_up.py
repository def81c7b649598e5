"""`rcdeploy up`: run a deployment. In: a DDSL file. Out: its outcome as an exit code."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.cli import options, rcdeploy_app, rcdeploy_running
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.deploy import folder, session
from robocomp_dsl.deploy.engines.local import Options, Outcome, lacking
from robocomp_dsl.deploy.plan import Plan


@click.command()
@rcdeploy_app.app
@options.folders
@rcdeploy_app.group
@click.option("--name", metavar="NAME", help="Run under this name; default: that of the file.")
@click.option("--domain", metavar="NAME", help="Isolate it under this name; default: a new one.")
@click.option(
    "--duration",
    type=click.FloatRange(min=0),
    metavar="S",
    help="Stop S seconds after all are ready.",
)
@click.option(
    "--grace",
    type=click.FloatRange(min=0),
    default=5.0,
    show_default=True,
    metavar="S",
    help="Time of a component to end when it is told to.",
)
@click.option("--keep-going", is_flag=True, help="Go on when a component has failed for good.")
@click.option(
    "--log-format",
    "form",
    type=click.Choice(["text", "json"]),
    default="text",
    help="How lines are shown.",
)
@click.option(
    "--table/--no-table",
    "live",
    default=None,
    help="The status below the lines; default: on a terminal.",
)
def command(
    app: Path,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    **how: Any,
) -> None:
    """Check everything, start the components in order, and care for them until they are stopped.

    Exit code 0: stopped on request, or all ended well; 1: findings, or a component failed.
    """
    checked = rcdeploy_app.check(app, folders, name, domain, group)
    options.show(checked.findings, "full", sys.stderr)
    if checked.plan is None or not checked.ready:
        options.complain(f"{app}: nothing was started ({options.summary(checked.findings)})")
        sys.exit(FINDINGS)
    if reason := lacking():
        rcdeploy_running.fail(reason)
    try:
        claim = folder.claim(checked.plan.name)
    except folder.Unavailable as error:
        rcdeploy_running.fail(str(error))
    try:
        outcome = _run(checked.plan, claim, **how)
    finally:
        claim.release()
    if outcome.code:
        rcdeploy_running.fail(outcome.reason)


def _run(
    plan: Plan,
    claim: folder.Claim,
    *,
    form: str,
    live: bool | None,
    duration: float | None,
    grace: float,
    keep_going: bool,
) -> Outcome:
    from robocomp_dsl.cli.rcdeploy_terminal import Terminal  # noqa: PLC0415 - not for --help
    from robocomp_dsl.deploy.engines.zenoh_watch import ZenohWatch  # noqa: PLC0415
    from robocomp_dsl.runtime.errors import MiddlewareError  # noqa: PLC0415

    try:
        watch = ZenohWatch(plan.domain)
    except MiddlewareError as error:
        return Outcome(FINDINGS, str(error))
    terminal = Terminal(
        sys.stdout,
        [one.name for one in plan.processes],
        live=form == "text" and (sys.stdout.isatty() if live is None else live),
        colours=options.colours_on(sys.stdout),
        as_json=form == "json",
    )
    how = Options(grace_s=grace, duration_s=duration, keep_going=keep_going)
    try:
        return session.run(plan, claim, watch, terminal, how)
    finally:
        terminal.close()
