"""Where the files are that a scene names: most worlds come from another machine.

In: a lowered scene and the folder of its description. Out: the same scene with absolute paths, to
files that are there wherever possible.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

_NAMING = (("meshes", "file"), ("boxes", "texture"))


def locate(scene: dict[str, Any], folder: Path) -> None:
    """Let meshes and pictures name files by where they are, from any working directory."""
    known: dict[str, str] = {}  # a table may stand in a room a hundred times
    for part, key in _NAMING:
        for one in scene[part]:
            written = one.get(key)
            if written:
                if written not in known:
                    known[written] = str(found(Path(written).absolute(), folder.absolute()))
                one[key] = known[written]


def found(written: Path, folder: Path) -> Path:
    """`written` if it is there; else what has the end of its path beside `folder`, or above it.

    `/home/robocomp/robocomp/files/osgModels/table.osg`, in a world in `~/rc/files/innermodel`, is
    `~/rc/files/osgModels/table.osg`. A bare name counts in the folder of the world alone.
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
