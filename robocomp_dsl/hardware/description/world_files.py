"""Searches the meshes and pictures of a world; many worlds were written on another computer.

In: a path as the world has it, the folder of the world, and folders that the user names. Out: the
path of an existing file, or the path as written.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

VARIABLE = "ROBOCOMP_FILES"
"""Variable with folders of meshes and pictures, separated by `:`."""

_ANNEX = ".git/annex"
_MOST_NAMED = 4


class FileSearch:
    """Searches files by the end of their path.

    `/home/robocomp/robocomp/files/osgModels/table.osg` is, in this order: that file; a file with
    the longest possible end of this path in one of `folders` or of `VARIABLE`, such as
    `FOLDER/osgModels/table.osg` or `FOLDER/table.osg`; the same in the folder of the world and the
    folders above it, where a bare file name is only searched beside the world; at last a file in
    `folders` or beside the world whose path differs in upper and lower case.
    """

    def __init__(
        self, world: Path, folders: Sequence[Path] = (), environ: Mapping[str, str] = os.environ
    ) -> None:
        more = [Path(entry) for entry in environ.get(VARIABLE, "").split(os.pathsep) if entry]
        self.world = world.absolute()
        self.folders = tuple(folder.expanduser().absolute() for folder in (*folders, *more))
        self._found: dict[Path, Path] = {}  # a mesh may occur a hundred times in a world
        self._entries: dict[Path, dict[str, str]] = {}

    def find(self, written: Path) -> Path:
        """The path of the file; `written`, absolute, if there is none.

        A link whose target is missing is the result if there is no file.
        """
        if written not in self._found:
            self._found[written] = self._find(written.absolute())
        return self._found[written]

    def _find(self, written: Path) -> Path:
        if _is_file(written):
            return written
        candidates = list(self._candidates(_parts(written)))
        for path in candidates:
            if _is_file(path):
                return path
        for base in (*self.folders, self.world):
            for tail in _tails(_parts(written), 1):
                if similar := self._similar(base, tail):
                    return similar
        return next((path for path in (written, *candidates) if _is_link(path)), written)

    def _candidates(self, parts: Sequence[str]) -> Iterator[Path]:
        for base in self.folders:
            yield from (base.joinpath(*tail) for tail in _tails(parts, 1))
        for base in (self.world, *self.world.parents):
            least = 1 if base == self.world else 2
            yield from (base.joinpath(*tail) for tail in _tails(parts, least))

    def _similar(self, folder: Path, tail: Sequence[str]) -> Path | None:
        """The file whose path differs from `tail` in upper and lower case only."""
        path = folder
        for name in tail:
            entry = self._names(path).get(name.casefold())
            if entry is None:
                return None
            path = path / entry
        return path if _is_file(path) else None

    def _names(self, folder: Path) -> dict[str, str]:
        if folder not in self._entries:
            try:
                names = sorted((path.name for path in folder.iterdir()), reverse=True)
            except OSError:
                names = []
            self._entries[folder] = {name.casefold(): name for name in names}
        return self._entries[folder]


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name that no file can have
        return False


def _is_link(path: Path) -> bool:
    try:
        return path.is_symlink()
    except (OSError, ValueError):
        return False


def _parts(written: Path) -> tuple[str, ...]:
    """The parts of a path; worlds of Windows have backslashes."""
    text = str(written)
    return Path(os.path.normpath(text.replace("\\", "/"))).parts[1:]


def _tails(parts: Sequence[str], least: int) -> Iterator[Sequence[str]]:
    """The ends of a path with at least `least` parts, the longest first."""
    return (parts[i:] for i in range(len(parts) - least + 1))


@dataclass(frozen=True, slots=True)
class MissingFiles:
    """The nodes of a world whose mesh or picture is missing: pairs of id and path."""

    meshes: tuple[tuple[str, str], ...]
    pictures: tuple[tuple[str, str], ...]

    def __bool__(self) -> bool:
        return bool(self.meshes or self.pictures)

    @property
    def first(self) -> str:
        """The id of the first node."""
        return (self.meshes or self.pictures)[0][0]

    @property
    def message(self) -> str:
        """Which nodes lack their file, in one line."""
        parts = []
        for nodes, noun, result in (
            (self.meshes, "mesh", "a small marker"),
            (self.pictures, "picture", "a colour"),
        ):
            if nodes:
                files = len({file for _, file in nodes})
                count = f"{len(nodes)} {_plural('node', len(nodes))}"
                parts.append(
                    f"{files} {_plural(noun, files)} not found, {result} instead in {count}:"
                    f" {_named(nodes)}"
                )
        return "; ".join(parts)

    def help(self, search: FileSearch, *, option: bool = True) -> str:
        """Where the files were searched, and what to do; `option`: there is `--files`."""
        links = [path for path in self._paths() if _is_link(path)]
        if any(_ANNEX in str(path.readlink()) for path in links):
            return f"git-annex has not fetched their content: `git annex get` in {links[0].parent}"
        named = [str(folder) for folder in search.folders]
        beside = f"{search.world} and the folders above it"
        end = "/".join(_parts(self._paths()[0])[-2:])
        ways = f"`--files DIR` or {VARIABLE}=DIR" if option else f"{VARIABLE}=DIR"
        return (
            f"searched by the end of the path in {', '.join([*named, beside])};"
            f" {ways} names the folder that has `{end}`"
        )

    def _paths(self) -> list[Path]:
        return [Path(file) for _, file in (*self.meshes, *self.pictures)]


def missing_files(
    meshes: Iterable[tuple[str, str]], pictures: Iterable[tuple[str, str]]
) -> MissingFiles:
    """Those of the pairs of id and path whose file does not exist."""
    return MissingFiles(
        tuple((id_, file) for id_, file in meshes if not exists(Path(file))),
        tuple((id_, file) for id_, file in pictures if not exists(Path(file))),
    )


def exists(path: Path) -> bool:
    """Whether a path names something."""
    try:
        return path.exists()
    except (OSError, ValueError):  # a name that no file can have
        return False


def _named(nodes: Sequence[tuple[str, str]]) -> str:
    """The first ids, each with its file."""
    first: dict[str, str] = {}
    for id_, file in nodes:
        first.setdefault(file, id_)
    listed = [f"`{id_}` ({file})" for file, id_ in first.items()]
    more = f" and {len(listed) - _MOST_NAMED} more" if len(listed) > _MOST_NAMED else ""
    return ", ".join(listed[:_MOST_NAMED]) + more


def _plural(noun: str, count: int) -> str:
    if count == 1:
        return noun
    return f"{noun}es" if noun.endswith("sh") else f"{noun}s"
