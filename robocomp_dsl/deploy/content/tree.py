"""The files of one process as they are on its host.

In: paths inside the tree and their content hashes. Out: `ContentTree`, whose hash depends on paths,
contents and permission to execute only. Pure.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

EXECUTABLE_SUFFIX = "-x"
"""Blobs of executable files have this after their hash: links share the permissions of a blob."""


@dataclass(frozen=True, slots=True)
class TreeFile:
    """One file: `path` relative to the tree, SHA-256 of its content, and where it is here."""

    path: str
    sha256: str
    size: int
    executable: bool
    source: str

    @property
    def blob(self) -> str:
        """The name of its content on a host."""
        return self.sha256 + (EXECUTABLE_SUFFIX if self.executable else "")


@dataclass(frozen=True)
class ContentTree:
    """The files of one process, sorted by path.

    `origin` is the folder of this machine that the tree mirrors; `working_folder` is relative to
    it. `folders` exist there even if they are empty. `named` are absolute paths as the command line
    has them, each with its place in the tree, longest first. `configs` are the places of the
    configurations that components would search for in their contexts, by full name.
    """

    origin: Path
    working_folder: str
    files: tuple[TreeFile, ...]
    folders: tuple[str, ...] = ()
    named: tuple[tuple[str, str], ...] = ()
    configs: tuple[tuple[str, str], ...] = ()

    @cached_property
    def hash(self) -> str:
        """SHA-256 over paths, contents and permissions, as 64 hexadecimal digits."""
        lines = [f"{folder}/\0\0" for folder in self.folders]
        lines += [f"{file.path}\0{file.blob}\0" for file in self.files]
        return hashlib.sha256("".join(lines).encode()).hexdigest()

    @cached_property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(file.size for file in self.files)


def make_tree(
    origin: Path,
    working_folder: str,
    files: Iterable[TreeFile],
    folders: Iterable[str] = (),
    named: Iterable[tuple[str, str]] = (),
    configs: Iterable[tuple[str, str]] = (),
) -> ContentTree:
    """A tree with sorted files, each path once."""
    by_path = {file.path: file for file in files}
    return ContentTree(
        origin,
        working_folder,
        tuple(by_path[path] for path in sorted(by_path)),
        tuple(sorted(set(folders))),
        tuple(named),
        tuple(configs),
    )
