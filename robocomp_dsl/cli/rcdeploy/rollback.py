"""`rcdeploy rollback`: runs an earlier version on all hosts. In: a deployment. Out: progress."""

from __future__ import annotations

import time

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running


@click.command()
@running.which
@click.argument("version", type=click.IntRange(min=1), required=False)
@click.option("--list", "list_versions", is_flag=True, help="List the stored versions instead.")
def command(which: str | None, version: int | None, *, list_versions: bool) -> None:
    """Run a stored version of a deployment over hosts; without VERSION: the one before.

    Only what differs restarts. The next `rcdeploy up` deploys the description again.
    """
    if which is not None and which.isdecimal() and version is None:
        version, which = int(which), None
    engine = running.resolve_deployment(which)
    from robocomp_dsl.deploy.engine import EngineError  # noqa: PLC0415 - not for --help
    from robocomp_dsl.deploy.hosts.host_engine import HostEngine  # noqa: PLC0415 - loads asyncssh

    if not isinstance(engine, HostEngine):
        text = f"`{engine.name}` runs on this machine only; versions are stored on other hosts"
        raise CliError(EXIT_FINDINGS, text)
    try:
        if list_versions:
            for stored in engine.versions():
                when = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(stored.created))
                current = "  current" if stored.is_current else ""
                listed = ", ".join(stored.hosts)
                print(f"{stored.version:4}  {when}  {stored.author}  on {listed}{current}")
            return
        result = engine.roll_back(version or 0, running.say)
    except EngineError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if not result.changes:
        print(f"{engine.name}: version {result.version} runs already")
    elif result.failed:
        raise CliError(EXIT_FINDINGS, f"failed: {', '.join(result.failed)}")
    else:
        print(f"{engine.name}: version {result.version} runs")
