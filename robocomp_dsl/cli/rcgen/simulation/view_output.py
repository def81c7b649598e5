"""The output of `rcgen view`: a screenshot, or the URL of the page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError

if TYPE_CHECKING:
    from robocomp_dsl.simulation.view.picture import Viewpoint


def save_screenshot(
    model: Any, data: Any, path: Path, size: tuple[int, int], viewpoint: Viewpoint
) -> None:
    """Render a screenshot of `size` (width, height in pixels) and print its path."""
    from robocomp_dsl.hardware.devices.errors import NoRendering  # noqa: PLC0415 - slow: MuJoCo
    from robocomp_dsl.simulation.view.picture import Renderer, save  # noqa: PLC0415

    try:
        with Renderer(model, *size) as renderer:
            save(path, renderer.render(data, viewpoint))
    except (NoRendering, OSError) as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    print(f"{path}: {size[0]} x {size[1]} pixels")


def port_error(port: int, error: OSError) -> CliError:
    """The error for a port that the page cannot use."""
    reason = error.strerror or error
    return CliError(EXIT_FINDINGS, f"port {port} cannot be used: {reason}; try --port 0")


def print_url(url: str) -> None:
    """Print the URL of the page."""
    print(f"view at {url}; Ctrl-C stops", flush=True)
