"""`rcgen simulator`: generates a component that simulates a world and serves its devices.

In: a file in InnerModel, URDF or MJCF. Out: a folder with the component, or with `--dry-run` the
list of the interfaces that would be served; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import click

from robocomp_dsl.check.codes import model_files as model_codes
from robocomp_dsl.check.passes import check_cdsl, check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.simulation.recovery_summary import summarise_recovery
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.hardware.description.model_kind import MODELS, root_tag
from robocomp_dsl.regular_file import read_bytes
from robocomp_dsl.source import Source, Span

if TYPE_CHECKING:
    from collections.abc import Callable

    from robocomp_dsl.generate.output import OutputFile
    from robocomp_dsl.generate.simulator.simulator import Simulator
    from robocomp_dsl.model.innermodel import InnerModel

    Complete: TypeAlias = Callable[[Simulator], Simulator]


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="WORLD.xml")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder; default: <world>_simulator beside the file.",
)
@click.option(
    "--dry-run", is_flag=True, help="Write nothing; list the interfaces that would be served."
)
@options.packages
@options.world_folders
@click.option(
    "--tactile",
    type=click.Path(readable=False, path_type=Path),
    metavar="FILE.yaml",
    help="Add the skin of this tactile description to the bodies of the world.",
)
@click.option(
    "--also",
    multiple=True,
    metavar="INTERFACE",
    help="Also serve an older interface: JointMotorSimple or Camera; repeatable.",
)
@click.option("--strict", is_flag=True, help="Reject an InnerModel file with errors.")
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    output: Path | None,
    dry_run: bool,
    packages: tuple[Path, ...],
    world_folders: tuple[Path, ...],
    tactile: Path | None,
    also: tuple[str, ...],
    strict: bool,
    output_format: str,
    folders: tuple[Path, ...],
) -> None:
    """Generate a simulator from a world: a component that serves its devices.

    The file is InnerModel, URDF or MJCF. In MJCF, a tuple of joints is a control board, and a
    number `speed_<joint>` is the maximum speed of a joint.

    The world is built once as a check; a world with errors is simulated with repairs. Later runs
    rewrite all files except `specificworker.py`, `README.md` and `etc/config.yaml`.
    """
    input_report, report = Report(), Report()
    workspace = Workspace(folders, world_folders=world_folders)

    def complete(simulator_: Simulator) -> Simulator:
        simulator_ = _with_skin(simulator_, tactile, workspace, report) if tactile else simulator_
        return _with_opt_in_interfaces(simulator_, also, file, report) if also else simulator_

    simulator_ = build_simulator(
        file, packages, workspace, input_report, report, strict=strict, complete=complete
    )
    folder = output or file.parent / (simulator_.name if simulator_ else "")
    files = (
        simulator_files(simulator_, folder, workspace, report)
        if simulator_ and not report.has_errors
        else []
    )
    input_report.extend(report)
    options.print_findings(input_report.sorted(), output_format, sys.stderr)
    if simulator_ is None or report.has_errors:
        raise CliError(EXIT_FINDINGS)
    if dry_run:
        print(table(simulator_))
    else:
        from robocomp_dsl.cli.rcgen.simulation.write_component import write_component  # noqa: PLC0415 - late

        write_component(folder, files, len(simulator_.ports), f"cd {folder} && python3 main.py")


def build_simulator(
    file: Path,
    packages: tuple[Path, ...],
    workspace: Workspace,
    input_report: Report,
    report: Report,
    *,
    strict: bool,
    complete: Complete = lambda simulator_: simulator_,
) -> Simulator | None:
    """The simulator of a file; `input_report` gets findings of the file, `report` of its world."""
    if _kind(file) in MODELS:
        return _model(file, packages, report, complete)
    return _world(file, workspace, input_report, report, strict, complete)


def _world(
    file: Path,
    workspace: Workspace,
    input_report: Report,
    report: Report,
    strict: bool,
    complete: Complete,
) -> Simulator | None:
    """The simulator of a body in InnerModel."""
    body = check_innermodel(file, workspace, input_report)
    if body is None or not body.has_root or (input_report.has_errors and strict):
        return None
    from robocomp_dsl.generate.simulator.simulator import simulator  # noqa: PLC0415 - not for --help

    simulator_ = complete(simulator(body, workspace.world_folders or ()))
    _build(simulator_, body, report)
    if input_report.has_errors and not report.has_errors:
        message = (
            f"this is simulated as far as it is understood: {summarise_recovery(input_report)}"
        )
        place = body.root.span.source.file_span
        report.add(
            codes.REPAIRED_WORLD, place, message, help="with `--strict` nothing is generated"
        )
    return simulator_


def _kind(file: Path) -> str:
    try:
        return root_tag(read_bytes(file))
    except OSError:  # the next reader reports it
        return ""


def _with_skin(
    simulator_: Simulator, path: Path, workspace: Workspace, report: Report
) -> Simulator:
    from robocomp_dsl.cli.rcgen.simulation.simulator_skin import (  # noqa: PLC0415 - slow: numpy, YAML
        with_described_skin,
    )

    return with_described_skin(simulator_, path, workspace, report)


def _with_opt_in_interfaces(
    simulator_: Simulator, also: tuple[str, ...], file: Path, report: Report
) -> Simulator:
    from robocomp_dsl.generate.simulator.served_interfaces import OPT_IN  # noqa: PLC0415
    from robocomp_dsl.generate.simulator.simulator import serving_also  # noqa: PLC0415 - late

    for name in also:
        if name not in OPT_IN:
            raise click.UsageError(f"`--also {name}` is none of {', '.join(OPT_IN)}")
    simulator_ = serving_also(simulator_, also)
    for name in also:
        if not any(port.interface == name for port in simulator_.ports):
            message = f"nothing in this world is served as `{name}`"
            report.add(codes.OPT_IN_WITHOUT_DEVICE, Source(file, "").file_span, message)
    return simulator_


def _model(
    file: Path, packages: tuple[Path, ...], report: Report, complete: Complete
) -> Simulator | None:
    try:
        from robocomp_dsl.cli.rcgen.simulation.simulator_model import model_world  # noqa: PLC0415 - slow: MuJoCo
    except ImportError as missing:
        report.add(codes.NO_SIMULATION, Source(file, "").file_span, str(missing))
        return None
    return model_world(file, packages, report, complete)


def _build(simulator_: Simulator, body: InnerModel, report: Report) -> None:
    """Build the world, and report simplifications and errors."""
    try:
        from robocomp_dsl.simulation.world.simulation import Simulation  # noqa: PLC0415 - slow
    except ImportError as missing:
        report.add(codes.NO_SIMULATION, body.root.span, str(missing))
        return
    from robocomp_dsl.hardware.description.scene import Scene  # noqa: PLC0415
    from robocomp_dsl.hardware.devices.errors import HardwareError  # noqa: PLC0415

    spans = {node.id: node.span for node, _ in body.nodes()}

    def place(message: str) -> Span:
        """The span of the first node that a message names, else of the whole world."""
        quoted = message.split("`")[1::2]
        return next((spans[name] for name in quoted if name in spans), body.root.span)

    try:
        simulation = Simulation(Scene.of_data(simulator_.scene))
    except HardwareError as error:
        report.add(codes.IMPOSSIBLE_WORLD, place(str(error)), str(error))
        return
    for note in simulation.notes:
        report.add(codes.SIMPLIFIED_WORLD, place(note), note)
    for overlap in simulation.overlaps():
        report.add(model_codes.MODEL_OVERLAP, place(overlap.message), overlap.message)


def simulator_files(
    simulator_: Simulator, folder: Path, workspace: Workspace, report: Report
) -> list[OutputFile]:
    """All files; the description files are checked before they are written."""
    from robocomp_dsl.generate.names import package_of  # noqa: PLC0415 - late
    from robocomp_dsl.generate.regeneration.package_rename import renamed  # noqa: PLC0415
    from robocomp_dsl.generate.simulator.simulator import descriptions, files  # noqa: PLC0415

    described = descriptions(simulator_)
    for item in described:
        workspace.sources.set_overlay(folder / item.path, item.text)
    component = check_cdsl(folder / described[0].path, workspace, report)
    if component is None or report.has_errors:
        return []
    package = package_of(component.name)
    return renamed(folder, package, [*described, *files(simulator_, component)], report)


def table(simulator_: Simulator) -> str:
    """A table of the served devices and interfaces."""
    rows = [("device", "kind", "interface", "port")]
    for port in simulator_.ports:
        shown = port.devices or (("(the world)", "world"),)
        rows += [(id_, kind, port.interface, port.port) for id_, kind in shown]
    rows += [(id_, kind, "-", "-") for id_, kind in simulator_.unserved]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    )
