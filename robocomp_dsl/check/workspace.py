"""Where the checked files are and what is known of them.

In: folders, the environment, unsaved buffers. Out: everything that the passes share. Keep one for
as long as an editor or a command runs: what did not change is not read, parsed or resolved again.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from robocomp_dsl.check.files import Files
from robocomp_dsl.check.library import Library
from robocomp_dsl.check.search import Search
from robocomp_dsl.resources import INTERFACES

MIDDLEWARES = ("inproc", "zenoh")
"""Those that come with the project; a caller that knows of more hands them in."""


class Workspace:
    """The files, the folders that imports are searched in, and the interfaces found there."""

    def __init__(
        self,
        folders: Iterable[Path] = (),
        environ: Mapping[str, str] = os.environ,
        middlewares: Iterable[str] = MIDDLEWARES,
        shipped: Path = INTERFACES,
        files: Files | None = None,
    ) -> None:
        self.files = Files() if files is None else files
        self.search = Search(self.files, folders, environ, shipped)
        self.library = Library(self.files, self.search)
        self.middlewares = tuple(middlewares)
