"""`rcdeploy logs`: prints logs. In: a deployment, filters. Out: log lines of one run, old and new.

The stored run is read first; what is newer comes from the running deployment itself.
"""

from __future__ import annotations

import re
import sys
import time
from collections import deque
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.cli.rcdeploy.log_selection import SelectedRun, describe_runs, select_run
from robocomp_dsl.deploy import control, instances
from robocomp_dsl.deploy.log_filter import LEVELS, LogFilter, parse_since
from robocomp_dsl.deploy.log_runs import read_records
from robocomp_dsl.deploy.logs import RCDEPLOY, LogRecord, format_record

if TYPE_CHECKING:
    from robocomp_dsl.deploy.hosts.registry import HostedDeployment


@click.command()
@running.which
@click.option("-f", "--follow", is_flag=True, help="Also print new lines as they appear.")
@click.option(
    "--run",
    "run",
    type=int,
    default=0,
    metavar="N",
    help="The run: 0 is the latest, -1 the one before it; or its number.",
)
@click.option("--runs", "list_runs", is_flag=True, help="List the stored runs instead.")
@click.option(
    "-n", "--last", type=click.IntRange(min=0), metavar="N", help="Only the last N lines."
)
@click.option(
    "-c", "--component", multiple=True, metavar="NAME", help="Only this component; repeatable."
)
@click.option(
    "--level", type=click.Choice(LEVELS), default=None, help="Only lines of this level or above."
)
@click.option(
    "--since", metavar="TIME", help="Only lines since: 10 min, 20:15 or '2026-11-22 20:15'."
)
@click.option("--grep", metavar="REGEX", help="Only lines that match; (?i)… ignores case.")
@click.option("--format", "output_format", type=click.Choice(["text", "json"]), default="text")
@click.option("--json", "output_format", flag_value="json", help="As --format json.")
def command(
    which: str | None,
    *,
    follow: bool,
    run: int,
    list_runs: bool,
    last: int | None,
    component: tuple[str, ...],
    level: str | None,
    since: str | None,
    grep: str | None,
    output_format: str,
) -> None:
    """Show the logs of a deployment while it runs, after its end, and after a crash."""
    if list_runs:
        print("\n".join(describe_runs(which)))
        return
    if (hosted := _hosted(which)) is not None:
        if run:
            text = f"`{hosted.name}` runs on hosts, which keep one log; use --since"
            raise CliError(EXIT_FINDINGS, text)
        from robocomp_dsl.cli.rcdeploy import host_logs  # noqa: PLC0415 - loads asyncssh

        members = (name for _, names in hosted.members for name in names)
        known = [*(name for name, _ in hosted.places), *members]
        names = {running.resolve_component(name, known) for name in component}
        chosen = LogFilter(names, level or "", _since(since), _pattern(grep))
        printer = _Printer(as_json=output_format == "json", follow=follow)
        host_logs.print_logs(hosted, chosen, printer.print, last=last, follow=follow)
        return
    selected = select_run(which, run)
    chosen = LogFilter(
        components=_components(component, selected),
        level=level or "",
        since=_since(since),
        pattern=_pattern(grep),
    )
    if follow and selected.deployment is None:
        print(f"this run of `{selected.name}` has ended; nothing will follow", file=sys.stderr)
    printer = _Printer(as_json=output_format == "json", follow=follow)
    source = _Source(selected)
    records = filter(chosen.matches, source.past())
    for record in records if last is None else deque(records, last):
        printer.print(record)
    if follow:
        for record in filter(chosen.matches, source.future()):
            printer.print(record)


def _hosted(which: str | None) -> HostedDeployment | None:
    """The deployment over hosts that is meant; also one that was stopped, if it is named."""
    from robocomp_dsl.deploy.hosts import registry  # noqa: PLC0415 - not for --help

    entries = list(registry.registered())
    if which is None:
        entries = [entry for entry in entries if not entry.is_stopped]
        supervised = instances.running() if entries else []
        return entries[0] if len(entries) == 1 and not supervised else None
    return next((e for e in entries if which == e.name or _is_file(which, e.path)), None)


def follow_hosted(name: str) -> None:
    """Show what a deployment over hosts logs from now on, until Ctrl-C. Raises `CliError`."""
    from robocomp_dsl.cli.rcdeploy import host_logs  # noqa: PLC0415 - loads asyncssh

    if (hosted := _hosted(name)) is not None:
        printer = _Printer(as_json=False, follow=True)
        host_logs.print_logs(hosted, LogFilter(), printer.print, last=0, follow=True)


def _is_file(which: str, path: str) -> bool:
    return str(Path(which).resolve()) == path


class _Printer:
    """Prints records as lines; the column of the names grows with the names."""

    def __init__(self, *, as_json: bool, follow: bool) -> None:
        self._as_json = as_json
        self._follow = follow
        self._colours = options.use_colours(sys.stdout)
        self._width = 0

    def print(self, record: LogRecord) -> None:
        self._width = max(self._width, len(record.label))
        text = (
            record.to_json()
            if self._as_json
            else format_record(record, self._width, colours=self._colours)
        )
        print(text, flush=self._follow)


class _Source:
    """The records of one run, each of them once."""

    def __init__(self, selected: SelectedRun) -> None:
        self._selected = selected
        self._last = 0

    def past(self) -> Iterator[LogRecord]:
        """The stored records, then those that the running deployment has in addition."""
        if self._selected.folder is not None:
            yield from self._counted(read_records(self._selected.folder))
        yield from self._live(follow=False)

    def future(self) -> Iterator[LogRecord]:
        """What follows, until the deployment ends."""
        yield from self._live(follow=True)

    def _live(self, *, follow: bool) -> Iterator[LogRecord]:
        if self._selected.deployment is None:
            return
        request = {"verb": "logs", "follow": follow, "after": self._last}
        replies = control.send_request(self._selected.deployment.name, request)
        try:
            yield from self._counted(LogRecord(**reply) for reply in replies)
        except instances.Unavailable as error:
            raise CliError(EXIT_FINDINGS, str(error)) from None

    def _counted(self, records: Iterable[LogRecord]) -> Iterator[LogRecord]:
        for record in records:
            self._last = max(self._last, record.sequence)
            yield record


def _components(names: tuple[str, ...], selected: SelectedRun) -> set[str]:
    if not names:
        return set()
    known = [RCDEPLOY, *selected.components]
    return {running.resolve_component(name, known) for name in names}


def _since(text: str | None) -> float:
    try:
        return parse_since(text, time.time()) if text else 0.0
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--since") from None


def _pattern(text: str | None) -> re.Pattern[str] | None:
    try:
        return re.compile(text) if text else None
    except re.error as error:
        message = f"`{text}` is not a regular expression: {error}"
        raise click.BadParameter(message, param_hint="--grep") from None
