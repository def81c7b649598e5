"""`rcgen hardware`: the real-hardware twin of a simulated device.

In: a name, and a device of a world. Out: a folder with a component that serves what the simulated
device serves, with a driver to fill in; findings on standard error.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.check import check_cdsl
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.cli.simulator import simulated
from robocomp_dsl.diagnostics import Report

if TYPE_CHECKING:
    from robocomp_dsl.generate.hardware import Twin
    from robocomp_dsl.generate.output import OutputFile
    from robocomp_dsl.generate.simulator import Simulator


@click.command()
@click.argument("name")
@click.option(
    "--like",
    required=True,
    metavar="WORLD.xml#ID",
    help="The device in a world; motors may be several, or a board: WORLD.xml#shoulder,elbow.",
)
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Where to; by default a folder NAME here.",
)
@options.packages
@options.output_format
@options.folders
def command(
    *,
    name: str,
    like: str,
    output: Path | None,
    packages: tuple[Path, ...],
    form: str,
    folders: tuple[Path, ...],
) -> None:
    """Generate a component for a real device that serves what a simulated one does.

    Code written against the simulated device runs unchanged on it. `driver.py` is to be filled in;
    a test holds it against the rules that the simulated twin keeps to. `generated/` and `main.py`
    are rewritten the next time, all else is yours.
    """
    file, _, listed = like.rpartition("#")
    ids = [one.strip() for one in listed.split(",") if one.strip()]
    if not file or not ids:
        raise click.UsageError(f"`--like {like}` names no device: say WORLD.xml#ID")
    if not name.isidentifier():
        raise click.UsageError(f"`{name}` cannot name a component: use letters, digits and _")
    told, report = Report(), Report()
    workspace = Workspace(folders)
    made = simulated(Path(file), packages, workspace, told, report, strict=False)
    told.extend(report)
    options.show(told.sorted(), form, sys.stderr)
    if made is None or report.failed:
        sys.exit(FINDINGS)
    _make(made, ids, name, output or Path(name), workspace, form)


def _make(
    world: Simulator, ids: list[str], name: str, folder: Path, workspace: Workspace, form: str
) -> None:
    from robocomp_dsl.cli.made import put  # noqa: PLC0415 - not for --help
    from robocomp_dsl.generate.hardware import NoTwin, twin  # noqa: PLC0415

    try:
        made = twin(world, ids, name)
    except NoTwin as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    report = Report()
    files = _files(made, folder, workspace, report)
    options.show(report.sorted(), form, sys.stderr)
    if report.failed:
        sys.exit(FINDINGS)
    then = f"fill in {folder / 'driver.py'}, then cd {folder} && python3 -m pytest"
    put(folder, files, len(made.made.ports), then)


def _files(made: Twin, folder: Path, workspace: Workspace, report: Report) -> list[OutputFile]:
    """All files; descriptions that are there already are the user's."""
    from robocomp_dsl.generate.hardware import descriptions, files  # noqa: PLC0415 - late

    described = descriptions(made)
    for one in described:
        if not workspace.files.exists(folder / one.path):
            workspace.files.open_buffer(folder / one.path, one.text)
    component = check_cdsl(folder / described[0].path, workspace, report)
    if component is None or report.failed:
        return []
    return [*described, *files(made, component, known(made))]


def known(made: Twin) -> dict[str, object]:
    """What the simulated device says of itself without being asked to measure."""
    from robocomp_dsl.generate.simulator import world_files  # noqa: PLC0415 - late
    from robocomp_dsl.generate.write import write  # noqa: PLC0415
    from robocomp_dsl.hardware.mujoco.simulation import Simulation  # noqa: PLC0415 - MuJoCo

    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder), world_files(made.made))
        simulation = Simulation.read(Path(folder, "generated", "scene.json"))
    device = simulation.devices[made.ids[0]]
    if made.motors:
        return {"spec": device.board.spec.part(made.ids)}
    return {name: getattr(device, name) for name in ("settings", "limits") if hasattr(device, name)}
