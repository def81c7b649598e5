"""Mesh files: OBJ and STL with faces; only points of `.osg`, `.3ds` and `.dae`.

In: a path. Out: points in the axes of the file, or in the frame of RoboComp's viewer, mirrored into
RoboComp's axes; or `MeshError` with a message for the user.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from xml.etree.ElementTree import ParseError

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.hardware.formats.collada import collada_points
from robocomp_dsl.regular_file import read_bytes

MAX_BYTES = 200 * 1024 * 1024

_OSG_ARRAY = re.compile(r"VertexArray\s+\w*\s*\d*\s*\{([^}]*)\}")
_3DS_GROUPS = {0x4D4D, 0x3D3D, 0x4000, 0x4100}
_3DS_OBJECT, _3DS_POINTS = 0x4000, 0x4110


class MeshError(HardwareError):
    """The file contains no usable mesh."""


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """`points` of shape (n, 3), in the units of the file; `faces` of shape (m, 3) or none."""

    points: NDArray[np.float64]
    faces: NDArray[np.int32]


def read_mesh(path: Path) -> Surface:
    """The mesh at `path` in RoboComp's axes. Raises `MeshError`."""
    surface = read_surface(path)
    if path.suffix.lower() == ".obj":
        surface = _turned_up(surface)
    # the viewer's frame is right-handed with z backwards (RoboComp, QMatToOSGMat4)
    return Surface(surface.points * (1.0, 1.0, -1.0), surface.faces[:, ::-1])


def read_surface(path: Path) -> Surface:
    """The mesh at `path` in the axes of the file, right-handed. Raises `MeshError`."""
    read = _READERS.get(path.suffix.lower())
    if read is None:
        raise MeshError(
            f"`{path.suffix}` files cannot be read; convert it to .obj or .stl"
            if path.suffix
            else "its suffix names no supported format"
        )
    try:
        if path.stat().st_size > MAX_BYTES:
            raise MeshError(f"the file is larger than {MAX_BYTES // 1024 // 1024} MB")
        surface = read(read_bytes(path))
    except OSError as error:
        raise MeshError(error.strerror or "the file cannot be read") from None
    except (ValueError, IndexError, struct.error, ParseError) as error:
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
    return _surface(points, faces)


def _turned_up(surface: Surface) -> Surface:
    """OpenSceneGraph treats y of an OBJ file as up and turns it to z."""
    x, y, z = surface.points.T
    return Surface(np.stack([x, -z, y], axis=1), surface.faces)


def _surface(points: list[list[float]], faces: list[tuple[int, int, int]]) -> Surface:
    vertices = np.array(points, dtype=np.float64).reshape(-1, 3)
    joined = np.array(faces, dtype=np.int32).reshape(-1, 3)
    if len(joined) and (joined.min() < 0 or joined.max() >= len(vertices)):
        raise ValueError("a face names a point that is not there")
    return Surface(vertices, joined)


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


def _osg(data: bytes) -> Surface:
    text = data.decode("utf-8", "replace")
    numbers = [float(word) for block in _OSG_ARRAY.findall(text) for word in block.split()]
    return _surface(np.array(numbers).reshape(-1, 3).tolist(), [])


def _3ds(data: bytes) -> Surface:
    points: list[NDArray[np.float64]] = []
    todo = [(0, len(data))]
    while todo:
        at, end = todo.pop()
        while at + 6 <= end:
            kind, size = struct.unpack_from("<HI", data, at)
            inside, after = at + 6, min(at + max(size, 6), end)
            if kind == _3DS_OBJECT:
                inside = data.index(b"\0", inside) + 1  # the name of the object
            if kind in _3DS_GROUPS:
                todo.append((inside, after))
            elif kind == _3DS_POINTS:
                (count,) = struct.unpack_from("<H", data, inside)
                found = np.frombuffer(data, "<f4", 3 * count, inside + 2)
                points.append(found.reshape(-1, 3).astype(np.float64))
            at = after
    return Surface(np.concatenate(points or [np.empty((0, 3))]), np.empty((0, 3), np.int32))


def _dae(data: bytes) -> Surface:
    return Surface(collada_points(data), np.empty((0, 3), np.int32))


_READERS: dict[str, Callable[[bytes], Surface]] = {
    ".obj": _obj,
    ".stl": _stl,
    ".osg": _osg,
    ".3ds": _3ds,
    ".dae": _dae,
}
