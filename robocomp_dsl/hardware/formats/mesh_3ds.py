"""Meshes of `.3ds` files (Autodesk 3D Studio).

In: the bytes of a file: nested chunks, each of a kind (uint16), a size with its head (uint32) and
content, little endian. Out: points and faces of all objects, placed by the nodes of the scene at
their first key, as OpenSceneGraph places them. Materials and lights are not read.

No maintained reader fits: trimesh and meshio do not read `.3ds`, and bindings of assimp or VTK are
native libraries of 5 to 100 MB for some chunks of points and faces.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from robocomp_dsl.hardware.formats.surface import (
    NO_FACES,
    Points,
    Surface,
    checked_surface,
    joined,
)

_FILE, _EDITOR, _OBJECT, _MESH = 0x4D4D, 0x3D3D, 0x4000, 0x4100
_POINTS, _FACES, _MATRIX = 0x4110, 0x4120, 0x4160
_KEYFRAMES, _NODE, _NODE_ID, _NODE_NAME, _PIVOT = 0xB000, 0xB002, 0xB030, 0xB010, 0xB013
_POSITION, _ROTATION, _SCALE = 0xB020, 0xB021, 0xB022
_HEAD = struct.Struct("<HI")
_TRACK_HEAD = 14
"""Bytes before the first key: flags, unused, number of keys."""
_NO_PARENT = 0xFFFF


@dataclass(frozen=True, slots=True, eq=False)
class _Object:
    """A mesh, as stored: in the frame of the scene; `frame` is its own frame there."""

    surface: Surface
    frame: Points


@dataclass(frozen=True, slots=True, eq=False)
class _Node:
    """A place of an object: its pose in the parent, and the object's own origin there."""

    parent: int
    name: bytes
    pose: Points
    pivot: Points


@dataclass(frozen=True, slots=True)
class _Chunk:
    """The content of a chunk: bytes `start` to `end` of the file."""

    data: bytes
    start: int
    end: int

    def all(self, kind: int) -> Iterator[_Chunk]:
        """The chunks of one kind directly in it."""
        at = self.start
        while at + _HEAD.size <= self.end:
            found, size = _HEAD.unpack_from(self.data, at)
            after = min(at + max(size, _HEAD.size), self.end)
            if found == kind:
                yield _Chunk(self.data, at + _HEAD.size, after)
            at = after

    def first(self, kind: int) -> _Chunk | None:
        """The first chunk of a kind."""
        return next(self.all(kind), None)

    def named(self) -> tuple[bytes, _Chunk]:
        """The text at its beginning, and the rest."""
        end = self.data.index(b"\0", self.start, self.end)
        return self.data[self.start : end], _Chunk(self.data, end + 1, self.end)

    def unpack(self, form: str, offset: int = 0) -> tuple[int, ...]:
        """Numbers at an offset."""
        return struct.unpack_from("<" + form, self.data, self.start + offset)

    def floats(self, count: int, offset: int = 0) -> Points:
        """Single precision numbers at an offset."""
        found = np.frombuffer(self.data, "<f4", count, self.start + offset)
        return found.astype(np.float64)


def read_3ds(data: bytes) -> Surface:
    """Raises `ValueError` and `struct.error` for a damaged file."""
    file = _Chunk(data, 0, len(data)).first(_FILE)
    if file is None:
        raise ValueError("it does not begin as a .3ds file")
    objects = {}
    for editor in file.all(_EDITOR):
        for named in editor.all(_OBJECT):
            name, parts = named.named()
            if mesh := parts.first(_MESH):
                objects[name] = _object(mesh)
    nodes: dict[int, _Node] = {}
    for keyframes in file.all(_KEYFRAMES):
        for index, chunk in enumerate(keyframes.all(_NODE)):
            identifier = chunk.first(_NODE_ID)
            nodes[identifier.unpack("H")[0] if identifier else index] = _node(chunk)
    placed = [
        _placed(objects[node.name], _pose(node, nodes) @ _shift(-node.pivot))
        for node in nodes.values()
        if node.name in objects
    ]
    names = {node.name for node in nodes.values()}
    return joined([*placed, *(item.surface for key, item in objects.items() if key not in names)])


def _object(chunk: _Chunk) -> _Object:
    points, faces, frame = np.empty((0, 3)), NO_FACES, np.eye(4)
    if found := chunk.first(_POINTS):
        points = found.floats(3 * found.unpack("H")[0], 2).reshape(-1, 3)
    if found := chunk.first(_FACES):
        count = found.unpack("H")[0]
        corners = np.frombuffer(chunk.data, "<u2", 4 * count, found.start + 2)
        faces = corners.reshape(-1, 4)[:, :3].astype(np.int32)  # the fourth has flags
    if found := chunk.first(_MATRIX):
        frame[:3] = found.floats(12).reshape(4, 3).T
    surface = checked_surface(points, faces)
    if np.linalg.det(frame[:3, :3]) < 0:  # a mirrored object is stored without the mirror
        surface = _moved(surface, frame @ np.diag([-1.0, 1.0, 1.0, 1.0]) @ _inverse(frame))
    return _Object(surface, frame)


def _node(chunk: _Chunk) -> _Node:
    named, pivot = chunk.first(_NODE_NAME), chunk.first(_PIVOT)
    name, parent = b"", _NO_PARENT
    if named:
        name, rest = named.named()
        parent = rest.unpack("H", 4)[0]
    place, turn, scale = (
        _first_key(chunk.first(kind), usual)
        for kind, usual in (
            (_POSITION, (0.0, 0.0, 0.0)),
            (_ROTATION, (0.0, 0.0, 0.0, 1.0)),
            (_SCALE, (1.0, 1.0, 1.0)),
        )
    )
    pose: Points = _shift(place)
    pose[:3, :3] = _rotation(turn[1:], -float(turn[0])) @ np.diag(scale)
    return _Node(parent, name, pose, pivot.floats(3) if pivot else np.zeros(3))


def _first_key(track: _Chunk | None, usual: tuple[float, ...]) -> Points:
    """The value of the first key; before it are its time and the settings of its spline."""
    if track is None or not track.unpack("I", _TRACK_HEAD - 4)[0]:
        return np.array(usual)
    splines = track.unpack("H", _TRACK_HEAD + 4)[0]
    return track.floats(len(usual), _TRACK_HEAD + 6 + 4 * (splines & 0x1F).bit_count())


def _pose(node: _Node, nodes: dict[int, _Node]) -> Points:
    """The pose of a node in the scene. Raises `ValueError` for a circle of parents."""
    pose: Points = node.pose
    for _ in nodes:
        parent = nodes.get(node.parent)
        if parent is None:
            return pose
        node, pose = parent, parent.pose @ pose
    raise ValueError("its nodes are their own parents")


def _placed(item: _Object, pose: Points) -> Surface:
    """The object at a pose instead of where it is stored."""
    return _moved(item.surface, pose @ _inverse(item.frame))


def _moved(surface: Surface, by: Points) -> Surface:
    return Surface(surface.points @ by[:3, :3].T + by[:3, 3], surface.faces)


def _inverse(frame: Points) -> Points:
    """Raises `ValueError` for a frame without volume."""
    if not np.isfinite(frame).all() or abs(np.linalg.det(frame)) < 1e-30:
        raise ValueError("the frame of an object has no volume")
    inverse: Points = np.linalg.inv(frame).astype(np.float64)
    return inverse


def _shift(by: Points) -> Points:
    pose: Points = np.eye(4)
    pose[:3, 3] = by
    return pose


def _rotation(axis: Points, angle: float) -> Points:
    """Rodrigues' formula."""
    length = float(np.linalg.norm(axis))
    if length == 0:
        return np.eye(3)
    x, y, z = axis / length
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation: Points = np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew
    return rotation
