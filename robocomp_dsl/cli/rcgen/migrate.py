"""`rcgen migrate`: migrates existing RoboComp components and deployments.

In: component folders and manager files. Out: a new folder with `MIGRATION.md`; exit code 1 if a
part could not be migrated.
"""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.diagnostics import Report, Severity

if TYPE_CHECKING:
    from robocomp_dsl.generate.output import OutputFile


@click.command()
@click.argument(
    "inputs",
    nargs=-1,
    required=True,
    type=click.Path(exists=True, readable=False, path_type=Path),
    metavar="DIR|FILE…",
)
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder, new or empty; default: the first name with `-migrated` appended.",
)
@click.option(
    "--enable",
    "tags",
    multiple=True,
    metavar="TAG",
    help="Include the parts of a YARP robot that are `enabled_by` TAG, or `all`; repeatable.",
)
@options.topic_types
@click.option("-q", "quiet", is_flag=True, help="Print findings only.")
@options.output_format
@options.folders
def command(
    *,
    inputs: tuple[Path, ...],
    output: Path | None,
    tags: tuple[str, ...],
    quiet: bool,
    output_format: str,
    folders: tuple[Path, ...],
    topic_types: tuple[str, ...],
) -> None:
    """Migrate components and deployments of RoboComp, and files of YARP.

    DIR is the folder of a component: its CDSL, etc/config (text or TOML), src/specificworker.py.
    FILE.xml is a file of rcmanager (or sub.toml; name the folders of its components, too), an
    application of yarpmanager, or a robot of yarprobotinterface; FILE.ini is a configuration of
    yarp-bottle-generator. The old files are never changed. MIGRATION.md lists what was migrated,
    and what was not.

    The exit code is 0 if everything was carried over, 1 if something was not.
    """
    out = output or _default_output(inputs[0])
    _validate_output(inputs, out)
    types = options.parse_topic_types(topic_types)
    _migrate(inputs, out, folders, tags, types, output_format, quiet)


def _default_output(first: Path) -> Path:
    absolute = Path(os.path.abspath(first))  # noqa: PTH100 - symbolic links stay
    name = absolute.name if first.is_dir() else absolute.stem
    return first.parent / f"{name}-migrated" if first.name else absolute.parent / f"{name}-migrated"


def _validate_output(inputs: tuple[Path, ...], out: Path) -> None:
    """Exit with code 2 if existing files would be overwritten."""
    real = out.resolve()
    for folder in inputs:
        if folder.is_dir() and real.is_relative_to(folder.resolve()):
            raise click.UsageError(f"`{out}` is in `{folder}`, which stays as it is; use -o")
    if out.exists() and not out.is_dir():
        raise click.UsageError(f"`{out}` is a file; -o names a new folder")
    if out.is_dir() and any(out.iterdir()):
        raise click.UsageError(f"`{out}` is not empty; remove it, or name another folder with -o")


def _migrate(
    inputs: tuple[Path, ...],
    out: Path,
    folders: tuple[Path, ...],
    tags: tuple[str, ...],
    topic_types: dict[str, str],
    output_format: str,
    quiet: bool,
) -> None:
    from robocomp_dsl.generate.write import CannotWrite, write  # noqa: PLC0415 - not for --help
    from robocomp_dsl.migrate.finish import (  # noqa: PLC0415
        check_migrated_files,
        generate_components,
        migration_report,
    )
    from robocomp_dsl.migrate.migration import plan_migration  # noqa: PLC0415

    report = Report()
    try:
        plan = plan_migration(inputs, out, folders, report, tags, topic_types)
        if plan.files:
            write(out, plan.files)
            for place, files in generate_components(plan, out, folders, report):
                write(out / place, files)
            for world in plan.worlds:
                folder = out / f"{Path(world).stem}_simulator"
                write(folder, _simulator(out / world, folder, folders, report))
            check_migrated_files(plan, out, folders, report)
            write(out, [migration_report(plan, report, _path_formatter(out))])
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    people = output_format in options.HUMAN_FORMATS
    shown = [d for d in report.sorted() if not people or d.severity is not Severity.NOTE]
    options.print_findings(shown, output_format, sys.stderr)
    if plan.files and not quiet:
        print(f"{out}: {len(plan.files)} files; {options.summary(report.sorted())}")
        print(f"next: read {shlex.quote(str(out / 'MIGRATION.md'))}")
    if report.has_errors or not plan.files:
        raise CliError(EXIT_FINDINGS)


def _simulator(
    world: Path, folder: Path, folders: tuple[Path, ...], report: Report
) -> list[OutputFile]:
    """The files of the simulator of a migrated world, as `rcgen simulator` writes them."""
    from robocomp_dsl.check.workspace.workspace import Workspace  # noqa: PLC0415 - not for --help
    from robocomp_dsl.cli.rcgen.simulation.simulator import (  # noqa: PLC0415
        build_simulator,
        simulator_files,
    )

    own, workspace = Report(), Workspace(folders)
    simulator = build_simulator(world, (), workspace, own, own, strict=False)
    files = simulator_files(simulator, folder, workspace, own) if simulator else []
    report.extend(own)
    return files


def _path_formatter(out: Path) -> Callable[[Path], str]:
    """Formats paths in the report: relative to the output folder, which contains the report."""
    base = out.resolve()

    def shown(path: Path) -> str:
        return Path(os.path.relpath(path.resolve(), base)).as_posix()

    return shown
