"""`rcgen migrate`: existing RoboComp components and deployments become ours.

In: component folders and manager files. Out: a new folder with `MIGRATION.md`; 1 if something
could not be carried over.
"""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Callable
from pathlib import Path

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report, Severity


@click.command()
@click.argument(
    "inputs",
    nargs=-1,
    required=True,
    type=click.Path(exists=True, readable=False, path_type=Path),
    metavar="DIR|MANAGER.xml…",
)
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Where to, a new or empty folder; by default the first name with `-migrated` behind.",
)
@click.option("-q", "quiet", is_flag=True, help="Say nothing but what to look at.")
@options.output_format
@options.folders
def command(
    *,
    inputs: tuple[Path, ...],
    output: Path | None,
    quiet: bool,
    form: str,
    folders: tuple[Path, ...],
) -> None:
    """Move existing RoboComp components over.

    DIR is the folder of a component: its CDSL, etc/config (text or TOML), src/specificworker.py.
    MANAGER.xml is a file of rcmanager, or sub.toml; name the folders of its components, too. The
    old folders are never changed. MIGRATION.md says what became what, and what did not.

    The exit code is 0 if everything was carried over, 1 if something was not.
    """
    out = output or _beside(inputs[0])
    _refuse(inputs, out)
    sys.exit(_move(inputs, out, folders, form, quiet))


def _beside(first: Path) -> Path:
    whole = Path(os.path.abspath(first))  # noqa: PTH100 - symbolic links stay
    name = whole.name if first.is_dir() else whole.stem
    return first.parent / f"{name}-migrated" if first.name else whole.parent / f"{name}-migrated"


def _refuse(inputs: tuple[Path, ...], out: Path) -> None:
    """Leave with 2 where writing would touch something that is there."""
    real = out.resolve()
    for one in inputs:
        if one.is_dir() and real.is_relative_to(one.resolve()):
            raise click.UsageError(f"`{out}` is in `{one}`, which stays as it is; use -o")
    if out.exists() and not out.is_dir():
        raise click.UsageError(f"`{out}` is a file; -o names a new folder")
    if out.is_dir() and any(out.iterdir()):
        raise click.UsageError(f"`{out}` is not empty; remove it, or name another folder with -o")


def _move(
    inputs: tuple[Path, ...], out: Path, folders: tuple[Path, ...], form: str, quiet: bool
) -> int:
    from robocomp_dsl.generate.write import CannotWrite, write  # noqa: PLC0415 - not for --help
    from robocomp_dsl.migrate import move_over  # noqa: PLC0415
    from robocomp_dsl.migrate.finish import generated, judged, recorded  # noqa: PLC0415

    report = Report()
    try:
        plan = move_over(inputs, out, folders, report)
        if plan.files:
            write(out, plan.files)
            for place, files in generated(plan, out, folders, report):
                write(out / place, files)
            judged(plan, out, folders, report)
            write(out, [recorded(plan, report, _shown(inputs, out))])
    except CannotWrite as error:
        options.complain(str(error))
        return FINDINGS
    people = form in options.FOR_PEOPLE
    shown = [d for d in report.sorted() if not people or d.severity is not Severity.NOTE]
    options.show(shown, form, sys.stderr)
    if plan.files and not quiet:
        print(f"{out}: {len(plan.files)} files; {options.summary(report.sorted())}")
        print(f"next: read {shlex.quote(str(out / 'MIGRATION.md'))}")
    return FINDINGS if report.failed or not plan.files else 0


def _shown(inputs: tuple[Path, ...], out: Path) -> Callable[[Path], str]:
    """How the report writes paths: from the folder that an input or the output is in."""

    def shown(path: Path) -> str:
        whole = path.resolve()
        for one in (*inputs, out):
            if whole.is_relative_to(one.resolve()):
                return whole.relative_to(one.resolve().parent).as_posix()
        return path.name

    return shown
