"""A tree of moving frames, and the transforms between any two of them.

In: frames, changed one at a time. Out: points, poses and matrices between any two. Only requested
transforms are computed, and cached until a frame moves. Pure numpy; not thread-safe.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from robocomp_dsl.hardware.description.scene import ROOT, Frame, Motion, Triple
from robocomp_dsl.hardware.devices.errors import CommandRefused, FrameError, require_finite
from robocomp_dsl.hardware.kinematics.frame_layout import FrameLayout
from robocomp_dsl.hardware.kinematics.rotations import Matrix, angles, inverse, pose_rows

_AXIS = {"x": 0, "y": 1, "z": 2}


@dataclass(slots=True, eq=False)
class _Node:
    id: str
    parent: _Node | None
    pose: list[float]
    motion: Motion | None
    children: dict[str, _Node] = field(default_factory=dict)


class TransformTree:
    """Frames by their ids; the first is `root`."""

    def __init__(self, frames: Iterable[Frame] = ()) -> None:
        self._nodes = {ROOT: _Node(ROOT, None, [0.0] * 6, None)}
        self._layout: FrameLayout | None = None
        self._stale = True
        self._known: dict[tuple[str, str], tuple[float, ...]] = {}
        for frame in frames:
            if frame.id != ROOT:
                self.add(frame)

    # -- changing -----------------------------------------------------------------------------

    def add(self, frame: Frame) -> None:
        """Add a frame to its parent. Raises `FrameError`, `CommandRefused`."""
        if frame.id in self._nodes:
            raise FrameError(f"there is a frame `{frame.id}` already")
        parent = self._node(frame.parent)
        pose = [*frame.place, *frame.turn]
        _check(pose)
        node = _Node(frame.id, parent, pose, frame.motion)
        self._nodes[frame.id] = parent.children[frame.id] = node
        self._rebuild()

    def remove(self, frame: str) -> None:
        """Remove a frame with its subtree. Raises `FrameError`."""
        node = self._movable(frame)
        del _parent(node).children[frame]
        todo = [node]
        while todo:
            removed = todo.pop()
            del self._nodes[removed.id]
            todo.extend(removed.children.values())
        self._rebuild()

    def move(self, frame: str, parent: str) -> None:
        """Move a frame to another parent, with the same local pose. Raises `FrameError`."""
        node, into = self._movable(frame), self._node(parent)
        above: _Node | None = into
        while above is not None:
            if above is node:
                raise FrameError(f"`{parent}` is part of `{frame}` and cannot hold it")
            above = above.parent
        del _parent(node).children[frame]
        node.parent = into
        into.children[frame] = node
        self._rebuild()

    def set_pose(self, frame: str, pose: Sequence[float]) -> None:
        """Set the pose in the parent: x, y, z in mm, rx, ry, rz in rad."""
        node = self._movable(frame)
        if len(pose) != 6:
            raise CommandRefused(f"a pose has six numbers, not {len(pose)}")
        _check(pose)
        node.pose[:] = pose
        self._changed(node)

    def set_joint(self, frame: str, value: float) -> None:
        """Set the angle of a hinge [rad] or the distance of a slide [mm]; no limit check."""
        node = self._node(frame)
        require_finite(value=value)
        node.pose[_index(node)] = value + _motion(node).offset
        self._changed(node)

    def copy(self) -> TransformTree:
        """An independent tree with the same frames and poses."""
        twin = TransformTree()
        twin._nodes = nodes = {
            node.id: _Node(node.id, None, list(node.pose), node.motion)
            for node in self._nodes.values()
        }
        for node in self._nodes.values():
            nodes[node.id].parent = nodes[node.parent.id] if node.parent else None
            nodes[node.id].children = {child: nodes[child] for child in node.children}
        return twin

    # -- asking -------------------------------------------------------------------------------

    def __contains__(self, frame: object) -> bool:
        return frame in self._nodes

    def __iter__(self) -> Iterator[str]:
        """All frames, in insertion order."""
        return iter(self._nodes)

    def __len__(self) -> int:
        return len(self._nodes)

    def parent(self, frame: str) -> str:
        """The parent of `frame`; empty for the root."""
        above = self._node(frame).parent
        return above.id if above else ""

    def local(self, frame: str) -> tuple[float, ...]:
        """The pose in the parent, as set: x, y, z, rx, ry, rz."""
        return tuple(self._node(frame).pose)

    def joint(self, frame: str) -> float:
        """The value that `set_joint` sets."""
        node = self._node(frame)
        return node.pose[_index(node)] - _motion(node).offset

    def transform(self, point: Sequence[float], source: str, target: str) -> Triple:
        """A point of the frame `source`, expressed in the frame `target`, both mm."""
        known = self._known.get((source, target))
        if known is None:
            known = self._between(source, target)
        a, b, c, d, e, f, g, h, i, j, k, m = known
        x, y, z = point
        return (
            a * x + b * y + c * z + d,
            e * x + f * y + g * z + h,
            i * x + j * y + k * z + m,
        )

    def transform_all(self, points: Matrix, source: str, target: str) -> Matrix:
        """As `transform` for points of shape (n, 3)."""
        matrix = self.matrix(source, target)
        return points @ matrix[:3, :3].T + matrix[:3, 3]

    def matrix(self, source: str, target: str) -> Matrix:
        """The transform from `source` to `target`, shape (4, 4)."""
        layout = self._refreshed()
        try:
            seen, seer = layout.rows[source], layout.rows[target]
        except KeyError as missing:
            raise FrameError(f"there is no frame `{missing.args[0]}`") from None
        relative: Matrix = inverse(layout.world[seer]) @ layout.world[seen]
        return relative

    def pose(self, frame: str, base: str) -> tuple[float, ...]:
        """The pose of `frame` in `base`: x, y, z, rx, ry, rz."""
        matrix = self.matrix(frame, base)
        return (*map(float, matrix[:3, 3]), *angles(matrix[:3, :3]))

    def axis(self, joint: str, base: str) -> Matrix:
        """The axis of a joint in `base`, shape (3,), of unit length."""
        node = self._node(joint)
        motion, at = _motion(node), _AXIS[_motion(node).axis]
        before = [0.0] * 6
        if motion.kind == "hinge":  # rotations that precede it in Rx·Ry·Rz rotate the axis
            before[3 : 3 + at] = node.pose[3 : 3 + at]
        in_parent = np.array(pose_rows(before))[:3, at]
        direction: Matrix = self.matrix(_parent(node).id, base)[:3, :3] @ in_parent
        return direction

    def motion(self, joint: str) -> Motion:
        """The motion of a joint. Raises `FrameError` for a frame that is not a joint."""
        return _motion(self._node(joint))

    def path(self, frame: str) -> tuple[str, ...]:
        """The frame and all its ancestors, up to the root."""
        found = [self._node(frame)]
        while (above := found[-1].parent) is not None:
            found.append(above)
        return tuple(node.id for node in found)

    # -- inside -------------------------------------------------------------------------------

    def _between(self, source: str, target: str) -> tuple[float, ...]:
        known = tuple(self.matrix(source, target)[:3].ravel().tolist())
        self._known[source, target] = known
        return known

    def _refreshed(self) -> FrameLayout:
        layout = self._layout
        if layout is None:
            layout = self._layout = self._laid_out()
        if self._stale:
            layout.refresh()
            self._stale = False
        return layout

    def _laid_out(self) -> FrameLayout:
        levels = [[self._nodes[ROOT]]]
        while below := [child for node in levels[-1] for child in node.children.values()]:
            levels.append(below)
        return FrameLayout(
            [
                [(node.id, node.parent.id if node.parent else "", node.pose) for node in level]
                for level in levels
            ]
        )

    def _changed(self, node: _Node) -> None:
        if self._layout is not None:
            self._layout.set_pose(node.id, node.pose)
        self._stale = True
        self._known.clear()

    def _rebuild(self) -> None:
        self._layout = None
        self._stale = True
        self._known.clear()

    def _node(self, frame: str) -> _Node:
        found = self._nodes.get(frame)
        if found is None:
            raise FrameError(f"there is no frame `{frame}`")
        return found

    def _movable(self, frame: str) -> _Node:
        node = self._node(frame)
        if node.parent is None:
            raise FrameError(f"`{frame}` is the root and stays where it is")
        return node


def _parent(node: _Node) -> _Node:
    assert node.parent is not None  # noqa: S101  only the root has none, and callers exclude it
    return node.parent


def _motion(node: _Node) -> Motion:
    if node.motion is None:
        raise FrameError(f"`{node.id}` is no joint")
    return node.motion


def _index(node: _Node) -> int:
    """Index of the pose component that the joint moves."""
    motion = _motion(node)
    return _AXIS[motion.axis] + (3 if motion.kind == "hinge" else 0)


def _check(pose: Sequence[float]) -> None:
    require_finite(**dict(zip(("x", "y", "z", "rx", "ry", "rz"), pose, strict=True)))
