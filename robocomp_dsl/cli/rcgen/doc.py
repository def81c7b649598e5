"""`rcgen doc`: writes documentation.

In: files and folders of descriptions. Out: pages; findings on standard error.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.inputs import expand_inputs
from robocomp_dsl.cli.output.left_out import describe_left_out
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.regular_file import open_regular

if TYPE_CHECKING:
    from robocomp_dsl.generate.output import OutputFile

FORMATS = {"html": ("html",), "markdown": ("markdown",), "both": ("html", "markdown")}
FOLDERS = (
    "bridges",
    "components",
    "deployments",
    "interfaces",
    "modules",
    "parameters",
    "statemachines",
)
"""Folder of the other pages, beside the first one."""
MARK_BYTES = 1000
"""The mark of generated files is within this number of bytes."""


@click.command()
@options.files
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    default=Path("build/doc"),
    show_default=True,
    metavar="DIR",
    help="Output folder.",
)
@click.option(
    "--format",
    "output_format",
    type=click.Choice(tuple(FORMATS)),
    default="html",
    show_default=True,
    help="Output format.",
)
@click.option("--title", metavar="WORDS", help="Title of the index page.")
@click.option("-q", "quiet", is_flag=True, help="Print findings only.")
@options.folders
def command(
    files: tuple[Path, ...],
    output: Path,
    output_format: str,
    title: str | None,
    quiet: bool,
    folders: tuple[Path, ...],
) -> None:
    """Generate linked documentation of interfaces, components and deployments.

    Imported files are included. Files with errors are reported and left out; the exit code is then
    1. Files that `rcgen doc` did not write are never changed.
    """
    from robocomp_dsl.cli.rcgen.doc_subject import read_subject  # noqa: PLC0415 - help needs no checks
    from robocomp_dsl.generate.doc.documentation import documentation  # noqa: PLC0415
    from robocomp_dsl.generate.write import CannotWrite  # noqa: PLC0415

    report = Report()
    paths = _paths(files)
    left_out: list[Path] = []
    workspace = Workspace(folders)
    subject = read_subject(paths, title or _title(files), workspace, report, left_out)
    options.print_findings(report.sorted(), "full", sys.stderr)
    if len(left_out) == len(paths):
        raise CliError(EXIT_FINDINGS)
    try:
        summary = _write(output, documentation(subject, FORMATS[output_format]))
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    if not quiet:
        print(summary)
    if left_out:
        raise CliError(EXIT_FINDINGS, describe_left_out(left_out, len(paths), "documented"))


def _paths(files: Sequence[Path]) -> list[Path]:
    """The description files. Raises `CliError` if there are none."""
    paths = expand_inputs(files)
    for path in paths:
        if path.suffix.lower() == ".xml":
            raise click.UsageError(f"`{path}`: bodies have no documentation, leave it out")
    return paths


def _title(files: Sequence[Path]) -> str:
    """The name of the only file or folder, or of the one around them."""
    only = files[0] if len(files) == 1 else Path()
    return only.stem or only.resolve().name or "Robot"


def _write(output: Path, files: Sequence[OutputFile]) -> str:
    """Write the pages and return a summary. Raises `CannotWrite`."""
    from robocomp_dsl.generate.write import CannotWrite, compare, write  # noqa: PLC0415

    for change in compare(output, files):
        if change.old is not None and not _is_generated(change.old):
            where = f"`{output / change.file.path}` is not a page of an earlier run"
            raise CannotWrite(f"{where}; move it, or choose another folder with -o")
    changes = write(output, files)
    written = sum(change.pending for change in changes)
    first = next(file.path for file in files if file.path.startswith("index."))
    message = f"{output / first}: {written} of {len(changes)} files written"
    left = _stale_pages(output, {file.path for file in files})
    return (
        f"{message}; stale pages of an earlier run remain: {', '.join(left)}" if left else message
    )


def _stale_pages(output: Path, written_paths: set[str]) -> list[str]:
    """Files of an earlier run, in the formats of this run, that no page links to."""
    kinds = {Path(path).suffix for path in written_paths}
    found = [p for folder in FOLDERS for p in output.glob(f"{folder}/*") if p.suffix in kinds]
    names = {path.relative_to(output).as_posix(): path for path in found}
    return sorted(
        name
        for name, path in names.items()
        if name not in written_paths and _is_generated_file(path)
    )


def _is_generated_file(path: Path) -> bool:
    try:
        with open_regular(path) as stream:
            return _is_generated(stream.read(MARK_BYTES))
    except OSError:  # a folder or an unreadable file is not a generated page
        return False


def _is_generated(data: bytes) -> bool:
    from robocomp_dsl.generate.doc.documentation import MARK  # noqa: PLC0415

    return MARK.encode() in data[:MARK_BYTES]
