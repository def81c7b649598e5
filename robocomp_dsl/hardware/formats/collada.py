"""Points of COLLADA files, as needed for a bounding box.

In: the bytes of a `.dae` file (COLLADA 1.4.1). Out: the corners of every geometry's box, in m with
z up, transformed by the nodes of its scene. Faces and materials are not read.
"""

from __future__ import annotations

import math
from itertools import product
from typing import TypeAlias
from xml.etree.ElementTree import Element, fromstring

import numpy as np
from numpy.typing import NDArray

Points: TypeAlias = NDArray[np.float64]

_UP = {
    "X_UP": np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]]),
    "Y_UP": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0.0]]),
    "Z_UP": np.eye(3),
}
_DEEPEST = 100


def collada_points(data: bytes) -> Points:
    """Points of shape (n, 3). Raises `ParseError` and `ValueError` for a damaged file."""
    # expat reads no other files and rejects entity expansion attacks (2.4.1 and later)
    root = fromstring(data)  # noqa: S314
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    boxes = {g.get("id", ""): _corners(g) for g in root.iter("geometry")}
    found: list[Points] = []
    for scene in root.iter("visual_scene"):
        for node in scene.findall("node"):
            _collect(node, np.eye(4), boxes, found, 0)
    points = np.concatenate(found or list(boxes.values()) or [np.empty((0, 3))])
    unit = root.find("asset/unit")
    metre = float(unit.get("meter", "1")) if unit is not None else 1.0
    up = (root.findtext("asset/up_axis") or "Y_UP").strip()
    scaled: Points = points @ _UP.get(up, _UP["Y_UP"]).T * metre
    return scaled


def _corners(geometry: Element) -> Points:
    """The eight corners of the box around a geometry; none if it has no points."""
    sources = {
        i.get("source", "")[1:] for i in geometry.iter("input") if i.get("semantic") == "POSITION"
    }
    for source in geometry.iter("source"):
        text = source.findtext("float_array") if source.get("id") in sources else None
        if text and text.strip():
            points = np.array(text.split(), dtype=np.float64).reshape(-1, 3)
            ends = np.stack((points.min(axis=0), points.max(axis=0))).T
            return np.array(list(product(*ends)))
    return np.empty((0, 3))


def _collect(
    node: Element, above: Points, boxes: dict[str, Points], found: list[Points], depth: int
) -> None:
    here = above @ _placed(node)
    for instance in node.findall("instance_geometry"):
        box = boxes.get(instance.get("url", "")[1:], np.empty((0, 3)))
        found.append(box @ here[:3, :3].T + here[:3, 3])
    if depth < _DEEPEST:
        for child in node.findall("node"):
            _collect(child, here, boxes, found, depth + 1)


def _placed(node: Element) -> Points:
    """The product of the node's transforms, in document order."""
    pose = np.eye(4)
    for element in node:
        step = np.eye(4)
        if element.tag not in {"matrix", "translate", "scale", "rotate"}:
            continue
        numbers = np.array((element.text or "").split(), dtype=np.float64)
        match element.tag:
            case "matrix":
                step = numbers.reshape(4, 4)
            case "translate":
                step[:3, 3] = numbers.reshape(3)
            case "scale":
                step[:3, :3] = np.diag(numbers.reshape(3))
            case "rotate":
                step[:3, :3] = _about(numbers[:3].reshape(3), math.radians(numbers[3]))
        pose = pose @ step
    return pose


def _about(axis: Points, angle: float) -> Points:
    """Rodrigues' formula."""
    length = float(np.linalg.norm(axis))
    if length == 0:
        return np.eye(3)
    x, y, z = (axis / length).tolist()
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation: Points = np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew
    return rotation
