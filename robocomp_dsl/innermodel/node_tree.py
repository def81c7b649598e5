"""The nodes of an InnerModel while a program runs: their values, and the poses of their frames.

In: a resolved model, and changes. Out: nodes with their current values, and the transform tree of
their frames. A node that is no frame (a plane, a mesh, a camera) is seen at the frame that holds
it, as in RoboComp. Not thread-safe. All methods raise `InnerModelError`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TypeVar

from robocomp_dsl.check.innermodel.resolve import MAX_DEPTH
from robocomp_dsl.diagnostics import did_you_mean
from robocomp_dsl.generate.scene.frames import lower_frame
from robocomp_dsl.hardware.description.scene import Frame, frame_of_data
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.model import innermodel

POSE = ("tx", "ty", "tz", "rx", "ry", "rz")
Kind = TypeVar("Kind", bound=innermodel.Node)


@dataclass(slots=True, eq=False)
class Entry:
    """A node. `node` has the values without those of `transforms`.

    `original` is the node as it was read, None for a new one.
    """

    node: innermodel.Node
    parent: str
    original: innermodel.Node | None
    children: list[str] = field(default_factory=list)


class NodeTree:
    """`frames` maps each id to the frame where the node is seen: itself, or what holds it."""

    def __init__(self, model: innermodel.InnerModel) -> None:
        root = model.root
        self.root = root.id
        self.entries = {root.id: Entry(root, "", root)}
        self.frames = {root.id: root.id}
        self.transforms = TransformTree()
        for node, parent in model.nodes():
            if parent is not None:
                self._insert(node, parent, node)

    # -- reading ------------------------------------------------------------------------------

    def entry(self, id: str) -> Entry:
        """The entry of a node."""
        found = self.entries.get(id)
        if found is None:
            raise self.unknown(id)
        return found

    def unknown(self, id: object) -> InnerModelError:
        """The error for an id that no node has."""
        label = did_you_mean(id, self.entries) if isinstance(id, str) else "an id is a string"
        return InnerModelError(f"there is no node `{id}`" + (f": {label}" if label else ""))

    def node(self, id: str) -> innermodel.Node:
        """The node with its current values."""
        node = self.entry(id).node
        if isinstance(node, innermodel.Transform) and id != self.root:
            tx, ty, tz, rx, ry, rz = pose = self.transforms.local(id)
            if pose != (node.tx, node.ty, node.tz, node.rx, node.ry, node.rz):
                return replace(node, tx=tx, ty=ty, tz=tz, rx=rx, ry=ry, rz=rz)
        if isinstance(node, innermodel.PrismaticJoint):
            position = self.transforms.joint(id)
            if position != (node.position or 0.0):
                return replace(node, position=position)
        return node

    def node_of(self, id: str, kind: type[Kind], noun: str) -> Kind:
        """The node, if it is of this class."""
        node = self.node(id)
        if not isinstance(node, kind):
            raise InnerModelError(f"`{id}` is a `{node.tag}`, not {noun}")
        return node

    def subtree(self, id: str) -> Iterator[str]:
        """The ids of a node and of all below it, parents first."""
        todo = [id]
        while todo:
            below = todo.pop()
            yield below
            todo.extend(reversed(self.entry(below).children))

    # -- changing -----------------------------------------------------------------------------

    def add(self, node: innermodel.Node, parent: str) -> None:
        """Add a new node as the last child of a frame."""
        if node.id in self.entries:
            raise InnerModelError(f"there is a node `{node.id}` already")
        holder = self._holder(parent)
        self._require_depth(self._depth(parent) + 1)
        self._insert(node, holder.node, None)

    def remove(self, id: str) -> list[str]:
        """Remove a node with all below it; their ids, parents first."""
        self._movable(id)
        removed = list(self.subtree(id))
        self.entries[self.entries[id].parent].children.remove(id)
        if self.frames[id] == id:
            self.transforms.remove(id)
        for gone in removed:
            del self.entries[gone], self.frames[gone]
        return removed

    def move(self, id: str, parent: str) -> None:
        """Move a node with all below it to another frame; its pose in its parent stays."""
        entry, holder = self._movable(id), self._holder(parent)
        if parent in self.subtree(id):
            raise InnerModelError(f"`{parent}` is part of `{id}` and cannot hold it")
        if isinstance(entry.node, innermodel.Motor):
            raise InnerModelError(f"`{id}` is the motor of `{entry.parent}` and stays there")
        if parent == entry.parent:
            return
        below = max(map(self._depth, self.subtree(id))) - self._depth(id)
        self._require_depth(self._depth(parent) + 1 + below)
        if self.frames[id] == id:
            self.transforms.move(id, parent)
        else:
            self.frames |= dict.fromkeys(self.subtree(id), parent)
        self.entries[entry.parent].children.remove(id)
        holder.children.append(id)
        entry.parent = parent

    # -- inside -------------------------------------------------------------------------------

    def _insert(
        self, node: innermodel.Node, parent: innermodel.Node, original: innermodel.Node | None
    ) -> None:
        self.entries[node.id] = Entry(node, parent.id, original)
        self.entries[parent.id].children.append(node.id)
        self.frames[node.id] = node.id if innermodel.is_frame(node) else self.frames[parent.id]
        if isinstance(node, innermodel.Transform | innermodel.PrismaticJoint):
            self.transforms.add(frame_of_data(lower_frame(node, parent, at_home=False)))
        elif innermodel.is_frame(node):
            self.transforms.add(Frame(node.id, parent.id))

    def _holder(self, id: str) -> Entry:
        entry = self.entry(id)
        if not innermodel.is_frame(entry.node):
            raise InnerModelError(f"`{id}` is a `{entry.node.tag}`: it cannot hold other nodes")
        return entry

    def _depth(self, id: str) -> int:
        """The number of nodes above a node."""
        depth = 0
        above = self.entries[id].parent
        while above:
            depth, above = depth + 1, self.entries[above].parent
        return depth

    def _require_depth(self, depth: int) -> None:
        if depth > MAX_DEPTH:
            raise InnerModelError(f"nodes are nested at most {MAX_DEPTH} deep")

    def _movable(self, id: str) -> Entry:
        entry = self.entry(id)
        if id == self.root:
            raise InnerModelError(f"`{id}` is the root of the model and stays")
        if isinstance(entry.node, innermodel.Patch | innermodel.Taxel):
            raise InnerModelError(f"`{id}` is part of a skin and stays there")
        return entry

    def copy(self) -> NodeTree:
        """An independent tree with the same nodes and poses."""
        twin = NodeTree.__new__(NodeTree)
        twin.root = self.root
        twin.frames = dict(self.frames)
        twin.transforms = self.transforms.copy()
        twin.entries = {
            name: Entry(entry.node, entry.parent, entry.original, list(entry.children))
            for name, entry in self.entries.items()
        }
        return twin
