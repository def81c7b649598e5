"""`rcgen interface`: exports interfaces to another format.

In: IDSL files and folders. Out: their files in another format; findings on standard error.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click

from robocomp_dsl.check.passes import check_idsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.inputs import expand_inputs
from robocomp_dsl.cli.output.left_out import describe_left_out
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.export import FORMATS, export
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.write import CannotWrite, write


@click.command()
@click.argument(
    "files",
    type=click.Path(readable=False, path_type=Path),
    nargs=-1,
    required=True,
    metavar="X.idsl|FOLDER...",
)
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
    files: tuple[Path, ...],
    to: str,
    output: Path | None,
    alone: bool,
    quiet: bool,
    output_format: str,
    folders: tuple[Path, ...],
) -> None:
    """Export interfaces as Slice (Ice), as ROS 2 messages and services, or as JSON Schema.

    Imported files are exported as well. Features that the format cannot express are reported.
    Files with errors are reported and left out; the exit code is then 1.
    """
    report = Report()
    workspace = Workspace(folders)
    paths = _interface_files(files)
    exported: dict[str, OutputFile] = {}
    left_out = []
    for path in paths:
        own = Report()
        modules = check_idsl(path, workspace, own)
        if modules and not own.has_errors:
            result = export(modules, to, alone=alone)
            own.extend(result.findings)
            if not own.has_errors:
                exported |= {file.path: file for file in result.files}
        report.extend(own)
        if own.has_errors:
            left_out.append(path)
    options.print_findings(report.sorted(), output_format, sys.stderr)
    if len(left_out) == len(paths):
        raise CliError(EXIT_FINDINGS)
    outputs = tuple(exported.values())
    if not outputs:
        named = f"`{files[0]}` declares" if len(files) == 1 else "these files declare"
        raise CliError(EXIT_FINDINGS, f"{named} nothing that could be exported")
    if output is None and len(outputs) > 1:
        less = "" if alone or to != "slice" else ", or leave out imports with --alone"
        raise click.UsageError(
            f"{len(outputs)} files would be written ({_listed(outputs)}); use -o DIR{less}"
        )
    _hand_out(outputs, output, quiet)
    if left_out:
        message = describe_left_out(left_out, len(paths), "exported")
        raise CliError(EXIT_FINDINGS, message)


def _interface_files(inputs: Sequence[Path]) -> list[Path]:
    """The named files, and the IDSL files in folders. Raises `CliError` if there are none."""
    named = [path for path in inputs if not path.is_dir()]
    inside = expand_inputs([path for path in inputs if path.is_dir()]) if named != [*inputs] else []
    paths = [*named, *(path for path in inside if path.suffix.lower() == ".idsl")]
    if not paths:
        folders = ", ".join(f"`{path}`" for path in inputs)
        raise CliError(EXIT_FINDINGS, f"there are no IDSL files in {folders}")
    return list(dict.fromkeys(paths))


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
