"""The workspace: the sources, import folders and loaded modules that all passes share.

In: folders, the environment, unsaved buffers. One workspace lives as long as a command or an editor
session: unchanged files are not read, parsed or resolved again.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from robocomp_dsl.check.workspace.import_resolver import ImportResolver
from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.check.workspace.module_loader import ModuleLoader
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.resources import INTERFACES


class Workspace:
    """The sources, the import folders and the loaded interface descriptions.

    `world_folders` are searched for the meshes and pictures of worlds; None: these are not checked.
    """

    def __init__(
        self,
        folders: Iterable[Path] = (),
        environ: Mapping[str, str] = os.environ,
        middlewares: KnownMiddlewares | None = None,
        shipped: Path = INTERFACES,
        files: SourceCache | None = None,
        world_folders: Iterable[Path] | None = None,
    ) -> None:
        self.sources = SourceCache() if files is None else files
        self.import_resolver = ImportResolver(self.sources, folders, environ, shipped)
        self.modules = ModuleLoader(self.sources, self.import_resolver)
        self.world_folders = None if world_folders is None else tuple(world_folders)
        self.middlewares = middlewares or KnownMiddlewares()
