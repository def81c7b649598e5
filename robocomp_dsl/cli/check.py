"""`rcgen check`: judges files. In: files and folders. Out: findings, and 1 if one is an error."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import click

from robocomp_dsl.check import check_file, check_syntax
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.given import descriptions
from robocomp_dsl.cli.listing import listed
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report

Judge = Callable[[Path, Workspace, Report], object]


@click.command()
@options.files
@click.option("--syntax", is_flag=True, help="Judge form only; follow no imports.")
@click.option("--fix", "fixing", is_flag=True, help="Bring legacy forms into today's form first.")
@click.option("--diff", is_flag=True, help="With --fix: write nothing; show what would change.")
@options.output_format
@click.option("-q", "quiet", is_flag=True, help="No summary.")
@options.folders
def command(
    *,
    files: tuple[Path, ...],
    syntax: bool,
    fixing: bool,
    diff: bool,
    form: str,
    quiet: bool,
    folders: tuple[Path, ...],
) -> None:
    """Check IDSL, CDSL, PDSL, DDSL, SMDSL, SCXML and InnerModel; of a folder, all that are in it.

    The exit code is 0 if there are no errors (there may be warnings), 1 if there are.
    """
    if diff and not fixing:
        raise click.UsageError("--diff goes with --fix")
    report = Report()
    workspace = Workspace(folders)
    judge = check_syntax if syntax else check_file
    paths = descriptions(files)
    if fixing:
        _fix(paths, judge, workspace, diff)
    if diff:
        sys.exit(0)
    for path in paths:
        judge(path, workspace, report)
    findings = report.sorted()
    shown, unlisted = listed(findings) if form in options.FOR_PEOPLE else (findings, [])
    options.show(shown, form, sys.stdout)
    sys.stdout.flush()
    for line in unlisted:
        print(line, file=sys.stderr)
    if form == "full" and not quiet:
        count = f"{len(paths)} file{'s' if len(paths) != 1 else ''}"
        print(f"{count} checked: {options.summary(findings)}", file=sys.stderr)
    sys.exit(FINDINGS if report.failed else 0)


def _fix(paths: list[Path], judge: Judge, workspace: Workspace, diff: bool) -> None:
    """Fix all files, each as a whole; leaves with 1 at the first that cannot be written."""
    from robocomp_dsl.cli.fixing import fix  # noqa: PLC0415 - most runs fix nothing
    from robocomp_dsl.generate.write import CannotWrite  # noqa: PLC0415

    for path in paths:
        try:
            fix(path, judge, workspace, diff=diff)
        except CannotWrite as error:
            options.complain(str(error))
            sys.exit(FINDINGS)
