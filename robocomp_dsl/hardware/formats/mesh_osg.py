"""Meshes of the text formats of OpenSceneGraph, `.osg` and `.osgt`.

In: the bytes of a file. Out: points and faces of all geometries, transformed by the nodes above
them. Points without primitives have no faces; materials, animations and shapes other than boxes
are not read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.formats.osg_text import Line, OsgBlock, parse_blocks
from robocomp_dsl.hardware.formats.surface import (
    NO_FACES,
    Faces,
    Points,
    Surface,
    checked_surface,
    joined,
)

_MOST_POINTS = 5_000_000
_DEEPEST = 200
_BOX = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def read_osg(data: bytes) -> Surface:
    """Raises `ValueError` for a damaged file."""
    reader = _Reader()
    reader.collect(parse_blocks(data.decode("utf-8", "replace")), np.eye(4), 0)
    return joined(reader.surfaces)


@dataclass(slots=True)
class _Reader:
    """`shared` has the blocks with an identifier, which later places refer to."""

    surfaces: list[Surface] = field(default_factory=list)
    shared: dict[str, OsgBlock] = field(default_factory=dict)
    count: int = 0

    def collect(self, block: OsgBlock, above: Points, depth: int) -> None:
        """Add the geometries of a block; points are rows, so `above` is applied last."""
        if depth > _DEEPEST:
            raise ValueError("its nodes refer to each other")
        block = self._share(block)
        here = _transform(block) @ above
        if block.name == "ShapeDrawable":
            self._add(_shape(block), here)
        elif (points := self._points(block)) is not None:
            self._add(checked_surface(points, _faces(block)), here)
        for item in block.items:
            if isinstance(item, OsgBlock):
                self.collect(item, here, depth + 1)
            elif item[0] == "Use" and item[1:] and item[1] in self.shared:
                self.collect(self.shared[item[1]], here, depth + 1)

    def _share(self, block: OsgBlock) -> OsgBlock:
        """The block itself; for a bare reference in `.osgt` the block that it names."""
        name = _identifier(block)
        if not name:
            return block
        if len(block.items) > 1 or name not in self.shared:
            self.shared[name] = block
        return self.shared[name]

    def _points(self, block: OsgBlock) -> Points | None:
        """The points of a geometry; None if the block is none."""
        for item in block.items:
            head = item.head if isinstance(item, OsgBlock) else item
            if head[:1] != ["VertexArray"] and head[:1] != ["VertexData"]:
                continue
            if not isinstance(item, OsgBlock):  # VertexArray Use Vec3Array_1
                found = self.shared.get(item[2]) if item[1:2] == ["Use"] and item[2:] else None
                return _rows(found) if found else None
            if head[1:2] == ["UniqueID"]:
                self.shared[head[2]] = item
            return self._rows_of(item)
        return None

    def _rows_of(self, item: OsgBlock) -> Points:
        """The rows of an array, which `.osgt` wraps in further blocks."""
        while item.blocks:
            item = self._share(item.blocks[0])
            if vector := item.block("vector"):
                item = vector
        return _rows(item)

    def _add(self, surface: Surface, here: Points) -> None:
        self.count += len(surface.points)
        if self.count > _MOST_POINTS:
            raise ValueError(f"it has more than {_MOST_POINTS} points")
        self.surfaces.append(Surface(surface.points @ here[:3, :3] + here[3, :3], surface.faces))


def _identifier(block: OsgBlock) -> str:
    name = block.words("UniqueID")
    return name[0] if name else ""


def _rows(block: OsgBlock) -> Points:
    return block.numbers().reshape(-1, 3)


def _transform(block: OsgBlock) -> Points:
    """The transform of a node, for rows: p · M."""
    if block.name == "MatrixTransform" and (matrix := block.block("Matrix")):
        return matrix.numbers().reshape(4, 4)
    pose = np.eye(4)
    if block.name == "PositionAttitudeTransform":
        place, turn, scale, pivot = (
            _values(block, name, usual)
            for name, usual in (
                ("position", (0, 0, 0)),
                ("attitude", (0, 0, 0, 1)),
                ("scale", (1, 1, 1)),
                ("pivotPoint", (0, 0, 0)),
            )
        )
        pose[:3, :3] = np.diag(scale) @ _rotation(turn).T
        pose[3, :3] = place - pivot @ pose[:3, :3]
    return pose


def _values(block: OsgBlock, name: str, usual: Sequence[float]) -> Points:
    """The numbers of an attribute, whose first letter is a capital in `.osgt`."""
    words = block.words(name) or block.words(name[0].upper() + name[1:])
    return np.array(words or usual, float).reshape(len(usual))


def _rotation(quaternion: Points) -> Points:
    """The rotation matrix of (x, y, z, w)."""
    length = float(np.linalg.norm(quaternion))
    if length == 0:
        return np.eye(3)
    x, y, z, w = quaternion / length
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation: Points = np.eye(3) + 2 * w * skew + 2 * skew @ skew
    return rotation


def _shape(block: OsgBlock) -> Surface:
    """A box; other shapes are left out."""
    box = block.block("Box") or next((b.block("Box") for b in block.blocks if b.block("Box")), None)
    if box is None:
        return Surface(np.empty((0, 3)), NO_FACES)
    half = _values(box, "HalfLengths", (0.5, 0.5, 0.5))
    turn = _rotation(_values(box, "Rotation", (0, 0, 0, 1)))
    corners = np.array(list(product((-1, 1), repeat=3))) * half @ turn.T
    faces = _triangles("QUADS", np.array(_BOX).ravel())
    return Surface(corners + _values(box, "Center", (0, 0, 0)), faces)


def _faces(block: OsgBlock) -> Faces:
    """The triangles of all primitives of a geometry."""
    sets = block.block("PrimitiveSets") or block.block("PrimitiveSetList")
    found = [_primitive(item) for item in sets.items] if sets else []
    return np.concatenate([NO_FACES, *found])


def _primitive(item: Line | OsgBlock) -> Faces:
    """The triangles of one primitive: `.osg` has its mode in the head, `.osgt` below it."""
    head = item.head if isinstance(item, OsgBlock) else item
    head = [word for i, word in enumerate(head) if "UniqueID" not in head[max(0, i - 1) : i + 1]]
    kind = head[0].rpartition("::")[2]
    if not isinstance(item, OsgBlock):
        return _drawn(head[1], *map(int, head[2:4])) if kind == "DrawArrays" else NO_FACES
    mode = head[1] if head[1:] else next(iter(item.words("Mode")), "")
    content = item.block("vector") or item
    if kind == "DrawArrays":
        return _drawn(mode, _integer(item, "First"), _integer(item, "Count"))
    if kind == "DrawArrayLengths":
        first = int(head[2]) if head[2:] else _integer(item, "First")
        lengths = content.numbers().astype(np.int64)
        starts = first + np.cumsum([0, *lengths[:-1]])
        parts = [_drawn(mode, int(s), int(n)) for s, n in zip(starts, lengths, strict=True)]
        return np.concatenate([NO_FACES, *parts])
    if kind.startswith("DrawElements"):
        return _triangles(mode, content.numbers())
    return NO_FACES


def _integer(block: OsgBlock, name: str) -> int:
    """An attribute of `.osgt`, which leaves out a 0."""
    return int((block.words(name) or ["0"])[0])


def _drawn(mode: str, first: int, count: int) -> Faces:
    if not 0 <= count <= _MOST_POINTS:
        raise ValueError(f"a primitive of {count} points")
    return _triangles(mode, np.arange(first, first + count))


def _triangles(mode: str, corners: NDArray[np.generic]) -> Faces:
    """The triangles of a primitive of OpenGL; none for points and lines."""
    p = corners.astype(np.int32)
    mode = mode.removeprefix("GL_")
    quads = p[: len(p) // 4 * 4].reshape(-1, 4)
    inner = np.arange(max(len(p) - 2, 0))
    odd = inner % 2
    match mode:
        case "TRIANGLES":
            found = p[: len(p) // 3 * 3].reshape(-1, 3)
        case "QUADS":
            found = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
        case "TRIANGLE_STRIP" | "QUAD_STRIP":
            found = np.stack((p[inner + odd], p[inner + 1 - odd], p[inner + 2]), axis=1)
        case "TRIANGLE_FAN" | "POLYGON":
            found = np.stack((p[inner * 0], p[inner + 1], p[inner + 2]), axis=1)
        case _:
            found = NO_FACES
    distinct = (found[:, [0, 1, 2]] != found[:, [1, 2, 0]]).all(axis=1)
    triangles: Faces = found[distinct].astype(np.int32)
    return triangles
