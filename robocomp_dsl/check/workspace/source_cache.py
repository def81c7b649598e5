"""Caches sources and trees; unsaved editor buffers (overlays) take precedence over the disk.

In: paths. Out: `Source` and `Parsed` values, which stay the same objects while a text is unchanged,
so that everything derived from them can be cached as well.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from stat import S_ISREG
from typing import Any, Generic, TypeVar

from robocomp_dsl.diagnostics import Diagnostic, Report
from robocomp_dsl.record import Record
from robocomp_dsl.source import Source

Tree = TypeVar("Tree")
Tree_co = TypeVar("Tree_co", covariant=True)
Parser = Callable[[Source, Report], Tree]
_Stamp = tuple[int, int, int]


class Parsed(Record, Generic[Tree_co]):
    """A text, its tree and its syntax diagnostics."""

    source: Source
    tree: Tree_co
    diagnostics: tuple[Diagnostic, ...]


def canonical_path(path: Path) -> str:
    """The canonical path of a file: absolute, symbolic links resolved."""
    try:
        return os.path.realpath(path)
    except (OSError, ValueError):
        return str(path)


class SourceCache:
    """Reads and parses files, and caches both until a file or its overlay changes."""

    def __init__(self) -> None:
        self._overlays: dict[str, Source] = {}
        self._virtual: dict[str, Source] = {}
        self._sources: dict[str, tuple[_Stamp, Source]] = {}
        self._parsed: dict[tuple[str, Any], Parsed[Any]] = {}

    def set_overlay(self, path: Path, text: str) -> Source:
        """Use `text` instead of the file at `path`; called for every change of an editor buffer."""
        key = canonical_path(path)
        earlier = self._overlays.get(key)
        source = Source(path, text, earlier.parse_cache if earlier else {})
        self._overlays[key] = source
        return source

    def remove_overlay(self, path: Path) -> None:
        """Use the file on disk at `path` again."""
        self._overlays.pop(canonical_path(path), None)

    def set_virtual(self, path: Path, text: str) -> None:
        """Use `text` where there is no file at `path`: a text that is stored elsewhere."""
        self._virtual[canonical_path(path)] = Source(path, text)

    def exists(self, path: Path) -> bool:
        """Whether there is an overlay, a regular file or a virtual file at `path`."""
        if is_regular_file(path):
            return True
        if not self._overlays and not self._virtual:
            return False
        key = canonical_path(path)
        return key in self._overlays or key in self._virtual

    def names_in(self, folder: Path) -> list[str]:
        """Names of the files in `folder` and of the overlays for it, sorted."""
        try:
            found = {entry.name for entry in os.scandir(folder) if entry.is_file()}
        except (OSError, ValueError):
            found = set()
        home = canonical_path(folder)
        found.update(Path(key).name for key in self._overlays if str(Path(key).parent) == home)
        return sorted(found)

    def read(self, path: Path) -> Source:
        """The text at `path`. Raises `UnreadableSource`."""
        key = canonical_path(path)
        if key in self._overlays:
            return self._overlays[key]
        stamp = _stamp(path)
        cached = self._sources.get(key)
        if cached is not None and stamp is not None and cached[0] == stamp:
            return cached[1]
        if stamp is None and key in self._virtual:
            return self._virtual[key]
        source = Source.read(path)
        if stamp is not None:
            self._sources[key] = (stamp, source)
        return source

    def parse(self, path: Path, parser: Parser[Tree]) -> Parsed[Tree]:
        """The tree of the text at `path`. Raises `UnreadableSource`."""
        source = self.read(path)
        key = (canonical_path(path), parser)
        cached = self._parsed.get(key)
        if cached is None or cached.source is not source:
            report = Report()
            cached = Parsed(source, parser(source, report), tuple(report))
            self._parsed[key] = cached
        return cached


def _stamp(path: Path) -> _Stamp | None:
    """Modification time, size and inode; None for missing and non-regular files."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return (found.st_mtime_ns, found.st_size, found.st_ino) if S_ISREG(found.st_mode) else None


def is_regular_file(path: Path) -> bool:
    """Whether there is a regular file at `path` on the disk."""
    try:
        return path.is_file()
    except OSError:  # name too long, folder not accessible
        return False
