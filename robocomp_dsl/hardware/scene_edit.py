"""Changes of a scene while it is simulated: pure functions from a scene to another one.

In: a scene and what is to be added, moved or taken away. Out: a scene whose frames come after their
parents again, or `NodeError` with the kind of mistake.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from enum import Enum

from robocomp_dsl.hardware.errors import HardwareError
from robocomp_dsl.hardware.scene import ROOT, Box, Frame, Mesh, Scene

FIXED = (ROOT, "world")
"""Nodes that stay: what a world begins with."""


class Mistake(Enum):
    """What can be wrong with a change; the names are those of `InnerModelManager`."""

    MISSING = "NonExistingNode"
    NO_ATTRIBUTE = "NonExistingAttribute"
    EXISTS = "NodeAlreadyExists"
    ATTRIBUTE_EXISTS = "AttributeAlreadyExists"
    PATH = "InvalidPath"
    VALUES = "InvalidValues"
    WRONG_NODE = "OperationInvalidNode"


class NodeError(HardwareError):
    """The change cannot be made; the scene is as it was."""

    def __init__(self, mistake: Mistake, said: str) -> None:
        super().__init__(said)
        self.mistake = mistake


def parents(scene: Scene) -> dict[str, str]:
    """The parent of every node; that of the root is empty. Depth first, in order of the scene."""
    below: dict[str, list[str]] = {}
    for frame in scene.frames:
        below.setdefault(frame.parent, []).append(frame.id)
    for frame_id, shape in _shapes(scene):
        below.setdefault(frame_id, []).append(shape)
    frames = {one.id for one in scene.frames}
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
    yield from ((one.frame, one.id) for one in scene.boxes)
    yield from ((one.frame, one.id) for one in scene.meshes)


def frame_of(scene: Scene, id: str) -> Frame:
    """The frame `id`. Raises `NodeError` for another node and for none."""
    found = next((one for one in scene.frames if one.id == id), None)
    if found is not None:
        return found
    if id in parents(scene):
        raise NodeError(Mistake.WRONG_NODE, f"`{id}` is no frame")
    raise NodeError(Mistake.MISSING, f"there is no node `{id}`")


def _is_holder(scene: Scene, id: str) -> None:
    found = frame_of(scene, id)
    if found.given in {"joint", "mark"}:
        said = f"`{id}` is a {found.given} of the model file: only a body can hold something"
        raise NodeError(Mistake.WRONG_NODE, said)


def _is_new(scene: Scene, id: str) -> None:
    if not id:
        raise NodeError(Mistake.VALUES, "a node needs a name")
    if id in parents(scene):
        raise NodeError(Mistake.EXISTS, f"there is a node `{id}` already")


def with_frame(scene: Scene, frame: Frame) -> Scene:
    """One more frame."""
    _is_holder(scene, frame.parent)
    _is_new(scene, frame.id)
    return replace(scene, frames=(*scene.frames, frame))


def with_box(scene: Scene, box: Box) -> Scene:
    """One more box."""
    _is_holder(scene, box.frame)
    _is_new(scene, box.id)
    return replace(scene, boxes=(*scene.boxes, box))


def with_mesh(scene: Scene, mesh: Mesh) -> Scene:
    """One more mesh."""
    _is_holder(scene, mesh.frame)
    _is_new(scene, mesh.id)
    return replace(scene, meshes=(*scene.meshes, mesh))


def changed_frame(scene: Scene, frame: Frame) -> Scene:
    """`frame` in the place of the one with its id."""
    frame_of(scene, frame.id)
    return replace(
        scene, frames=tuple(frame if one.id == frame.id else one for one in scene.frames)
    )


def changed_box(scene: Scene, box: Box) -> Scene:
    """`box` in the place of the one with its id, which must be a box."""
    _is_kind(scene, box.id, scene.boxes, "plane")
    return replace(scene, boxes=tuple(box if one.id == box.id else one for one in scene.boxes))


def rescaled(scene: Scene, id: str, scale: tuple[float, float, float]) -> Scene:
    """The mesh `id` with another scale."""
    _is_kind(scene, id, scene.meshes, "mesh")
    meshes = tuple(replace(one, scale=scale) if one.id == id else one for one in scene.meshes)
    return replace(scene, meshes=meshes)


def box_of(scene: Scene, id: str) -> Box:
    """The box `id`."""
    _is_kind(scene, id, scene.boxes, "plane")
    return next(one for one in scene.boxes if one.id == id)


def _is_kind(scene: Scene, id: str, those: Iterable[Box | Mesh], what: str) -> None:
    if any(one.id == id for one in those):
        return
    if id in parents(scene):
        raise NodeError(Mistake.WRONG_NODE, f"`{id}` is no {what}")
    raise NodeError(Mistake.MISSING, f"there is no node `{id}`")


def subtree(scene: Scene, id: str) -> set[str]:
    """`id` and all nodes below it."""
    above = parents(scene)
    if id not in above:
        raise NodeError(Mistake.MISSING, f"there is no node `{id}`")
    found = {id}
    for node, parent in above.items():  # parents come first
        if parent in found:
            found.add(node)
    return found


def _is_changeable(scene: Scene, id: str, done: str) -> None:
    if id in FIXED:
        raise NodeError(Mistake.WRONG_NODE, f"`{id}` cannot be {done}")
    given = {one.id for one in scene.frames if one.given}
    own = {one.id for one in scene.devices if one.frame in given or one.kind.startswith("model_")}
    if id in given | own:
        raise NodeError(Mistake.WRONG_NODE, f"`{id}` is of the model file and cannot be {done}")


def without(scene: Scene, id: str) -> Scene:
    """The scene without a node and all below it."""
    _is_changeable(scene, id, "removed")
    gone = subtree(scene, id)
    return replace(
        scene,
        frames=tuple(one for one in scene.frames if one.id not in gone),
        boxes=tuple(one for one in scene.boxes if one.id not in gone),
        meshes=tuple(one for one in scene.meshes if one.id not in gone),
        devices=tuple(one for one in scene.devices if one.id not in gone),
        skins=tuple(one.without(gone) for one in scene.skins if one.id not in gone),
    )


def moved(scene: Scene, id: str, into: str) -> Scene:
    """A node, with all below it, in another frame; its pose is told there as before."""
    _is_changeable(scene, id, "moved into another")
    below = subtree(scene, id)
    if any(id == patch.name for skin in scene.skins for patch in skin.patches):
        raise NodeError(Mistake.WRONG_NODE, f"`{id}` stays in its skin")
    _is_holder(scene, into)
    if into in below:
        raise NodeError(Mistake.WRONG_NODE, f"`{into}` is part of `{id}` and cannot hold it")
    frames = tuple(replace(one, parent=into) if one.id == id else one for one in scene.frames)
    return replace(
        scene,
        frames=_in_order(frames),
        boxes=tuple(replace(one, frame=into) if one.id == id else one for one in scene.boxes),
        meshes=tuple(replace(one, frame=into) if one.id == id else one for one in scene.meshes),
        devices=tuple(
            replace(one, frame=into) if one.id == id and one.frame != id else one
            for one in scene.devices
        ),
        skins=tuple(one.moved_to(into) if one.id == id else one for one in scene.skins),
    )


def _in_order(frames: tuple[Frame, ...]) -> tuple[Frame, ...]:
    """Parents before their children."""
    below: dict[str, list[Frame]] = {}
    for one in frames:
        below.setdefault(one.parent, []).append(one)
    done: list[Frame] = []
    todo = list(below[""])
    while todo:
        one = todo.pop(0)
        done.append(one)
        todo.extend(below.get(one.id, []))
    return tuple(done)
