"""Mesh files: the faces of OBJ, STL, `.3ds`, `.osg`, `.osgt` and PLY, and the points of `.dae`.

In: a path. Out: points in the axes of the file, or in the frame of RoboComp's viewer, mirrored into
RoboComp's axes; or `MeshError` with a message for the user. `.ive` and `.osgb` need the program
`osgconv` of OpenSceneGraph, PLY needs trimesh.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from xml.etree.ElementTree import ParseError

import numpy as np

from robocomp_dsl.hardware.formats.collada import collada_points
from robocomp_dsl.hardware.formats.mesh_3ds import read_3ds
from robocomp_dsl.hardware.formats.mesh_osg import read_osg
from robocomp_dsl.hardware.formats.mesh_ply import read_ply
from robocomp_dsl.hardware.formats.osgconv import converted_to_stl
from robocomp_dsl.hardware.formats.surface import NO_FACES, MeshError, Surface, checked_surface
from robocomp_dsl.regular_file import read_bytes

MAX_BYTES = 200 * 1024 * 1024

_CACHED = 64
_POINTERS = {
    b"version https://git-lfs.": "Git LFS has not fetched its content: run `git lfs pull`",
    b"/annex/objects/": "git-annex has not fetched its content: run `git annex get`",
    b"../.git/annex/": "git-annex has not fetched its content: run `git annex get`",
}
"""What tools of large files leave in place of a file."""


def read_mesh(path: Path) -> Surface:
    """The mesh at `path` in RoboComp's axes. Raises `MeshError`."""
    surface = read_surface(path)
    if path.suffix.lower() == ".obj":
        surface = _turned_up(surface)
    # the viewer's frame is right-handed with z backwards (RoboComp, QMatToOSGMat4)
    return Surface(surface.points * (1.0, 1.0, -1.0), surface.faces[:, ::-1])


def read_surface(path: Path) -> Surface:
    """The mesh at `path` in the axes of the file, right-handed. Raises `MeshError`."""
    try:
        status = path.stat()
    except OSError as error:
        raise MeshError(error.strerror or "the file cannot be read") from None
    except ValueError as error:
        raise MeshError(f"its path is invalid: {error}") from None
    if status.st_size > MAX_BYTES:
        raise MeshError(f"the file is larger than {MAX_BYTES // 1024 // 1024} MB")
    result = _read(path, status.st_mtime_ns, status.st_size)
    if isinstance(result, str):
        raise MeshError(result)
    return result


@lru_cache(maxsize=_CACHED)
def _read(path: Path, _modified: int, _size: int) -> Surface | str:
    """The mesh, or why there is none; cached: worlds use a mesh often and are built again."""
    try:
        surface = _surface(path)
    except MeshError as error:
        return str(error)
    surface.points.flags.writeable = False
    surface.faces.flags.writeable = False
    return surface


def _surface(path: Path) -> Surface:
    suffix = path.suffix.lower()
    read = _READERS.get(suffix)
    if read is None and suffix not in CONVERTED:
        raise MeshError(
            f"`{path.suffix}` files cannot be read; convert it to .obj or .stl"
            if path.suffix
            else "its suffix names no supported format"
        )
    try:
        data = read_bytes(path)
        if reason := next((text for key, text in _POINTERS.items() if key in data[:200]), ""):
            raise MeshError(reason)
        surface = read(data) if read else _stl(converted_to_stl(path))
    except OSError as error:
        raise MeshError(error.strerror or "the file cannot be read") from None
    except (ValueError, IndexError, OverflowError, struct.error, ParseError) as error:
        raise MeshError(f"the file is damaged ({error})") from None
    if len(surface.points) == 0 or not np.isfinite(surface.points).all():
        raise MeshError("the file has no points" if len(surface.points) == 0 else "a point is NaN")
    return surface


def _obj(data: bytes) -> Surface:
    points: list[list[float]] = []
    faces: list[tuple[int, int, int]] = []
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [c - 1 if c > 0 else len(points) + c for c in corners]
            faces += [(corners[0], b, c) for b, c in pairwise(corners[1:])]
    vertices = np.array(points, dtype=np.float64).reshape(-1, 3)
    return checked_surface(vertices, np.array(faces, dtype=np.int32).reshape(-1, 3))


def _turned_up(surface: Surface) -> Surface:
    """OpenSceneGraph treats y of an OBJ file as up and turns it to z."""
    x, y, z = surface.points.T
    return Surface(np.stack([x, -z, y], axis=1), surface.faces)


def _stl(data: bytes) -> Surface:
    count = int.from_bytes(data[80:84], "little")
    if len(data) >= 84 and len(data) == 84 + 50 * count:
        record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
        corners = np.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3)
    else:
        found = re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data)
        corners = np.array(found, dtype=np.float64).reshape(-1, 3)
    points, index = np.unique(corners.astype(np.float64), axis=0, return_inverse=True)
    return Surface(points, index.reshape(-1, 3).astype(np.int32))


def _dae(data: bytes) -> Surface:
    return Surface(collada_points(data), NO_FACES)


CONVERTED = frozenset({".ive", ".osgb"})
"""Formats that `osgconv` converts."""

_READERS: dict[str, Callable[[bytes], Surface]] = {
    ".obj": _obj,
    ".stl": _stl,
    ".osg": read_osg,
    ".osgt": read_osg,
    ".3ds": read_3ds,
    ".dae": _dae,
    ".ply": read_ply,
}
