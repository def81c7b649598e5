"""`rcgen fmt`: formats files. In: files and folders. Out: the files in canonical style."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click

from robocomp_dsl.check.languages import check_syntax
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.inputs import expand_inputs
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.rewrite_file import BOM, rewrite_file, unified_diff
from robocomp_dsl.diagnostics import Report, Severity
from robocomp_dsl.format.formatter import PARSERS, CannotFormat, format_source
from robocomp_dsl.generate.write import CannotWrite
from robocomp_dsl.source import Source, UnreadableSource, declare_utf8, decode

STDIN = Path("-")


@click.command()
@options.files
@click.option(
    "--check", "checking", is_flag=True, help="Write nothing; list the files that would change."
)
@click.option("--diff", is_flag=True, help="Write nothing; show the changes as a diff.")
@click.option(
    "--stdin-filename",
    "name",
    type=click.Path(readable=False, path_type=Path),
    metavar="NAME",
    help="With `-`: a file name for the text; it determines the language.",
)
@click.option("-q", "quiet", is_flag=True, help="Print no summary.")
def command(
    *, files: tuple[Path, ...], checking: bool, diff: bool, name: Path | None, quiet: bool
) -> None:
    """Format description files in place; `-` is standard input.

    A folder means all its files except XML. A file with syntax errors is not changed; its errors
    are printed and the exit code is 1. With --check the exit code is also 1 if a file would change.
    """
    if (STDIN in files) != (name is not None) or (STDIN in files and len(files) > 1):
        raise click.UsageError(
            "`-` must be the only file and requires --stdin-filename, for example x.cdsl"
        )
    run = _FormatRun()
    if name:
        run.add_stdin(name)
    else:
        found = expand_inputs(files)
        run.add_files([item for item in found if item in files or item.suffix.lower() in PARSERS])
    if diff:
        run.show_differences()
    elif checking:
        run.list_changes(quiet)
    elif name:
        run.print_stdin(name)
    else:
        run.write(quiet)
    sys.stdout.flush()
    options.print_findings(run.report.sorted(), "full", sys.stderr)
    failed = run.failed or run.report.has_errors
    if failed or (checking and run.changing):
        raise CliError(EXIT_FINDINGS)


class _FormatRun:
    """The texts of one run: `new` is the formatted text of each, if known."""

    def __init__(self) -> None:
        self.report = Report()
        self.failed = False
        self.new: dict[Path, str] = {}
        self.old: dict[Path, str] = {}
        self._workspace = Workspace(())
        self._mark = ""

    @property
    def changing(self) -> list[Path]:
        return [path for path, text in self.new.items() if text != self.old[path]]

    def add_files(self, paths: Sequence[Path]) -> None:
        for path in paths:
            self._add(path)

    def add_stdin(self, name: Path) -> None:
        data = sys.stdin.buffer.read()
        try:
            text = decode(data)
        except UnreadableSource as error:
            self._report_failure(f"standard input cannot be read: {error}")
            return
        self._mark = BOM if data.startswith(BOM.encode()) else ""
        self._workspace.sources.set_overlay(name, text)
        self._add(name)

    def _add(self, path: Path) -> None:
        found = Report()
        check_syntax(path, self._workspace, found)
        if found.has_errors:
            self.report.extend(item for item in found if item.severity is Severity.ERROR)
            return
        if path.suffix.lower() not in PARSERS:
            self._report_failure(
                f"`{path}` is not formatted: there is no formatter for its language"
            )
            return
        source: Source = self._workspace.sources.read(path)
        try:
            new = format_source(source, list(found))
        except CannotFormat as error:
            self._report_failure(f"`{path}` is not formatted: {error}")
            return
        if new is not None:
            self.old[path], self.new[path] = source.text, new

    def show_differences(self) -> None:
        for path in self.changing:
            sys.stdout.write(unified_diff(path, self.old[path], self.new[path]))

    def list_changes(self, quiet: bool) -> None:
        for path in self.changing:
            print(path)
        self._print_summary("would be formatted", quiet)

    def print_stdin(self, name: Path) -> None:
        text = self._mark + declare_utf8(self.new.get(name, ""))
        sys.stdout.buffer.write(text.encode())

    def write(self, quiet: bool) -> None:
        for path in self.changing:
            try:
                rewrite_file(path, self.new[path])
            except CannotWrite as error:
                self._report_failure(str(error))
                del self.new[path]
        self._print_summary("formatted", quiet)

    def _report_failure(self, message: str) -> None:
        options.print_error(message)
        self.failed = True

    def _print_summary(self, what: str, quiet: bool) -> None:
        if quiet:
            return
        changed = len(self.changing)
        left = len(self.new) - changed
        parts = [f"{_files(changed)} {what}"] if changed or not left else []
        parts += [f"{_files(left)} unchanged"] if left else []
        print(", ".join(parts), file=sys.stderr)


def _files(count: int) -> str:
    return f"{count} file{'s' if count != 1 else ''}"
