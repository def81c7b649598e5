"""The user's files as the checks see them: unsaved buffers first, then the disk; each parsed once.

In: paths. Out: `Source` and `Parsed` values that stay the same objects while a text stays the same,
so that everything derived from them can be kept as well.
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
    """A text, its tree, and what the parser said about its form."""

    source: Source
    tree: Tree_co
    findings: tuple[Diagnostic, ...]


def identity(path: Path) -> str:
    """One name per file, however it was reached."""
    try:
        return os.path.realpath(path)
    except (OSError, ValueError):
        return str(path)


class Files:
    """Reads and parses files, and remembers both until a file or its buffer changes."""

    def __init__(self) -> None:
        self._buffers: dict[str, Source] = {}
        self._sources: dict[str, tuple[_Stamp, Source]] = {}
        self._parsed: dict[tuple[str, Any], Parsed[Any]] = {}

    def open_buffer(self, path: Path, text: str) -> Source:
        """Let `text` win over what is on the disk at `path`; again for every change of it."""
        key = identity(path)
        earlier = self._buffers.get(key)
        source = Source(path, text, earlier.memory if earlier else {})
        self._buffers[key] = source
        return source

    def close_buffer(self, path: Path) -> None:
        """Go back to the disk for `path`."""
        self._buffers.pop(identity(path), None)

    def exists(self, path: Path) -> bool:
        """Whether there is a buffer or a regular file at `path`."""
        return _is_file(path) or (bool(self._buffers) and identity(path) in self._buffers)

    def names_in(self, folder: Path) -> list[str]:
        """Names of the files in `folder` and of the buffers opened for it, sorted."""
        try:
            found = {entry.name for entry in os.scandir(folder) if entry.is_file()}
        except (OSError, ValueError):
            found = set()
        home = identity(folder)
        found.update(Path(key).name for key in self._buffers if str(Path(key).parent) == home)
        return sorted(found)

    def read(self, path: Path) -> Source:
        """The text at `path`. Raises `UnreadableSource`."""
        key = identity(path)
        if key in self._buffers:
            return self._buffers[key]
        stamp = _stamp(path)
        kept = self._sources.get(key)
        if kept is not None and stamp is not None and kept[0] == stamp:
            return kept[1]
        source = Source.read(path)
        if stamp is not None:
            self._sources[key] = (stamp, source)
        return source

    def parse(self, path: Path, parser: Parser[Tree]) -> Parsed[Tree]:
        """The tree of the text at `path`. Raises `UnreadableSource`."""
        source = self.read(path)
        key = (identity(path), parser)
        kept = self._parsed.get(key)
        if kept is None or kept.source is not source:
            report = Report()
            kept = Parsed(source, parser(source, report), tuple(report))
            self._parsed[key] = kept
        return kept


def _stamp(path: Path) -> _Stamp | None:
    """What changes when a file is written; None for what is not there or is read only once."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return (found.st_mtime_ns, found.st_size, found.st_ino) if S_ISREG(found.st_mode) else None


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name too long, a folder that may not be entered
        return False
