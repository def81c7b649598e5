"""Opens a page in the user's browser without showing its URL to other users.

In: a URL with a token. Out: a browser that shows it. The command line of a process can be read by
all users, so the browser gets the name of a private file that leads to the URL.
"""

from __future__ import annotations

import contextlib
import html
import os
import sys
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from robocomp_dsl.runtime.private_folder import user_folder

_PAGE = """<!doctype html><meta charset="utf-8"><meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={url}"><a href="{url}">{url}</a>
"""


def has_display() -> bool:
    """Whether a browser can be shown: there is a desktop, and a person at a terminal."""
    desktop = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    return sys.stdout.isatty() and (bool(desktop) or sys.platform == "darwin")


@contextmanager
def opened_in_browser(url: str, *, opens: bool) -> Iterator[None]:
    """Show `url` in the browser if `opens`; the file that leads to it exists during the block.

    Raises `UnsafeFolder`. A browser that cannot be started is no error.
    """
    if not opens:
        yield
        return
    path = redirect_file(url)
    try:
        with contextlib.suppress(webbrowser.Error, OSError):
            webbrowser.open(path.as_uri())
        yield
    finally:
        path.unlink(missing_ok=True)


def redirect_file(url: str) -> Path:
    """A new file with mode 0600 in the user's folder that leads to `url`."""
    path = user_folder() / f"view-{os.getpid()}.html"
    path.unlink(missing_ok=True)
    descriptor = os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
    with os.fdopen(descriptor, "w", encoding="utf-8") as stream:
        stream.write(_PAGE.format(url=html.escape(url)))
    return path
