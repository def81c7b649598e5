"""`rcgen view`: a world, a robot or a running simulation in the browser, or as a picture.

In: a file in InnerModel, URDF or MJCF, the name of a robot that ships, or that of a simulator that
runs. Out: a page on this machine, or a PNG file; findings on standard error.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Never

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
@click.argument(
    "file", type=click.Path(readable=False, path_type=Path), metavar="[FILE]", required=False
)
@click.option(
    "--live", is_flag=True, help="FILE is a component that simulates; without: the only one."
)
@click.option(
    "--domain",
    metavar="NAME",
    envvar="ROBOCOMP_DOMAIN",
    help="Where it runs: a domain or a deployment; by default it is looked for.",
)
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
@options.packages
@options.output_format
def command(
    *,
    file: Path | None,
    live: bool,
    domain: str | None,
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
    """Show a world, a robot or a running simulation in the browser, or make a picture of it.

    FILE is InnerModel, URDF or MJCF, or a robot that ships: nao_h21, nao_h25, icub_v2. The page is
    served on this machine alone. A model with errors is shown as far as it is understood. With
    `--live` the page follows a simulation that runs, and its time can be held there.
    """
    if file is None and not live:
        raise click.UsageError("Missing argument 'FILE'; `--live` shows a simulation that runs.")
    report = Report()
    try:
        from robocomp_dsl.cli.view_subject import read_subject  # noqa: PLC0415 - slow: MuJoCo
        from robocomp_dsl.hardware.view.picture import Look  # noqa: PLC0415
    except ImportError as missing:
        options.complain(str(missing))
        sys.exit(FINDINGS)
    look = Look(azimuth, elevation, 1 / zoom, camera, frames, names, contacts)
    if live or file is None:
        from robocomp_dsl.cli import view_live  # noqa: PLC0415 - loads a middleware

        view_live.show(str(file or ""), domain, look, screenshot, size, port)
        return
    subject = read_subject(file, packages, report)
    options.show(report.sorted(), form, sys.stderr)
    if subject is None:
        sys.exit(FINDINGS)
    if screenshot:
        photograph(subject.model, subject.data(), screenshot, size, look)
    else:
        _serve(subject, port, look)


def photograph(model: Any, data: Any, path: Path, size: tuple[int, int], look: Look) -> None:
    """Make a picture, and say so."""
    from robocomp_dsl.hardware.view.picture import Painter, save  # noqa: PLC0415
    from robocomp_dsl.hardware.view.screenless import NoRendering  # noqa: PLC0415

    try:
        with Painter(model, *size) as painter:
            save(path, painter.paint(data, look))
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
        serve(subject.name, subject.model, subject.data(), look, port, tell)
    except OSError as error:
        taken(port, error)


def taken(port: int, error: OSError) -> Never:
    """Say that the page cannot be there."""
    options.complain(f"port {port} cannot be used: {error.strerror or error}; try --port 0")
    sys.exit(FINDINGS)


def tell(url: str) -> None:
    """Where the page is."""
    print(f"{url} shows it; Ctrl-C ends", flush=True)
