"""Resolves imports of interface descriptions to files.

In: the path in an import, the importing file and the checked file. Out: the first existing file of:
the path as written, relative to the importing file; its last part beside the checked file and
beside the importing file; both in the `-I` folders and those of `ROBOCOMP_INTERFACES`; both in
`interfaces/` beside or above the importing file and the checked file; the shipped interfaces.

A file of the shipped interfaces imports what is beside the checked file, if it has the name: a
project that has its own version of a shipped file uses it everywhere.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check.workspace.ros_definitions import RosDefinitions
from robocomp_dsl.check.workspace.source_cache import SourceCache
from robocomp_dsl.check.workspace.yarp_definitions import YarpDefinitions
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.source import Source, UnreadableSource

VARIABLE = "ROBOCOMP_INTERFACES"
SUFFIX = ".idsl"
_PROJECT = (("interfaces",), ("interfaces", "IDSLs"))
"""Folders of interfaces of a project, the second in the layout of RoboComp."""
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
        self._named = (*folders, *listed)
        self._shipped = shipped
        self._around: dict[Path, tuple[Path, ...]] = {}
        self.ros = RosDefinitions(files, self._named, environ, shipped)
        self.yarp = YarpDefinitions(files, (*self._named, shipped))
        self._declared: dict[Path, tuple[Source, frozenset[str]]] = {}
        self._importable: tuple[Path, list[Path]] | None = None

    def search_path(self, root: Path, beside: Path | None = None) -> Sequence[Path]:
        """The folders searched for what the file `beside` imports, without duplicates.

        `root` is the checked file, which is also the default of `beside`.
        """
        around = self._interfaces_around(root)
        own: tuple[Path, ...] = (root.parent,)
        if beside is not None and beside.parent != root.parent:
            own = (root.parent, beside.parent)
            around = (*self._interfaces_around(beside), *around)
        return list(dict.fromkeys((*own, *self._named, *around, self._shipped)))

    def find(self, written: str, root: Path, beside: Path | None = None) -> Path | None:
        """The file that an import of `written` in the file `beside` means, or None."""
        path, name = written.replace("\\", "/"), base_name(written)
        importing = beside or root
        if importing.parent != self._shipped:
            found = self._first(importing.parent, (path,))
            if found is not None:
                return found
        leaves = path.startswith("/") or ".." in path.split("/")
        texts = (name,) if leaves or path == name else (path, name)
        for folder in self.search_path(root, beside):
            found = self._first(folder, texts)
            if found is not None:
                return found
        return None

    def _first(self, folder: Path, texts: Iterable[str]) -> Path | None:
        for text in texts:
            path = folder / text
            if self._files.exists(path):
                return Path(os.path.normpath(path)) if ".." in text else path
        return None

    def _interfaces_around(self, file: Path) -> tuple[Path, ...]:
        """The folders `interfaces` beside and above a file, below that of the shipped ones."""
        folder = file.parent
        if folder not in self._around:
            self._around[folder] = tuple(self._climb(folder))
        return self._around[folder]

    def _climb(self, folder: Path) -> Iterator[Path]:
        home = self._shipped.absolute().parent
        if ".." in folder.parts:
            folder = folder.resolve()
        for place in (folder, *folder.parents, *folder.absolute().parents[len(folder.parents) :]):
            if place.absolute() == home:
                return
            for part in _PROJECT:
                if Path(place, *part).is_dir():
                    yield Path(place, *part)

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
            paths: dict[str, Path] = {}
            for folder in self.search_path(root):
                for known in self._files.names_in(folder):
                    if known.lower().endswith(SUFFIX):
                        paths.setdefault(known, folder / known)
            self._importable = (root, list(paths.values()))
        return [path for path in self._importable[1] if name in self._declared_names(path)]

    def start_run(self) -> None:
        """Forget the folder contents; they are assumed constant within one run."""
        self._importable = None
        self._around.clear()

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
