"""`rcgen hardware`: generates a component for a real device from a simulated one.

In: a name, and a device of a world. Out: a folder with a component that serves the same interfaces
as the simulated device, with a driver to implement; findings on standard error.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.simulation.simulator import build_simulator
from robocomp_dsl.diagnostics import Report

if TYPE_CHECKING:
    from robocomp_dsl.generate.hardware.driver_component import DriverComponent
    from robocomp_dsl.generate.output import OutputFile
    from robocomp_dsl.generate.simulator.simulator import Simulator


@click.command()
@click.argument("name")
@click.option(
    "--like",
    required=True,
    metavar="WORLD.xml#ID",
    help="The simulated device; several motors may form a board: WORLD.xml#shoulder,elbow.",
)
@click.option(
    "-o",
    "output",
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Output folder; default: NAME.",
)
@options.packages
@options.world_folders
@options.output_format
@options.folders
def command(
    *,
    name: str,
    like: str,
    output: Path | None,
    packages: tuple[Path, ...],
    world_folders: tuple[Path, ...],
    output_format: str,
    folders: tuple[Path, ...],
) -> None:
    """Generate a component for a real device that serves what a simulated one does.

    Code written for the simulated device runs unchanged on it. You implement `driver.py`; a test
    checks it with the conformance rules of the simulated device. `NAME_generated/` and `main.py`
    are rewritten in later runs; all other files are yours.
    """
    file, _, names = like.rpartition("#")
    ids = [item.strip() for item in names.split(",") if item.strip()]
    if not file or not ids:
        raise click.UsageError(f"`--like {like}` names no device: write WORLD.xml#ID")
    if not name.isidentifier():
        raise click.UsageError(f"`{name}` cannot name a component: use letters, digits and _")
    input_report, report = Report(), Report()
    workspace = Workspace(folders, world_folders=world_folders)
    driver = build_simulator(Path(file), packages, workspace, input_report, report, strict=False)
    input_report.extend(report)
    options.print_findings(input_report.sorted(), output_format, sys.stderr)
    if driver is None or report.has_errors:
        raise CliError(EXIT_FINDINGS)
    _generate(driver, ids, name, output or Path(name), workspace, output_format)


def _generate(
    world: Simulator,
    ids: list[str],
    name: str,
    folder: Path,
    workspace: Workspace,
    output_format: str,
) -> None:
    from robocomp_dsl.cli.rcgen.simulation.write_component import write_component  # noqa: PLC0415 - not for --help
    from robocomp_dsl.generate.hardware.driver_component import UnsupportedDevice, driver_component  # noqa: PLC0415

    try:
        driver = driver_component(world, ids, name)
    except UnsupportedDevice as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    report = Report()
    files = _files(driver, folder, workspace, report)
    options.print_findings(report.sorted(), output_format, sys.stderr)
    if report.has_errors:
        raise CliError(EXIT_FINDINGS)
    then = f"fill in {folder / 'driver.py'}, then cd {folder} && python3 -m pytest"
    write_component(folder, files, len(driver.simulator.ports), then)


def _files(
    driver: DriverComponent, folder: Path, workspace: Workspace, report: Report
) -> list[OutputFile]:
    """All files; existing description files belong to the user."""
    # Loaded late: not for --help.
    from robocomp_dsl.generate.hardware.driver_component import descriptions, files  # noqa: PLC0415
    from robocomp_dsl.generate.names import package_of  # noqa: PLC0415
    from robocomp_dsl.generate.regeneration.package_rename import renamed  # noqa: PLC0415

    described = descriptions(driver)
    for item in described:
        if not workspace.sources.exists(folder / item.path):
            workspace.sources.set_overlay(folder / item.path, item.text)
    component = check_cdsl(folder / described[0].path, workspace, report)
    if component is None or report.has_errors:
        return []
    written = [*described, *files(driver, component, known_properties(driver))]
    return renamed(folder, package_of(component.name), written, report)


def known_properties(driver: DriverComponent) -> dict[str, object]:
    """The static properties of the simulated device, such as its limits."""
    from robocomp_dsl.generate.simulator.simulator import world_files  # noqa: PLC0415 - late
    from robocomp_dsl.generate.write import write  # noqa: PLC0415
    from robocomp_dsl.hardware.description.scene import Scene  # noqa: PLC0415
    from robocomp_dsl.simulation.world.simulation import Simulation  # noqa: PLC0415 - MuJoCo

    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder), world_files(driver.simulator, "world"))
        simulation = Simulation(Scene.of_data(driver.simulator.scene, Path(folder, "world")))
    device = simulation.devices[driver.ids[0]]
    if driver.motors:
        return {"spec": device.board.spec.part(driver.ids)}
    return {name: getattr(device, name) for name in ("settings", "limits") if hasattr(device, name)}
