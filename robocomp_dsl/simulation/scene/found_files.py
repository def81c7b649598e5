"""Finds the meshes and pictures of a scene that was described on another computer.

In: a scene and its folder. Out: the scene with the paths of the files that exist.
"""

from __future__ import annotations

from dataclasses import replace
from logging import Logger
from pathlib import Path

from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.description.world_files import FileSearch, missing_files


def with_found_files(scene: Scene, folder: Path, log: Logger) -> Scene:
    """The scene with the files that are found beside it or in ROBOCOMP_FILES.

    A warning names the missing ones.
    """
    search = FileSearch(folder)
    boxes = tuple(
        replace(box, texture=str(search.find(Path(box.texture)))) if box.texture else box
        for box in scene.boxes
    )
    meshes = tuple(
        replace(mesh, file=str(search.find(Path(mesh.file)))) if mesh.file else mesh
        for mesh in scene.meshes
    )
    missing = missing_files(
        ((mesh.id, mesh.file) for mesh in meshes if mesh.file),
        ((box.id, box.texture) for box in boxes if box.texture),
    )
    if missing:
        log.warning("%s (%s)", missing.message, missing.help(search, option=False))
    return replace(scene, boxes=boxes, meshes=meshes)
