"""Changes of a scene during simulation: pure functions from a scene to a new scene.

In: a scene, and parts to add, move or remove. Out: a scene whose frames follow their parents, or
`NodeError` with the kind of error.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from enum import Enum

from robocomp_dsl.hardware.description.scene import ROOT, Box, Frame, Mesh, Scene
from robocomp_dsl.hardware.devices.errors import HardwareError

FIXED = (ROOT, "world")
"""Nodes that cannot be removed: the initial nodes of a world."""


class NodeErrorCode(Enum):
    """Kinds of errors of a change; the names are those of `InnerModelManager`."""

    MISSING = "NonExistingNode"
    NO_ATTRIBUTE = "NonExistingAttribute"
    EXISTS = "NodeAlreadyExists"
    ATTRIBUTE_EXISTS = "AttributeAlreadyExists"
    PATH = "InvalidPath"
    ENGINE = "InvalidEngine"
    VALUES = "InvalidValues"
    WRONG_NODE = "OperationInvalidNode"


class NodeError(HardwareError):
    """The change is not possible; the scene is unchanged."""

    def __init__(self, code: NodeErrorCode, message: str) -> None:
        super().__init__(message)
        self.code = code


def parents(scene: Scene) -> dict[str, str]:
    """The parent of every node; that of the root is empty. Depth first, in order of the scene."""
    below: dict[str, list[str]] = {}
    for frame in scene.frames:
        below.setdefault(frame.parent, []).append(frame.id)
    for frame_id, shape in _shapes(scene):
        below.setdefault(frame_id, []).append(shape)
    frames = {item.id for item in scene.frames}
    for device in scene.devices:
        if device.id not in frames:
            below.setdefault(device.frame, []).append(device.id)
    for skin in scene.skins:
        below.setdefault(skin.id, []).extend(patch.name for patch in skin.patches)
    found: dict[str, str] = {}
    todo = [(ROOT, "")]
    while todo:
        node, parent = todo.pop()
        found[node] = parent
        todo.extend((child, node) for child in reversed(below.get(node, [])))
    return found


def _shapes(scene: Scene) -> Iterator[tuple[str, str]]:
    """Every shape as (its frame, its id)."""
    yield from ((shape.frame, shape.id) for shape in scene.boxes)
    yield from ((shape.frame, shape.id) for shape in scene.meshes)


def frame_of(scene: Scene, id: str) -> Frame:
    """The frame `id`. Raises `NodeError` if it does not exist or is not a frame."""
    found = next((frame for frame in scene.frames if frame.id == id), None)
    if found is not None:
        return found
    if id in parents(scene):
        raise NodeError(NodeErrorCode.WRONG_NODE, f"`{id}` is no frame")
    raise NodeError(NodeErrorCode.MISSING, f"there is no node `{id}`")


def _require_parent(scene: Scene, id: str) -> None:
    found = frame_of(scene, id)
    if found.model_part in {"joint", "mark"}:
        message = (
            f"`{id}` is a {found.model_part} of the model file: only a body can hold something"
        )
        raise NodeError(NodeErrorCode.WRONG_NODE, message)


def _require_new(scene: Scene, id: str) -> None:
    if not id:
        raise NodeError(NodeErrorCode.VALUES, "a node needs a name")
    if id in parents(scene):
        raise NodeError(NodeErrorCode.EXISTS, f"there is a node `{id}` already")


def add_frame(scene: Scene, frame: Frame) -> Scene:
    """Add a frame."""
    _require_parent(scene, frame.parent)
    _require_new(scene, frame.id)
    return replace(scene, frames=(*scene.frames, frame))


def add_box(scene: Scene, box: Box) -> Scene:
    """Add a box."""
    _require_parent(scene, box.frame)
    _require_new(scene, box.id)
    return replace(scene, boxes=(*scene.boxes, box))


def add_mesh(scene: Scene, mesh: Mesh) -> Scene:
    """Add a mesh."""
    _require_parent(scene, mesh.frame)
    _require_new(scene, mesh.id)
    return replace(scene, meshes=(*scene.meshes, mesh))


def replace_frame(scene: Scene, frame: Frame) -> Scene:
    """Replace the frame with the id of `frame`."""
    frame_of(scene, frame.id)
    return replace(
        scene, frames=tuple(frame if old.id == frame.id else old for old in scene.frames)
    )


def replace_box(scene: Scene, box: Box) -> Scene:
    """Replace the box with the id of `box`."""
    _require_kind(scene, box.id, scene.boxes, "plane")
    return replace(scene, boxes=tuple(box if old.id == box.id else old for old in scene.boxes))


def rescale_node(scene: Scene, id: str, scale: tuple[float, float, float]) -> Scene:
    """The mesh `id` with another scale."""
    _require_kind(scene, id, scene.meshes, "mesh")
    meshes = tuple(replace(mesh, scale=scale) if mesh.id == id else mesh for mesh in scene.meshes)
    return replace(scene, meshes=meshes)


def box_of(scene: Scene, id: str) -> Box:
    """The box `id`."""
    _require_kind(scene, id, scene.boxes, "plane")
    return next(box for box in scene.boxes if box.id == id)


def _require_kind(scene: Scene, id: str, those: Iterable[Box | Mesh], what: str) -> None:
    if any(node.id == id for node in those):
        return
    if id in parents(scene):
        raise NodeError(NodeErrorCode.WRONG_NODE, f"`{id}` is no {what}")
    raise NodeError(NodeErrorCode.MISSING, f"there is no node `{id}`")


def subtree(scene: Scene, id: str) -> set[str]:
    """`id` and all nodes below it."""
    above = parents(scene)
    if id not in above:
        raise NodeError(NodeErrorCode.MISSING, f"there is no node `{id}`")
    found = {id}
    for node, parent in above.items():  # parents precede their children
        if parent in found:
            found.add(node)
    return found


def _require_changeable(scene: Scene, id: str, done: str) -> None:
    if id in FIXED:
        raise NodeError(NodeErrorCode.WRONG_NODE, f"`{id}` cannot be {done}")
    fixed = {frame.id for frame in scene.frames if frame.model_part}
    own = {
        frame.id
        for frame in scene.devices
        if frame.frame in fixed or frame.kind.startswith("model_")
    }
    if id in fixed | own:
        raise NodeError(
            NodeErrorCode.WRONG_NODE, f"`{id}` is of the model file and cannot be {done}"
        )


def remove_node(scene: Scene, id: str) -> Scene:
    """The scene without a node and its subtree."""
    _require_changeable(scene, id, "removed")
    gone = subtree(scene, id)
    return replace(
        scene,
        frames=tuple(node for node in scene.frames if node.id not in gone),
        boxes=tuple(node for node in scene.boxes if node.id not in gone),
        meshes=tuple(node for node in scene.meshes if node.id not in gone),
        devices=tuple(node for node in scene.devices if node.id not in gone),
        skins=tuple(node.without(gone) for node in scene.skins if node.id not in gone),
    )


def move_node(scene: Scene, id: str, into: str) -> Scene:
    """Move a node with its subtree to another frame; its local pose is unchanged."""
    _require_changeable(scene, id, "moved into another")
    below = subtree(scene, id)
    if any(id == patch.name for skin in scene.skins for patch in skin.patches):
        raise NodeError(NodeErrorCode.WRONG_NODE, f"`{id}` stays in its skin")
    _require_parent(scene, into)
    if into in below:
        raise NodeError(NodeErrorCode.WRONG_NODE, f"`{into}` is part of `{id}` and cannot hold it")
    frames = tuple(replace(node, parent=into) if node.id == id else node for node in scene.frames)
    return replace(
        scene,
        frames=_in_order(frames),
        boxes=tuple(replace(node, frame=into) if node.id == id else node for node in scene.boxes),
        meshes=tuple(replace(node, frame=into) if node.id == id else node for node in scene.meshes),
        devices=tuple(
            replace(node, frame=into) if node.id == id and node.frame != id else node
            for node in scene.devices
        ),
        skins=tuple(node.moved_to(into) if node.id == id else node for node in scene.skins),
    )


def _in_order(frames: tuple[Frame, ...]) -> tuple[Frame, ...]:
    """Parents before their children."""
    below: dict[str, list[Frame]] = {}
    for frame in frames:
        below.setdefault(frame.parent, []).append(frame)
    done: list[Frame] = []
    todo = list(below[""])
    while todo:
        frame = todo.pop(0)
        done.append(frame)
        todo.extend(below.get(frame.id, []))
    return tuple(done)
