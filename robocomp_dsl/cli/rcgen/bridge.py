"""`rcgen bridge`: generates a component that joins topics and services of several middlewares.

In: a BDSL file, or a configuration of yarp-bottle-generator. Out: the files of a component's
folder, written or only compared; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.component import run_mode, selected_mode
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.write import CannotWrite

if TYPE_CHECKING:
    from robocomp_dsl.generate.output import OutputFile
    from robocomp_dsl.model.bridge import Bridge


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="X.bdsl|X.ini")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder; default: the folder of the file.",
)
@options.write_modes
@options.topic_types
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    output: Path | None,
    quiet: bool,
    output_format: str,
    folders: tuple[Path, ...],
    topic_types: tuple[str, ...],
    **modes: bool,
) -> None:
    """Generate a bridge: a component that joins topics and services of several middlewares.

    The descriptions, `main.py` and `NAME_generated/` are rewritten each time; `specificworker.py`,
    with the functions that the file declares, `README.md` and `etc/config.yaml` are written once
    and then belong to you. X.ini is a configuration of yarp-bottle-generator, as it is; X.bdsl is
    written from it. The types of the ROS topics that it reads come from --type, or from the ROS
    master if it runs.
    """
    mode = selected_mode(modes)
    report = Report()
    folder = output or file.parent
    workspace = Workspace(folders)
    types = options.parse_topic_types(topic_types)
    bridge, converted = _bridge(file, folder, types, workspace, report)
    files = _files(bridge, folder, workspace, report, writes=not mode) if bridge else []
    files = [*converted, *files] if files else []
    options.print_findings(report.sorted(), output_format, sys.stderr)
    if not files:
        raise CliError(EXIT_FINDINGS)
    try:
        run_mode(mode, folder, files, quiet)
    except CannotWrite as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def _bridge(
    file: Path, folder: Path, types: dict[str, str], workspace: Workspace, report: Report
) -> tuple[Bridge | None, list[OutputFile]]:
    """The bridge of a file without errors, and the BDSL file that was converted from it."""
    from robocomp_dsl.check.passes import check_bdsl  # noqa: PLC0415 - late

    if file.suffix.lower() == ".ini":
        from robocomp_dsl.cli.rcgen.bottle_generator import convert  # noqa: PLC0415 - rarely

        return convert(file, folder, types, workspace, report)
    found = check_bdsl(file, workspace, report)
    return None if report.has_errors else found, []


def _files(
    bridge: Bridge, folder: Path, workspace: Workspace, report: Report, *, writes: bool
) -> list[OutputFile]:
    """All files; the descriptions are checked before they are written. Empty with errors."""
    # Loaded late: not for --help.
    from robocomp_dsl.check.passes import check_cdsl  # noqa: PLC0415
    from robocomp_dsl.generate.bridge.bridge_files import bridge_files  # noqa: PLC0415
    from robocomp_dsl.generate.bridge.descriptions import description_files  # noqa: PLC0415
    from robocomp_dsl.generate.bridge.wiring import MiddlewareQueries, wiring_of  # noqa: PLC0415

    known = KnownMiddlewares()

    def has_external_peers(name: str) -> bool:
        description = known.describe(name)
        return description is not None and description.capabilities.external_peers

    def names_topics(name: str) -> bool:
        description = known.describe(name)
        return description is not None and description.capabilities.ros_types_only

    wiring = wiring_of(bridge, MiddlewareQueries(has_external_peers, names_topics))
    described = description_files(bridge, wiring, folder)
    for item in described:
        workspace.sources.set_overlay(folder / item.path, item.text)
    component = check_cdsl(folder / f"{bridge.name}.cdsl", workspace, report)
    if component is None or report.has_errors:
        return []
    files = bridge_files(folder, bridge, component, wiring, report, writes=writes)
    return [*described, *files]
