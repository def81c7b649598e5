"""Reads MJCF files, and replaces missing meshes and textures.

In: the path of an MJCF file. Out: its `MjSpec`, in which meshes that MuJoCo cannot read are boxes
or markers, and missing textures are dropped, with findings.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.parsers import expat

import mujoco
import numpy as np

from robocomp_dsl.finding import Finding
from robocomp_dsl.hardware.description.findings import ModelFileError, model_finding
from robocomp_dsl.hardware.description.model_paths import resolve
from robocomp_dsl.hardware.formats.mesh_file import read_surface
from robocomp_dsl.hardware.formats.surface import MeshError, used_part
from robocomp_dsl.regular_file import read_text
from robocomp_dsl.simulation.models.mesh_geom import MeshCache, Settings, is_flat

_POINT = 1e-6  # m
_ITS_OWN = {".obj", ".msh"}
_INCLUDE = re.compile(r"<\s*include\b[^>]*\bfile\s*=\s*[\"']([^\"']+)")
_PREFIX = re.compile(r"^(?:(?:XML )?Error:\s*)+")
_LINE = re.compile(r"line(?: number=|\s+)(\d+)", re.IGNORECASE)


def build_mjcf(path: Path, packages: Sequence[Path] = ()) -> tuple[Any, list[Finding]]:
    """The model in the file at `path`. Raises `ModelFileError`."""
    try:
        spec = _parse(path)
    except (ValueError, mujoco.FatalError) as error:
        raise _malformed(path) or error_with_line(error) from None
    findings: list[Finding] = []
    _replace_meshes(spec, path, packages, findings)
    _drop_textures(spec, path, packages, findings)
    return spec, findings


def _parse(path: Path) -> Any:
    """The file as a spec. MuJoCo reads files of other suffixes than `.xml` as text only."""
    if path.suffix.lower() == ".xml":
        return mujoco.MjSpec.from_file(str(path))
    text = read_text(path)
    included: dict[str, bytes] = {}
    _collect_included(text, path.parent, included)
    spec = mujoco.MjSpec.from_string(text, include=included)
    spec.modelfiledir = str(path.parent)
    return spec


def _malformed(path: Path) -> ModelFileError | None:
    """The first place that is not XML, in words; None for XML, whose errors are MuJoCo's."""
    try:
        expat.ParserCreate().Parse(path.read_bytes(), True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        return ModelFileError(f"this is not well-formed XML: {reason}", error.lineno)
    return None


def _collect_included(text: str, folder: Path, included: dict[str, bytes]) -> None:
    """The files that `text` includes, by their names; a missing one is MuJoCo's error."""
    for name in _INCLUDE.findall(text):
        file = folder / name
        if name not in included and file.is_file():
            included[name] = file.read_bytes()
            _collect_included(read_text(file), folder, included)


def error_with_line(error: Exception) -> ModelFileError:
    """MuJoCo's error about a file, with its line."""
    message = str(error)
    line = _LINE.search(message)
    words = _PREFIX.sub("", " ".join(message.split()))
    return ModelFileError(words, int(line[1]) if line else 0)


def _replace_meshes(
    spec: Any, path: Path, packages: Sequence[Path], findings: list[Finding]
) -> None:
    shelf = MeshCache(spec, findings)
    boxes: dict[str, Settings] = {}
    unreadable: dict[str, Path] = {}
    for mesh in list(spec.meshes):
        file = _mesh_path(spec, mesh, path, packages)
        if not mesh.file or _reads(mesh, file):
            continue
        name = mesh.name or file.stem
        box = shelf.geom(file, tuple(mesh.scale.tolist()), name, _line(mesh))
        if box is None:
            unreadable[name] = file
        else:
            boxes[name] = box
        spec.delete(mesh)
    for geom in list(spec.geoms):
        if geom.meshname in boxes:
            _show_box(geom, boxes[geom.meshname])
        elif geom.meshname in unreadable:
            shelf.mark(geom.parent, unreadable[geom.meshname], geom.pos)
            _hide(geom)


def _mesh_path(spec: Any, mesh: Any, path: Path, packages: Sequence[Path]) -> Path:
    folder = "" if "://" in mesh.file else spec.meshdir
    return resolve(str(Path(folder) / mesh.file) if folder else mesh.file, path, packages)


def _reads(mesh: Any, file: Path) -> bool:
    """Whether MuJoCo reads the mesh of a file itself, or has got its points."""
    if file.suffix.lower() in _ITS_OWN and file.is_file():
        mesh.file = str(file.absolute())
        return True
    return _mesh_source(mesh, file)


def _show_box(geom: Any, box: Settings) -> None:
    """Make the geom of a mesh a box."""
    geom.meshname = ""
    geom.type, geom.size = box["type"], box["size"]
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, geom.quat / np.linalg.norm(geom.quat))
    geom.pos = geom.pos + turn.reshape(3, 3) @ box["shift"]


def _hide(geom: Any) -> None:
    """Make the geom of an unreadable mesh a point that nothing touches and no camera sees.

    It stays in the model, because pairs and sensors may name it.
    """
    geom.meshname, geom.material = "", ""
    geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [_POINT, 0.0, 0.0]
    geom.contype, geom.conaffinity, geom.density = 0, 0, 0.0
    geom.rgba = [0.0, 0.0, 0.0, 0.0]


def _mesh_source(mesh: Any, file: Path) -> bool:
    """Set the points of a mesh from a file; MuJoCo reads OBJ and small binary STL files only."""
    try:
        surface = used_part(read_surface(file))
    except MeshError:
        return False
    if not len(surface.faces) or is_flat(surface.points):
        return False
    mesh.name = mesh.name or file.stem
    mesh.file = ""
    mesh.uservert = surface.points.ravel().tolist()
    mesh.userface = surface.faces.ravel().tolist()
    return True


def _drop_textures(
    spec: Any, path: Path, packages: Sequence[Path], findings: list[Finding]
) -> None:
    gone: set[str] = set()
    for texture in list(spec.textures):
        files = [file for file in (texture.file, *texture.cubefiles) if file]
        folder = Path(spec.texturedir or "")
        missing = [
            file for file in files if not resolve(str(folder / file), path, packages).is_file()
        ]
        if missing:
            name = texture.name or Path(missing[0]).stem
            message = f"the texture `{name}` is left out: `{missing[0]}` is not there"
            findings.append(model_finding("texture", name, message, _line(texture)))
            gone.add(name)
            spec.delete(texture)
    for material in spec.materials:
        for i, name in enumerate(material.textures):
            if name in gone:
                material.textures[i] = ""


def _line(element: Any) -> int:
    found = re.search(r"line (\d+)", element.info)
    return int(found[1]) if found else 0
