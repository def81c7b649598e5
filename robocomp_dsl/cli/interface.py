"""`rcgen interface`: an interface for tools that know nothing of IDSL.

In: an IDSL file. Out: its files in another format; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click

from robocomp_dsl.check import check_idsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import FORMATS, export
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="X.idsl")
@click.option("--to", required=True, type=click.Choice(tuple(FORMATS)), help="The format.")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Write there; without it, one file goes to standard output.",
)
@click.option("--alone", is_flag=True, help="Leave out what the file imports.")
@click.option("-q", "quiet", is_flag=True, help="Say nothing but findings.")
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    to: str,
    output: Path | None,
    alone: bool,
    quiet: bool,
    form: str,
    folders: tuple[Path, ...],
) -> None:
    """Write an interface as Slice (Ice), as messages and services of ROS 2, or as JSON Schema.

    What it imports is written as well. What the format cannot say as IDSL does is a finding.
    """
    report = Report()
    modules = check_idsl(file, Workspace(folders), report)
    files: tuple[OutputFile, ...] = ()
    if modules and not report.failed:
        made = export(modules, to, alone=alone)
        report.extend(made.findings)
        files = made.files
    options.show(report.sorted(), form, sys.stderr)
    if report.failed:
        sys.exit(FINDINGS)
    if not files:
        options.complain(f"`{file}` declares nothing that could be exported")
        sys.exit(FINDINGS)
    if output is None and len(files) > 1:
        less = "" if alone or to != "slice" else ", or leave out imports with --alone"
        raise click.UsageError(
            f"{len(files)} files result ({_listed(files)}); say with -o DIR where they go{less}"
        )
    _hand_out(files, output, quiet)


def _hand_out(files: tuple[OutputFile, ...], folder: Path | None, quiet: bool) -> None:
    if folder is None:
        options.write_text(files[0].text, sys.stdout)
        return
    try:
        changes = write(folder, list(files))
    except CannotWrite as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    if not quiet:
        written = sum(one.pending for one in changes)
        print(f"{folder}: {written} of {len(changes)} files written")


def _listed(files: tuple[OutputFile, ...]) -> str:
    shown = ", ".join(one.path for one in files[:3])
    return f"{shown}, …" if len(files) > 3 else shown
