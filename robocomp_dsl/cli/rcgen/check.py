"""`rcgen check`: checks files. In: files and folders. Out: findings; exit code 1 for errors."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

import click

from robocomp_dsl.check.languages import check_file, check_syntax
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.inputs import expand_inputs
from robocomp_dsl.cli.output.limit import limit_findings
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report

Check = Callable[[Path, Workspace, Report], object]


@click.command()
@options.files
@click.option("--syntax", is_flag=True, help="Check syntax only; do not resolve imports.")
@click.option(
    "--static",
    is_flag=True,
    help="Check texts only, not whether this machine can start the named deployments.",
)
@click.option(
    "--fix",
    "fixing",
    is_flag=True,
    help="Apply safe fixes, such as updates of legacy syntax, first.",
)
@click.option("--diff", is_flag=True, help="With --fix: show the changes; write nothing.")
@options.world_folders
@options.output_format
@click.option("-q", "quiet", is_flag=True, help="Print no summary.")
@options.folders
def command(
    *,
    files: tuple[Path, ...],
    syntax: bool,
    static: bool,
    fixing: bool,
    diff: bool,
    world_folders: tuple[Path, ...],
    output_format: str,
    quiet: bool,
    folders: tuple[Path, ...],
) -> None:
    """Check files of all languages, also of whole folders.

    Of a deployment that is named, and not found in a folder, it finds the same as `rcdeploy
    check`: also components that are not generated, invalid configurations, and ports in use.

    The exit code is 1 if there are errors, else 0; warnings do not count.
    """
    if diff and not fixing:
        raise click.UsageError("--diff requires --fix")
    report = Report()
    search_files = bool(world_folders or os.environ.get("ROBOCOMP_FILES"))
    workspace = Workspace(folders, world_folders=world_folders if search_files else None)
    check = check_syntax if syntax else check_file
    paths = expand_inputs(files)
    if fixing:
        _fix(paths, check, workspace, diff)
    if diff:
        return
    for path in paths:
        if path in files and path.suffix.lower() == ".ddsl" and not (syntax or static):
            _check_deployment(path, workspace, report)
        else:
            check(path, workspace, report)
    findings = report.sorted()
    is_human = output_format in options.HUMAN_FORMATS
    shown, unlisted = limit_findings(findings) if is_human else (findings, [])
    options.print_findings(shown, output_format, sys.stdout)
    sys.stdout.flush()
    for line in unlisted:
        print(line, file=sys.stderr)
    if output_format == "full" and not quiet:
        count = f"{len(paths)} file{'s' if len(paths) != 1 else ''}"
        print(f"{count} checked: {options.summary(findings)}", file=sys.stderr)
    if report.has_errors:
        raise CliError(EXIT_FINDINGS)


def _check_deployment(path: Path, workspace: Workspace, report: Report) -> None:
    """Add all that `rcdeploy check` finds."""
    from robocomp_dsl.deploy.checked_deployment import check_deployment  # noqa: PLC0415 - for .ddsl only

    report.extend(check_deployment(path, workspace).findings)


def _fix(paths: list[Path], check: Check, workspace: Workspace, diff: bool) -> None:
    """Fix all files. Raises `CliError` for the first file that cannot be written."""
    from robocomp_dsl.cli.rcgen.apply_fixes import apply_fixes  # noqa: PLC0415 - most runs fix nothing
    from robocomp_dsl.generate.write import CannotWrite  # noqa: PLC0415

    for path in paths:
        try:
            apply_fixes(path, check, workspace, diff=diff)
        except CannotWrite as error:
            raise CliError(EXIT_FINDINGS, str(error)) from None
