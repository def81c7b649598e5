"""`InnerModel`: the nodes of a robot and its world, for the code of a component.

In: an InnerModel file. Out: transforms between its nodes, while they move; and the file again, with
what has changed. The names are those of RoboComp's binding `librobocomp_innermodel` and of the C++
class behind it. Lengths are mm, angles rad; x points right, y up, z ahead. Results are numpy
arrays. All methods may be called by any thread.
"""

# ruff: noqa: N802, N803  names as in RoboComp

from __future__ import annotations

import threading
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from robocomp_dsl.innermodel.cameras import CameraGeometry
from robocomp_dsl.innermodel.new_nodes import NewNodes
from robocomp_dsl.innermodel.node_tree import NodeTree
from robocomp_dsl.innermodel.read import InnerModelFile, parse_text, read_file
from robocomp_dsl.innermodel.shared_state import NodeOrId, id_of, locked
from robocomp_dsl.innermodel.write import render, write_file
from robocomp_dsl.model import innermodel

if TYPE_CHECKING:
    from robocomp_dsl.finding import Finding

Kind = TypeVar("Kind", bound=innermodel.Node)
_EMPTY = "<innerModel>\n</innerModel>\n"


class InnerModel(NewNodes, CameraGeometry):
    """The nodes of an InnerModel, with poses that change.

    `warnings` are the findings of the file that are no errors.
    """

    _file: InnerModelFile

    def __init__(self, xmlFilePath: str | Path | InnerModel | None = None) -> None:
        """Load a file with all files that it includes, copy a model, or begin with the root only.

        Raises `InnerModelError` with all errors of the files and where they are.
        """
        self.lock = threading.RLock()
        if isinstance(xmlFilePath, InnerModel):
            with xmlFilePath.lock:
                self._file, self._tree = xmlFilePath._file, xmlFilePath._tree.copy()
        elif xmlFilePath is None:
            self._start(parse_text(_EMPTY, Path("innermodel.xml")))
        else:
            self._start(read_file(Path(xmlFilePath)))

    @classmethod
    def fromString(cls, text: str, folder: str | Path = ".") -> InnerModel:
        """The model in `text`; includes are relative to `folder`. Raises `InnerModelError`."""
        model = cls.__new__(cls)
        model.lock = threading.RLock()
        model._start(parse_text(text, Path(folder, "innermodel.xml")))
        return model

    def _start(self, file: InnerModelFile) -> None:
        self._file = file
        self._tree = NodeTree(file.model)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """The findings of the file that are no errors."""
        return self._file.warnings

    # -- copies and files ---------------------------------------------------------------------

    def copy(self) -> InnerModel:
        """An independent model with the same nodes and poses."""
        return InnerModel(self)

    def __copy__(self) -> InnerModel:
        return self.copy()

    def __deepcopy__(self, _: object) -> InnerModel:
        return self.copy()

    def save(self, path: str | Path) -> bool:
        """Write the model as XML: the text that was read, with what has changed since.

        Comments, layout, order and units stay; without a change the file is the same, byte for
        byte. An included file is written into this one if a node from it has changed, so that only
        `path` is written. Relative names of files stay as they are. Returns True. Raises
        `InnerModelError` if the file cannot be written; then an existing file is unchanged.
        """
        write_file(Path(path), self.toString(), self._file.encoding)
        return True

    @locked
    def toString(self) -> str:
        """The text that `save` writes."""
        return render(self._tree, self._file.model, self._file.source)

    # -- nodes --------------------------------------------------------------------------------

    @locked
    def getIDKeys(self) -> list[str]:
        """The ids of all nodes, parents first."""
        return list(self._tree.subtree(self._tree.root))

    @locked
    def getNode(self, id: str) -> innermodel.Node | None:
        """A node with its current values, or None; its fields are those of the attributes."""
        return self._tree.node(id) if id in self._tree.entries else None

    @locked
    def getRoot(self) -> innermodel.Node:
        """The root."""
        return self._tree.node(self._tree.root)

    @locked
    def getParentIdentifier(self, id: str) -> str:
        """The id of the node that holds `id`; empty for the root."""
        return self._tree.entry(id).parent

    @locked
    def getSubTree(self, node: NodeOrId) -> list[str]:
        """The ids of a node and of all nodes below it, parents first."""
        return list(self._tree.subtree(id_of(node)))

    @locked
    def removeSubTree(self, node: NodeOrId) -> list[str]:
        """Remove a node and all nodes below it; returns their ids."""
        return self._tree.remove(id_of(node))

    def removeNode(self, id: NodeOrId) -> None:
        """Remove a node and all nodes below it."""
        self.removeSubTree(id)

    @locked
    def moveSubTree(self, nodeSrc: NodeOrId, nodeDst: NodeOrId) -> None:
        """Move a node and all nodes below it to another frame; its pose in its parent stays."""
        self._tree.move(id_of(nodeSrc), id_of(nodeDst))

    def getTransform(self, id: str) -> innermodel.Transform:
        """A transform, joint or base with its current values."""
        return self._get(id, innermodel.Transform, "a transform")

    def getDifferentialRobot(self, id: str) -> innermodel.Base:
        """A base with its current values."""
        return self._get(id, innermodel.Base, "a base")

    def getOmniRobot(self, id: str) -> innermodel.Base:
        """A base with its current values."""
        return self._get(id, innermodel.Base, "a base")

    def getCamera(self, id: str) -> innermodel.Camera:
        """A camera with its values."""
        return self._get(id, innermodel.Camera, "a camera")

    def getRGBD(self, id: str) -> innermodel.Camera:
        """A camera with its values."""
        return self._get(id, innermodel.Camera, "a camera")

    def getLaser(self, id: str) -> innermodel.Laser:
        """A laser with its values."""
        return self._get(id, innermodel.Laser, "a laser")

    def getIMU(self, id: str) -> innermodel.Imu:
        """An inertial measurement unit with its values."""
        return self._get(id, innermodel.Imu, "an IMU")

    def getPlane(self, id: str) -> innermodel.Plane:
        """A plane or display with its current values."""
        return self._get(id, innermodel.Plane, "a plane")

    def getMesh(self, id: str) -> innermodel.Mesh:
        """A mesh with its values."""
        return self._get(id, innermodel.Mesh, "a mesh")

    def getTouchSensor(self, id: str) -> innermodel.TouchSensor:
        """A touch sensor with its values."""
        return self._get(id, innermodel.TouchSensor, "a touch sensor")

    def getPointCloud(self, id: str) -> innermodel.PointCloud:
        """A point cloud."""
        return self._get(id, innermodel.PointCloud, "a point cloud")

    @locked
    def _get(self, id: str, kind: type[Kind], noun: str) -> Kind:
        return self._tree.node_of(id, kind, noun)

    @locked
    def __contains__(self, id: object) -> bool:
        return id in self._tree.entries

    @locked
    def __len__(self) -> int:
        return len(self._tree.entries)

    @locked
    def __str__(self) -> str:
        """The nodes as an indented list."""
        lines = []
        depth = {self._tree.root: 0}
        for name in self._tree.subtree(self._tree.root):
            entry = self._tree.entries[name]
            depth |= dict.fromkeys(entry.children, depth[name] + 1)
            lines.append(f"{'  ' * depth[name]}{name} ({entry.node.tag})")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"InnerModel({str(self._file.source.path)!r}, {len(self)} nodes)"
