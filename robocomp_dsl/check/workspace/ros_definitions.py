"""Finds ROS definitions: `sensor_msgs/msg/LaserScan.msg`.

In: the path in an import and the importing file. Out: an existing file, in this order: beside the
importing file (a ROS definition: in the folder of its package's neighbours), the folder of the
checked file, the import folders, the folders in AMENT_PREFIX_PATH and ROS_PACKAGE_PATH, the shipped
interfaces, and the definitions that the library rosbags contains, if it is installed. The messages
of an action are found by its definition if ROS did not generate them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from robocomp_dsl.check.workspace.ros_action_messages import action_message
from robocomp_dsl.check.workspace.source_cache import SourceCache, is_regular_file
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.syntax.ros.kinds import ROS_SUFFIXES

VARIABLES = ("AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH")
"""Environment variables of ROS 2 and ROS 1 with folders of packages."""

_WRITTEN = re.compile(
    r"(?P<package>[A-Za-z]\w*)/(?:(?P<folder>msg|srv|action)/)?(?P<file>\w+\.\w+)"
)


def is_ros_import(written: str) -> bool:
    """Whether an import names a ROS definition."""
    return written.lower().endswith(ROS_SUFFIXES)


def canonical_name(written: str) -> str:
    """`sensor_msgs/msg/LaserScan.msg`, also for `sensor_msgs/LaserScan.msg`; "" for other texts."""
    found = _WRITTEN.fullmatch(written.strip())
    if found is None:
        return ""
    folder = found["file"].rpartition(".")[2].lower()
    return f"{found['package']}/{folder}/{found['file']}"


class RosDefinitions:
    """The folders of one workspace in which ROS packages are searched."""

    def __init__(
        self,
        files: SourceCache,
        folders: Iterable[Path],
        environ: Mapping[str, str],
        shipped: Path,
    ) -> None:
        listed = [
            Path(folder)
            for variable in VARIABLES
            for folder in environ.get(variable, "").split(os.pathsep)
            if folder
        ]
        self._files = files
        self._folders = (*folders, *listed, shipped)

    def search_path(self, beside: Path, root: Path) -> list[Path]:
        """The folders searched for the definitions that the file `beside` imports."""
        own: tuple[Path, ...] = (beside.parent,)
        if is_ros_import(beside.name):
            own = tuple(beside.parents)[2:3]
        return list(dict.fromkeys((*own, root.parent, *self._folders)))

    def find(self, written: str, beside: Path, root: Path) -> Path | None:
        """The file of a definition, or None."""
        name = canonical_name(written)
        if not name:
            return None
        folders = self.search_path(beside, root)
        found = self._find(name, folders, is_real=True)
        if found is None:
            action = action_message(name, lambda other: self._find(other, folders), self._files)
            found = action or self._find(name, folders)
        return found or _stored(name, self._files)

    def _find(self, name: str, folders: list[Path], *, is_real: bool = False) -> Path | None:
        for folder in folders:
            for path in _candidates(folder, name):
                if is_regular_file(path) if is_real else self._files.exists(path):
                    return path
        return None

    def importable(self, beside: Path, root: Path) -> list[str]:
        """The names of all definitions, for completion and suggestions."""
        names = (n for folder in self.search_path(beside, root) for n in _listed(folder))
        return list(dict.fromkeys((*names, *_stored_names())))

    def suggest(self, written: str, beside: Path, root: Path) -> list[str]:
        """The definitions with the same name, else the closest one of the closest package."""
        known = self.importable(beside, root)
        file = written.rpartition("/")[2]
        same = [name for name in known if name.rpartition("/")[2].lower() == file.lower()]
        if same:
            return same
        packages = {name.partition("/")[0] for name in known}
        package = nearest(canonical_name(written).partition("/")[0], packages)
        inside = {n.rpartition("/")[2]: n for n in known if n.partition("/")[0] == package}
        near = nearest(file, inside)
        return [inside[near]] if near else []


def _candidates(folder: Path, name: str) -> Iterator[Path]:
    """Where a package may be: beside others, installed, the folder itself, or a stack of ROS 1."""
    package, _, rest = name.partition("/")
    yield folder / name
    yield folder / "share" / name
    if folder.name == package:
        yield folder / rest
    try:
        yield from sorted(folder.glob(f"*/{name}"))
    except OSError:
        return


def _listed(folder: Path) -> Iterator[str]:
    """The definitions of all packages in a folder."""
    for base in (folder, folder / "share"):
        for suffix in ROS_SUFFIXES:
            try:
                found = sorted(base.glob(f"*/{suffix[1:]}/*{suffix}"))
            except OSError:
                found = []
            yield from (f"{p.parts[-3]}/{p.parts[-2]}/{p.name}" for p in found)


def _stored(name: str, files: SourceCache) -> Path | None:
    from robocomp_dsl.check.workspace import ros_store  # noqa: PLC0415 - loads rosbags

    return ros_store.definition(name, files)


def _stored_names() -> list[str]:
    from robocomp_dsl.check.workspace import ros_store  # noqa: PLC0415 - loads rosbags

    return ros_store.names()
