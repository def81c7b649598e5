"""`rcgen simulator`: a world becomes a component that simulates it and serves what is in it.

In: a file in InnerModel, URDF or MJCF. Out: a folder with the component, or with `--dry-run` the
list of what would be served; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import click

from robocomp_dsl.check import check_cdsl, check_innermodel
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.consequences import consequences
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes, codes_model
from robocomp_dsl.hardware.model_kind import MODELS, outermost
from robocomp_dsl.source import Source, Span

if TYPE_CHECKING:
    from collections.abc import Callable

    from robocomp_dsl.generate.output import OutputFile
    from robocomp_dsl.generate.simulator import Simulator
    from robocomp_dsl.model.body import Body

    Complete: TypeAlias = Callable[[Simulator], Simulator]


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="WORLD.xml")
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Where to; by default a folder <world>_simulator beside the file.",
)
@click.option("--dry-run", is_flag=True, help="Write nothing; list what would be served.")
@options.packages
@click.option(
    "--tactile",
    type=click.Path(readable=False, path_type=Path),
    metavar="FILE.yaml",
    help="Skin on the bodies of the world, as this description of touch has it.",
)
@click.option(
    "--also",
    multiple=True,
    metavar="INTERFACE",
    help="Serve an older interface, too: JointMotorSimple or Camera. Repeatable.",
)
@click.option("--strict", is_flag=True, help="Make nothing of an InnerModel file with errors.")
@options.output_format
@options.folders
def command(
    *,
    file: Path,
    output: Path | None,
    dry_run: bool,
    packages: tuple[Path, ...],
    tactile: Path | None,
    also: tuple[str, ...],
    strict: bool,
    form: str,
    folders: tuple[Path, ...],
) -> None:
    """Generate a simulator from a world: a component that serves its devices.

    The file is InnerModel, URDF or MJCF. In MJCF, a tuple of joints is a control board, and a
    number `speed_<joint>` tells the largest speed of a joint.

    The world is built once to see that it can be; one with errors is simulated as far as it is
    understood. All is rewritten the next time but `specificworker.py`, `README.md` and
    `etc/config.yaml`.
    """
    told, report = Report(), Report()
    workspace = Workspace(folders)

    def complete(made: Simulator) -> Simulator:
        made = _touched(made, tactile, workspace, report) if tactile else made
        return _asked(made, also, file, report) if also else made

    made = simulated(file, packages, workspace, told, report, strict=strict, complete=complete)
    folder = output or file.parent / (made.name if made else "")
    files = _files(made, folder, workspace, report) if made and not report.failed else []
    told.extend(report)
    options.show(told.sorted(), form, sys.stderr)
    if made is None or report.failed:
        sys.exit(FINDINGS)
    if dry_run:
        print(table(made))
    else:
        from robocomp_dsl.cli.made import put  # noqa: PLC0415 - late

        put(folder, files, len(made.ports), f"cd {folder} && python3 main.py")


def simulated(
    file: Path,
    packages: tuple[Path, ...],
    workspace: Workspace,
    told: Report,
    report: Report,
    *,
    strict: bool,
    complete: Complete = lambda made: made,
) -> Simulator | None:
    """The simulator of a file. What the file says wrongly is `told`; `report` is of its world."""
    if _kind(file) in MODELS:
        return _model(file, packages, report, complete)
    return _world(file, workspace, told, report, strict, complete)


def _world(
    file: Path,
    workspace: Workspace,
    told: Report,
    report: Report,
    strict: bool,
    complete: Complete,
) -> Simulator | None:
    """The simulator of a body in InnerModel."""
    body = check_innermodel(file, workspace, told)
    if body is None or not body.found or (told.failed and strict):
        return None
    from robocomp_dsl.generate.simulator import simulator  # noqa: PLC0415 - not for --help

    made = complete(simulator(body))
    _build(made, body, report)
    if told.failed and not report.failed:
        said = f"this is simulated as far as it is understood: {consequences(told)}"
        place = body.root.span.source.whole
        report.add(codes.UNDERSTOOD_WORLD, place, said, help="with `--strict` nothing is made")
    return made


def _kind(file: Path) -> str:
    try:
        return outermost(file.read_bytes())
    except OSError:  # told by who reads it next
        return ""


def _touched(made: Simulator, path: Path, workspace: Workspace, report: Report) -> Simulator:
    from robocomp_dsl.cli.simulator_skin import touched  # noqa: PLC0415 - slow: numpy and YAML

    return touched(made, path, workspace, report)


def _asked(made: Simulator, also: tuple[str, ...], file: Path, report: Report) -> Simulator:
    from robocomp_dsl.generate.simulator import serving_also  # noqa: PLC0415 - late
    from robocomp_dsl.generate.simulator.offers import ALSO  # noqa: PLC0415

    for name in also:
        if name not in ALSO:
            raise click.UsageError(f"`--also {name}` is none of {', '.join(ALSO)}")
    made = serving_also(made, also)
    for name in also:
        if not any(one.interface == name for one in made.ports):
            said = f"nothing in this world is served as `{name}`"
            report.add(codes.NOTHING_ASKED, Source(file, "").whole, said)
    return made


def _model(
    file: Path, packages: tuple[Path, ...], report: Report, complete: Complete
) -> Simulator | None:
    try:
        from robocomp_dsl.cli.simulator_model import model_world  # noqa: PLC0415 - slow: MuJoCo
    except ImportError as missing:
        report.add(codes.NO_SIMULATION, Source(file, "").whole, str(missing))
        return None
    return model_world(file, packages, report, complete)


def _build(made: Simulator, body: Body, report: Report) -> None:
    """Build the world, and report what is not as described or cannot be."""
    try:
        from robocomp_dsl.hardware.mujoco.simulation import Simulation  # noqa: PLC0415 - slow
    except ImportError as missing:
        report.add(codes.NO_SIMULATION, body.root.span, str(missing))
        return
    from robocomp_dsl.hardware.errors import HardwareError  # noqa: PLC0415
    from robocomp_dsl.hardware.scene import Scene  # noqa: PLC0415

    spans = {node.id: node.span for node, _ in body.nodes()}

    def place(said: str) -> Span:
        """The node whose id a message names first, else the whole world."""
        quoted = said.split("`")[1::2]
        return next((spans[name] for name in quoted if name in spans), body.root.span)

    try:
        simulation = Simulation(Scene.of_data(made.scene))
    except HardwareError as error:
        report.add(codes.IMPOSSIBLE_WORLD, place(str(error)), str(error))
        return
    for note in simulation.notes:
        report.add(codes.SIMPLIFIED_WORLD, place(note), note)
    for one in simulation.overlaps():
        report.add(codes_model.MODEL_OVERLAP, place(one.said), one.said)


def _files(made: Simulator, folder: Path, workspace: Workspace, report: Report) -> list[OutputFile]:
    """All files, from descriptions that are checked as if they stood on the disk already."""
    from robocomp_dsl.generate.simulator import descriptions, files  # noqa: PLC0415 - late

    described = descriptions(made)
    for one in described:
        workspace.files.open_buffer(folder / one.path, one.text)
    component = check_cdsl(folder / described[0].path, workspace, report)
    return [*described, *files(made, component)] if component and not report.failed else []


def table(made: Simulator) -> str:
    """What is served, a line for each device and interface."""
    rows = [("device", "kind", "interface", "port")]
    for one in made.ports:
        shown = one.devices or (("(the world)", "world"),)
        rows += [(id_, kind, one.interface, one.port) for id_, kind in shown]
    rows += [(id_, kind, "-", "-") for id_, kind in made.unserved]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    )
