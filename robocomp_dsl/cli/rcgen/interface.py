"""`rcgen interface`: exports an interface to another format.

In: an IDSL file. Out: its files in another format; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import FORMATS, export
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="X.idsl")
@click.option("--to", required=True, type=click.Choice(tuple(FORMATS)), help="The target format.")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder; without it, a single file is written to standard output.",
)
@click.option("--alone", is_flag=True, help="Do not export imported files.")
@click.option("-q", "quiet", is_flag=True, help="Print findings only.")
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    to: str,
    output: Path | None,
    alone: bool,
    quiet: bool,
    output_format: str,
    folders: tuple[Path, ...],
) -> None:
    """Export an interface as Slice (Ice), as ROS 2 messages and services, or as JSON Schema.

    Imported files are exported as well. Features that the format cannot express are reported.
    """
    report = Report()
    modules = check_idsl(file, Workspace(folders), report)
    files: tuple[OutputFile, ...] = ()
    if modules and not report.has_errors:
        exported = export(modules, to, alone=alone)
        report.extend(exported.findings)
        files = exported.files
    options.print_findings(report.sorted(), output_format, sys.stderr)
    if report.has_errors:
        raise CliError(EXIT_FINDINGS)
    if not files:
        raise CliError(EXIT_FINDINGS, f"`{file}` declares nothing that could be exported")
    if output is None and len(files) > 1:
        less = "" if alone or to != "slice" else ", or leave out imports with --alone"
        raise click.UsageError(
            f"{len(files)} files would be written ({_listed(files)}); use -o DIR{less}"
        )
    _hand_out(files, output, quiet)


def _hand_out(files: tuple[OutputFile, ...], folder: Path | None, quiet: bool) -> None:
    if folder is None:
        options.write_text(files[0].text, sys.stdout)
        return
    try:
        changes = write(folder, list(files))
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if not quiet:
        written = sum(change.pending for change in changes)
        print(f"{folder}: {written} of {len(changes)} files written")


def _listed(files: tuple[OutputFile, ...]) -> str:
    shown = ", ".join(file.path for file in files[:3])
    return f"{shown}, …" if len(files) > 3 else shown
