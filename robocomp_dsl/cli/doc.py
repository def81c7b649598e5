"""`rcgen doc`: writes documentation.

In: files and folders of descriptions. Out: pages; findings on standard error.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.given import descriptions
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report

if TYPE_CHECKING:
    from robocomp_dsl.generate.output import OutputFile

FORMATS = {"html": ("html",), "markdown": ("markdown",), "both": ("html", "markdown")}
FOLDERS = ("components", "deployments", "interfaces", "modules", "parameters", "statemachines")
"""Where pages go, beside the first one."""
BEGINNING = 1000
"""The mark of our files is in the first bytes of each."""


@click.command()
@options.files
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    default=Path("build/doc"),
    show_default=True,
    metavar="DIR",
    help="Where to.",
)
@click.option(
    "--format",
    "form",
    type=click.Choice(tuple(FORMATS)),
    default="html",
    show_default=True,
    help="What to write.",
)
@click.option("--title", metavar="WORDS", help="Title of the first page.")
@click.option("-q", "quiet", is_flag=True, help="Say nothing but findings.")
@options.folders
def command(
    files: tuple[Path, ...],
    output: Path,
    form: str,
    title: str | None,
    quiet: bool,
    folders: tuple[Path, ...],
) -> None:
    """Write linked documentation of interfaces, components and deployments.

    What the files import is in it. All pages are written, or none if a file has errors; a file that
    `rcgen doc` has not written itself is never touched.
    """
    from robocomp_dsl.cli.doc_subject import read_subject  # noqa: PLC0415 - help needs no checks
    from robocomp_dsl.generate.doc import documentation  # noqa: PLC0415
    from robocomp_dsl.generate.write import CannotWrite  # noqa: PLC0415

    report = Report()
    paths = _paths(files)
    subject = read_subject(paths, title or _title(files), Workspace(folders), report)
    options.show(report.sorted(), "full", sys.stderr)
    if report.failed:
        sys.exit(FINDINGS)
    try:
        said = _write(output, documentation(subject, FORMATS[form]))
    except CannotWrite as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    if not quiet:
        print(said)


def _paths(files: Sequence[Path]) -> list[Path]:
    """The descriptions meant; leaves with 1 where there are none."""
    paths = descriptions(files)
    for path in paths:
        if path.suffix.lower() == ".xml":
            raise click.UsageError(f"`{path}`: bodies have no documentation, leave it out")
    return paths


def _title(files: Sequence[Path]) -> str:
    """The name of the only file or folder, or of the one around them."""
    only = files[0] if len(files) == 1 else Path()
    return only.stem or only.resolve().name or "Robot"


def _write(output: Path, files: Sequence[OutputFile]) -> str:
    """Write the pages; what to say then. Raises `CannotWrite`."""
    from robocomp_dsl.generate.write import CannotWrite, compare, write  # noqa: PLC0415

    for one in compare(output, files):
        if one.old is not None and not _is_ours(one.old):
            where = f"`{output / one.file.path}` is not a page of an earlier run"
            raise CannotWrite(f"{where}; move it, or choose another folder with -o")
    changes = write(output, files)
    written = sum(one.pending for one in changes)
    first = next(one.path for one in files if one.path.startswith("index."))
    said = f"{output / first}: {written} of {len(changes)} files written"
    left = _left(output, {one.path for one in files})
    return f"{said}; pages of an earlier run are left: {', '.join(left)}" if left else said


def _left(output: Path, made: set[str]) -> list[str]:
    """Files of an earlier run, in the formats of this one, to which nothing leads any more."""
    kinds = {Path(path).suffix for path in made}
    found = [p for folder in FOLDERS for p in output.glob(f"{folder}/*") if p.suffix in kinds]
    names = {path.relative_to(output).as_posix(): path for path in found}
    return sorted(name for name, path in names.items() if name not in made and _was_ours(path))


def _was_ours(path: Path) -> bool:
    try:
        with path.open("rb") as stream:
            return _is_ours(stream.read(BEGINNING))
    except OSError:  # a folder, or a file that may not be read, is not a page of ours
        return False


def _is_ours(data: bytes) -> bool:
    from robocomp_dsl.generate.doc import MARK  # noqa: PLC0415

    return MARK.encode() in data[:BEGINNING]
