"""`rcdeploy up`: runs a deployment. In: a DDSL file. Out: its outcome as an exit code."""

from __future__ import annotations

import contextlib
import io
import os
import sys
import time
from functools import partial
from pathlib import Path
from typing import Any

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import app as rcdeploy_app
from robocomp_dsl.deploy import instances, session
from robocomp_dsl.deploy.log_runs import LogRun
from robocomp_dsl.deploy.log_store import DAY_S, LogLimits, LogStore
from robocomp_dsl.deploy.plan import Plan
from robocomp_dsl.deploy.supervisor.requests import PlanRejected, Replan
from robocomp_dsl.deploy.supervisor.run_options import Options, Outcome
from robocomp_dsl.deploy.supervisor.system import unsupported_reason
from robocomp_dsl.runtime.presence.domain_names import NameTaken, reserve
from robocomp_dsl.runtime.private_folder import UnsafeFolder

MEGABYTE = 1_000_000


@click.command()
@rcdeploy_app.app
@options.folders
@rcdeploy_app.group
@click.option(
    "--name", metavar="NAME", help="Name of the running deployment; default: its name in the file."
)
@click.option("--domain", metavar="NAME", help="Communication domain; default: a new domain.")
@click.option(
    "--duration",
    type=click.FloatRange(min=0),
    metavar="S",
    help="Stop S seconds after all components are ready.",
)
@click.option(
    "--grace",
    type=click.FloatRange(min=0),
    default=5.0,
    show_default=True,
    metavar="S",
    help="Time for a component to exit after a stop request.",
)
@click.option(
    "--keep-going",
    is_flag=True,
    help="Keep the other components running after a permanent failure.",
)
@click.option(
    "--traceback",
    "show_traceback",
    is_flag=True,
    help="Log the traceback of each error in a component's code.",
)
@click.option(
    "--log-format",
    "output_format",
    type=click.Choice(["text", "json"]),
    default="text",
    help="Format of the log lines.",
)
@click.option(
    "--table/--no-table",
    "live",
    default=None,
    help="Show the status table below the log; default: on a terminal.",
)
@click.option(
    "--log-size",
    type=click.IntRange(min=1),
    default=LogLimits().size // MEGABYTE,
    show_default=True,
    metavar="MB",
    help="Limit of the stored logs of all runs together.",
)
@click.option(
    "--log-days",
    type=click.FloatRange(min=0),
    default=LogLimits().age_s / DAY_S,
    show_default=True,
    metavar="DAYS",
    help="Older logs are deleted.",
)
@click.option(
    "-f", "--follow", is_flag=True, help="On several hosts: show the logs until Ctrl-C afterwards."
)
@click.option(
    "--clock-limit",
    type=click.FloatRange(min=0),
    metavar="MS",
    help="On several hosts: warn if a clock differs by more; default: 50.",
)
def command(
    app: Path,
    folders: tuple[Path, ...],
    group: str | None,
    name: str | None,
    domain: str | None,
    show_traceback: bool,
    follow: bool,
    clock_limit: float | None,
    **how: Any,
) -> None:
    """Check the deployment, start its components in order, and supervise them.

    With components on other hosts: check all hosts, copy what they lack, start what differs, wait
    until all are ready, and return; systemd supervises them.

    The exit code is 0 if it was stopped on request or all components exited successfully, 1 for
    findings or a failed component, 141 if the reader of its output has gone.
    """
    if show_traceback:
        os.environ["ROBOCOMP_TRACEBACK"] = "1"
    checked = rcdeploy_app.check(app, folders, name, domain, group)
    with contextlib.suppress(OSError):  # a full disk does not keep a robot from running
        options.print_findings(checked.findings, "full", sys.stderr)
    if checked.plan is None or not checked.ready:
        raise CliError(
            EXIT_FINDINGS, f"{app}: nothing was started ({options.summary(checked.findings)})"
        )
    if checked.hosted:
        from robocomp_dsl.cli.rcdeploy import up_hosts  # noqa: PLC0415 - loads asyncssh

        up_hosts.reject_options(how)
        up_hosts.command(checked, follow=follow, clock_limit_ms=clock_limit)
        return
    if clock_limit is not None:
        raise click.UsageError("--clock-limit is for several hosts")
    if follow:
        raise click.UsageError("--follow is for several hosts; on one machine `up` shows the logs")
    _reject_hosted(checked.plan.name)
    if reason := unsupported_reason():
        raise CliError(EXIT_FINDINGS, reason)
    try:
        claim = instances.acquire(checked.plan.name)
    except instances.Unavailable as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    try:
        replan = partial(_replan, checked.plan, app, folders, name, group)
        outcome = _run(checked.plan, claim, replan, **how)
    finally:
        claim.release()
    if outcome.code:
        raise CliError(outcome.code, outcome.reason)


def _reject_hosted(name: str) -> None:
    """Raise `CliError` if a deployment of that name runs on other machines."""
    from robocomp_dsl.deploy.hosts import registry  # noqa: PLC0415 - seldom any

    for entry in registry.registered():
        if entry.name == name and not entry.is_stopped:
            hosts = ", ".join(host.name for host in entry.hosts)
            raise CliError(
                EXIT_FINDINGS,
                f"`{name}` runs on {hosts}; stop it with `rcdeploy stop {name}`, or use another"
                " --name",
            )


def _replan(
    running: Plan, app: Path, folders: tuple[Path, ...], name: str | None, group: str | None
) -> tuple[Plan, str]:
    """The plan of the file as it is now, in the same domain. Raises `PlanRejected`."""
    try:
        checked = rcdeploy_app.check(app, folders, name, running.domain, group)
    except click.UsageError as error:
        raise PlanRejected(error.message) from None
    text = io.StringIO()
    options.print_findings(checked.findings, "full", text)
    if checked.plan is None or not checked.ready:
        raise PlanRejected(f"{text.getvalue()}{app} has errors; nothing was changed")
    return checked.plan, text.getvalue().rstrip()


def _run(
    plan: Plan,
    claim: instances.InstanceLock,
    replan: Replan,
    *,
    output_format: str,
    live: bool | None,
    duration: float | None,
    grace: float,
    keep_going: bool,
    log_size: int,
    log_days: float,
) -> Outcome:
    from robocomp_dsl.cli.rcdeploy.terminal import Terminal  # noqa: PLC0415 - not for --help
    from robocomp_dsl.deploy.supervisor.domain_monitor import DomainMonitor  # noqa: PLC0415
    from robocomp_dsl.runtime.errors import MiddlewareError  # noqa: PLC0415

    try:
        reservation = reserve(plan.domain, (each.name for each in plan.components), plan.name)
    except (NameTaken, UnsafeFolder, OSError) as error:
        return Outcome(EXIT_FINDINGS, str(error))
    try:
        watch = DomainMonitor(plan.domain)
    except MiddlewareError as error:
        reservation.release()
        return Outcome(EXIT_FINDINGS, str(error))
    terminal = Terminal(
        sys.stdout,
        list(plan.names),
        live=output_format == "text" and (sys.stdout.isatty() if live is None else live),
        colours=options.use_colours(sys.stdout),
        as_json=output_format == "json",
    )
    how = Options(grace_s=grace, duration_s=duration, keep_going=keep_going)
    store = _open_log_store(plan, LogLimits(log_size * MEGABYTE, log_days * DAY_S))
    try:
        return session.run(plan, claim, watch, terminal, how, replan, store)
    finally:
        terminal.close()
        reservation.release()


def _open_log_store(plan: Plan, limits: LogLimits) -> LogStore | None:
    """Where the logs of this run are stored; None, and a warning, where they cannot be."""
    components = plan.names
    path = str(plan.path.resolve())
    run = LogRun(plan.name, path, plan.domain, os.getpid(), time.time(), components)
    try:
        return LogStore(run, limits)
    except OSError as error:
        with contextlib.suppress(OSError):
            print(f"warning: logs are not stored: {error}", file=sys.stderr)
        return None
