"""Resolve the files that a scene refers to; many worlds were written on another computer.

In: a lowered scene and where to search. Out: the same scene with absolute paths, to existing files
if possible.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robocomp_dsl.hardware.description.world_files import FileSearch

_FILE_KEYS = (("meshes", "file"), ("boxes", "texture"))


def resolve_files(scene: dict[str, Any], search: FileSearch) -> None:
    """Replace the file names of meshes and textures by absolute paths."""
    for part, key in _FILE_KEYS:
        for item in scene[part]:
            if item.get(key):
                item[key] = str(search.find(Path(item[key])))
