"""Resolve the files that a scene refers to; many worlds were written on another machine.

In: a lowered scene and the folder of its description. Out: the same scene with absolute paths, to
existing files if possible.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

_FILE_KEYS = (("meshes", "file"), ("boxes", "texture"))


def resolve_files(scene: dict[str, Any], folder: Path) -> None:
    """Replace the file names of meshes and textures by absolute paths."""
    known: dict[str, str] = {}  # a mesh may occur a hundred times in a world
    for part, key in _FILE_KEYS:
        for item in scene[part]:
            written = item.get(key)
            if written:
                if written not in known:
                    known[written] = str(find_file(Path(written).absolute(), folder.absolute()))
                item[key] = known[written]


def find_file(written: Path, folder: Path) -> Path:
    """`written` if it exists; else a file with the end of its path in `folder` or a parent of it.

    `/home/robocomp/robocomp/files/osgModels/table.osg`, in a world in `~/rc/files/innermodel`, is
    `~/rc/files/osgModels/table.osg`. A bare file name is only searched in the folder of the world.
    """
    if written.is_file():
        return written
    parts = written.parts[1:]
    for base in (folder, *folder.parents):
        least = 1 if base == folder else 2
        for i in range(len(parts) - least + 1):
            here = base.joinpath(*parts[i:])
            if here.is_file():
                return here
    return written
