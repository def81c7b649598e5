"""`rcgen view`: a world or a robot in the browser, or as a picture.

In: a file in InnerModel, URDF or MJCF, or the name of a robot that ships. Out: a page on this
machine, or a PNG file; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import FINDINGS
from robocomp_dsl.diagnostics import Report

if TYPE_CHECKING:
    from robocomp_dsl.cli.view_subject import Subject
    from robocomp_dsl.hardware.view.picture import Look


def _size(_: click.Context, __: click.Parameter, written: str) -> tuple[int, int]:
    width, cross, height = written.partition("x")
    if not cross or not (width.isdecimal() and height.isdecimal()):
        raise click.BadParameter("width and height, as in 1280x960")
    return int(width), int(height)


@click.command()
@click.argument("file", type=click.Path(readable=False, path_type=Path), metavar="FILE")
@click.option(
    "--screenshot",
    type=click.Path(readable=False, dir_okay=False, path_type=Path),
    metavar="PNG",
    help="Make a picture instead; needs no screen.",
)
@click.option("--size", default="1280x960", callback=_size, help="Of the picture, in pixels.")
@click.option("--camera", default="", metavar="NAME", help="Look through this camera of the model.")
@click.option("--azimuth", default=120.0, show_default=True, help="Where to look from, in degrees.")
@click.option(
    "--elevation", default=-25.0, show_default=True, help="Degrees; negative: from above."
)
@click.option("--zoom", default=1.0, type=click.FloatRange(0.01, 100), help="How near.")
@click.option("--frames", is_flag=True, help="Show the frames of all bodies.")
@click.option("--names", is_flag=True, help="Show the names of all bodies.")
@click.option("--contacts", is_flag=True, help="Show what touches.")
@click.option("--port", default=8080, show_default=True, help="Of the page; 0: any that is free.")
@click.option(
    "--packages",
    multiple=True,
    type=click.Path(readable=False, path_type=Path),
    metavar="DIR",
    help="Look for package://… here; may be repeated.",
)
@options.output_format
def command(
    *,
    file: Path,
    screenshot: Path | None,
    size: tuple[int, int],
    camera: str,
    azimuth: float,
    elevation: float,
    zoom: float,
    frames: bool,
    names: bool,
    contacts: bool,
    port: int,
    packages: tuple[Path, ...],
    form: str,
) -> None:
    """Show a world or a robot in the browser, or make a picture of it.

    FILE is InnerModel, URDF or MJCF, or a robot that ships: nao_h21, nao_h25, icub_v2. The page is
    served on this machine alone. A model with errors is shown as far as it is understood.
    """
    report = Report()
    try:
        from robocomp_dsl.cli.view_subject import read_subject  # noqa: PLC0415 - slow: MuJoCo
        from robocomp_dsl.hardware.view.picture import Look  # noqa: PLC0415
    except ImportError as missing:
        options.complain(str(missing))
        sys.exit(FINDINGS)
    subject = read_subject(file, packages, report)
    options.show(report.sorted(), form, sys.stderr)
    if subject is None:
        sys.exit(FINDINGS)
    look = Look(azimuth, elevation, 1 / zoom, camera, frames, names, contacts)
    if screenshot:
        _photograph(subject, screenshot, size, look)
    else:
        _serve(subject, port, look)


def _photograph(subject: Subject, path: Path, size: tuple[int, int], look: Look) -> None:
    from robocomp_dsl.hardware.view.picture import Painter, save  # noqa: PLC0415
    from robocomp_dsl.hardware.view.screenless import NoRendering  # noqa: PLC0415

    try:
        with Painter(subject.model, *size) as painter:
            save(path, painter.paint(subject.data(), look))
    except (NoRendering, OSError) as error:
        options.complain(str(error))
        sys.exit(FINDINGS)
    print(f"{path}: {size[0]} x {size[1]} pixels")


def _serve(subject: Subject, port: int, look: Look) -> None:
    try:
        from robocomp_dsl.hardware.view.browser import serve  # noqa: PLC0415
    except ImportError as missing:
        options.complain(str(missing))
        sys.exit(FINDINGS)
    try:
        serve(subject.name, subject.model, subject.data(), look, port, _tell)
    except OSError as error:
        options.complain(f"port {port} cannot be used: {error.strerror or error}; try --port 0")
        sys.exit(FINDINGS)


def _tell(url: str) -> None:
    print(f"{url} shows it; Ctrl-C ends", flush=True)
