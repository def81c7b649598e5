"""Resolves imports of interface descriptions to files.

In: the name in an import and the importing file. Out: a path in one of the folders, in this order:
the folder of the file, the `-I` folders, those of `ROBOCOMP_INTERFACES`, the shipped interfaces.
Only the last part of a written path is used, so no import leaves these folders.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check.workspace.ros_definitions import RosDefinitions
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.check.workspace.yarp_definitions import YarpDefinitions
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.source import Source, UnreadableSource

VARIABLE = "ROBOCOMP_INTERFACES"
SUFFIX = ".idsl"
_DECLARED = re.compile(
    r"\b(?:interface|struct|enum|exception)\s+([A-Za-z_]\w*)|>\s*([A-Za-z_]\w*)\s*;"
)


def base_name(written: str) -> str:
    """The last part of a path with slashes or backslashes."""
    return re.split(r"[\\/]", written)[-1]


class ImportResolver:
    """The import folders of one run and their files."""

    def __init__(
        self, files: SourceCache, folders: Iterable[Path], environ: Mapping[str, str], shipped: Path
    ) -> None:
        self._files = files
        listed = (Path(folder) for folder in environ.get(VARIABLE, "").split(os.pathsep) if folder)
        named = (*folders, *listed)
        self._everywhere = (*named, shipped)
        self.ros = RosDefinitions(files, named, environ, shipped)
        self.yarp = YarpDefinitions(files, self._everywhere)
        self._declared: dict[Path, tuple[Source, frozenset[str]]] = {}
        self._importable: tuple[Path, list[Path]] | None = None

    def search_path(self, root: Path) -> Sequence[Path]:
        """The folders searched for imports of the checked file `root`, without duplicates."""
        return list(dict.fromkeys((root.parent, *self._everywhere)))

    def find(self, name: str, root: Path) -> Path | None:
        """The first file called `name`, or None."""
        for folder in self.search_path(root):
            path = folder / name
            if self._files.exists(path):
                return path
        return None

    def importable_files(self, root: Path) -> list[str]:
        """Names of all importable files, for completion and suggestions."""
        names = (n for folder in self.search_path(root) for n in self._files.names_in(folder))
        return list(dict.fromkeys(n for n in names if n.lower().endswith(SUFFIX)))

    def suggest(self, name: str, root: Path) -> str | None:
        """The importable file whose name is closest to `name`, or None."""
        known = {
            file[: -len(SUFFIX)]: file for file in self.importable_files(root) if file != root.name
        }
        stem = nearest(name.removesuffix(SUFFIX), known)
        return known[stem] if stem else None

    def files_mentioning(self, name: str, root: Path) -> list[Path]:
        """The importable files that probably declare `name`.

        Files are scanned with a regular expression, not parsed: see `suggest_import`.
        """
        if self._importable is None or self._importable[0] != root:
            paths = (self.find(known, root) for known in self.importable_files(root))
            self._importable = (root, [path for path in paths if path is not None])
        return [path for path in self._importable[1] if name in self._declared_names(path)]

    def start_run(self) -> None:
        """Forget the folder contents; they are assumed constant within one run."""
        self._importable = None

    def _declared_names(self, path: Path) -> frozenset[str]:
        try:
            source = self._files.read(path)
        except UnreadableSource:
            return frozenset()
        cached = self._declared.get(path)
        if cached is None or cached[0] is not source:
            cached = (source, frozenset(a or b for a, b in _DECLARED.findall(source.text)))
            self._declared[path] = cached
        return cached[1]
