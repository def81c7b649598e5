"""`rcgen view`: a world, a robot or a running simulation in the browser, or as a picture.

In: a file in InnerModel, URDF or MJCF, the name of a shipped robot, or of a running simulator. Out:
a page on this machine, or a PNG file; findings on standard error.
"""

from __future__ import annotations

import sys
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli import options
from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcgen.simulation.view_output import page_errors, save_screenshot, shown_page
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.extras import MissingExtra

if TYPE_CHECKING:
    from robocomp_dsl.cli.rcgen.simulation.view_subject import Subject
    from robocomp_dsl.simulation.view.picture import Viewpoint


def _size(_: click.Context, __: click.Parameter, written: str | None) -> tuple[int, int] | None:
    if written is None:
        return None
    width, cross, height = written.partition("x")
    if not cross or not (width.isdecimal() and height.isdecimal()):
        raise click.BadParameter("width and height, as in 1280x960")
    return int(width), int(height)


@click.command()
@click.argument(
    "file", type=click.Path(readable=False, path_type=Path), metavar="[FILE]", required=False
)
@click.option(
    "--live",
    is_flag=True,
    help="Show a running simulation; FILE is its component, if there are several.",
)
@click.option(
    "--domain",
    metavar="NAME",
    envvar="ROBOCOMP_DOMAIN",
    help="Domain or deployment of the running simulation; default: searched.",
)
@click.option(
    "--screenshot",
    type=click.Path(readable=False, dir_okay=False, path_type=Path),
    metavar="PNG",
    help="Save a screenshot instead; works without a display.",
)
@click.option(
    "--size",
    metavar="WIDTHxHEIGHT",
    callback=_size,
    help="Size of the screenshot, in pixels; default: that of the camera, or 1280x960.",
)
@click.option("--camera", default="", metavar="NAME", help="View through this camera of the world.")
@click.option(
    "--azimuth", default=120.0, show_default=True, help="Azimuth of the viewpoint, in degrees."
)
@click.option(
    "--elevation",
    default=-25.0,
    show_default=True,
    help="Elevation of the viewpoint in degrees; negative: from above.",
)
@click.option("--zoom", default=1.0, type=click.FloatRange(0.01, 100), help="Zoom factor.")
@click.option("--frames", is_flag=True, help="Show the frames of all bodies.")
@click.option("--names", is_flag=True, help="Show the names of all bodies.")
@click.option("--contacts", is_flag=True, help="Show contact points.")
@click.option(
    "--port", default=8080, show_default=True, help="Port of the page; 0 chooses a free port."
)
@click.option(
    "--browser/--no-browser",
    default=None,
    help="Open the page in the browser; default: on a terminal with a display.",
)
@options.packages
@options.world_folders
@options.output_format
def command(
    *,
    file: Path | None,
    live: bool,
    domain: str | None,
    screenshot: Path | None,
    size: tuple[int, int] | None,
    camera: str,
    azimuth: float,
    elevation: float,
    zoom: float,
    frames: bool,
    names: bool,
    contacts: bool,
    port: int,
    browser: bool | None,
    packages: tuple[Path, ...],
    world_folders: tuple[Path, ...],
    output_format: str,
) -> None:
    """Show a world, a robot or a running simulation in the browser, or save a screenshot.

    FILE is InnerModel, URDF or MJCF, or a shipped robot: nao_h21, nao_h25, icub_v2. The page is
    served on this machine only, and to you only: its URL contains a token. Of a model with errors
    the valid part is shown. With `--live` the page follows a running simulation, and can pause it.
    """
    if file is None and not live:
        raise click.UsageError("Missing argument 'FILE'; `--live` shows a simulation that runs.")
    report = Report()
    try:
        from robocomp_dsl.cli.rcgen.simulation.view_subject import read_subject  # noqa: PLC0415 - slow: MuJoCo
        from robocomp_dsl.simulation.view.picture import Viewpoint  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise MissingExtra("`rcgen view`", "view", error) from None
    look = Viewpoint(azimuth, elevation, 1 / zoom, camera, frames, names, contacts)
    if live or file is None:
        from robocomp_dsl.cli.rcgen.simulation import view_live  # noqa: PLC0415 - loads a middleware

        view_live.show(str(file or ""), domain, look, screenshot, size, port, opens=browser)
        return
    subject = read_subject(file, packages, report, world_folders)
    options.print_findings(report.sorted(), output_format, sys.stderr)
    if subject is None:
        raise CliError(EXIT_FINDINGS)
    if screenshot:
        save_screenshot(subject.model, subject.data(), screenshot, size, look)
    else:
        _serve(subject, port, look, opens=browser)


def _serve(subject: Subject, port: int, look: Viewpoint, *, opens: bool | None) -> None:
    from robocomp_dsl.simulation.view.browser import BrowserPage  # noqa: PLC0415 - needs an extra

    with page_errors(port):
        page = BrowserPage(subject.name, subject.model, subject.data(), look, port=port)
    with closing(page), shown_page(page.url, opens=opens):
        page.run()
