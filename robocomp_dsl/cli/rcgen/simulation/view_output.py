"""The output of `rcgen view`: a screenshot, or the URL of the page."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.runtime.private_folder import UnsafeFolder

if TYPE_CHECKING:
    from robocomp_dsl.simulation.view.picture import Viewpoint


def save_screenshot(
    model: Any, data: Any, path: Path, size: tuple[int, int] | None, viewpoint: Viewpoint
) -> None:
    """Render a screenshot of `size` (width, height in pixels) and print its path.

    Without a size it is that of the camera.
    """
    from robocomp_dsl.hardware.devices.errors import NoRendering  # noqa: PLC0415 - slow: MuJoCo
    from robocomp_dsl.simulation.view.picture import Renderer, picture_size, save  # noqa: PLC0415

    try:
        size = size or picture_size(model, viewpoint)
        with Renderer(model, *size) as renderer:
            save(path, renderer.render(data, viewpoint))
    except (NoRendering, OSError) as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    print(f"{path}: {size[0]} x {size[1]} pixels")


@contextmanager
def page_errors(port: int) -> Iterator[None]:
    """Turn the errors of opening a page into those of the command."""
    from robocomp_dsl.hardware.devices.errors import NoRendering  # noqa: PLC0415 - slow: MuJoCo
    from robocomp_dsl.simulation.view.page_guard import Unprotected  # noqa: PLC0415 - an extra

    try:
        yield
    except OSError as error:
        reason = error.strerror or error
        raise CliError(
            EXIT_FINDINGS, f"port {port} cannot be used: {reason}; try --port 0"
        ) from None
    except (NoRendering, UnsafeFolder, Unprotected) as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


@contextmanager
def shown_page(url: str, *, opens: bool | None) -> Iterator[None]:
    """Print the URL of the page and open it; `opens` None: if there is a display."""
    from robocomp_dsl.simulation.view.open_browser import (  # noqa: PLC0415 - slow: MuJoCo
        has_display,
        opened_in_browser,
    )

    print(f"view at {url}; Ctrl-C stops", flush=True)
    with opened_in_browser(url, opens=has_display() if opens is None else opens):
        yield
